"""Values of an archive at given places, and how they are written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.figures.words import value_words

if TYPE_CHECKING:
    import xarray as xr


class NotInArchiveError(LookupError):
    """An archive that lacks the values which a statement is about."""


def at(dataset: xr.Dataset, **places: float | str) -> xr.Dataset:
    """The part of a Dataset at given values of its parameters, those dimensions dropped.

    Raises
    ------
    NotInArchiveError
        If a dimension or a value is not there.
    """
    for name, value in places.items():
        if name not in dataset.coords:
            raise NotInArchiveError(f"no {name}")
        known = np.atleast_1d(dataset[name].values)
        same = known == value if isinstance(value, str) else np.isclose(known, value, rtol=1e-9, atol=1e-12)
        if not same.any():
            raise NotInArchiveError(f"no {name} = {value_words(name, value)}")
        if name in dataset.dims:
            dataset = dataset.isel({name: int(np.argmax(same))})
        dataset = dataset.drop_vars(name)
    return dataset


def with_dims(dataset: xr.Dataset, *names: str) -> xr.Dataset:
    """The Dataset, if it varies along all the named dimensions.

    Raises
    ------
    NotInArchiveError
        If one is missing.
    """
    for name in names:
        if name not in dataset.dims:
            raise NotInArchiveError(f"no axis {name}")
    return dataset


def listed(values: xr.DataArray, form: str = ".2f") -> str:
    """The values of a one-dimensional array with their places: "1/2: 2.74, 1: 1.50"."""
    (dim,) = map(str, values.dims)
    places = values[dim].values.tolist()
    return ", ".join(
        f"{value_words(dim, place)}: {value:{form}}"
        for place, value in zip(places, values.values.tolist(), strict=True)
    )
