"""Measures of how curves vary, for any labelled array."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.mechanics.points import FloatArray

if TYPE_CHECKING:
    import xarray as xr

#: Harmonics below this fraction of the largest one are traces of kinks between grid points.
_SMALLEST_HARMONIC = 0.02
#: A curve whose harmonics are all below this fraction of its values is constant but for rounding.
_ROUNDING = 1e-9


def spread(values: xr.DataArray, dim: str) -> xr.DataArray:
    """Largest over smallest value along a dimension."""
    return values.max(dim) / values.min(dim)


def largest_fall(dataset: xr.Dataset, dim: str) -> float:
    """Largest relative fall of s from one value of a dimension to the next one above.

    Falls within the estimated errors of the two values do not count; 0 if s falls nowhere.
    """
    return _largest_change(dataset, dim, -1)


def largest_rise(dataset: xr.Dataset, dim: str) -> float:
    """Largest relative rise of s; see `largest_fall`."""
    return _largest_change(dataset, dim, 1)


def _largest_change(dataset: xr.Dataset, dim: str, sense: int) -> float:
    ordered = dataset.sortby(dim)
    before, after = (ordered.isel({dim: part}).drop_vars(dim) for part in (slice(-1), slice(1, None)))
    change = (sense * (after.s - before.s) - before.s_error - after.s_error) / before.s
    return max(float(change.max()), 0.0)


def coupling(values: xr.DataArray, dim: str) -> float:
    """Share of the variance of ln(values) that no product f(dim)·g(all other dimensions) explains.

    The interaction term of a two-way analysis of variance: 0 if the dimensions are not coupled.
    """
    logarithm = np.log(values)
    centred = logarithm - logarithm.mean()
    others = [other for other in values.dims if other != dim]
    interaction = centred - centred.mean(dim) - centred.mean(others)
    return float((interaction**2).sum() / (centred**2).sum())


def period(values: FloatArray) -> float:
    """Smallest period of a 2π-periodic curve, from equally spaced samples; the last repeats the first.

    Returns
    -------
    float
        2π over the greatest common divisor of the curve's harmonics; inf for a constant.
    """
    harmonics = np.abs(np.fft.rfft(values[:-1]))[1:]
    if not harmonics.max() > _ROUNDING * np.abs(values).max():
        return math.inf
    orders = 1 + np.flatnonzero(harmonics > _SMALLEST_HARMONIC * harmonics.max())
    return 2 * math.pi / math.gcd(*orders.tolist())


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
    return [index for index in found if 0 < index < len(values) - 1]
