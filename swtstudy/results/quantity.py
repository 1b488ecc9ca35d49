"""s over its value at one place of a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.results.select import slice_at
from swtstudy.study.figure import reference

if TYPE_CHECKING:
    import xarray as xr


def normalised(dataset: xr.Dataset, y: str) -> xr.DataArray:
    """The quantity that a figure's ``y`` names: s, or s over its value at one place.

    Parameters
    ----------
    dataset
        Results.
    y
        "s", or "s/s(name=value)" with the name or the letter of a parameter.

    Raises
    ------
    ValueError
        If it is neither, or the place is not there.

    See Also
    --------
    normalised_error : the error that goes with it.
    """
    place = reference(y)
    if place is None:
        return dataset.s
    name, value = place
    ratio = dataset.s / slice_at(dataset, {name: value}).s.drop_vars(name)
    attributes = {"long_name": f"s over s at {name} = {value}", "units": "1", "symbol": "s/s_0"}
    return ratio.rename("s").assign_attrs(attributes)


def normalised_error(dataset: xr.Dataset, y: str) -> xr.DataArray:
    """Estimated absolute error of `normalised`; 0 at the place itself, and where no error is known."""
    place = reference(y)
    if "s_error" not in dataset:
        return 0.0 * normalised(dataset, y)
    if place is None:
        return dataset.s_error
    name, value = place
    there = slice_at(dataset, {name: value})
    own, reference_error = (part.s_error / abs(part.s) for part in (dataset, there.drop_vars(name)))
    error = abs(normalised(dataset, y)) * (own + reference_error)
    return error.where(dataset[name] != there[name].item(), 0.0)
