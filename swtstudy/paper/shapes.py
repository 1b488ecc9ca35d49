"""Figures 5 to 8: the radius of the punch face, and the waviness, over whose amplitude s oscillates."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import xarray as xr

from swtstudy.paper.measures import at, even, largest_change, listed, spread, with_dims
from swtstudy.paper.statements import Measured
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.wording import value_words


def monotone(figure5: xr.Dataset, profile: str, sense: int) -> Measured:
    """Changes of s with b against a sense, rising (1) or falling (-1), beyond its error at any phase."""
    curves = with_dims(at(figure5, profile=profile), "flat_radius", "phase").sortby("flat_radius")
    curves = curves.transpose("flat_radius", "phase")
    s, error = curves.s.values, curves.s_error.values
    against = sense * (s[:-1] - s[1:]) - error[1:] - error[:-1]
    means, wrong = even(curves, "phase").s.mean("phase"), against > 0
    others = f"likewise at each of {s.shape[1]} phases"
    if wrong.any():
        relative, b = against / s[:-1], curves.flat_radius.values
        step, column = np.unravel_index(relative.argmax(), against.shape)
        phase = np.degrees(curves.phase.values[column])
        others = (
            f"the opposite at {wrong.any(axis=0).sum()} of {s.shape[1]} phases, by up to "
            f"{relative.max():.1%} (b/a_H = {b[step]:g} to {b[step + 1]:g}, ψ = {phase:.1f}°)"
        )
    return not wrong.any(), {"means": listed(means / means[0].item()), "others": others}


def weakly_coupled(
    archive: xr.Dataset, dim: str, at_most: float, profile: str = "", regular: str = ""
) -> Measured:
    """Coupling of a shape parameter with the load, of one profile, at the regular steps of one axis.

    Share of the variance of ln s that no product of a function of the shape parameter and one of all others
    explains: the interaction term of a two-way analysis of variance.
    """
    chosen = at(archive, profile=profile) if profile else archive
    chosen = even(chosen, regular) if regular else chosen
    logarithm = np.log(with_dims(chosen, dim).s)
    centred = logarithm - logarithm.mean()
    others = [other for other in centred.dims if other != dim]
    interaction = centred - centred.mean(dim) - centred.mean(others)
    share = float((interaction**2).sum() / (centred**2).sum())
    return share <= at_most, {"share": share}


def all_curves_fall(figure6: xr.Dataset) -> Measured:
    """Largest rise of s from one b to the next."""
    rise = largest_change(with_dims(figure6, "flat_radius"), "flat_radius", 1)
    s = figure6.s.sortby("flat_radius")
    end, b = s.isel(flat_radius=-1) / s.isel(flat_radius=0), s.flat_radius[-1]
    words = f"rises by up to {rise:.1e} from one b to the next" if rise else "rises nowhere"
    return rise == 0, {"rises": words, "b": b, "low": end.min(), "high": end.max()}


def ratios_are_alike(figure6: xr.Dataset, at_most: float) -> Measured:
    """Distances of the curves s/s(b = 0), at one phase and at all, over the height of the figure."""
    normalised = with_dims(figure6, "phase", "frequency_ratio").s / at(figure6, flat_radius=0).s
    height = normalised.max() - normalised.min()
    by_phase, whole = (
        (normalised.max(over) - normalised.min(over)).max("flat_radius") / height
        for over in (["frequency_ratio"], ["frequency_ratio", "phase"])
    )
    words = (f"ψ = {value_words('phase', each.phase.item())}: {each:.0%}" for each in by_phase)
    return whole <= at_most, {"distances": ", ".join(words), "share": whole}


def grows_without_bound(stability_thin_annulus: xr.Dataset) -> Measured:
    """Growth of SWT/E* = s δ0/R while R goes to 0."""
    curves = at(stability_thin_annulus, profile="rounded_punch")
    curves = with_dims(curves, "flat_radius").sortby("flat_radius")
    b = curves.flat_radius
    swt, error = curves.s * b**2, curves.s_error * b**2
    steps = swt.diff("flat_radius") - error.rolling(flat_radius=2).sum().isel(flat_radius=slice(1, None))
    grows = (steps > 0.0).all()
    last = np.log(swt.isel(flat_radius=[-2, -1])).diff("flat_radius") / np.log(b.values[-1] / b.values[-2])
    words = "at every step" if grows else f"at {(steps > 0.0).mean():.0%} of the steps"
    power = {"low": 0.5 * last.min(), "high": 0.5 * last.max()}
    return grows, {"steps": words, "fall": (b[0] / b[-1]) ** 2, "curves": curves.s.size // b.size, **power}


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
        without = at(figure3, normal_amplitude=amplitude, phase=0).s
        relative = at(figure7, normal_amplitude=amplitude).s / without - 1
        low, high = float(relative.min()), float(relative.max())
        holds = holds and low <= -by and high >= by
        words.append(f"δA/δ0 = {amplitude:g}: {low:+.0%} to {high:+.0%}")
    return holds, {"changes": "; ".join(words)}


def oscillations(dataset: xr.Dataset, *others: str) -> list[tuple[FloatArray, FloatArray]]:
    """The oscillation of every curve over h/δ0; the curves differ in other parameters.

    Returns
    -------
    list
        Of each curve its periods, the distances from one maximum to the next, and from one minimum to the
        next, alternately; and its swings, the absolute changes of s from each turning point to the next.
    """
    curves = with_dims(dataset, "waviness_amplitude", *others).sortby("waviness_amplitude").s
    h, found = curves.waviness_amplitude.values, []
    for s in curves.transpose(..., "waviness_amplitude").values.reshape(-1, len(h)):
        turns = turning_points(s, _RIPPLE * float(np.ptp(s)))
        found.append((h[turns][2:] - h[turns][:-2], np.abs(np.diff(s[turns]))))
    return found


def turning_points(values: FloatArray, smallest_swing: float) -> list[int]:
    """Indices where a curve turns by at least a given swing: alternately maxima and minima, without its ends.

    Parameters
    ----------
    values
        Shape (n,).
    smallest_swing
        Smaller ripples do not count.

    Examples
    --------
    >>> turning_points(np.array([0.0, 3.0, 2.9, 3.1, 1.0, 4.0]), 0.5)
    [3, 4]
    """
    found: list[int] = []
    low = high = 0
    sense = 0
    for index, value in enumerate(values):
        high = index if value > values[high] else high
        low = index if value < values[low] else low
        if sense >= 0 and values[high] - value >= smallest_swing:
            found.append(high)
            sense, low = -1, index
        elif sense <= 0 and value - values[low] >= smallest_swing:
            found.append(low)
            sense, high = 1, index
    return [index for index in found if index > 0]


def growing(found: Sequence[tuple[FloatArray, FloatArray]]) -> tuple[BoolArray, BoolArray]:
    """True if each period exceeds the last one, and each rise, or fall, the last rise, or fall."""
    periods, swings = zip(*found, strict=True)
    longer = np.concatenate([np.diff(own) for own in periods])
    larger = np.concatenate([own[2:] - own[:-2] for own in swings])
    return longer > 0, larger > 0


def as_a_rule(steps: Sequence[BoolArray], share: float) -> bool:
    """Return whether so many of the steps follow each trend; False without any step."""
    return all(len(each) and each.mean() >= share for each in steps)


def oscillations_shrink(figure7: xr.Dataset, share: float) -> Measured:
    """Growth of periods and swings with h on all curves together."""
    found = oscillations(figure7, "wavelength", "normal_amplitude")
    steps, longest = growing(found), max(found, key=lambda one: len(one[1]))
    periods, swings = (f"{each.sum()} of {len(each)}" for each in steps)
    ends = [f"{each[0]:.2g} to {each[-1]:.2g}" if len(each) else "none" for each in longest]
    words = {"periods": periods, "swings": swings, "curves": len(found)}
    return as_a_rule(steps, share), words | {"longest_periods": ends[0], "longest_swings": ends[1]}


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
