"""The MDR springs: the memory diagram in the radius."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.body import TimeNodes
from swtstudy.mechanics.contact import GROWTH, slip_front
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Scene


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
    depth = np.maximum(cycle.protocol.depth(nodes.instant[None]), 0.0)
    u = cycle.protocol.displacement(nodes.instant[None])
    senses = cycle.forward, cycle.backward
    front, sign, _ = slip_front(cycle.protocol, cycle.memory, *senses, nodes.interval[None], depth, u)
    depth, u, front, sign = (values[0][:, None] for values in (depth, u, front, sign))
    memory = cycle.memory.take((np.zeros_like(nodes.interval), nodes.interval))
    at = scene.profile.depth(radius[None])[0]
    piece = np.maximum((memory.start[:, None] <= at[:, None]).sum(axis=-1) - 1, 0)
    start, offset, slope, branch = (
        np.take_along_axis(values, piece, axis=1)
        for values in (memory.start, memory.offset, memory.slope, memory.branch)
    )
    distance = np.where(np.isfinite(start), at - start, 0.0)
    line = offset + np.where(slope == GROWTH, 0.0, slope) * distance
    grown = cycle.protocol.displacement(
        cycle.protocol.touch_down(np.broadcast_to(at, branch.shape).reshape(1, -1), branch.reshape(1, -1))
    ).reshape(branch.shape)
    stuck = u - np.where(slope == GROWTH, grown, line)
    compression = np.maximum(depth - at, 0.0)
    force = np.where(at < front, stuck, sign * compression)
    return compression, np.where(compression > 0.0, force, 0.0)
