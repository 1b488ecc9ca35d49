"""Local maxima of swt along the surface line, also far below the largest one.

A mean over a critical distance may be largest about one of these.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.accuracy import Accuracy
from swtstudy.mechanics.line.climb import FIRST_WIDTH, Climb
from swtstudy.mechanics.line.first_look import first_look
from swtstudy.mechanics.line.maximum import SCAN_PLANES, SCAN_RESOLUTION
from swtstudy.mechanics.line.positions import positions_of_first_look
from swtstudy.mechanics.line.round import climb_round
from swtstudy.mechanics.line.value import refine
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Relative accuracy of swt there, and rounds of the climbs at most.
TOLERANCE, ROUNDS = 1e-4, 16
#: Maxima of a point nearer to one another than this share of the contact radius are one.
SAME = 1e-5


class Candidates(NamedTuple):
    """m local maxima, arrays of shape (m,).

    Attributes
    ----------
    rows
        Number of the point.
    position, double_angle, swt
        Signed x in a_H, 2θ of the best plane there, rad, and swt; descending in swt for each point.
    """

    rows: NDArray[np.intp]
    position: FloatArray
    double_angle: FloatArray
    swt: FloatArray


def candidates(scene: Scene, least: FloatArray) -> Candidates:
    """Local maxima of swt on the surface line of n points that are above the ``least``, shape (n,).

    Of a load whose second half mirrors the first, those at x ≥ 0 alone. Cusps that the positions of the first
    look step over, beside a higher maximum, are left out.
    """
    split = scene.split_at_breakpoints()
    positions = positions_of_first_look(split.cycle, scene.coordinate, scene.bulk is not None)
    look = first_look(scene, positions.r, SCAN_RESOLUTION, SCAN_PLANES)
    swt = np.where(np.arange(positions.r.shape[1]) < positions.count[:, None, None], look.swt, -np.inf)
    padded = np.pad(swt, ((0, 0), (0, 0), (1, 1)), constant_values=-np.inf)
    peak = (swt > padded[..., :-2]) & (swt >= padded[..., 2:]) & (swt > least[:, None, None])
    point, side, column = np.nonzero(peak)
    climb = _started(scene, look.closer(scene, point, side, column), point, side, column)
    accuracy = Accuracy.for_tolerance(TOLERANCE)
    for _ in range(ROUNDS):
        going = np.flatnonzero(~climb.settled)
        if not going.size:
            break
        moved, _ = climb_round(split, positions, climb.take(going), accuracy)
        climb = Climb.joined([climb.take(climb.settled), moved])
    r = climb.brackets(positions).radius(climb.centre[:, None])
    value, angle = refine(split.take(climb.point), r, climb.side, climb.angle[:, None], accuracy.check)
    found = Candidates(climb.point, climb.side * r[:, 0], angle[:, 0], value[:, 0])
    return _apart(found, SAME * scene.largest_radius)


def _started(
    scene: Scene, angle: FloatArray, point: NDArray[np.intp], side: NDArray[np.intp], column: NDArray[np.intp]
) -> Climb:
    """Climbs from positions of the first look."""
    m = len(point)
    centre, top, seen, remaining = np.zeros((4, m))
    x_sign, width = np.where(side == 0, 1.0, -1.0), np.full(m, FIRST_WIDTH)
    rounds, settled = np.zeros(m, dtype=np.intp), np.zeros(m, dtype=bool)
    return Climb(point, x_sign, column, angle, centre, width, top, seen, remaining, rounds, settled)


def _apart(found: Candidates, distance: FloatArray) -> Candidates:
    """In descending order for each point, without those near to higher ones."""
    order = np.lexsort((-found.swt, found.rows))
    kept: list[int] = []
    for k in order:
        same = [j for j in kept if found.rows[j] == found.rows[k]]
        if all(abs(found.position[j] - found.position[k]) > distance[found.rows[k]] for j in same):
            kept.append(int(k))
    rows, position, double_angle, swt = found
    return Candidates(rows[kept], position[kept], double_angle[kept], swt[kept])
