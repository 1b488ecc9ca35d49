"""Results as a tidy table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.quantities import COUNTED

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def to_table(dataset: xr.Dataset) -> pd.DataFrame:
    """Results as a table, one row per point: see ``to_table`` of the accessor."""
    import pandas as pd

    # A point has several cycles, which are no column.
    dataset = dataset.drop_vars([*COUNTED], errors="ignore")
    dims = list(map(str, dataset.dims))
    # Those of a sample are along its dimension, single values along none.
    others = [str(name) for name in dataset.coords if name not in dims]
    shape = tuple(dataset.sizes.values())
    columns = {}
    for name in [*dims, *others, *map(str, dataset.data_vars)]:
        values = dataset[name].broadcast_like(dataset) if dims else dataset[name]
        flat = np.broadcast_to(values.transpose(*dims).values, shape).ravel()
        meanings = dataset[name].attrs.get("flag_meanings")
        if meanings is not None:
            # xarray's operations leave NaN where a flag is missing.
            codes = np.where(np.isfinite(flat), flat, -1).astype(int)
            flat = pd.Categorical.from_codes(codes, meanings.split())
        columns[name] = flat
    return pd.DataFrame(columns).rename_axis("point")
