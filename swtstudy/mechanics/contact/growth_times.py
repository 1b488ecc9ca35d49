"""When the ground was gained that the memory knows as growths."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import FloatArray, IntArray
from swtstudy.mechanics.rows import Rows


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

    row: NDArray[np.intp]
    table: FloatArray

    @classmethod
    def of(cls, load: Load, edge: FloatArray, branch: IntArray, grows: NDArray[np.bool_]) -> GrowthTimes:
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

    def take(self, index: NDArray[np.intp]) -> GrowthTimes:
        """Return the times of the loads at ``index``, repetitions allowed."""
        return replace(self, row=self.row[index])

    def slip_line_brackets(self, sense: float, row: NDArray[np.intp], number: IntArray) -> Brackets:
        """The stretches of given numbers of the loads at ``row``, for the slip line sense·T − N."""
        return Brackets(*self.table[0 if sense > 0.0 else 1][:, self.row[row], number])
