"""Climbs to the maxima of swt along the surface line, many at once: where they stand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.first_look import FirstLook
from swtstudy.mechanics.line.look import LEVEL
from swtstudy.mechanics.line.positions import PositionBrackets, Positions
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Half the distance between the positions of a climb's first round, in gaps of the first look, and how it
#: shrinks from round to round. Twice the first: 1e-4 at 1 of 128 points; half: 3e-7.
#: Shrinking to a tenth: 3e-6 at rtol 1e-5; to 0.4: 3e-5 at 2 of 128.
FIRST_WIDTH, SHRINKING = 0.25, 0.2
#: Up to this share of the largest radius positions are next to a tip.
TIP = 1e-3


@dataclass(frozen=True)
class Climb:
    """Climbs to m local maxima of swt along x; arrays of shape (m,).

    Attributes
    ----------
    point, side, column
        Number of the point, sign of x, and column of the position around which is searched.
    angle
        2θ of the best plane so far, rad.
    centre, width
        Where the next round looks, in the c of `PositionBrackets`.
    top, seen
        Estimated maximum of swt, and the largest value so far.
    remaining
        How much `top` would change in further rounds, at most.
    rounds
        Rounds that narrowed the search.
    settled
        Whether the next round would change too little to matter.
    """

    point: NDArray[np.intp]
    side: FloatArray
    column: NDArray[np.intp]
    angle: FloatArray
    centre: FloatArray
    width: FloatArray
    top: FloatArray
    seen: FloatArray
    remaining: FloatArray
    rounds: NDArray[np.intp]
    settled: NDArray[np.bool_]

    @classmethod
    def start(cls, scene: Scene, look: FirstLook, r: FloatArray) -> Climb:
        """From the first look at positions r of a scene, shape (n, X)."""
        point, side, column = look.candidates(r)
        angle = look.closer(scene, point, side, column)
        # Next to a tip shear alone makes two planes that the first look cannot tell apart.
        again = np.flatnonzero(scene.profile.tip[point] & (r[point, column] < TIP * r.max(axis=1)[point]))
        if again.size:
            point, side, column = (np.append(values, values[again]) for values in (point, side, column))
            angle = np.append(angle, -angle[again])
        x_sign = np.where(side == 0, 1.0, -1.0)
        centre, top, seen, remaining = np.zeros((4, len(point)))
        width, rounds = np.full(len(point), FIRST_WIDTH), np.zeros(len(point), dtype=np.intp)
        settled = np.zeros(len(point), dtype=bool)
        return cls(point, x_sign, column, angle, centre, width, top, seen, remaining, rounds, settled)

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> Climb:
        """The local maxima at ``index``."""
        return Climb(*(values[index] for values in vars(self).values()))

    def leading(self, height: FloatArray, share: float) -> Climb:
        """Those whose height, shape (m,), is at least a share of the largest one at their point."""
        largest = np.zeros(self.point.max(initial=0) + 1)
        np.maximum.at(largest, self.point, height)
        return self.take(height >= share * largest[self.point])

    def without_followers(self, moved: NDArray[np.bool_]) -> Climb:
        """Without those that have just moved to a position around which another one searches no lower.

        On another plane the position itself may be higher than the other one has seen.
        """
        order = np.lexsort((moved, self.column, self.side, self.point))
        key = np.stack([self.point, self.side, self.column])[:, order]
        same = np.zeros(len(order), dtype=bool)
        same[1:] = (key[:, 1:] == key[:, :-1]).all(axis=0)
        first = np.maximum.accumulate(np.where(same, 0, np.arange(len(order))))
        seen = self.seen[order]
        higher = seen > (1.0 + LEVEL) * seen[first]
        return self.take(order[~(same & moved[order]) | higher])

    @classmethod
    def joined(cls, several: list[Climb]) -> Climb:
        """All local maxima of several searches."""
        columns = zip(*(vars(one).values() for one in several), strict=True)
        return cls(*(np.concatenate(values) for values in columns))

    def twins(
        self, index: NDArray[np.intp], centre: FloatArray, value: FloatArray, angle: FloatArray
    ) -> Climb:
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
        )

    def brackets(self, positions: Positions) -> PositionBrackets:
        """Where the positions around which is searched lie."""
        return PositionBrackets.around(positions, self.point, self.column)
