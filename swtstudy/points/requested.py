"""Quantities beside s as labelled arrays, and back: columns of points, and data variables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import DIRECTIONS, QUANTITY_AXES
from swtstudy.vocabulary.quantities import (
    COUNTED,
    COUNTED_SIZES,
    COUNTS,
    DISTANCE,
    QUANTITIES,
    Request,
    columns_in,
    distance_of,
    item_of,
    rows_of,
)

#: The attribute of results with units that says what their coordinates do not say of the contacts.
CONTACT = "contact"


def has_units(dataset: xr.Dataset) -> bool:
    """Return whether results are those of real contacts."""
    return CONTACT in dataset.attrs


def require(dataset: xr.Dataset, *names: str) -> None:
    """Raise a StudyError if results have been left without some of their data variables."""
    if lacking := [name for name in names if name not in dataset]:
        raise StudyError(
            [Mistake("results", f"none of {', '.join(lacking)}", "results that still have them")]
        )


def variables(asked: Request, columns: Mapping[str, NDArray]) -> dict[str, tuple[tuple[str, ...], NDArray]]:
    """Data variables of n points with their own dimensions, of shape (n, …).

    Parameters
    ----------
    asked
        What was asked.
    columns
        By `swtstudy.vocabulary.quantities.columns_of`, each of shape (n,).
    """
    found: dict[str, tuple[tuple[str, ...], NDArray]] = {}
    for name, dims in asked.variables.items():
        row = next(row for row in QUANTITIES.values() if name in row.variables)
        items = [item_of(distance) for distance in asked.distances]
        if DISTANCE not in row.dims:
            items = [COUNTS if row.name in COUNTED else row.name]
        parts = [np.stack([columns[key] for key in columns_in(row, name, item)], axis=-1) for item in items]
        values = np.stack(parts, axis=1)
        lengths = {DISTANCE: len(items), "direction": values.shape[2], **COUNTED_SIZES}
        sizes = [lengths[dim] for dim in dims]
        found[name] = dims, values.reshape((len(values), *sizes))
    return found


def coordinates(asked: Request, row: Parameter) -> dict[str, Any]:
    """The coordinates of the quantities' own dimensions; ``row`` is that of the critical distance."""
    if not asked.distances:
        return {}
    values = np.array(asked.distances)
    return {
        DISTANCE: (DISTANCE, values, _meaning(row)) if asked.is_axis else ((), values[0], _meaning(row)),
        "direction": (
            "direction",
            np.array(DIRECTIONS, dtype=object),
            _meaning(QUANTITY_AXES["direction"], units=False),
        ),
    }


def request_of(dataset: xr.Dataset, items: Iterable[str]) -> Request:
    """Return the request behind a Dataset whose points have these items; real contacts have lengths."""
    own = Request.of(items, DISTANCE in dataset.dims)
    if not own.distances or not has_units(dataset):
        return own
    lengths = np.atleast_1d(dataset[DISTANCE].values).tolist() if DISTANCE in dataset.coords else []
    return Request(own.names, tuple(lengths), DISTANCE in dataset.dims, own.counts)


def columns_from(dataset: xr.Dataset, items: Iterable[str]) -> dict[str, FloatArray]:
    """The columns of items, from the data variables of a Dataset, at its points in C order."""
    found: dict[str, FloatArray] = {}
    for item in items:
        distance = distance_of(item)
        part = dataset
        if distance is not None and DISTANCE in dataset.dims:
            known = [item_of(value) for value in dataset[DISTANCE].values.tolist()]
            part = dataset.isel({DISTANCE: known.index(item)})
        for row in rows_of(item):
            for variable in row.variables:
                keys = columns_in(row, variable, item)
                own = [dim for dim in row.dims if dim != DISTANCE]
                values = part[variable].transpose(*dataset.s.dims, *own).values.reshape(-1, len(keys))
                found |= zip(keys, values.T, strict=True)
    return found


def _meaning(row: Parameter, units: bool = True) -> dict[str, str]:
    words = {"long_name": row.name.replace("_", " "), "comment": row.meaning}
    return words | ({"units": row.units, "symbol": row.symbol} if units else {})
