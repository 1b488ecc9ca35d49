"""The least and the greatest s along a dimension."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.mistakes import nearest
from swtstudy.results.select import require_points


def extrema(dataset: xr.Dataset, dim: str) -> xr.Dataset:
    """Least and greatest s along a dimension, and where they are: see ``extrema`` of the accessor."""
    if dim not in dataset.s.dims:
        raise ValueError(
            f"found {dim!r}, not a dimension of s; allowed: {nearest(dim, map(str, dataset.s.dims))}"
        )
    require_points(dataset)
    dataset = dataset[["s"]].compute()  # xarray indexes by arrays in memory only
    parts: dict[str, xr.DataArray] = {}
    for name, index in (
        ("minimum", dataset.s.fillna(np.inf).argmin(dim)),
        ("maximum", dataset.s.fillna(-np.inf).argmax(dim)),
    ):
        # Parameters of a sample, too, are along the dimension, and differ between the two places.
        along = [str(name) for name, values in dataset.coords.items() if dim in values.dims]
        value = dataset.s.isel({dim: index}).drop_vars(along)
        place = dataset[dim].isel({dim: index}).drop_vars(along)
        place = place.where(value.notnull()) if place.dtype.kind == "f" else place
        words = {"long_name": f"{name} of s", "comment": f"along {dim}", "units": "1", "symbol": "s"}
        parts[name] = value.drop_attrs().assign_attrs(words)
        words = {"long_name": f"{dim.replace('_', ' ')} of {name} s"}
        parts[f"at_{name}"] = place.assign_attrs(dataset[dim].attrs | words)
    words = {"long_name": "maximum over minimum of s", "comment": f"along {dim}", "units": "1"}
    parts["ratio"] = (parts["maximum"] / parts["minimum"]).drop_attrs().assign_attrs(words)
    found = xr.Dataset(parts)
    # The places that xarray indexes by bring coordinates without attributes.
    return found.assign_coords({name: found[name].assign_attrs(dataset[name].attrs) for name in found.coords})
