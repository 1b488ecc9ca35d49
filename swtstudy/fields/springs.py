"""The MDR springs: the memory diagram over the radius."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.body.body import TimeNodes
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene


def spring_forces(scene: Scene, nodes: TimeNodes, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Compression and tangential force of the springs at some radii.

    Parameters
    ----------
    scene
        A batch of one point.
    nodes
        T instants of its cycle.
    radius
        Shape (X,), ξ in a_H.

    Returns
    -------
    compression, force
        Shape (T, X): w in δ0, and τ = G* u_MDR/(μ E* δ0), |τ| ≤ w.
    """
    cycle = scene.cycle
    states = cycle.states(nodes.interval[None], nodes.instant[None])
    edge, tangential, front, sign = (
        values[0][:, None] for values in (states.edge, states.tangential, states.front, states.sign)
    )
    at = scene.coordinate.of(radius[None])[0]
    piece = np.maximum((cycle.memory.start[0, nodes.interval, None] <= at[:, None]).sum(axis=-1) - 1, 0)
    pieces = cycle.memory.take((np.zeros_like(piece)[None], nodes.interval[:, None], piece))
    stuck = tangential - held_offset(cycle.load, pieces, np.broadcast_to(at, (1, *piece.shape)))[0]
    compression = np.maximum(edge - at, 0.0)
    force = np.where(at < front, stuck, sign * compression)
    return compression, np.where(compression > 0.0, force, 0.0)
