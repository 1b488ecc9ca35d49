"""The maximum of swt over the surface line (eq. 10)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import joined_pieces, resolved
from swtstudy.mechanics.line.look import Accuracy
from swtstudy.mechanics.line.positions import Pieces, Positions
from swtstudy.mechanics.line.rounding import of_rounding
from swtstudy.mechanics.line.rounds import CHANGE_SHARE, tops
from swtstudy.mechanics.numerics.arrays import highest_of_rows
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.scene import Scene


@dataclass(frozen=True)
class Maximum(Rows):
    """Largest swt of n points.

    Attributes
    ----------
    swt, error
        Shape (n,): over E* δ0/R, and its estimated absolute error.
    position
        Shape (n,): signed x in a_H.
    double_angle
        Shape (n,): 2θ of the critical plane's normal, rad.
    """

    swt: FloatArray
    error: FloatArray
    position: FloatArray
    double_angle: FloatArray

    @classmethod
    def unknown(cls, count: int, value: float) -> Maximum:
        """``count`` points that all have the same ``value`` everywhere."""
        return cls(*(np.full(count, value) for _ in range(4)))

    def put(self, index: IndexArray | BoolArray, other: Maximum) -> Maximum:
        """The same with other points at ``index``."""
        result = Maximum(*(values.copy() for values in vars(self).values()))
        result.write(index, other)
        return result


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene.

    Points that miss the tolerance are climbed to once more with twice the instants and more rounds.
    """
    split = scene.split_at_breakpoints()
    positions, seen = resolved(scene, joined_pieces(scene, Pieces.of(split)))
    start = Climb.start(split, positions, seen, accuracy.search)
    found = _climbed(split, positions, start, accuracy)
    doubtful = np.flatnonzero(found.error > accuracy.tolerance * found.swt)
    if doubtful.size:
        some = start.take(np.isin(start.point, doubtful))
        again = _climbed(split, positions, some, accuracy.finer())
        # What was found is there: the larger value stands, and the smaller error.
        better = (again.error < found.error[doubtful]) & (
            again.swt >= found.swt[doubtful] - found.error[doubtful]
        )
        found = found.put(doubtful[better], again.take(better))
    # Where a bulk stress presses, tension may be within rounding of none.
    rows = np.flatnonzero((found.swt > 0.0) | scene.critical_everywhere)
    if rows.size:
        critical = found.position[rows], found.double_angle[rows]
        rounding = of_rounding(scene.take(rows), found.swt[rows], *critical, accuracy)
        found.error[rows] = np.maximum(found.error[rows], rounding)
    return found


def _climbed(split: Scene, positions: Positions, climb: Climb, accuracy: Accuracy) -> Maximum:
    """The maxima of the points to which climbs belong, in their order."""
    found = tops(split, positions, climb, accuracy, only_highest=True)
    best = found.take(highest_of_rows(found.climb.point, found.value))
    # A climb that is not over may change by all that its last round has changed, once more.
    climb = best.climb
    remaining = np.where(
        climb.settled, climb.remaining, np.minimum(climb.remaining / CHANGE_SHARE, climb.top)
    )
    error = np.abs(best.value - climb.top) + remaining
    # Nothing finer than this was looked at.
    error = np.maximum(error, accuracy.tolerance * best.value)
    return Maximum(best.value, error, best.position, best.angle)
