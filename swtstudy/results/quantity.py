"""The quantity that a figure shows: a data variable, or s over its value at one place."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.points.records import COMPUTED
from swtstudy.results.select import slice_at
from swtstudy.study.figure import QUANTITY, reference
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest
from swtstudy.vocabulary.quantities import error_of

if TYPE_CHECKING:
    import xarray as xr


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
    place = reference(y)
    if place is None:
        name = y.strip()
        if name not in dataset.data_vars:
            known = f"{nearest(name, map(str, dataset.data_vars))}, {QUANTITY}"
            raise StudyError([Mistake("figure.y", f"{literal(y)} (not a quantity)", known)])
        return known_regime(dataset) if name == "regime" else dataset[name]
    name, value = place
    ratio = dataset.s / slice_at(dataset, {name: value}).s.drop_vars(name)
    attributes = {"long_name": f"s over s at {name} = {value}", "units": "1", "symbol": "s/s_0"}
    return ratio.rename("s").assign_attrs(attributes)


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
    there = slice_at(dataset, {name: value})
    own, reference_error = (part.s_error / abs(part.s) for part in (dataset, there.drop_vars(name)))
    both = abs(quantity(dataset, y)) * (own + reference_error)
    return both.where(dataset[name] != there[name].item(), 0.0)
