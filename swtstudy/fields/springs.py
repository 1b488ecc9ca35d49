"""The MDR springs: the memory diagram over the radius."""

from __future__ import annotations

import numpy as np

from swtstudy.fields.forces import NODES, of_instants
from swtstudy.mechanics.body.body import TimeNodes
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.control.force import ForceCoordinate
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.conjugate import Conjugate
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
        Shape (T, X): w in δ0, and τ = G* u_MDR/(μ E* δ0), |τ| ≤ w. In the plane, where strips have no
        springs, what the diagram has in their place: N − N(ξ) over P_0, and the tangential force over μP_0.
    """
    if isinstance(scene.coordinate, ForceCoordinate) and not scene.profile.plane:
        whole = Conjugate.whole(scene, scene.coordinate.unit, NODES)
        return _of_conjugate(of_instants(whole, nodes.interval), nodes.instant, radius)
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


def _of_conjugate(
    conjugate: Conjugate, instant: FloatArray, radius: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The same where the normal force is the diagram's coordinate: offsets are integrals over it."""
    states = conjugate.cycle.states(np.zeros((1, 1), dtype=np.intp), instant[:, None])
    edge, front = (conjugate.other.of(conjugate.coordinate.radius(v)) for v in (states.edge, states.front))
    radii = np.broadcast_to(radius, (len(instant), radius.size))
    depth = conjugate.other.of(radii)
    compression = np.maximum(edge - depth, 0.0)
    at = np.minimum(conjugate.coordinate.of(radii), states.front)
    stuck = conjugate.at(instant[:, None, None])[:, 0] - conjugate.offset(at[:, None])[:, 0]
    force = np.where(depth < front, stuck, states.sign * compression)
    return compression, np.where(compression > 0.0, force, 0.0)
