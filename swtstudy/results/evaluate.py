"""Evaluating results: slices, the quantity that a figure shows, extrema along a dimension, tidy tables.

Values of parameters are written as in a study file. A quantity is a data variable, or s over its value at one
place.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points.values import AXIS_TOLERANCE, Value, hint_at_degrees, index_of, read_exact, read_value
from swtstudy.study.figure import QUANTITY, reference
from swtstudy.study.units.results import usual_measure
from swtstudy.vocabulary.mistakes import Report, literal, nearest, refused
from swtstudy.vocabulary.parameters import AXES, short
from swtstudy.vocabulary.quantities import COMPUTED, COUNTED, error_of
from swtstudy.vocabulary.wording import line_words

#: Values of an axis that a message lists one by one; of longer axes the first and the last.
_LISTED = 12


def slice_at(
    dataset: xr.Dataset, places: Mapping[str, object], tolerance: float = AXIS_TOLERANCE
) -> xr.Dataset:
    """The part of results at given values of their parameters: see ``slice`` of the accessor."""
    require_points(dataset)
    report = Report()
    chosen: dict[str, Any] = {}
    kept = {dim: np.ones(size, bool) for dim, size in dataset.sizes.items()}
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
        for dim in {*dataset[name].dims} - {name}:
            values = dataset[name].values
            kept[dim] &= np.isin(values, values[found])
    report.refuse()
    rows = {dim: np.flatnonzero(some) for dim, some in kept.items() if not some.all()}
    return dataset.isel(rows | chosen)


def require_points(dataset: xr.Dataset) -> None:
    """Raise a ValueError for results without a single point, which a selection may leave."""
    empty = [str(name) for name, size in dataset.sizes.items() if not size]
    if empty:
        raise ValueError(f"these results are empty: no value is left of {', '.join(empty)}")


def _index(there: xr.DataArray, raw: object, tolerance: float, report: Report) -> int:
    """Index of a value along its coordinate; 0, and a mistake, if the results lack it."""
    name, known = str(there.name), np.atleast_1d(there.values).tolist()
    meanings = str(there.attrs.get("flag_meanings", "")).split()
    # Values with a name, such as a body, by their number; a name with blanks, as in figures, as it is typed.
    word = "_".join(raw.split()) if isinstance(raw, str) else ""
    if word in meanings:
        raw = int(there.attrs["flag_values"][meanings.index(word)])
    elif word in known and raw not in known:
        raw = word
    value: Value
    unit = str(there.attrs.get("units", AXES[name].units))
    sized = unit != AXES[name].units
    if sized and isinstance(raw, str):
        raw = raw.strip().removesuffix(unit)
    try:
        # A name is known by its place in the results, whatever it stood for.
        named = AXES[name].kind == "name" and isinstance(raw, str) and raw in known
        value = str(raw) if named else float(read_exact(raw)) if sized else read_value(AXES[name], raw)
    except ValueError as error:
        listed = meanings or sized or AXES[name].kind == "name"
        report(name, f"{literal(raw)} ({error})", _listed(there) if listed else AXES[name].allowed)
        return 0
    index = index_of(value, known, tolerance)
    if index is None:
        hint = hint_at_degrees(raw) if AXES[name].units == "rad" else ""
        allowed = "; ".join(filter(None, (_listed(there), hint)))
        report(name, f"{literal(raw)}, which is not in these results", allowed)
    return index or 0


def _listed(there: xr.DataArray) -> str:
    values = np.atleast_1d(there.values).tolist()
    words = [line_words(str(there.name), value, there.attrs) for value in values]
    if len(words) > _LISTED:
        words = [*words[: _LISTED // 2], "…", *words[-_LISTED // 2 :], f"({len(values)} values)"]
    return ", ".join(words)


def quantity(dataset: xr.Dataset, y: str) -> xr.DataArray:
    """The quantity that a figure's ``y`` names.

    Parameters
    ----------
    dataset
        Results.
    y
        The name of a data variable, or "s/s(name=value)" with the name or the symbol of a parameter.

    Raises
    ------
    ValueError
        If it is neither, or the place is not in the results.

    See Also
    --------
    quantity_error : its estimated error.
    """
    try:
        place = reference(str(y))
    except ValueError as error:
        allowed = f"a data variable of these results, or {QUANTITY}"
        raise refused("figure.y", f"{literal(y)} ({error})", allowed) from None
    if place is None:
        name = y.strip()
        if name not in dataset.data_vars:
            known = f"{nearest(name, map(str, dataset.data_vars))}; or {QUANTITY}".replace("?;", "?")
            raise refused("figure.y", f"{literal(y)} (not a quantity)", known)
        return known_regime(dataset) if name == "regime" else dataset[name]
    name, value = place
    ratio = dataset.s / _at_place(dataset, name, value).s.drop_vars(name)
    attributes = {"long_name": f"s over s at {name} = {value}", "units": "1", "symbol": "s/s_0"}
    return ratio.rename("s").assign_attrs(attributes)


def _at_place(dataset: xr.Dataset, name: str, value: Value) -> xr.Dataset:
    """The part of results at one value of a parameter; of a list of points the only one there."""
    there = slice_at(dataset, {name: value})
    for dim in {*dataset[name].dims} - {name}:
        if there.sizes[dim] > 1:
            found = f"{there.sizes[dim]} points with {name} = {value}, of a list of points"
            raise refused("figure.y", found, f"one such point, or {name} as an axis")
        there = there.squeeze(dim, drop=True).assign_coords({name: there[name].item()})
    return there


def known_regime(dataset: xr.Dataset) -> xr.DataArray:
    """The regime; NaN at points that failed or are missing, which an archive marks "not_finite"."""
    if "status" not in dataset:
        return dataset.regime
    return dataset.regime.where(dataset.status == COMPUTED)


def quantity_error(dataset: xr.Dataset, y: str) -> xr.DataArray | None:
    """Estimated absolute error of `quantity`, 0 at the reference place; None if no error is known."""
    place = reference(y)
    error = error_of("s" if place is not None else y.strip())
    if error not in dataset:
        return None
    if place is None:
        return dataset[error]
    name, value = place
    there = _at_place(dataset, name, value)
    own, reference_error = (part.s_error / abs(part.s) for part in (dataset, there.drop_vars(name)))
    both = abs(quantity(dataset, y)) * (own + reference_error)
    return both.where(dataset[name] != there[name].item(), 0.0)


def extrema(dataset: xr.Dataset, dim: str, y: str | None = None) -> xr.Dataset:
    """Least and greatest values along a dimension, and where they are: see ``extrema`` of the accessor."""
    require_points(dataset)
    y = y or usual_measure(dataset)
    values = quantity(dataset, y).compute()  # xarray indexes by arrays in memory only
    if "flag_values" in values.attrs:
        raise refused("y", f"{literal(y)}, whose values are flags", "numbers, such as 's'")
    if dim not in values.dims:
        raise ValueError(
            f"found {dim!r}, not a dimension of {y}; allowed: {nearest(dim, map(str, values.dims))}"
        )
    labels = {"units": values.attrs.get("units", "1"), "symbol": values.attrs.get("symbol", y)}
    found = xr.Dataset()
    for name in ("minimum", "maximum"):
        value = getattr(values, name[:3])(dim, keep_attrs=False)
        place = getattr(values, f"idx{name[:3]}")(dim, keep_attrs=False)
        words = {"long_name": f"{name} of {y}", "comment": f"along {dim}", **labels}
        found[name] = value.assign_attrs(words)
        words = {"long_name": f"{dim.replace('_', ' ')} of {name} {y}"}
        found[f"at_{name}"] = place.assign_attrs(dataset[dim].attrs | words)
    words = {"long_name": f"maximum over minimum of {y}", "comment": f"along {dim}", "units": "1"}
    found["ratio"] = (found.maximum / found.minimum).drop_attrs(deep=False).assign_attrs(words)
    return found


def to_table(dataset: xr.Dataset, beside: Sequence[str] | None = None) -> pd.DataFrame:
    """Results as a table, one row per point: see ``to_table`` of the accessor.

    What has dimensions that are ``beside`` those of the rows, by default `dims_beside`, has a column for each
    place along these.
    """
    # A point has several cycles, which are no column.
    dataset = dataset.drop_vars({*COUNTED} & {*dataset.variables})
    beside = dims_beside(dataset) if beside is None else beside
    dims = [str(name) for name in dataset.dims if name not in beside]
    # Parameters of a sample are along its dimension, single values along none.
    others = [str(name) for name in dataset.coords if name not in (*dims, *beside)]
    rows = dataset.drop_dims(beside)
    columns = {}
    for name in [*dims, *others, *map(str, dataset.data_vars)]:
        values = dataset[name]
        own = [dim for dim in beside if dim in values.dims]
        for place in itertools.product(*(values[dim].values.tolist() for dim in own)):
            part = values.sel(dict(zip(own, place, strict=True)), drop=True)
            flat = part.broadcast_like(rows).transpose(*dims).values.ravel()
            if "flag_meanings" in part.attrs:
                meanings = part.attrs["flag_meanings"].split()
                flat = pd.Categorical.from_codes(_flags(flat, part.attrs), meanings)
            columns[f"{name}[{','.join(map(short, place))}]" if own else name] = flat
    return pd.DataFrame(columns).rename_axis("point")


def dims_beside(dataset: xr.Dataset) -> list[str]:
    """Dimensions that only some columns have, which make several columns of these, not more rows.

    The directions of nonlocal values; the bodies, where only what they are made of differs.
    """
    along = {str(dim) for values in dataset.data_vars.values() for dim in values.dims}
    beside = ["direction"] + ["body"] * ("body" not in along)
    return [name for name in beside if name in dataset.dims]


def words_of(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """Flags as words: see ``words`` of the accessor."""
    flags = [str(each) for each, values in dataset.data_vars.items() if "flag_meanings" in values.attrs]
    if name not in flags:
        raise refused("name", literal(name), f"a variable of flags: {', '.join(flags)}")
    words = np.array([*dataset[name].attrs["flag_meanings"].split(), ""], dtype=object)
    found = dataset[name].copy(data=words[_flags(dataset[name].values, dataset[name].attrs)])
    return found.drop_attrs(deep=False).assign_attrs(long_name=dataset[name].attrs.get("long_name", name))


def _flags(values: NDArray, attributes: Mapping[Any, Any]) -> NDArray:
    """Places of flags among their meanings; -1 for NaN, which xarray's operations leave where one lacks."""
    codes = pd.Index(np.atleast_1d(attributes["flag_values"])).get_indexer(np.ravel(values))
    return codes.reshape(np.shape(values))
