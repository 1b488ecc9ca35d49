"""One chunk of work: what a worker receives and what it returns."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from swtstudy.grid.codes import Definitions
from swtstudy.grid.unique import UniquePoints
from swtstudy.mechanics.points import REGIMES, WITHOUT_S, FloatArray, IntArray, Points, Solution
from swtstudy.records.result import Result
from swtstudy.records.solutions import blank, joined

#: Solves a batch of points to a relative accuracy.
Solver = Callable[[Points, float], Solution]


@dataclass(frozen=True)
class Chunk:
    """Blocks of points; each block is solved in one call.

    Attributes
    ----------
    rows
        Shape (n,): indices of the points in the table of the run.
    table
        Their canonical rows, shape (n, len(COLUMNS)).
    lengths
        Number of points in each block, adding up to n.
    definitions
        What the user has defined, by its code.
    """

    rows: IntArray
    table: FloatArray
    lengths: tuple[int, ...]
    definitions: Definitions

    @classmethod
    def of(cls, points: UniquePoints, blocks: list[IntArray]) -> Chunk:
        """The chunk that consists of the given blocks of rows."""
        rows = np.concatenate(blocks)
        return cls(rows, points.table[rows], tuple(map(len, blocks)), points.definitions)

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def name(self) -> str:
        """Name of the task: no two chunks of a run have a row in common."""
        return f"points-{self.rows[0]}-{len(self)}"

    def split(self) -> Iterator[Chunk]:
        """Its blocks, or the halves of its only block, as separate chunks."""
        lengths = self.lengths if len(self.lengths) > 1 else (len(self) // 2, -(-len(self) // 2))
        start = 0
        for length in lengths:
            part = slice(start, start + length)
            yield Chunk(self.rows[part], self.table[part], (length,), self.definitions)
            start += length


def solve_chunk(chunk: Chunk, rtol: float, solver: Solver) -> Result:
    """Solve a chunk, even if single points of it fail; runs in a worker."""
    from swtstudy.version import SOLVER_VERSION

    begin = time.perf_counter()
    solutions: list[Solution] = []
    messages: dict[int, str] = {}
    start = 0
    for solution, message in _isolated(chunk, rtol, solver):
        if message:
            messages[start] = message
        solutions.append(solution)
        start += len(solution.s)
    failed = np.zeros(len(chunk), bool)
    failed[list(messages)] = True
    seconds = time.perf_counter() - begin
    return Result(chunk.rows, joined(solutions), failed, messages, seconds, SOLVER_VERSION)


def _isolated(chunk: Chunk, rtol: float, solver: Solver) -> list[tuple[Solution, str]]:
    """Solutions of the points, in order; a point that fails is isolated, with its message."""
    if len(chunk.lengths) == 1:
        try:
            return [(_checked(chunk, rtol, solver), "")]
        except Exception as error:
            if len(chunk) == 1:
                return [(blank(1), f"{type(error).__name__}: {error}")]
    return [found for part in chunk.split() for found in _isolated(part, rtol, solver)]


def given_up(chunk: Chunk, message: str) -> Result:
    """The result of a chunk that could not be completed: every point failed."""
    from swtstudy.version import SOLVER_VERSION

    size = len(chunk)
    messages = dict.fromkeys(range(size), message)
    return Result(chunk.rows, blank(size), np.ones(size, bool), messages, 0.0, SOLVER_VERSION)


def solve_points(points: Points, rtol: float) -> Solution:
    """The solver of the mechanics, imported where it runs."""
    from swtstudy import mechanics

    return mechanics.solve_points(points, rtol)


def _checked(chunk: Chunk, rtol: float, solver: Solver) -> Solution:
    from swtstudy.grid.canonical import points_from

    solution = solver(points_from(chunk.table, chunk.definitions), rtol)
    lost = np.isnan(solution.s) & ~np.isin(solution.regime, [REGIMES.index(name) for name in WITHOUT_S])
    if lost.any():
        raise ArithmeticError("the solver found no value")
    return solution
