"""The least and the greatest value of a quantity along a dimension."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.results.quantity import quantity
from swtstudy.results.select import require_points
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest


def extrema(dataset: xr.Dataset, dim: str, y: str = "s") -> xr.Dataset:
    """Least and greatest values along a dimension, and where they are: see ``extrema`` of the accessor."""
    require_points(dataset)
    values = quantity(dataset, y).compute()  # xarray indexes by arrays in memory only
    if "flag_values" in values.attrs:
        raise StudyError([Mistake("y", f"{literal(y)}, whose values are flags", "numbers, such as 's'")])
    if dim not in values.dims:
        raise ValueError(
            f"found {dim!r}, not a dimension of {y}; allowed: {nearest(dim, map(str, values.dims))}"
        )
    symbol, units = values.attrs.get("symbol", y), values.attrs.get("units", "1")
    parts: dict[str, xr.DataArray] = {}
    for name, index in (
        ("minimum", values.fillna(np.inf).argmin(dim)),
        ("maximum", values.fillna(-np.inf).argmax(dim)),
    ):
        # Parameters of a sample, too, are along the dimension, and differ between the two places.
        along = [str(name) for name, each in values.coords.items() if dim in each.dims]
        value = values.isel({dim: index}).drop_vars(along)
        place = values[dim].isel({dim: index}).drop_vars(along)
        place = place.where(value.notnull()) if place.dtype.kind == "f" else place
        words = {"long_name": f"{name} of {y}", "comment": f"along {dim}", "units": units, "symbol": symbol}
        parts[name] = value.drop_attrs().assign_attrs(words)
        words = {"long_name": f"{dim.replace('_', ' ')} of {name} {y}"}
        parts[f"at_{name}"] = place.assign_attrs(dataset[dim].attrs | words)
    words = {"long_name": f"maximum over minimum of {y}", "comment": f"along {dim}", "units": "1"}
    parts["ratio"] = (parts["maximum"] / parts["minimum"]).drop_attrs().assign_attrs(words)
    found = xr.Dataset(parts)
    # The places that xarray indexes by bring coordinates without attributes.
    return found.assign_coords({name: found[name].assign_attrs(dataset[name].attrs) for name in found.coords})
