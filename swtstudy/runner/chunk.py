"""Chunks of work: what a worker receives and returns; missing points are cut into them by whole blocks."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.points import REGIMES, WITHOUT_S, BoolArray, IntArray, Points, Solution
from swtstudy.points.canonical import Definitions, Table, points_from
from swtstudy.points.records import COMPUTED, FAILED, Records, Run, join
from swtstudy.points.unique import UniquePoints, block_ends, weights
from swtstudy.vocabulary.quantities import YIELD, columns_of, distance_of

#: Solves a batch of points to a relative accuracy.
Solver = Callable[[Points, float], Solution]


#: Points with values of the body in a block: about a second of work.
_FEW = 8


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
    def block(self) -> int | None:
        """Most points of a block; None for as many as share work: what is of the body shares none."""
        of_body = (item == YIELD or distance_of(item) is not None for item in self.quantities)
        return _FEW if any(of_body) else None

    def at(self, rows: IntArray | slice) -> Asked:
        """Return the values asked of the points at the given rows."""
        return self if self.known is None else Asked(self.quantities, self.known.take(rows))


#: s alone.
ONLY_S = Asked()


@dataclass(frozen=True)
class Chunk:
    """Blocks of points; each block is solved in one call.

    Attributes
    ----------
    rows
        Shape (n,): indices of the points in the table of the run.
    table
        Their canonical rows, shape (n,).
    lengths
        Number of points in each block, adding up to n.
    definitions
        What the user has defined, by its code.
    asked
        What is asked of them.
    """

    rows: IntArray
    table: Table
    lengths: tuple[int, ...]
    definitions: Definitions
    asked: Asked = ONLY_S

    @classmethod
    def of(cls, points: UniquePoints, blocks: list[IntArray], asked: Asked = ONLY_S) -> Chunk:
        """The chunk that consists of the given blocks of rows; ``asked`` of all points."""
        rows = np.concatenate(blocks)
        lengths = tuple(map(len, blocks))
        return cls(rows, points.table[rows], lengths, points.definitions, asked.at(rows))

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
            own = self.rows[part], self.table[part], (length,)
            yield Chunk(*own, self.definitions, self.asked.at(part))
            start += length


def solve_chunk(chunk: Chunk, rtol: float, solver: Solver) -> Records:
    """Solve a chunk, even if single points of it fail; runs in a worker."""
    begin = time.perf_counter()
    found = join(_isolated(chunk, rtol, solver))
    return _of_run(chunk, found, rtol, time.perf_counter() - begin)


def given_up(chunk: Chunk, rtol: float, message: str) -> Records:
    """The records of a chunk that could not be completed: every point failed."""
    return _of_run(chunk, _failed(chunk, message), rtol, 0.0)


def solve_points(points: Points, rtol: float) -> Solution:
    """The solver of the mechanics, imported where it runs."""
    from swtstudy import mechanics

    return mechanics.solve_points(points, rtol)


def _of_run(chunk: Chunk, records: Records, rtol: float, seconds: float) -> Records:
    """Records of a chunk with what the worker knows of the run."""
    from swtstudy.vocabulary.version import SOLVER_VERSION

    items = tuple(sorted(chunk.asked.quantities))
    run = Run(SOLVER_VERSION, rtol, "", "", seconds=seconds, quantities=items)
    return replace(records, run=np.zeros(len(chunk), np.int32), runs=(run,))


def _isolated(chunk: Chunk, rtol: float, solver: Solver) -> list[Records]:
    """Records of the points, in order; a point that fails is isolated, with its message."""
    if len(chunk.lengths) == 1:
        try:
            return [_checked(chunk, rtol, solver)]
        except Exception as error:
            if len(chunk) == 1:
                return [_failed(chunk, f"{type(error).__name__}: {error}")]
    return [found for part in chunk.split() for found in _isolated(part, rtol, solver)]


def _failed(chunk: Chunk, message: str) -> Records:
    """Return records of points that failed: NaN in every column."""
    found = Records.of(chunk.table, Solution.blank(len(chunk)), FAILED, message)
    return replace(
        found, quantities={name: found.quantity(name) for name in columns_of(chunk.asked.quantities)}
    )


def _checked(chunk: Chunk, rtol: float, solver: Solver) -> Records:
    points, asked = points_from(chunk.table, chunk.definitions), chunk.asked
    solution = solver(points, rtol) if asked.known is None else asked.known
    lost = np.isnan(solution.s) & ~np.isin(solution.regime, [REGIMES.index(name) for name in WITHOUT_S])
    if lost.any():
        raise ArithmeticError("the solver found no value")
    found = Records.of(chunk.table, solution, COMPUTED)
    if not asked.quantities:
        return found
    from swtstudy.mechanics.quantities import quantities_of

    return replace(found, quantities=quantities_of(points, asked.quantities, solution))


def chunks(
    points: UniquePoints, wanted: BoolArray, size: Callable[[], float], asked: Asked = ONLY_S
) -> Iterator[Chunk]:
    """Chunks of the wanted points of a table: whole blocks, with a weight of about `size()`.

    Parameters
    ----------
    points
        The points of the study.
    wanted
        Shape (len(points.table),): the points to be solved.
    size
        Called for every chunk, so that later chunks follow the timing of earlier ones.
    asked
        What is asked of the points.
    """
    weight = weights(points.table)
    blocks: list[IntArray] = []
    heaviness = 0
    for rows in _long_cycles_first(points.table, wanted, weight):
        for block in np.array_split(rows, -(-len(rows) // (asked.block or len(rows)))):
            block_weight = int(weight[block].sum())
            if blocks and heaviness + block_weight > size():
                yield Chunk.of(points, blocks, asked)
                blocks, heaviness = [], 0
            blocks.append(block)
            heaviness += block_weight
    if blocks:
        yield Chunk.of(points, blocks, asked)


def _long_cycles_first(table: Table, wanted: BoolArray, weight: IntArray) -> list[IntArray]:
    """The wanted rows of each block that has some, long cycles first, and of these the largest blocks.

    So the last blocks let no worker wait, nor do the first ones, which are solved beside one another.
    """
    begin, found = 0, []
    for end in block_ends(table).tolist():
        rows = begin + np.flatnonzero(wanted[begin:end])
        begin = end
        if len(rows):
            found.append(rows)
    return sorted(found, key=lambda rows: (-int(weight[rows].max()), -len(rows)))
