"""From parameter points to s: batches that share protocols, bounded in memory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import Cycle, solve_cycle
from swtstudy.mechanics.face_edge import at_edge, may_be_largest, not_finite
from swtstudy.mechanics.local_search import Accuracy
from swtstudy.mechanics.maximum import Maximum, maximum
from swtstudy.mechanics.points import REGIMES, Points, Solution
from swtstudy.mechanics.profiles import make_profile, resolved_shape, roughness
from swtstudy.mechanics.protocol import Protocol
from swtstudy.mechanics.surface_circle import circle_gain
from swtstudy.mechanics.swt_line import Scene

#: Points times turning instants of one batch: enough to hide the interpreter.
BATCH_SIZE = 1600
#: The same with the square of the turning instants, which are instants and positions: the memory is bounded.
BATCH_SQUARES = 60_000
#: Relative error of tables, series and rounding, which no rtol removes (results/accuracy.md, at 1e-7).
LEAST_ERROR = 8e-8
#: So many batches may share the contact solutions that are held at a time.
SHARING = 8


def solve_points(points: Points, rtol: float = 1e-4) -> Solution:
    """s of every point (eqs. 7–20).

    Parameters
    ----------
    points
        n points of one profile family.
    rtol
        Relative accuracy asked for.

    Returns
    -------
    Solution
        Arrays of shape (n,). The value of a point does not depend on the others.
    """
    n = len(points)
    _, left_out = resolved_shape(points.profile, points.shape, 1.0 + points.normal_amplitude)
    # Without tangential motion there is no traction, whatever the friction.
    friction = np.where(points.tangential_amplitude > 0.0, points.friction, 0.0)
    # Pressure alone makes no tension at ν = 1/2, and without motion no swing of strain.
    idle = (friction == 0.0) & ((points.poisson_ratio == 0.5) | (points.normal_amplitude == 0.0))
    s, error, position, angle, surface = (np.zeros(n) for _ in range(5))
    regime = np.zeros(n, dtype=np.int8)
    accuracy = Accuracy.for_tolerance(rtol)
    for index, cycle in _batches(points):
        shape = {name: values[index] for name, values in points.shape.items()}
        profile = make_profile(points.profile, shape, 1.0 + points.normal_amplitude[index])
        scene = Scene(cycle, profile, points.poisson_ratio[index], friction[index])
        lost = not_finite(profile, cycle, scene.friction)
        still = idle[index] & ~lost
        found = _maximum(scene, np.flatnonzero(~(lost | still)), accuracy)
        found = found.put(still, Maximum.unknown(int(still.sum()), 0.0))
        s[index] = found.swt
        error[index] = np.maximum(found.error + left_out[index] * found.swt, LEAST_ERROR * found.swt)
        gain, _ = circle_gain(scene, found.position, found.double_angle)
        surface[index] = np.where(found.swt == 0.0, 0.0, found.swt * (1.0 + gain))
        critical = found.swt > 0.0
        position[index] = np.where(critical, found.position, np.nan)
        angle[index] = np.where(critical, _fold_angle(np.degrees(found.double_angle) / 2.0), np.nan)
        state = np.where(cycle.slips(), "partial_slip", "stick")
        state = np.where(cycle.gross_slip, "gross_slip", state)
        state = np.where(cycle.lift_off, "lift_off", state)
        state = np.where(lost, "not_finite", state)
        regime[index] = [REGIMES.index(name) for name in state]
    return Solution(s, error, position, angle, regime, surface)


def _batches(points: Points) -> Iterator[tuple[NDArray[np.intp], Cycle]]:
    """Indices of points with the same frequency ratio and roughness, and their contact cycles."""
    if not len(points):
        return
    level = roughness(points.profile, points.shape, 1.0 + points.normal_amplitude)
    loads = points.phase, points.tangential_amplitude, points.normal_amplitude
    order = np.lexsort((*loads, points.p, points.q))
    ratio = np.stack([points.p, points.q])[:, order]
    for group in np.split(order, np.flatnonzero((np.diff(ratio, axis=1) != 0).any(axis=0)) + 1):
        turns = 6 * int(max(points.p[group[0]], points.q[group[0]]))
        size = max(min(BATCH_SIZE // turns, BATCH_SQUARES // turns**2), 1)
        for sharing in _split(group, SHARING * size):
            # One contact solution for all profiles.
            protocol, load = _shared_protocols(points, sharing)
            cycle = solve_cycle(protocol)
            for alike in np.unique(level[sharing]):
                for rows in _split(np.flatnonzero(level[sharing] == alike), size):
                    yield sharing[rows], cycle.take(load[rows])


def _split(index: NDArray[np.intp], size: int) -> list[NDArray[np.intp]]:
    """The index in pieces of ``size`` at most, which are nearly equal."""
    return np.array_split(index, -(-len(index) // size))


def _shared_protocols(points: Points, index: NDArray[np.intp]) -> tuple[Protocol, NDArray[np.intp]]:
    """The distinct load protocols of a batch, and which of them each point has."""
    loads = np.stack(
        [points.normal_amplitude[index], points.tangential_amplitude[index], points.phase[index]], axis=1
    )
    distinct, load = np.unique(loads, axis=0, return_inverse=True)
    normal, tangential, phase = distinct.T
    p, q = int(points.p[index[0]]), int(points.q[index[0]])
    return Protocol(normal, tangential, phase, p, q), load.reshape(-1)


def _maximum(scene: Scene, finite: NDArray[np.intp], accuracy: Accuracy) -> Maximum:
    """The maximum of each point of the scene, NaN but for those at ``finite``."""
    found = Maximum.unknown(len(scene), np.nan)
    if finite.size:
        found = found.put(finite, maximum(scene.take(finite), accuracy))
    near = finite[may_be_largest(scene.profile, scene.cycle, scene.friction)[finite]]
    if near.size:
        found = found.put(near, at_edge(scene.take(near), found.take(near), accuracy))
    return found


def _fold_angle(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same plane's angle in (−90, 90]."""
    return 90.0 - np.mod(90.0 - degrees, 180.0)
