"""The stress of a point's cycle at uniform instants, from this package's contact solution."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics import Points
from swtstudy.mechanics.body.body import nodes_at
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.stress.history import History
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import scene_of

INSTANTS, DIGITS = 64, 6.0


def history_at(point: Points, radius: np.ndarray) -> History:
    """Building blocks of the stress at r = ``radius``, shape (1, X, INSTANTS)."""
    scene = scene_of(point)
    nodes = nodes_at(scene, 2.0 * np.pi * (np.arange(INSTANTS) + 0.5) / INSTANTS)
    index = np.broadcast_to(np.arange(INSTANTS), (1, len(radius), INSTANTS))
    line = SurfaceLine(scene.cycle, scene.coordinate, radius[None], DIGITS)
    return line.history(Nodes(nodes.interval[None], nodes.instant[None], index))
