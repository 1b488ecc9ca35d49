"""The zone of permanent stick of the points in an archive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.grid.canonical import COLUMNS, points_from
from swtstudy.grid.grid import Grid
from swtstudy.grid.reading import read_grid
from swtstudy.mechanics.contact.stick_depth import stick_depth
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.bimodal import Protocol
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
    protocol = Protocol(
        points.normal_amplitude, points.tangential_amplitude, points.phase, int(points.p[0]), int(points.q[0])
    )
    depth = stick_depth(protocol)
    profile = make_profile(points.profile, points.shape, 1.0 + points.normal_amplitude)
    return np.where(depth >= 0, profile.radius(np.maximum(depth, 0.0)[:, None])[:, 0], 0.0)


def _grid(dataset: xr.Dataset) -> Grid:
    """The grid that a Dataset was computed on, from its coordinates."""
    known = {name: dataset[name].values for name in dataset.coords if name in PARAMETERS}
    axes = {name: known.pop(name).tolist() for name in map(str, dataset.s.dims)}
    grid, mistakes = read_grid({str(name): value.item() for name, value in known.items()}, axes)
    if grid is None:
        raise StudyError(mistakes)
    return grid
