"""The zone of permanent stick of the points in an archive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.archive.recall import grid_of
from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.of_points import load_of
from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.points.canonical import SHARED_COLUMNS, group_rows, points_from

if TYPE_CHECKING:
    import xarray as xr


def stick_radius(dataset: xr.Dataset) -> xr.DataArray:
    """Radius in a_H inside which the contact sticks throughout the cycle.

    Returns
    -------
    xarray.DataArray
        With the dimensions of ``dataset.s``; 0 where the whole contact slides, or is lost, once a cycle.
        Where a flat face only just sticks, the radius of the face.
    """
    rows, _ = grid_of(dataset).canonical()
    radius = np.empty(len(rows))
    _, group = group_rows(rows[[*SHARED_COLUMNS]])
    for family in range(int(group.max()) + 1):
        members = np.flatnonzero(group == family)
        radius[members] = _radius(points_from(rows[members], {}))
    return dataset.s.copy(data=radius.reshape(dataset.s.shape)).rename("stick_radius")


def _radius(points: Points) -> FloatArray:
    """Radii of points of one profile family and frequency ratio, shape (n,)."""
    load = load_of(points)
    at = stick_coordinate(load)
    coordinate = DepthCoordinate(make_profile(points.profile, points.shape, load.largest_normal))
    return np.where(at >= 0, coordinate.radius(np.maximum(at, 0.0)[:, None])[:, 0], 0.0)
