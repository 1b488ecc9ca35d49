"""Figures 7 and 8: the waviness, over whose amplitude s oscillates, and the frequency ratio."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from swtstudy.paper.statements.face import WEAK, coupling_with
from swtstudy.paper.statements.statement import (
    Finding,
    at,
    even,
    listed,
    spread,
    statement,
    turning_points,
    with_dims,
)
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.wording import value_words

#: Ripples below this fraction of a curve's range do not count as oscillations.
_RIPPLE = 0.1
#: Share of the steps that must follow a trend for it to hold as a rule.
AS_A_RULE = 0.8


@dataclass(frozen=True)
class Oscillation:
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

    @classmethod
    def of(cls, x: FloatArray, s: FloatArray) -> Oscillation:
        """The oscillation of s over ascending x."""
        turns = turning_points(s, _RIPPLE * float(np.ptp(s)))
        return cls(x[turns][2:] - x[turns][:-2], np.abs(np.diff(s[turns])))


def longer_periods(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Number of steps over which the period grows, and of all steps."""
    return _growing([np.diff(oscillation.periods) for oscillation in oscillations])


def larger_swings(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Number of steps over which a rise exceeds the last rise, or a fall the last fall, and of all steps."""
    return _growing([oscillation.swings[2:] - oscillation.swings[:-2] for oscillation in oscillations])


def _growing(changes: list[FloatArray]) -> tuple[int, int]:
    together = np.concatenate(changes)
    return int((together > 0).sum()), len(together)


def as_a_rule(count: tuple[int, int]) -> bool:
    """Return whether most of the steps follow a trend; False without any step."""
    return count[1] > 0 and count[0] >= AS_A_RULE * count[1]


@statement("Figure 7")
def waviness_matters(figure7: xr.Dataset) -> Finding:
    """Even a very small waviness matters, above all by its amplitude.

    Holds if: max/min over h/δ0 at least 1.2 on every curve
    """
    ratios = spread(figure7, "waviness_amplitude", "wavelength", "normal_amplitude")
    rows = []
    for row in ratios:
        values = "/".join(f"{value:.2f}" for value in row.values)
        rows.append(f"{value_words('wavelength', float(row.wavelength))}: {values}")
    amplitudes = "/".join(f"{value:g}" for value in ratios.normal_amplitude.values)
    measured = f"max/min over h/δ0: λ/√(hR) = {', '.join(rows)} (δA/δ0 = {amplitudes})"
    return Finding(measured, bool((ratios >= 1.2).all()))


@statement("Abstract")
def waviness_raises_and_lowers(figure3: xr.Dataset, figure7: xr.Dataset) -> Finding:
    """A small waviness can raise or lower s markedly.

    Holds if: by 10% or more either way against the paraboloid, for both δA/δ0
    """
    changes = []
    for amplitude in figure7.normal_amplitude.values.tolist():
        smooth = float(at(figure3, normal_amplitude=amplitude, phase=0).s)
        s = at(figure7, normal_amplitude=amplitude).s
        changes.append((amplitude, float(s.min()) / smooth - 1, float(s.max()) / smooth - 1))
    words = "; ".join(f"δA/δ0 = {a:g}: {low:+.0%} to {high:+.0%}" for a, low, high in changes)
    holds = all(low <= -0.1 and high >= 0.1 for _, low, high in changes)
    return Finding(f"against the paraboloid, {words}", holds)


@statement("Figure 7")
def oscillations_shrink(figure7: xr.Dataset) -> Finding:
    """s oscillates at small waviness amplitudes, with periods and amplitudes that shrink as h → 0.

    Holds if: from one oscillation to the next, period and rise (or fall) grow with h in 4 of 5 cases; ripples
    below 10% of a curve's range do not count
    """
    found = oscillations(with_dims(figure7, "wavelength", "normal_amplitude"))
    periods, swings = longer_periods(found), larger_swings(found)
    longest = max(found, key=lambda oscillation: len(oscillation.swings))
    measured = (
        f"with h grow {periods[0]} of {periods[1]} periods and {swings[0]} of {swings[1]} swings on "
        f"{len(found)} curves; the longest series: period {_ends(longest.periods)}, "
        f"swing {_ends(longest.swings)}"
    )
    return Finding(measured, as_a_rule(periods) and as_a_rule(swings))


def oscillations(dataset: xr.Dataset) -> list[Oscillation]:
    """The oscillation of every curve over h/δ0."""
    ordered = with_dims(dataset, "waviness_amplitude").sortby("waviness_amplitude")
    h = ordered.waviness_amplitude.values
    s = ordered.s.transpose(..., "waviness_amplitude").values.reshape(-1, len(h))
    return [Oscillation.of(h, curve) for curve in s]


@statement("Figure 7")
def effects_are_alike(figure7: xr.Dataset) -> Finding:
    """The normal oscillation hardly changes how much the waviness matters.

    Holds if: ln(max/min) over h/δ0, mean over the wavelengths, differs by at most 25% between the two δA/δ0
    """
    sizes = np.log(spread(figure7, "waviness_amplitude", "normal_amplitude", "wavelength").values)
    change = float(sizes[-1].mean() / sizes[0].mean()) - 1
    each = sizes[-1] / sizes[0] - 1
    measured = (
        f"mean of ln(max/min) over h: {sizes[0].mean():.2f} at the smaller, {sizes[-1].mean():.2f} at the "
        f"larger δA/δ0 ({change:+.0%}; single wavelengths {each.min():+.0%} to {each.max():+.0%})"
    )
    return Finding(measured, abs(change) <= 0.25)


@statement("Figure 7")
def curves_are_alike(figure7: xr.Dataset) -> Finding:
    """Both amplitudes of the normal oscillation give quantitatively similar curves.

    Holds if: at equal h the curves, each over its mean, differ by at most half of the effect of h (rms)
    """
    s = even(with_dims(figure7, "normal_amplitude"), "waviness_amplitude").s.sortby("normal_amplitude")
    effect = s / s.mean("waviness_amplitude") - 1
    distance = effect.isel(normal_amplitude=-1) - effect.isel(normal_amplitude=0)
    share = float(np.sqrt((distance**2).mean() / (effect**2).mean()))
    return Finding(f"the distance is {share:.2f} of the effect of h (rms; 1.41: unrelated)", share <= 0.5)


def _ends(values: FloatArray) -> str:
    return f"{values[0]:.2g} to {values[-1]:.2g}" if len(values) else "none"


@statement("Figure 8")
def half_differs_most(figure8: xr.Dataset) -> Finding:
    """Wavy paraboloid: the phases 0 and π differ most at ω2/ω1 = 1/2.

    Holds if: the mean over h of |ln s(π)/s(0)| is largest at 1/2
    """
    curves = even(with_dims(figure8, "phase", "frequency_ratio"), "waviness_amplitude")
    change = np.abs(np.log(at(curves, phase=math.pi).s / at(curves, phase=0).s)).mean("waviness_amplitude")
    largest = float(change.idxmax("frequency_ratio"))
    return Finding(f"mean over h of |ln s(π)/s(0)| at ω2/ω1 = {listed(change)}", largest == 0.5)


@statement("Figure 8")
def trends_are_similar(figure8: xr.Dataset) -> Finding:
    """All curves show similar trends.

    Holds if: every curve oscillates, with periods and swings that grow with h in 4 of 5 cases
    """
    found = oscillations(with_dims(figure8, "phase", "frequency_ratio"))
    alike = sum(as_a_rule(longer_periods([one])) and as_a_rule(larger_swings([one])) for one in found)
    curves = figure8.s.transpose(..., "waviness_amplitude").values.reshape(len(found), -1)
    correlation = np.corrcoef(curves)[np.triu_indices(len(curves), 1)]
    measured = (
        f"periods and swings grow with h on {alike} of {len(found)} curves; correlation of two curves: "
        f"median {np.median(correlation):.2f}, from {correlation.min():.2f} to {correlation.max():.2f}"
    )
    return Finding(measured, alike == len(found))


@statement("Figure 8")
def loads_couple_weakly(figure8: xr.Dataset) -> Finding:
    """Waviness and load are weakly coupled.

    Holds if: at most 10% of the variance of ln s is left over by a product f(h)·g(ψ, ω2/ω1)
    """
    return coupling_with(even(figure8, "waviness_amplitude"), "waviness_amplitude", WEAK)
