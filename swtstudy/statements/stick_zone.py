"""The zone of permanent stick of the points in an archive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.grid.canonical import COLUMNS, points_from
from swtstudy.grid.grid import Grid
from swtstudy.grid.reading import read_grid
from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.of_points import load_of
from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.mistakes import StudyError
from swtstudy.parameters import PARAMETERS

if TYPE_CHECKING:
    import xarray as xr

_GROUP = [COLUMNS.index(name) for name in ("profile", "p", "q")]


def stick_radius(dataset: xr.Dataset) -> xr.DataArray:
    """Radius in a_H inside of which the contact sticks all through the cycle.

    Returns
    -------
    xarray.DataArray
        Of the shape of ``dataset.s``; 0 where the whole contact slides or is lost once a cycle. Where a
        flat face just sticks it is the radius of the face.
    """
    rows, _ = _grid(dataset).canonical()
    radius = np.empty(len(rows))
    _, group = np.unique(rows[:, _GROUP], axis=0, return_inverse=True)
    for number in range(int(group.max()) + 1):
        members = np.flatnonzero(group.ravel() == number)
        radius[members] = _radius(points_from(rows[members]))
    return dataset.s.copy(data=radius.reshape(dataset.s.shape)).rename("stick_radius")


def _radius(points: Points) -> FloatArray:
    """Radii of points of one profile family and frequency ratio, shape (n,)."""
    load = load_of(points)
    at = stick_coordinate(load)
    coordinate = DepthCoordinate(make_profile(points.profile, points.shape, load.largest_normal))
    return np.where(at >= 0, coordinate.radius(np.maximum(at, 0.0)[:, None])[:, 0], 0.0)


def _grid(dataset: xr.Dataset) -> Grid:
    """The grid that a Dataset was computed on, from its coordinates."""
    known = {name: dataset[name].values for name in dataset.coords if name in PARAMETERS}
    axes = {name: known.pop(name).tolist() for name in map(str, dataset.s.dims)}
    grid, mistakes = read_grid({str(name): value.item() for name, value in known.items()}, axes)
    if grid is None:
        raise StudyError(mistakes)
    return grid
