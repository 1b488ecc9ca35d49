"""Slices of results at given values of parameters, written as in a study file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.grid import SAMPLE
from swtstudy.points.nearest import TOLERANCE, index_of
from swtstudy.points.values import Value, read_exact, read_value
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.mistakes import Report, literal, nearest
from swtstudy.vocabulary.wording import value_words

if TYPE_CHECKING:
    import xarray as xr

#: Values of an axis that a message lists one by one; of longer axes the first and the last.
_LISTED = 12


def slice_at(dataset: xr.Dataset, places: Mapping[str, object], tolerance: float = TOLERANCE) -> xr.Dataset:
    """The part of results at given values of their parameters: see ``slice`` of the accessor."""
    require_points(dataset)
    report = Report()
    chosen: dict[str, Any] = {}
    rows = np.ones(dataset.sizes.get(SAMPLE, 0), bool)
    for name, raw in places.items():
        if name not in dataset.coords or name not in AXES:
            known = [str(known) for known in dataset.coords if known in AXES]
            report(name, "not a parameter of these results", nearest(name, known))
            continue
        several = isinstance(raw, list | tuple | range | np.ndarray) and np.ndim(raw) > 0
        elements: list[object] = list(raw) if several else [raw]  # type: ignore[call-overload]
        if not elements:
            report(name, literal(raw), "at least one value")
        found = [_index(dataset[name], element, tolerance, report) for element in elements]
        if name in dataset.dims:
            chosen[name] = found if several else found[0]
        elif dataset[name].dims == (SAMPLE,):
            values = dataset[name].values
            rows &= np.isin(values, values[found])
    report.refuse()
    return dataset.isel(chosen if rows.all() else {**chosen, SAMPLE: np.flatnonzero(rows)})


def require_points(dataset: xr.Dataset) -> None:
    """Raise a ValueError for results without a single point, which a selection may leave."""
    empty = [str(name) for name, size in dataset.sizes.items() if not size]
    if empty:
        raise ValueError(f"these results are empty: no value is left of {', '.join(empty)}")


def _index(there: xr.DataArray, raw: object, tolerance: float, report: Report) -> int:
    """Index of a value along its coordinate; 0, and a mistake, if the results lack it."""
    name = str(there.name)
    value: Value
    try:
        # A name is known by its place in the results, whatever it stood for.
        named = AXES[name].kind == "name" and isinstance(raw, str) and raw in np.atleast_1d(there.values)
        sized = there.attrs.get("units", AXES[name].units) != AXES[name].units
        value = str(raw) if named else float(read_exact(raw)) if sized else read_value(AXES[name], raw)
    except ValueError as error:
        report(name, f"{literal(raw)} ({error})", AXES[name].allowed)
        return 0
    known = np.atleast_1d(there.values).tolist()
    index = index_of(value, known, tolerance)
    if index is None:
        report(name, f"{literal(raw)}, which is not in these results", _listed(name, known))
        return 0
    return index


def _listed(name: str, values: list[float | str]) -> str:
    words = [value_words(name, value) for value in values]
    if len(words) > _LISTED:
        words = [*words[: _LISTED // 2], "…", *words[-_LISTED // 2 :], f"({len(values)} values)"]
    return ", ".join(words)
