"""Chunks of points: what a worker receives and returns, and how points are cut into them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from swtstudy.points.canonical import COST, Definitions, Table, alike, points_from
from swtstudy.points.records import COMPUTED, FAILED, Records, Run, join
from swtstudy.points.unique import UniquePoints
from swtstudy.solver.points import Points, Solution
from swtstudy.vocabulary.arrays import BoolArray, IntArray
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.quantities import YIELD, columns_of, distance_of

#: Solves points to a relative accuracy.
Solver = Callable[[Points, float], Solution]

#: Points of a chunk whose cycles are short, as one compiled call takes them, and where means over the body
#: are asked: some 0.1 s of work, short enough to lose.
MOST, MOST_OF_BODY = 64, 8
#: Pieces of the load cycles of a chunk, all together: fewer points of longer cycles.
PIECES = 128


@dataclass(frozen=True)
class Asked:
    """The values that are asked of points: s, and quantities beside it.

    Attributes
    ----------
    quantities
        As in `swtstudy.vocabulary.quantities.Request.items`.
    known
        The solution of the points, if that is known and the quantities alone are asked.
    """

    quantities: tuple[str, ...] = ()
    known: Solution | None = None

    @property
    def most(self) -> int:
        """Most points of a chunk."""
        of_body = (item == YIELD or distance_of(item) is not None for item in self.quantities)
        return MOST_OF_BODY if any(of_body) else MOST

    def at(self, rows: IntArray | slice) -> Asked:
        """Return the values asked of the points at the given rows."""
        return self if self.known is None else Asked(self.quantities, self.known[rows])


#: s alone.
ONLY_S = Asked()


@dataclass(frozen=True)
class Chunk:
    """Points that are solved in one call: of one profile family, criterion, control and loop.

    Attributes
    ----------
    rows
        Shape (n,): indices of the points in the table of the run.
    table
        Their canonical rows, shape (n,).
    definitions
        What the user has defined, by its code.
    asked
        What is asked of them.
    """

    rows: IntArray
    table: Table
    definitions: Definitions
    asked: Asked = ONLY_S

    @classmethod
    def of(cls, points: UniquePoints, rows: IntArray, asked: Asked = ONLY_S) -> Chunk:
        """The chunk of some rows of a table; ``asked`` of all points of it."""
        return cls(rows, points.table[rows], points.definitions, asked.at(rows))

    def __len__(self) -> int:
        return len(self.rows)

    def at(self, part: slice) -> Chunk:
        """The chunk of some of its points."""
        return Chunk(self.rows[part], self.table[part], self.definitions, self.asked.at(part))

    def halves(self) -> tuple[Chunk, Chunk]:
        """Its two halves."""
        half = len(self) // 2
        return self.at(slice(half)), self.at(slice(half, None))


def solve_chunk(chunk: Chunk, rtol: float, solver: Solver) -> Records:
    """Solve a chunk, even if single points of it fail; runs in a worker."""
    begin = time.perf_counter()
    found = join(_isolated(chunk, rtol, solver))
    return _of_run(chunk, found, rtol, time.perf_counter() - begin)


def given_up(chunk: Chunk, rtol: float, message: str) -> Records:
    """The records of a chunk that could not be completed: every point failed."""
    return _of_run(chunk, _failed(chunk, message), rtol, 0.0)


def solve_points(points: Points, rtol: float) -> Solution:
    """The solver, imported where it runs."""
    from swtstudy.solver import solve

    return solve.solve_points(points, rtol)


def _of_run(chunk: Chunk, records: Records, rtol: float, seconds: float) -> Records:
    """Records of a chunk with what the worker knows of the run."""
    from swtstudy.vocabulary.version import SOLVER_VERSION

    items = tuple(sorted(chunk.asked.quantities))
    run = Run(SOLVER_VERSION, rtol, "", "", seconds=seconds, quantities=items)
    return replace(records, run=np.zeros(len(chunk), np.int32), runs=(run,))


def _isolated(chunk: Chunk, rtol: float, solver: Solver) -> list[Records]:
    """Records of the points, in order; a point that fails is isolated, with its message."""
    try:
        return [_checked(chunk, rtol, solver)]
    except Exception as error:
        if len(chunk) == 1:
            return [_failed(chunk, f"{type(error).__name__}: {error}")]
    return [found for half in chunk.halves() for found in _isolated(half, rtol, solver)]


def _failed(chunk: Chunk, message: str) -> Records:
    """Return records of points that failed: NaN in every column."""
    found = Records.of(chunk.table, Solution.blank(len(chunk)), FAILED, message)
    return replace(
        found, quantities={name: found.quantity(name) for name in columns_of(chunk.asked.quantities)}
    )


def _checked(chunk: Chunk, rtol: float, solver: Solver) -> Records:
    """Return records of points that all have a value."""
    found = values_of(chunk, rtol, solver)
    lost = np.isnan(found.solution.s)
    lost &= ~np.isin(found.solution.regime, [REGIMES.index(name) for name in WITHOUT_S])
    if lost.any():
        raise ArithmeticError("the solver found no value")
    return found


def values_of(chunk: Chunk, rtol: float, solver: Solver) -> Records:
    """Solve the points of a chunk, and find what else is asked of them."""
    points, asked = points_from(chunk.table, chunk.definitions), chunk.asked
    # The caller's np.seterr is not meant for the solver, in which NaN and inf are values.
    with np.errstate(all="ignore"):
        solution = solver(points, rtol) if asked.known is None else asked.known
        found = Records.of(chunk.table, solution, COMPUTED)
        if not asked.quantities:
            return found
        from swtstudy.solver.quantities import quantities_of

        return replace(found, quantities=quantities_of(points, asked.quantities, solution))


def chunks(points: UniquePoints, wanted: BoolArray, asked: Asked = ONLY_S) -> list[Chunk]:
    """Chunks of the wanted points of a table, those of long cycles first: no worker waits for another's.

    Parameters
    ----------
    points
        The points of the study.
    wanted
        Shape (len(points.table),): the points to be solved.
    asked
        What is asked of the points.
    """
    rows = np.flatnonzero(wanted)
    pieces = points.table["p"] + points.table["q"] + points.table[COST]
    found = []
    for group in alike(points.table[rows]):
        own = rows[group]
        own = own[np.argsort(-pieces[own], kind="stable")]
        begin = 0
        while begin < len(own):
            end = begin + min(asked.most, max(PIECES // int(pieces[own[begin]]), 1))
            found.append(own[begin:end])
            begin = end
    found.sort(key=lambda each: -int(pieces[each[0]]))
    return [Chunk.of(points, each, asked) for each in found]
