"""Curves of one parameter point: forces and displacements over the cycle, its springs at marked instants.

The springs show the memory diagram over the radius; forces are known whichever of them are prescribed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.body import TimeNodes, nodes_at, time_nodes, together
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.control.coordinate import ForceCoordinate
from swtstudy.mechanics.numerics.arrays import ROUNDING
from swtstudy.mechanics.planes.swing import NORMAL_STRAIN, SHEAR_STRESS
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.mechanics.stress.work import LARGEST_SIZE, Conjugate

#: Gauss nodes for each growth of the memory: 1e-6 of the amplitude and better.
NODES = 64


def of_instants(whole: Conjugate, interval: IndexArray) -> Conjugate:
    """That of one cycle at T instants, as T cycles of one interval each."""
    return whole.take_intervals(np.zeros(len(interval), dtype=np.intp), interval)


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


Variables = dict[str, tuple[Any, Any, dict[str, str]]]

#: Uniform instants for smooth curves: 360 for each oscillation of a cycle of up to 4, no fewer than 90 for
#: each of longer cycles; and steps between two events.
_SPARSE, _UNIFORM, _FEW, _STEPS = 90, 360, 4, 8
#: How many instants are marked at most, and their least distance in cycles: their marks do not overlap.
_MARKED, _APART = 4, 0.08


def named(meaning: str, symbol: str) -> dict[str, str]:
    """Attributes of a non-dimensional variable."""
    return {"long_name": meaning, "units": "1", "symbol": symbol}


def instants_of(scene: Scene, special: list[float]) -> TimeNodes:
    """Instants of the cycle for smooth curves, with events; also those at some distances from the axis."""
    oscillations = max(scene.cycle.load.oscillations)
    count = max(_UNIFORM * min(oscillations, _FEW), _SPARSE * oscillations)
    uniform = nodes_at(scene, 2.0 * np.pi * np.arange(count + 1) / count)
    return together(scene, time_nodes(scene, _STEPS, special), uniform)


def course_of_load(scene: Scene, unit: FloatArray, nodes: TimeNodes) -> Variables:
    """The prescribed loads and the responses over time; in the plane forces alone.

    Parameters
    ----------
    scene
        A batch of one point.
    unit
        Shape (1,), see `swtstudy.mechanics.control.coordinate.unit_half_load`.
    nodes
        T instants of its cycle.
    """
    load = scene.cycle.load
    normal, tangential = (f(nodes.instant[None])[0] for f in (load.normal, load.tangential))
    if scene.profile.plane:  # of displacements only changes at constant load are known
        return _over_time(normal_force=normal, tangential_force=tangential)
    whole = Conjugate.whole(scene, unit, NODES)
    other_normal = whole.other.of(scene.coordinate.radius(np.maximum(normal, 0.0)[None]))[0]
    size = max(1, LARGEST_SIZE // (scene.cycle.memory.start.shape[2] * NODES))
    answer = np.empty_like(tangential)
    for first in range(0, answer.size, size):
        part = slice(first, first + size)
        answer[part] = of_instants(whole, nodes.interval[part]).at(nodes.instant[part, None, None])[:, 0, 0]
    given, answers = (normal, tangential), (other_normal, answer)
    forces, motion = (given, answers) if whole.by_force else (answers, given)
    return _over_time(
        depth=motion[0], displacement=motion[1], normal_force=forces[0], tangential_force=forces[1]
    )


_MEANINGS = {
    "depth": named("indentation depth", r"\delta/\delta_0"),
    "displacement": named("tangential displacement", r"G^* u/(\mu E^* \delta_0)"),
    "normal_force": named("normal force", "F_N/F_0"),
    "tangential_force": named("tangential force", r"F_x/(\mu F_0)"),
}


def _over_time(**curves: FloatArray) -> Variables:
    return {name: ("time", values, _MEANINGS[name]) for name, values in curves.items()}


def edge_states(scene: Scene, nodes: TimeNodes) -> NDArray[np.int8]:
    """State of the outermost springs between each instant and the next, numbered as in `slip_map`."""
    ends = np.append(nodes.instant[1:], nodes.instant[-1])
    middle = nodes_at(scene, 0.5 * (nodes.instant + ends))
    states = scene.cycle.states(middle.interval[None], middle.instant[None])
    slips = np.where(states.sign > 0.0, 2, 3)
    state = np.where(states.front >= (1.0 - ROUNDING) * states.edge, 1, slips)
    return np.where(states.edge > 0.0, state, 0)[0].astype(np.int8)


def of_states(flags: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes of `edge_states`, from those of the states of a slip map."""
    return {**flags, "long_name": "state of the contact next to its edge, until the next instant"}


def marked_instants(share: FloatArray, curves: dict[str, FloatArray]) -> tuple[IndexArray, list[str]]:
    """Instants at which curves over the cycle are extreme, in the order of time, and the reason for each.

    Parameters
    ----------
    share
        Shape (T,): time in cycles.
    curves
        Depth and displacement over it, or without them the forces; if stress and strain, or shear stress, on
        the critical plane are there, they come first.
    """
    of_swt: dict[str, np.intp] = {}
    if "normal_stress" in curves:
        of_swt["σ_n largest"] = curves["normal_stress"].argmax()
    if NORMAL_STRAIN.name in curves:
        of_swt["ε_n smallest"] = curves[NORMAL_STRAIN.name].argmin()
    if SHEAR_STRESS.name in curves:
        of_swt |= {
            "τ largest": curves[SHEAR_STRESS.name].argmax(),
            "τ smallest": curves[SHEAR_STRESS.name].argmin(),
        }
    names = {"δ": "depth", "u": "displacement"}
    if "depth" not in curves:
        names = {"F_N": "normal_force", "F_x": "tangential_force"}
    (normal, tangential), extremes = names.values(), of_swt
    for letter, name in names.items():
        extremes = extremes | {
            f"{letter} largest": curves[name].argmax(),
            f"{letter} smallest": curves[name].argmin(),
        }
    touching = curves[normal] > 0.0
    distance = np.full(share.size, 1.0)  # to the nearest instant that is marked already
    marked: dict[int, str] = {}

    def mark(index: int, reason: str) -> None:
        marked[index] = reason
        nonlocal distance
        distance = np.minimum(distance, np.abs((share - share[index] + 0.5) % 1.0 - 0.5))

    for reason, index in extremes.items():
        if len(marked) < _MARKED and distance[index] >= _APART and (reason in of_swt or touching[index]):
            mark(int(index), reason)
    swings = (NORMAL_STRAIN.name, SHEAR_STRESS.name)
    moving = next((curves[name] for name in swings if name in curves), curves[tangential])
    while len(marked) < _MARKED and np.ptp(moving) > 0.0:
        mark(int(np.where(touching, distance, -1.0).argmax()), "in between")
    order = sorted(marked)
    return np.array(order), [marked[index] for index in order]


def springs_of(scene: Scene, some: TimeNodes, radius: FloatArray) -> Variables:
    """The memory diagram over r at some instants; see `spring_forces`."""
    compression, force = spring_forces(scene, some, radius)
    dims = ("instant", "r")
    if scene.profile.plane:
        return {
            "compression": (dims, compression, named("normal force beyond that of the strip", "w/F_0")),
            "force": (dims, force, named("tangential force in the diagram", r"\tau/(\mu F_0)")),
        }
    return {
        "compression": (dims, compression, named("compression of the springs", r"w/\delta_0")),
        "force": (dims, force, named("tangential force of the springs", r"G^* u_{MDR}/(\mu E^* \delta_0)")),
    }
