"""Closed polygons in the plane of the normal and the tangential load.

Nothing depends on the speed: each side takes the same share of the period. On a straight side growth in stick
leaves a line of the diagram, and every passage is the root of a linear function.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from swtstudy.kernel.loops import without_collinear
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.numerics.arrays import ROUNDING, align
from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray


@dataclass(frozen=True)
class PolygonLoad(Load):
    """n closed polygons.

    Attributes
    ----------
    corner_normal, corner_tangential
        Shape (m, k + 1): both components of m polygons at the vertices in the order of time. The first vertex
        follows the last one; shorter rows are filled up with it.
    sides
        Shape (n,): number of sides of each, k at most.
    row
        Shape (n,): which of the m polygons each is. Loads are taken often, and vertices are many.
    """

    corner_normal: FloatArray
    corner_tangential: FloatArray
    sides: IntArray
    row: IndexArray

    @classmethod
    def of(cls, loops: Sequence[FloatArray]) -> PolygonLoad:
        """The polygons through vertices of shape (k, 2), one each: the normal and the tangential load.

        Vertices on the straight line between their neighbours are left out.
        """
        return cls.through([without_collinear(np.asarray(loop, dtype=float)) for loop in loops])

    @classmethod
    def through(cls, loops: Sequence[FloatArray]) -> PolygonLoad:
        """The same with every vertex: something else turns at those that `of` would leave out."""
        sides = np.array([len(loop) for loop in loops], dtype=np.int64)
        corners = np.empty((len(loops), int(sides.max(initial=1)) + 1, 2))
        for row, loop in zip(corners, loops, strict=True):
            row[: len(loop)], row[len(loop) :] = loop, loop[0]
        return cls(corners[..., 0], corners[..., 1], sides, np.arange(len(loops)))

    def __len__(self) -> int:
        return len(self.sides)

    def take(self, index: IndexArray) -> PolygonLoad:
        return PolygonLoad(self.corner_normal, self.corner_tangential, self.sides[index], self.row[index])

    def with_normal(self, function: Callable[[FloatArray], FloatArray]) -> PolygonLoad:
        """The same loads with a function of each one's normal load, (n, …) to (n, …), in its place."""
        normal, tangential = self.corner_normal[self.row], self.corner_tangential[self.row]
        return PolygonLoad(function(normal), tangential, self.sides, np.arange(len(self)))

    def normal(self, instant: FloatArray) -> FloatArray:
        return self._at(self.corner_normal, instant)

    def tangential(self, instant: FloatArray) -> FloatArray:
        return self._at(self.corner_tangential, instant)

    def normal_rate(self, instant: FloatArray) -> FloatArray:
        return self._rate(self.corner_normal, instant)

    def tangential_rate(self, instant: FloatArray) -> FloatArray:
        return self._rate(self.corner_tangential, instant)

    @property
    def least_normal(self) -> FloatArray:
        return self.corner_normal.min(axis=1)[self.row]

    @property
    def largest_normal(self) -> FloatArray:
        return self.corner_normal.max(axis=1)[self.row]

    @property
    def motion(self) -> FloatArray:
        spans = np.ptp(self.corner_normal, axis=1) + np.ptp(self.corner_tangential, axis=1)
        return np.asarray(0.5 * spans[self.row])

    @property
    def has_tangential(self) -> BoolArray:
        return np.asarray((np.abs(self.corner_tangential).max(axis=1) > 0.0)[self.row])

    @property
    def moves_tangentially(self) -> BoolArray:
        return np.asarray(np.ptp(self.corner_tangential, axis=1)[self.row] > 0.0)

    @property
    def oscillations(self) -> tuple[int, int]:
        return 1, 1

    @property
    def mirrored_half(self) -> bool:
        return False

    @property
    def grows_in_lines(self) -> bool:
        return True

    def turning_instants(self) -> FloatArray:
        corner = self.corner_normal[self.row]
        number = np.arange(corner.shape[1], dtype=np.float64)
        columns = [self._corner_instant(np.broadcast_to(number, corner.shape))]
        if np.any(corner < 0.0):
            before, after = corner[:, :-1], corner[:, 1:]
            crosses = before * after < 0.0
            share = np.divide(before, before - after, out=np.zeros_like(before), where=crosses)
            columns.append(np.where(crosses, self._corner_instant(number[:-1] + share), PERIOD))
        return np.sort(np.concatenate(columns, axis=1), axis=1)

    def branch(self, instant: FloatArray) -> IntArray:
        return self._side_and_share(instant)[0]

    def touch_down(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        before, after = self._ends(self.corner_normal, branch)
        rise = after - before
        share = np.divide(normal - before, rise, out=np.zeros(np.shape(normal)), where=rise > 0.0)
        return self._corner_instant(branch + np.clip(share, 0.0, 1.0))

    def growth_slope(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        (before, after), (first, last) = (
            self._ends(corner, branch) for corner in (self.corner_normal, self.corner_tangential)
        )
        rise = after - before
        ratio = np.divide(last - first, rise, out=np.zeros(rise.shape), where=rise > 0.0)
        return np.broadcast_to(-np.clip(ratio, -1.0, 1.0), normal.shape)

    def passage(self, normal: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
        first, last = (self.normal(instant)[:, None] for instant in (begin, end))
        low, high = begin[:, None], end[:, None]
        rise = last - first
        gap = normal[:, :, None] - first
        share = np.divide(gap, rise, out=np.ones(gap.shape), where=rise != 0.0)
        return np.asarray(low + np.clip(share, 0.0, 1.0) * (high - low))

    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        none = np.zeros_like(low)
        at_low, at_high = (sense * self.tangential(at) - self.normal(at) for at in (low, high))
        return Brackets(low, high, at_low, at_high, none, none)

    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        rise = brackets.at_high - brackets.at_low
        share = np.divide(goal - brackets.at_low, rise, out=np.zeros_like(goal), where=rise != 0.0)
        return np.asarray(brackets.low + np.clip(share, 0.0, 1.0) * (brackets.high - brackets.low))

    def _corner_instant(self, number: FloatArray) -> FloatArray:
        """Instant of a vertex, or of a place between two, by its number."""
        return np.minimum(number * (PERIOD / align(self._count, number)), PERIOD)

    @property
    def _count(self) -> FloatArray:
        return self.sides.astype(np.float64)

    def _side_and_share(self, instant: FloatArray) -> tuple[IntArray, FloatArray]:
        return _side_and_share(instant, align(self._count, instant))

    def _ends(self, corner: FloatArray, side: IntArray) -> tuple[FloatArray, FloatArray]:
        """A component at both ends of sides."""
        place = align(self.row * corner.shape[1], side) + side
        return corner.take(place), corner.take(place + 1)

    def _at(self, corner: FloatArray, instant: FloatArray) -> FloatArray:
        side, share = self._side_and_share(instant)
        before, after = self._ends(corner, side)
        # Exact at both ends.
        return np.where(share < 1.0, before + share * (after - before), after)

    def _rate(self, corner: FloatArray, instant: FloatArray) -> FloatArray:
        before, after = self._ends(corner, self._side_and_share(instant)[0])
        return (after - before) * (align(self._count, instant) / PERIOD)


@dataclass(frozen=True)
class PolygonCourse:
    """A course through values at the vertices of a polygon in straight lines, at the instants of its loads.

    Attributes
    ----------
    corner
        Shape (k + 1,): the values in the order of time, the first one again at the end.
    """

    corner: FloatArray

    def value(self, instant: FloatArray) -> FloatArray:
        """Values at instants of any shape."""
        side, share = _side_and_share(instant, np.float64(len(self.corner) - 1))
        before, after = self.corner[side], self.corner[side + 1]
        return np.where(share < 1.0, before + share * (after - before), after)

    @property
    def turns(self) -> FloatArray:
        """Instants at which it turns while the load does not: none."""
        return np.zeros(0)

    @property
    def ends(self) -> tuple[float, float]:
        """Least and largest value."""
        return float(self.corner.min()), float(self.corner.max())


def _side_and_share(instant: FloatArray, sides: FloatArray | np.float64) -> tuple[IntArray, FloatArray]:
    """Number of the side on which each instant is, and the share of it that has passed."""
    place = instant * (sides / PERIOD)
    vertex = np.rint(place)
    place = np.where(np.abs(place - vertex) < ROUNDING * sides, vertex, place)
    side = np.clip(np.floor(place), 0.0, sides - 1.0)
    return side.astype(np.int64), place - side
