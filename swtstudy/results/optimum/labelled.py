"""An optimum, how it was found, its neighbourhood and the worst case as a Dataset."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.points.grid import SAMPLE
from swtstudy.points.labelled import ATTRIBUTES
from swtstudy.results.optimum.box import Box
from swtstudy.results.optimum.least import Least
from swtstudy.results.optimum.objective import worst
from swtstudy.vocabulary.quantities import NAMED

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.points.grid import Grid

#: The data variables that may be made least: those with values that are not flags, and what may be asked.
MINIMISED = (
    *(n for n, words in ATTRIBUTES.items() if "flag_values" not in words and n not in ("s_error", "run")),
    *NAMED,
)
#: Steps of the neighbourhood, as fractions of a range.
_STEPS = np.linspace(-0.1, 0.1, 41)


def dataset_of(
    box: Box, found: Mapping[str, Least], quantity: str, solve: Callable[[Grid], xr.Dataset]
) -> xr.Dataset:
    """The Dataset of the optima by case; see `swtstudy.optimise`."""
    units = np.array([each.unit for each in found.values()])
    cases = solve(box.sample(units)).drop_vars(SAMPLE).rename({SAMPLE: "case"})
    cases = cases.assign_coords(case=list(found))
    own = {key: words for key, words in cases[quantity].attrs.items() if key in ("units", "symbol")}
    progress = np.full((len(found), max(len(each.progress) for each in found.values())), np.nan)
    for row, each in zip(progress, found.values(), strict=True):
        row[: len(each.progress)] = each.progress
    columns = list(zip(*((e.searched, e.converged, e.evaluations) for e in found.values()), strict=True))
    how: dict[str, Any] = {
        "searched": ("case", np.array(columns[0]), {"long_name": f"{quantity} before the polish", **own}),
        "progress": (
            ("case", "generation"),
            progress,
            {"long_name": f"{quantity} after each generation", **own},
        ),
        "converged": ("case", np.array(columns[1], np.int8), {"long_name": "whether the search converged"}),
        "evaluations": ("case", np.array(columns[2]), {"long_name": "number of points solved"}),
    }
    return cases.assign(how).merge(_neighbourhood(box, units, quantity, own, solve))


def _neighbourhood(
    box: Box, units: FloatArray, quantity: str, own: dict[str, str], solve: Callable[[Grid], xr.Dataset]
) -> xr.Dataset:
    """The quantity along each parameter through each of n points of the unit cube, shape (n, d)."""
    import xarray as xr

    d = units.shape[1]
    # Shape (cases, d, steps, d): every parameter is stepped by itself.
    places = units[:, None, None, :] + np.eye(d)[:, None, :] * _STEPS[:, None]
    inside = ((places >= 0.0) & (places <= 1.0)).all(axis=-1)
    found = np.full(inside.shape, np.nan)
    found[inside] = worst(solve(box.sample(places[inside]))[quantity])
    stepped = np.moveaxis(np.diagonal(box.values(places), axis1=1, axis2=3), -1, 1)
    along = ("case", "parameter", "step")
    values = np.where(inside, stepped, np.nan)
    words = {"long_name": "value of the parameter", "comment": "the others are those of the case"}
    return xr.Dataset(
        {"nearby": (along, found, {"long_name": f"{quantity} along each parameter", **own})},
        {
            "nearby_value": (along, values, words),
            "parameter": list(box.names),
            "step": ("step", _STEPS, {"long_name": "step as a fraction of the range"}),
        },
    )
