"""Dependence of s on friction, amplitudes, the Poisson ratio, the phase and the frequency ratio.

Section 4.1, figures 3 and 4, and section 4.2.
"""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import xarray as xr

from swtstudy.paper.measures import at, even, largest_change, listed, period, spread, with_dims
from swtstudy.paper.statements import Measured
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.wording import value_words

_AMPLITUDE = "tangential_amplitude"


def rises_with_friction(archive: xr.Dataset) -> Measured:
    """Largest fall of s from one value of μ to the next."""
    fall, μ = largest_change(with_dims(archive, "friction"), "friction", -1), archive.friction
    words = f"falls by up to {fall:.1e} from one value to the next" if fall else "falls nowhere"
    return fall == 0, {"falls": words, "low": μ.min(), "high": μ.max(), "curves": archive.s.size // μ.size}


def rises_with_amplitude(sample: xr.Dataset) -> Measured:
    """Falls of s with the tangential amplitude."""
    falls = _falls(sample)
    return not (falls > 0.0).any(), {"falls": _in_words(falls)}


def rises_in_partial_slip(sample: xr.Dataset, few: float, little: float) -> Measured:
    """Falls of s with the tangential amplitude before gross slip, and in it."""
    falls, slides = _falls(sample), sample.regime == REGIMES.index("gross_slip")
    before, within = falls.where(~slides, 0.0), falls.where(slides, 0.0)
    holds = (before > 0.0).any(_AMPLITUDE).mean() <= few and within.max() <= little
    return holds, {"before": _in_words(before), "within": _in_words(within)}


def _falls(sample: xr.Dataset) -> xr.DataArray:
    """Relative distance of s, with its error, below its largest value at any smaller amplitude; else 0."""
    ordered = with_dims(sample, _AMPLITUDE).sortby(_AMPLITUDE)
    largest = (ordered.s - ordered.s_error).cumulative(_AMPLITUDE).max()
    return ((largest - ordered.s - ordered.s_error) / abs(largest)).clip(min=0.0)


def _in_words(falls: xr.DataArray) -> str:
    """On how many curves s falls, and by how much."""
    curves = (falls > 0.0).any(_AMPLITUDE)
    if not curves.any():
        return f"falls on none of {curves.size} random curves"
    return f"falls on {curves.sum():d} of {curves.size} random curves, by up to {falls.max():.1%}"


def poisson_ratio_is_weak(archive: xr.Dataset, low: float, high: float, at_most: float) -> Measured:
    """Relative change of s across a range of ν, and ratio of s at the ends of all ν."""
    s = with_dims(archive, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    metals = s.sel(poisson_ratio=slice(low, high))
    change = (metals.max("poisson_ratio") - metals.min("poisson_ratio")) / metals.mean("poisson_ratio")
    whole, ν = s.isel(poisson_ratio=-1) / s.isel(poisson_ratio=0), s.poisson_ratio
    values = {"changes": listed(change, ".0%"), "first": ν[0], "last": ν[-1], "whole": listed(whole)}
    return (change <= at_most).all(), values


def poisson_ratio_is_intricate(archive: xr.Dataset) -> Measured:
    """Share of the steps of ν at which s rises."""
    s = with_dims(archive, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    rising = (s.diff("poisson_ratio") > 0).mean("poisson_ratio")
    intricate = ((rising > 0) & (rising < 1)).any() or np.ptp(rising.values) > 0
    return intricate, {"rising": listed(rising)}


#: The ratios for which the paper finds that the phase matters most.
PROMINENT = [0.25, 0.5, 1.5]
#: Table 1's amplitude of the tangential oscillation.
_TANGENTIAL = 5 / 6


def flat_at_the_smallest(figure3: xr.Dataset, at_most: float) -> Measured:
    """Largest over smallest s at the smallest amplitude."""
    smallest = spread(figure3, "phase", "normal_amplitude").isel(normal_amplitude=[0])
    return smallest[0] <= at_most, {"ratios": listed(smallest, ".3f")}


def grows_with_amplitude(figure3: xr.Dataset) -> Measured:
    """Largest over smallest s at each amplitude."""
    ratios = spread(figure3, "phase", "normal_amplitude")
    return (np.diff(ratios) > 0).all(), {"ratios": listed(ratios)}


def factor_at_the_largest(figure3: xr.Dataset, at_least: float, below: float) -> Measured:
    """Largest over smallest s at δA/δ0 = 8/9."""
    curve = at(with_dims(figure3, "phase"), normal_amplitude=8 / 9).s
    low, high = curve.min(), curve.max()
    return at_least <= high / low < below, {"low": low, "high": high, "factor": high / low}


def raises_and_lowers(
    figure3: xr.Dataset, figure4: xr.Dataset, tangential_amplitude: xr.Dataset, by: float
) -> Measured:
    """Extreme s over s without a normal oscillation."""
    without = at(tangential_amplitude, normal_amplitude=0).s.interp(tangential_amplitude=_TANGENTIAL)
    figures = {"one": figure3, "several": figure4}
    found = {name: (each.s.max() / without - 1, each.s.min() / without - 1) for name, each in figures.items()}
    words = {name: f"{high:+.0%} to {low:+.0%}" for name, (high, low) in found.items()}
    high, low = found["several"]
    return high >= by and low <= -by, {"without": without, **words}


def _by_phase(archive: xr.Dataset) -> xr.DataArray:
    """Largest over smallest s over ψ, by amplitude and frequency ratio."""
    return spread(archive, "phase", "normal_amplitude", "frequency_ratio")


def _by_amplitude(ratios: xr.DataArray, symbol: str = "ω2/ω1") -> str:
    """The values of an array of amplitude and another parameter, the largest amplitude first."""
    rows = (
        f"δA/δ0 = {row.normal_amplitude:g}: {symbol} = {listed(row.drop_vars('normal_amplitude'))}"
        for row in ratios[::-1]
    )
    return "; ".join(rows)


def prominent(figure4: xr.Dataset, without: list[float] | None = None) -> Measured:
    """Largest over smallest s at prominent ratios and at all others, but for some that are left out."""
    ratios = _by_phase(figure4)
    ratios = ratios.sel(frequency_ratio=~ratios.frequency_ratio.isin(without or []))
    chosen = ratios.frequency_ratio.isin(PROMINENT)
    others, own = ratios.sel(frequency_ratio=~chosen), ratios.sel(frequency_ratio=chosen)
    holds = (others.max("frequency_ratio") < own.min("frequency_ratio")).all()
    return holds, {"ratios": _by_amplitude(ratios)}


def others_matter_little(figure4: xr.Dataset, other_frequencies: xr.Dataset) -> Measured:
    """Largest over smallest s at other ratios than the prominent ones."""
    ratios = _by_phase(other_frequencies)
    least = _by_phase(figure4).sel(frequency_ratio=PROMINENT).min("frequency_ratio").values
    values = {"ratios": _by_amplitude(ratios), "least": least[-1]}
    return (ratios < least.reshape(-1, 1)).all(), values


def long_cycles_matter_little(frequencies: xr.Dataset) -> Measured:
    """Largest over smallest s, the largest of all ratios with one denominator."""
    variation = _by_phase(frequencies) - 1.0
    ratios = variation.frequency_ratio.values
    q = [Fraction(ratio).limit_denominator(100).denominator for ratio in ratios]
    largest = variation.groupby(xr.DataArray(q, dims="frequency_ratio", name="q")).max()
    largest = largest.transpose("normal_amplitude", "q")
    return (largest.diff("q") < 0.0).all(), {"largest": _by_amplitude(largest, "q")}


def period_shrinks(*archives: xr.Dataset) -> Measured:
    """Periods of s(ψ) at all ratios of archives."""
    found: dict[float, float] = {}
    for archive in archives:
        curves = even(with_dims(archive, "frequency_ratio"), "phase").s.isel(normal_amplitude=-1)
        for ratio in curves.frequency_ratio.values.tolist():
            found[ratio] = period(curves.sel(frequency_ratio=ratio).sortby("phase").values)
    found = dict(sorted(found.items()))
    periods = [*found.values()]
    never_longer = all(b <= a or math.isclose(a, b) for a, b in itertools.pairwise(periods))
    words = (
        f"{value_words('frequency_ratio', ratio)}: {value_words('phase', p) if p < math.inf else 'none'}"
        for ratio, p in found.items()
    )
    return never_longer and periods[-1] < periods[0], {"periods": ", ".join(words)}


def amplitude_amplifies(figure4: xr.Dataset) -> Measured:
    """Largest over smallest s at both amplitudes."""
    ratios = _by_phase(figure4)
    return (np.diff(ratios, axis=0) > 0).all(), {"ratios": _by_amplitude(ratios)}


def half_differs_most(figure4: xr.Dataset) -> Measured:
    """s(π)/s(0) at the larger amplitude."""
    curves = with_dims(figure4, "frequency_ratio").sortby("normal_amplitude").isel(normal_amplitude=-1)
    change = at(curves, phase=math.pi).s / at(curves, phase=0).s
    return np.abs(np.log(change)).idxmax("frequency_ratio") == 0.5, {"changes": listed(change)}
