"""Nonlocal values of s over a critical distance, on a grid of parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import read_distances
from swtstudy.grid.canonical import SHAPE_COLUMNS
from swtstudy.mechanics.body import nonlocal_swt as mechanics
from swtstudy.mistakes import Mistake, StudyError, literal
from swtstudy.parameters import PARAMETERS, family_of
from swtstudy.solving import solve

_MEANINGS = {
    "s_volume": "mean of swt/SWT0 over the half sphere of the critical distance about the critical point",
    "s_point": "swt/SWT0 at half the critical distance (point method)",
    "s_line": "mean of swt/SWT0 over twice the critical distance (line method)",
}
_SHAPES = {
    f"s_{mean}{error}": () if mean == "volume" else (len(mechanics.DIRECTIONS),)
    for mean in ("volume", "point", "line")
    for error in ("", "_error")
}


def nonlocal_swt(critical_distance: object, **parameters: Any) -> xr.Dataset:
    """s and its nonlocal counterparts, which tend to s as the critical distance tends to 0.

    Parameters
    ----------
    critical_distance
        ℓ/a_H > 0, a number or a one-dimensional sequence.
    **parameters
        As for `swtstudy.solve`: single values or sequences.

    Returns
    -------
    xarray.Dataset
        What `swtstudy.solve` returns, with s_volume over the parameters and critical_distance, and s_point
        and s_line over these and direction: straight down, or along the critical plane into the body; each
        with its absolute error, …_error. NaN where there is no critical point.

    Raises
    ------
    StudyError
        A ValueError with the mistakes in the distances or the parameters.
    """
    allowed = "finite numbers ℓ/a_H > 0"
    distance = read_distances("critical_distance", critical_distance, allowed)
    if (distance <= 0.0).any():
        raise StudyError([Mistake("critical_distance", literal(critical_distance), allowed)])
    dataset = solve(**parameters)
    dims, shape = dataset.s.dims, dataset.s.shape
    found = {name: np.full((*shape, distance.size, *more), np.nan) for name, more in _SHAPES.items()}
    # Where s is not finite, or 0, there is no critical point.
    for index in map(tuple, np.argwhere(np.isfinite(dataset.critical_x.values))):
        one = dataset.isel(dict(zip(dims, index, strict=True)))
        # A grid of several profiles has the shape parameters of all of them.
        others = {*SHAPE_COLUMNS} - {*family_of(one.profile.item()).shape}
        values = {name: one[name].item() for name in PARAMETERS if name in one.coords and name not in others}
        x, angle = (one[name].values.reshape(1) for name in ("critical_x", "critical_angle"))
        for name, value in vars(mechanics.nonlocal_swt(read_scene(values), x, angle, distance)).items():
            found[f"s_{name}"][index] = value[0]
    of_axis = {"long_name": "critical distance, in units of a_H", "units": "1", "symbol": r"\ell/a_H"}
    dataset = dataset.assign_coords(
        critical_distance=("critical_distance", distance, of_axis),
        direction=("direction", np.array(mechanics.DIRECTIONS, dtype=object)),
    )
    for name, mean in found.items():
        along = (*dims, "critical_distance", *(["direction"] if mean.ndim > len(dims) + 1 else []))
        of_what = name.removesuffix("_error")
        meaning = _MEANINGS.get(name, f"estimated absolute error of {of_what}")
        dataset[name] = (along, mean, {"long_name": meaning, "units": "1"})
    return dataset
