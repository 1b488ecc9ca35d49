"""Nonlocal values of s over a critical distance, on a grid of parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from swtstudy.fields.decisive import decisive_nodes
from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import read_distances
from swtstudy.grid.canonical import SHAPE_COLUMNS
from swtstudy.mechanics.body.body import Body
from swtstudy.mechanics.body.nonlocal_swt import at_distance, critical_direction, line_mean, volume_mean
from swtstudy.mechanics.points import FloatArray
from swtstudy.mistakes import Mistake, StudyError, literal
from swtstudy.parameters import PARAMETERS, family_of
from swtstudy.solving import solve

#: Cells of the field, as for the instants (`decisive_nodes`).
_CELLS = 60
DIRECTIONS = ("depth", "critical_plane")
_MEANINGS = {
    "s_volume": "mean of swt/SWT0 over the half sphere of the critical distance about the critical point",
    "s_point": "swt/SWT0 at half the critical distance (point method)",
    "s_line": "mean of swt/SWT0 over twice the critical distance (line method)",
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
        and s_line over these and direction: straight down, or along the critical plane into the body. The
        instants are those of the critical point, so that values are about 1 % low at ℓ = 0.3 a_H, and less
        so at smaller ℓ. NaN where there is no critical point.

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
    volume = np.full((*shape, distance.size), np.nan)
    point, line = (np.full((*shape, distance.size, len(DIRECTIONS)), np.nan) for _ in range(2))
    # Where s is not finite, or 0, there is no critical point.
    for index in map(tuple, np.argwhere(np.isfinite(dataset.critical_x.values))):
        one = dataset.isel(dict(zip(dims, index, strict=True)))
        # A grid of several profiles has the shape parameters of all of them.
        others = {*SHAPE_COLUMNS} - {*family_of(one.profile.item()).shape}
        values = {name: one[name].item() for name in PARAMETERS if name in one.coords and name not in others}
        volume[index], point[index], line[index] = _of_point(values, float(one.critical_x), distance)
    meaning = {"long_name": "critical distance, in units of a_H", "units": "1", "symbol": r"\ell/a_H"}
    dataset = dataset.assign_coords(
        critical_distance=("critical_distance", distance, meaning),
        direction=("direction", np.array(DIRECTIONS, dtype=object)),
    )
    far = (*dims, "critical_distance")
    for name, found, along in (
        ("s_volume", volume, far),
        ("s_point", point, (*far, "direction")),
        ("s_line", line, (*far, "direction")),
    ):
        dataset[name] = (along, found, {"long_name": _MEANINGS[name], "units": "1"})
    return dataset


def _of_point(
    parameters: dict[str, object], x: float, distance: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Volume mean, point value and line mean of one parameter point, shapes (k,), (k, 2) and (k, 2)."""
    scene = read_scene(parameters)
    body = Body(scene, decisive_nodes(scene, (x, 0.0, 0.0)), _CELLS)
    down = np.array([0.0, 0.0, 1.0])
    directions = down, critical_direction(body.swt(x, 0.0, 0.0).normal)
    point = np.stack([at_distance(body, x, direction, distance) for direction in directions], axis=-1)
    line = np.stack([line_mean(body, x, direction, distance) for direction in directions], axis=-1)
    return volume_mean(body, x, distance), point, line
