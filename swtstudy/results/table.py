"""Results as a tidy table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal
from swtstudy.vocabulary.quantities import COUNTED

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from numpy.typing import NDArray


def to_table(dataset: xr.Dataset) -> pd.DataFrame:
    """Results as a table, one row per point: see ``to_table`` of the accessor."""
    import pandas as pd

    # A point has several cycles, which are no column.
    dataset = dataset.drop_vars([*COUNTED], errors="ignore")
    beside = dims_beside(dataset)
    dims = [str(name) for name in dataset.dims if name not in beside]
    # Those of a sample are along its dimension, single values along none.
    others = [str(name) for name in dataset.coords if name not in (*dims, *beside)]
    rows = dataset.drop_dims(beside)
    shape = tuple(rows.sizes[name] for name in dims)
    columns = {}
    for name in [*dims, *others, *map(str, dataset.data_vars)]:
        for column, values in _columns(name, dataset[name], beside):
            whole = values.broadcast_like(rows) if dims else values
            flat = np.broadcast_to(whole.transpose(*dims).values, shape).ravel()
            columns[column] = _as_words(flat, values.attrs.get("flag_meanings"))
    return pd.DataFrame(columns).rename_axis("point")


def dims_beside(dataset: xr.Dataset) -> list[str]:
    """Dimensions that only some columns have, which make several columns of these in the place of more rows.

    The directions of nonlocal values; the bodies, where only what they are made of differs.
    """
    along = {str(dim) for values in dataset.data_vars.values() for dim in values.dims}
    beside = ["direction"] + ["body"] * ("body" not in along)
    return [name for name in beside if name in dataset.dims]


def _columns(name: str, values: xr.DataArray, beside: list[str]) -> Iterator[tuple[str, xr.DataArray]]:
    own = next((dim for dim in beside if dim in values.dims), None)
    if own is None:
        yield name, values
        return
    for index, place in enumerate(values[own].values.tolist()):
        yield f"{name}[{place}]", values.isel({own: index}, drop=True)


def words_of(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """Flags as words: see ``words`` of the accessor."""
    flags = [str(each) for each, values in dataset.data_vars.items() if "flag_meanings" in values.attrs]
    if name not in flags:
        raise StudyError([Mistake("name", literal(name), f"a variable of flags: {', '.join(flags)}")])
    words = np.array([*dataset[name].attrs["flag_meanings"].split(), ""], dtype=object)
    values = dataset[name].values
    known = np.isfinite(values)
    found = dataset[name].copy(data=words[np.where(known, values, -1).astype(int)])
    return found.drop_attrs(deep=False).assign_attrs(long_name=dataset[name].attrs.get("long_name", name))


def _as_words(flat: NDArray, meanings: str | None) -> NDArray:
    """Flags by their meanings."""
    import pandas as pd

    if meanings is None:
        return flat
    # xarray's operations leave NaN where a flag is missing.
    codes = np.where(np.isfinite(flat), flat, -1).astype(int)
    return pd.Categorical.from_codes(codes, meanings.split())
