"""Section 4.1: friction, amplitude of the tangential oscillation and Poisson ratio."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.paper.statements.measures import largest_change, listed, with_dims
from swtstudy.paper.statements.statement import Measured
from swtstudy.vocabulary.choices import REGIMES

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
