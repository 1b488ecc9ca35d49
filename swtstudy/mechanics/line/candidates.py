"""Local maxima of swt along the surface line, also far below the largest one.

A mean over a critical distance may be largest about one of these.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.accuracy import Accuracy
from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import resolved
from swtstudy.mechanics.line.positions import Pieces
from swtstudy.mechanics.line.round import climb_to_tops, looked_at_once_more
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Relative accuracy of swt there.
TOLERANCE = 1e-4
#: Maxima of a point nearer to one another than this share of the contact radius are one.
SAME_MAXIMUM = 1e-5


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

    Of a load whose second half mirrors the first, those at x ≥ 0 alone.
    """
    split, accuracy = scene.split_at_breakpoints(), Accuracy.for_tolerance(TOLERANCE)
    positions, seen = resolved(scene, Pieces.of(split))
    climb = Climb.start(split, positions, seen, accuracy.search, least)
    climb = climb_to_tops(split, positions, climb, accuracy)
    position, swt, angle = looked_at_once_more(split, positions, climb, accuracy)
    found = Candidates(climb.point, position, angle, swt)
    return _apart(found, SAME_MAXIMUM * scene.largest_radius)


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
