"""Figures 7 and 8: the waviness, over whose amplitude s oscillates, and the frequency ratio."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from swtstudy.paper.statements.measures import at, even, listed, spread, turning_points, with_dims
from swtstudy.paper.statements.statement import Measured
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.wording import value_words

#: Ripples below this fraction of a curve's range do not count as oscillations.
_RIPPLE = 0.1


def matters(figure7: xr.Dataset, at_least: float) -> Measured:
    """Largest over smallest s of each curve."""
    ratios = spread(figure7, "waviness_amplitude", "wavelength", "normal_amplitude")
    rows = {row.wavelength.item(): "/".join(f"{value:.2f}" for value in row.values) for row in ratios}
    words = (f"{value_words('wavelength', place)}: {row}" for place, row in rows.items())
    amplitudes = "/".join(f"{value:g}" for value in ratios.normal_amplitude.values)
    return (ratios >= at_least).all(), {"ratios": ", ".join(words), "amplitudes": amplitudes}


def raises_and_lowers(figure3: xr.Dataset, figure7: xr.Dataset, by: float) -> Measured:
    """Extreme s over s of the paraboloid, at each amplitude."""
    holds, words = True, []
    for amplitude in figure7.normal_amplitude.values.tolist():
        relative = (
            at(figure7, normal_amplitude=amplitude).s / at(figure3, normal_amplitude=amplitude, phase=0).s
        )
        low, high = float(relative.min()) - 1, float(relative.max()) - 1
        holds = holds and low <= -by and high >= by
        words.append(f"δA/δ0 = {amplitude:g}: {low:+.0%} to {high:+.0%}")
    return holds, {"changes": "; ".join(words)}


class Oscillation(NamedTuple):
    """The oscillation of one curve.

    Attributes
    ----------
    periods
        Distances from one maximum to the next, and from one minimum to the next, alternately.
    swings
        Absolute changes of s from each turning point to the next.
    """

    periods: FloatArray
    swings: FloatArray


def oscillations(dataset: xr.Dataset, *others: str) -> list[Oscillation]:
    """The oscillation of every curve over h/δ0; the curves differ in other parameters."""
    curves = with_dims(dataset, "waviness_amplitude", *others).sortby("waviness_amplitude").s
    h, found = curves.waviness_amplitude.values, []
    for s in curves.transpose(..., "waviness_amplitude").values.reshape(-1, len(h)):
        turns = turning_points(s, _RIPPLE * float(np.ptp(s)))
        found.append(Oscillation(h[turns][2:] - h[turns][:-2], np.abs(np.diff(s[turns]))))
    return found


def growing(found: Sequence[Oscillation]) -> tuple[BoolArray, BoolArray]:
    """True if each period exceeds the last one, and each rise, or fall, the last rise, or fall."""
    periods = np.concatenate([np.diff(one.periods) for one in found])
    swings = np.concatenate([one.swings[2:] - one.swings[:-2] for one in found])
    return periods > 0, swings > 0


def as_a_rule(steps: Sequence[BoolArray], share: float) -> bool:
    """Return whether so many of the steps follow each trend; False without any step."""
    return all(len(each) and each.mean() >= share for each in steps)


def oscillations_shrink(figure7: xr.Dataset, share: float) -> Measured:
    """Growth of periods and swings with h on all curves together."""
    found = oscillations(figure7, "wavelength", "normal_amplitude")
    steps, longest = growing(found), max(found, key=lambda one: len(one.swings))
    periods, swings = (f"{each.sum()} of {len(each)}" for each in steps)
    ends = (f"{each[0]:.2g} to {each[-1]:.2g}" if len(each) else "none" for each in longest)
    words = {"periods": periods, "swings": swings, "curves": len(found)}
    return as_a_rule(steps, share), words | dict(
        zip(("longest_periods", "longest_swings"), ends, strict=True)
    )


def effects_are_alike(figure7: xr.Dataset, at_most: float) -> Measured:
    """Logarithm of largest over smallest s, its mean over the wavelengths, at both amplitudes."""
    sizes = np.log(spread(figure7, "waviness_amplitude", "normal_amplitude", "wavelength").values)
    smaller, larger, each = sizes[0].mean(), sizes[-1].mean(), sizes[-1] / sizes[0] - 1
    change = larger / smaller - 1
    values = {"smaller": smaller, "larger": larger, "change": change, "least": each.min(), "most": each.max()}
    return abs(change) <= at_most, values


def curves_are_alike(figure7: xr.Dataset, at_most: float) -> Measured:
    """Distance of the curves at both amplitudes, each over its mean, over the effect of h."""
    s = even(with_dims(figure7, "normal_amplitude"), "waviness_amplitude").s.sortby("normal_amplitude")
    effect = s / s.mean("waviness_amplitude") - 1
    distance = effect.isel(normal_amplitude=-1) - effect.isel(normal_amplitude=0)
    share = np.sqrt((distance**2).mean() / (effect**2).mean())
    return share <= at_most, {"share": share}


def half_differs_most(figure8: xr.Dataset) -> Measured:
    """Mean over h of |ln s(π)/s(0)|."""
    curves = even(with_dims(figure8, "phase", "frequency_ratio"), "waviness_amplitude")
    change = np.abs(np.log(at(curves, phase=math.pi).s / at(curves, phase=0).s)).mean("waviness_amplitude")
    return change.idxmax("frequency_ratio") == 0.5, {"changes": listed(change)}


def trends_are_similar(figure8: xr.Dataset, share: float) -> Measured:
    """Growth of periods and swings with h on each curve, and correlation of two curves."""
    found = oscillations(figure8, "phase", "frequency_ratio")
    alike = sum(as_a_rule(growing([one]), share) for one in found)
    curves = figure8.s.transpose(..., "waviness_amplitude").values.reshape(len(found), -1)
    correlation = np.corrcoef(curves)[np.triu_indices(len(curves), 1)]
    extent = {"median": np.median(correlation), "least": correlation.min(), "most": correlation.max()}
    return alike == len(found), {"alike": alike, "curves": len(found), **extent}
