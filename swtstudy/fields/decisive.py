"""The instants of a cycle that decide swt at one point."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.body.body import TimeNodes, closer_nodes, time_nodes
from swtstudy.mechanics.stress.field.kernels import kernels_of
from swtstudy.mechanics.stress.scene import Scene

#: Steps on each stretch between two events: a smooth extreme is missed by 0.6 % of the range there at most.
_STEPS = 10
#: Cells of the field in which extremes are searched, and rounds of the search: swt is then within 1e-6 of
#: that over all instants.
_CELLS, _ROUNDS = 60, 2


def decisive_nodes(scene: Scene, point: tuple[float, float, float]) -> TimeNodes:
    """Instants aligned with the events at a point, and close to the extremes that decide its swt.

    Parameters
    ----------
    scene
        A batch of one point.
    point
        x, y, z in a_H.
    """
    distance = kernels_of(scene.profile).distance(*np.array(point[:2]))
    nodes = time_nodes(scene, _STEPS, [distance])
    return closer_nodes(scene, nodes, point, _CELLS, _ROUNDS)
