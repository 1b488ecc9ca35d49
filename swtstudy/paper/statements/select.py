"""Values of an archive at given places, and lists of them in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.results.select import slice_at
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.wording import value_words

if TYPE_CHECKING:
    import xarray as xr


class NotInArchiveError(LookupError):
    """An archive that lacks values that a statement needs."""


def at(dataset: xr.Dataset, **places: float | str) -> xr.Dataset:
    """The part of a Dataset at given values of its parameters, those dimensions dropped.

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
    places = values[dim].values.tolist()
    return ", ".join(
        f"{value_words(dim, place)}: {value:{form}}"
        for place, value in zip(places, values.values.tolist(), strict=True)
    )
