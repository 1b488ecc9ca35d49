"""The loads of parameter points: which points can be solved together, and which share one load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.points import FloatArray, Points


def load_of(points: Points) -> Load:
    """The loads (eqs. 7, 8) of points that are alike, see `alike`."""
    if points.path is not None:
        return points.path.loads(points.normal_amplitude, points.tangential_amplitude)
    of_load = points.normal_amplitude, points.tangential_amplitude, points.phase
    return BimodalLoad(*of_load, int(points.p[0]), int(points.q[0]))


def alike(points: Points) -> list[NDArray[np.intp]]:
    """Indices of points whose loads are one `Load`; within each, points with the same load are neighbours."""
    if not len(points):
        return []
    of_load = points.phase, points.tangential_amplitude, points.normal_amplitude
    order = np.lexsort((*of_load, points.p, points.q))
    ratio = np.stack([points.p, points.q])[:, order]
    return np.split(order, np.flatnonzero((np.diff(ratio, axis=1) != 0).any(axis=0)) + 1)


def largest_normal(points: Points) -> FloatArray:
    """The largest normal load of each point, shape (n,)."""
    largest = np.empty(len(points))
    for index in alike(points):
        largest[index] = load_of(points.take(index)).largest_normal
    return largest


def largest_turn_count(points: Points) -> int:
    """Largest number of turning instants that the load of points with equal shared columns can have."""
    if points.path is not None:
        return points.path.turn_count
    return 6 * int(max(points.p[0], points.q[0]))


def shared_load(points: Points) -> tuple[Load, NDArray[np.intp]]:
    """The distinct loads of points that are alike, and which of them each point has."""
    table = np.stack([points.normal_amplitude, points.tangential_amplitude, points.phase], axis=1)
    _, first, number = np.unique(table, axis=0, return_index=True, return_inverse=True)
    return load_of(points.take(first)), number.reshape(-1)
