"""One chunk of work: what a worker is given and what it gives back."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from swtstudy.mechanics.points import FloatArray, Points, Solution

#: What solves a batch of points with a relative accuracy.
Solver = Callable[[Points, float], Solution]


@dataclass(frozen=True)
class Chunk:
    """Points to be solved together.

    Attributes
    ----------
    start
        Index of the first point among all points of the run.
    table
        Canonical rows of one profile, shape (n, len(COLUMNS)).
    """

    start: int
    table: FloatArray

    def __len__(self) -> int:
        return len(self.table)


@dataclass(frozen=True)
class Result:
    """Solution of a chunk, and the seconds that a worker took for it."""

    start: int
    solution: Solution
    seconds: float

    def __len__(self) -> int:
        return len(self.solution.s)


def solve_chunk(chunk: Chunk, rtol: float, solver: Solver) -> Result:
    """Solve a chunk; runs in a worker."""
    from swtstudy.grid.canonical import points_from

    begin = time.perf_counter()
    solution = solver(points_from(chunk.table), rtol)
    return Result(chunk.start, solution, time.perf_counter() - begin)


def solve_points(points: Points, rtol: float) -> Solution:
    """The solver of the mechanics, imported only where it is used: the parent process does without."""
    from swtstudy import mechanics

    return mechanics.solve_points(points, rtol)
