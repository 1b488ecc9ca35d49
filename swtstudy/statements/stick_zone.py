"""The zone of permanent stick of the points in an archive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.archive.recall import grid_of
from swtstudy.grid.canonical import COLUMNS, points_from
from swtstudy.mechanics.points import FloatArray, Points
from swtstudy.mechanics.profiles import make_profile
from swtstudy.mechanics.protocol import Protocol, stick_depth

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
    rows, _ = grid_of(dataset).canonical()
    radius = np.empty(len(rows))
    _, group = np.unique(rows[:, _GROUP], axis=0, return_inverse=True)
    for family in range(int(group.max()) + 1):
        members = np.flatnonzero(group.ravel() == family)
        radius[members] = _radius(points_from(rows[members]))
    return dataset.s.copy(data=radius.reshape(dataset.s.shape)).rename("stick_radius")


def _radius(points: Points) -> FloatArray:
    """Radii of points of one profile family and frequency ratio, shape (n,)."""
    protocol = Protocol(
        points.normal_amplitude, points.tangential_amplitude, points.phase, int(points.p[0]), int(points.q[0])
    )
    depth = stick_depth(protocol)
    profile = make_profile(points.profile, points.shape, 1.0 + points.normal_amplitude)
    return np.where(depth >= 0, profile.radius(np.maximum(depth, 0.0)[:, None])[:, 0], 0.0)
