"""Pieces of the memory diagram: the offset of the springs over the diagram's coordinate.

Of growths the memory knows that the ground was gained in stick; the load says when.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray, Rows

#: Value of `Memory.slope` that marks a piece left by growth in stick which is no line.
GROWTH = 2.0


@dataclass(frozen=True)
class Memory(Rows):
    """Stacks of pieces of o(G), from the centre outwards, along the last axis d.

    Attributes
    ----------
    start
        Coordinate G at which the piece begins; +inf behind the last piece.
    offset
        o at the start.
    slope
        do/dG of the piece, from −1 to 1, or `GROWTH`.
    stop
        Of a growth: the coordinate at which it ended.
    branch
        Of a growth: number of the load's branch on which the ground was gained.
    growth
        Of a growth: number of the interval of the period in which it was gained. No two have the same.
    """

    start: FloatArray
    offset: FloatArray
    slope: FloatArray
    stop: FloatArray
    branch: IntArray
    growth: IntArray

    @classmethod
    def empty(cls, *shape: int) -> Memory:
        """Stacks without a piece."""
        zero, number = np.zeros(shape), np.zeros(shape, dtype=np.int64)
        return cls(np.full(shape, np.inf), zero, zero.copy(), zero.copy(), number, number.copy())

    def deeper(self, depth: int) -> Memory:
        """The same stacks with room for more pieces."""
        *lead, own = self.start.shape
        deeper = Memory.empty(*lead, depth)
        deeper.write((..., slice(own)), self)
        return deeper


def held_offset(load: Load, pieces: Memory, coordinate: FloatArray) -> FloatArray:
    """o(G) of springs that stick, each in its own piece.

    Parameters
    ----------
    load
        n loads.
    pieces
        One piece for each spring, shape (n, …).
    coordinate
        Shape (n, …): G of the springs.
    """
    grown = pieces.slope == GROWTH
    distance = np.where(np.isfinite(pieces.start), coordinate - pieces.start, 0.0)
    held = pieces.offset + np.where(grown, 0.0, pieces.slope) * distance
    if np.any(grown):
        held = np.where(grown, load.tangential(load.touch_down(coordinate, pieces.branch)), held)
    return held


@dataclass(frozen=True)
class Growths:
    """The distinct growths of n cycles, k at most in a row; shorter rows end with empty ones.

    Attributes
    ----------
    begin, end
        Shape (n, k): the coordinates between which ground was gained.
    branch
        Shape (n, k): the load's branch on which it was.
    index
        Shape (n, i, d): which of them left each piece of the memory; 0 for lines.
    """

    begin: FloatArray
    end: FloatArray
    branch: IntArray
    index: IndexArray

    @classmethod
    def of(cls, memory: Memory) -> Growths:
        """The growths of a memory of shape (n, i, d)."""
        grown = (memory.slope == GROWTH) & np.isfinite(memory.start)
        row, number = np.nonzero(grown)[0], memory.growth[grown]
        seen = np.zeros((len(memory.start), int(number.max(initial=-1)) + 1), dtype=bool)
        seen[row, number] = True
        place = (np.cumsum(seen, axis=1) - 1)[row, number]
        shape = len(seen), int(seen.sum(axis=1).max(initial=0))
        begin, end, branch = np.zeros(shape), np.zeros(shape), np.zeros(shape, dtype=np.int64)
        begin[row, place], end[row, place] = memory.start[grown], memory.stop[grown]
        branch[row, place] = memory.branch[grown]
        index = np.zeros(grown.shape, dtype=np.intp)
        index[grown] = place
        return cls(begin, end, branch, index)


@dataclass(frozen=True)
class DistinctPieces(Rows):
    """The distinct pieces of the memory of n cycles, m at most in a row; shorter rows repeat their first.

    What lies beneath a piece of a stack never changes, so that many intervals share a piece and all of it.

    Attributes
    ----------
    start, slope
        Shape (n, m): as in `Memory`; an empty stack is a piece that starts at 0.
    first
        Shape (n, m): where in the flattened memory (n, i·d) each is first met.
    level
        Shape (n, m): number of pieces beneath.
    below
        Shape (n, m): number of the piece right beneath, its own for the lowest.
    index
        Shape (n, i, d): the number of each piece of the memory.
    """

    start: FloatArray
    slope: FloatArray
    first: IndexArray
    level: IndexArray
    below: IndexArray
    index: IndexArray

    @classmethod
    def of(cls, memory: Memory) -> DistinctPieces:
        """The pieces of a memory of shape (n, i, d)."""
        n, intervals, depth = memory.start.shape
        finite = np.isfinite(memory.start)
        new = np.ones(finite.shape, dtype=bool)
        same = memory.start[:, 1:] == memory.start[:, :-1]
        same &= memory.slope[:, 1:] == memory.slope[:, :-1]
        same &= memory.growth[:, 1:] == memory.growth[:, :-1]
        new[:, 1:] = ~np.logical_and.accumulate(same, axis=-1)
        new[..., 1:] &= finite[..., 1:]
        interval = np.arange(intervals)[:, None]
        since = np.maximum.accumulate(np.where(new, interval, 0), axis=1)
        number = np.cumsum(new.reshape(n, -1), axis=1) - 1
        index = gather(number, (since * depth + np.arange(depth)).reshape(n, -1)).reshape(finite.shape)
        below = np.concatenate([index[..., :1], index[..., :-1]], axis=-1)
        every = np.broadcast_to(np.arange(intervals * depth), (n, intervals * depth))
        (first,) = packed(new.reshape(n, -1), every)
        start, slope, below = (gather(v.reshape(n, -1), first) for v in (memory.start, memory.slope, below))
        return cls(np.where(np.isfinite(start), start, 0.0), slope, first, first % depth, below, index)


@dataclass(frozen=True)
class GrowthTimes(Rows):
    """The stretches of time in which n loads gained ground in stick, by their number in the period.

    Attributes
    ----------
    row
        Shape (n,): the row of each load in the table.
    table
        Shape (2, 6, N, i): for forward and backward slip the fields of `Brackets` of the slip lines; 0 where
        no ground was gained.
    """

    row: IndexArray
    table: FloatArray

    @classmethod
    def of(cls, load: Load, edge: FloatArray, branch: IntArray, grows: BoolArray) -> GrowthTimes:
        """Of intervals of time between which the edge is at the coordinates (n, i + 1).

        Parameters
        ----------
        load
            n loads.
        edge
            Shape (n, i + 1).
        branch, grows
            Shape (n, i): the load's branch, and whether a growth is left there that is no line.
        """
        row, interval = at = np.nonzero(grows)
        table = np.zeros((2, 6, *grows.shape))
        if row.size:
            one = load.take(row)
            low, high = (one.touch_down(edge[row, end], branch[at]) for end in (interval, interval + 1))
            for of_sense, sense in zip(table, (1.0, -1.0), strict=True):
                brackets = one.slip_line_brackets(sense, low, high)
                of_sense[:, row, interval] = np.stack(list(vars(brackets).values()))
        return cls(np.arange(len(load)), table)

    def take(self, index: IndexArray) -> GrowthTimes:
        """Return the times of the loads at ``index``, repetitions allowed."""
        return replace(self, row=self.row[index])

    def slip_line_brackets(self, sense: float, row: IndexArray, number: IntArray) -> Brackets:
        """The stretches of given numbers of the loads at ``row``, for the slip line sense·T − N."""
        return Brackets(*self.table[0 if sense > 0.0 else 1][:, self.row[row], number])
