"""Measures of how curves vary, of any labelled array, and values of an archive at given places."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from swtstudy.results.evaluate import slice_at
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.wording import value_words

#: Harmonics below this fraction of the largest one are traces of kinks between grid points.
_SMALLEST_HARMONIC = 0.02
#: A curve whose harmonics are all below this fraction of its values is constant but for rounding.
_ROUNDING = 1e-9


class NotInArchiveError(LookupError):
    """An archive that lacks values that a statement needs."""


def at(dataset: xr.Dataset, **places: float | str) -> xr.Dataset:
    """Select values of parameters of a Dataset, and drop their dimensions.

    Raises
    ------
    NotInArchiveError
        If the archive lacks a dimension or a value.
    """
    try:
        return slice_at(dataset, places).drop_vars(places)
    except StudyError as error:
        mistake = error.mistakes[0]
        place = f" = {value_words(mistake.key, places[mistake.key])}" if mistake.key in dataset.coords else ""
        raise NotInArchiveError(f"no {mistake.key}{place}") from None


def with_dims(dataset: xr.Dataset, *names: str) -> xr.Dataset:
    """The Dataset itself, if it has all the named dimensions.

    Raises
    ------
    NotInArchiveError
        If one is missing.
    """
    for name in names:
        if name not in dataset.dims:
            raise NotInArchiveError(f"no axis {name}")
    return dataset


def even(dataset: xr.Dataset, name: str) -> xr.Dataset:
    """The Dataset without values that were put in among equal steps, or equal ratios, of an axis.

    Raises
    ------
    NotInArchiveError
        If it lacks the axis.
    """
    places = np.sort(with_dims(dataset, name)[name].values)
    if len(places) < 3:
        return dataset
    for scale in (np.asarray, np.log) if places[0] > 0.0 else (np.asarray,):
        x = scale(places)
        steps = round((x[-1] - x[0]) / np.diff(x).max())
        share = (x - x[0]) / (x[-1] - x[0]) * steps
        kept = np.abs(share - np.round(share)) < 1e-6
        if kept.sum() == steps + 1:
            return dataset.sel({name: places[kept]})
    return dataset


def listed(values: xr.DataArray, form: str = ".2f") -> str:
    """The values of a one-dimensional array with their places: "1/2: 2.74, 1: 1.50"."""
    (dim,) = map(str, values.dims)
    return ", ".join(f"{value_words(dim, each[dim].item())}: {each.item():{form}}" for each in values)


def spread(dataset: xr.Dataset, dim: str, *others: str) -> xr.DataArray:
    """Largest over smallest s along a dimension, over its other dimensions in this order, each ascending."""
    s = with_dims(dataset, dim, *others).s.sortby([*others])
    return (s.max(dim) / s.min(dim)).transpose(*others)


def largest_change(dataset: xr.Dataset, dim: str, sense: int) -> float:
    """Largest relative rise (sense 1) or fall (-1) of s from one value of a dimension to the next one above.

    Changes within the estimated errors of the two values do not count; 0 if there is no other one.
    """
    ordered = dataset.sortby(dim)
    before, after = (ordered.isel({dim: part}).drop_vars(dim) for part in (slice(-1), slice(1, None)))
    change = (sense * (after.s - before.s) - before.s_error - after.s_error) / before.s
    return max(float(change.max()), 0.0)


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
