"""The stress history of one point at the instants that make it, a few at a time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.body import Body, TimeNodes, closer_nodes, time_nodes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Scene

#: Steps on each stretch between two events: a smooth extreme is missed by 0.6 % of the range there at most.
_STEPS = 10
#: Cells with which the extremes are looked for, and how often: swt is within 1e-6 of that of all instants.
_CELLS, _LOOKS = 60, 2
#: Instants whose contact states are held at a time: their memory grows with the square of the number.
_BLOCK = 64


def decisive_nodes(scene: Scene, point: tuple[float, float, float]) -> TimeNodes:
    """Instants aligned with the events at a point, and close around the extremes that make its swt.

    Parameters
    ----------
    scene
        A batch of one point.
    point
        x, y, z in a_H.
    """
    nodes = time_nodes(scene, _STEPS, [np.hypot(*point[:2])])
    return closer_nodes(scene, nodes, point, _CELLS, _LOOKS)


def stress_at(
    scene: Scene, nodes: TimeNodes, cells: int, x: ArrayLike, y: ArrayLike, z: ArrayLike
) -> FloatArray:
    """Stress history at points of shape S, shape S + (T, 6), in E* √(δ0/R); ``cells`` as for `Body.of`."""
    stress = np.empty((*np.broadcast_shapes(*map(np.shape, (x, y, z))), nodes.instant.size, 6))
    for first in range(0, nodes.instant.size, _BLOCK):
        part = slice(first, first + _BLOCK)
        some = TimeNodes(nodes.interval[part], nodes.instant[part])
        stress[..., part, :] = Body.of(scene, some, cells).stress(x, y, z)
    return stress
