"""Climbs to the maxima of swt along the surface line, many at once: where they start and where they stand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.line.first_look import SHARE, Seen, high_positions
from swtstudy.mechanics.line.look import Look, Resolution
from swtstudy.mechanics.line.positions import Positions
from swtstudy.mechanics.line.refine import beside, summits
from swtstudy.mechanics.numerics.arrays import SAME, largest_of_rows, with_neighbours
from swtstudy.mechanics.numerics.roots import near_maximum
from swtstudy.mechanics.planes.through_y import PlaneHistory, on_planes
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.scene import Scene

#: Half the distance between the positions of a climb's first round, in gaps of the first look, and how it
#: shrinks from round to round. Twice or half the first: 3e-4 and 6e-4 low at points of
#: tests/mechanics/test_overlooked.py. Shrinking to a tenth: 3e-6 at rtol 1e-5; to 0.4: 3e-5 at 2 of 128.
FIRST_WIDTH, SHRINKING = 0.25, 0.2
#: Planes on which swt is looked at where climbs may start. 16, as of a first look: 1.4e-3 low at a point of
#: tests/mechanics/test_overlooked.py, at every rtol.
PLANES = 48


@dataclass(frozen=True)
class Climb(Rows):
    """Climbs to m local maxima of swt along x; arrays of shape (m,).

    Attributes
    ----------
    point, side, place
        Number of the point, sign of x, and number of the position around which is searched.
    intervals
        Shape (m, i): in which intervals of the cycle swt is looked at.
    angle
        2θ of the best plane so far, rad.
    centre, width
        Where the next round looks, in the c of `Positions.around`.
    top, seen
        Estimated maximum of swt, and the largest value so far.
    remaining
        How much `top` would change in further rounds, at most; all of it where the last round had the maximum
        at its outermost place.
    rounds
        Rounds that narrowed the search.
    settled
        Whether the next round would change too little to matter.
    """

    point: IndexArray
    side: FloatArray
    place: IndexArray
    intervals: BoolArray
    angle: FloatArray
    centre: FloatArray
    width: FloatArray
    top: FloatArray
    seen: FloatArray
    remaining: FloatArray
    rounds: IndexArray
    settled: BoolArray

    @classmethod
    def start(
        cls,
        scene: Scene,
        positions: Positions,
        seen: Seen,
        resolution: Resolution,
        least: FloatArray | None = None,
    ) -> Climb:
        """From a first look at positions of n points, on each plane on which swt may be largest.

        With ``least``, of shape (n,), on each on which it may be as high as that.
        """
        place, side = high_positions(positions, seen, least)
        own, x_sign = scene.take(positions.point[place]), np.where(side == 0, 1.0, -1.0)
        look = Look.at(own, positions.r[place][:, None], resolution.nodes, resolution.digits)
        planes = own.planes(look.history, x_sign[:, None, None]).take(np.arange(place.size), 0 * place)
        starts = _starts(planes, seen.double_angle[place, side])
        row, angle, swt = summits(planes, look.inside[:, 0], *starts)
        point = positions.point[place[row]]
        if least is None:
            least = largest_of_rows(point, swt)
        # Positions that were predicted by half of them leave less than half of the share.
        high = swt >= (1.0 - 0.5 * SHARE) * least[point]
        row, angle, point, zero = row[high], angle[high], point[high], np.zeros(np.count_nonzero(high))
        interval, count = look.placed.interval[row, 0], scene.cycle.begin.shape[1]
        intervals = _high_intervals(planes.take(row), angle, interval, count)
        heights = zero, zero + FIRST_WIDTH, zero, zero, zero
        rounds, settled = zero.astype(np.intp), zero > 0.0
        return cls(point, x_sign[row], place[row], intervals, angle, *heights, rounds, settled)

    def leading(self, turn: int) -> Climb:
        """Keep the climbs that may be the highest of their point after a round, the first one being 0."""
        # What the first look left unseen shrinks with the width of the rounds.
        unseen = SHARE * FIRST_WIDTH * SHRINKING**turn
        return self.take(self.top >= (1.0 - unseen) * largest_of_rows(self.point, self.top)[self.point])

    def without_followers(self, moved: BoolArray) -> Climb:
        """Without those that have just moved to a position around which another one searches no lower.

        On another plane the position itself may be higher than the other one has seen.
        """
        order = np.lexsort((moved, self.place, self.side, self.point))
        key = np.stack([self.point, self.side, self.place])[:, order]
        same = np.zeros(len(order), dtype=bool)
        same[1:] = (key[:, 1:] == key[:, :-1]).all(axis=0)
        first = np.maximum.accumulate(np.where(same, 0, np.arange(len(order))))
        seen = self.seen[order]
        higher = seen > (1.0 + SAME) * seen[first]
        return self.take(order[~(same & moved[order]) | higher])

    def twins(self, index: IndexArray, centre: FloatArray, value: FloatArray, angle: FloatArray) -> Climb:
        """Searches between the same neighbours as those at ``index``, around other values that were seen."""
        twins = self.take(index)
        return replace(
            twins,
            angle=angle,
            centre=centre,
            width=twins.width * SHRINKING,
            top=value,
            seen=value,
            remaining=value,
            rounds=twins.rounds + 1,
            settled=np.zeros(len(twins.point), dtype=bool),
        )


def _high_intervals(
    planes: PlaneHistory, double_angle: FloatArray, interval: IndexArray, count: int
) -> BoolArray:
    """Which of ``count`` intervals of the cycle may make swt near places, shape (m, count).

    Parameters
    ----------
    planes
        At m places and T instants.
    double_angle
        Shape (m,): 2θ of a plane each, rad.
    interval
        Shape (m, T): in which the instants are.
    """
    curves = planes.criterion.curves(*planes.on_plane(double_angle))
    # What positions, instants and planes may leave unseen.
    high = np.logical_or.reduce([near_maximum(curve, 3.0 * SHARE) for curve in curves])
    # An extreme is between its neighbours, which may be in other intervals.
    high = with_neighbours(high)
    result = np.zeros((len(interval), count), dtype=bool)
    place, instant = np.nonzero(high)
    result[place, interval[place, instant]] = True
    return result


def _starts(planes: PlaneHistory, double_angle: FloatArray) -> tuple[IndexArray, FloatArray]:
    """Planes from which to climb to the `summits` of m places that may be the largest.

    Parameters
    ----------
    planes
        At m places and T instants.
    double_angle
        Shape (m,): 2θ of the best planes of the first look, rad.

    Returns
    -------
    row, double_angle
        Shape (s,): numbers of the places, and 2θ of the planes in rad.
    """
    angles, table = np.linspace(0.0, 2.0 * np.pi, PLANES, endpoint=False), on_planes(planes, PLANES)
    own = np.arange(len(double_angle))
    peak = (table >= np.roll(table, 1, axis=0)) & (table > np.roll(table, -1, axis=0))
    peak &= table >= (1.0 - 2.0 * SHARE) * table.max(axis=0)
    # A place without tension keeps one.
    peak[table.argmax(axis=0), own] = True
    row, plane = np.nonzero(peak.T)
    around, start = beside(row, angles[plane])
    return np.append(around, own), np.append(start, double_angle)
