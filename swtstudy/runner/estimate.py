"""How long a study will take, estimated from the timing of a few points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.blocks import block_ends
from swtstudy.grid.canonical import SHARED_COLUMNS, group_rows, select
from swtstudy.grid.unique import UniquePoints
from swtstudy.records.result import Result
from swtstudy.runner.chunk import ONLY_S, Asked, Chunk, Solver, solve_chunk

#: How many kinds of points (profile and frequency ratio) are timed, one block each: a plan takes seconds.
_TIMED_KINDS = 4


def estimate(
    points: UniquePoints,
    missing: NDArray[np.bool_],
    rtol: float,
    solver: Solver,
    timed: Callable[[Result], None] = lambda result: None,
    asked: Asked = ONLY_S,
) -> float:
    """Computing time of the missing points of a table in seconds, from the timing of a few blocks.

    Parameters
    ----------
    points
        The points of the study.
    missing
        Shape (len(points.table),): the points to be solved.
    rtol, solver
        As in `run`.
    timed
        Called with the result of each block that was timed.
    asked
        What is asked of the points.
    """
    table, rows = points.table, np.flatnonzero(missing)
    if not len(rows):
        return 0.0
    _, kind = group_rows(select(table[rows], SHARED_COLUMNS))
    kinds, sizes = np.unique(kind, return_counts=True)
    largest = kinds[np.argsort(-sizes, kind="stable")][:_TIMED_KINDS]
    ends = block_ends(table)
    seconds = count = 0.0
    total = 0.0
    for index, each in enumerate(largest):
        middle = rows[kind == each][(kind == each).sum() // 2]
        block = int(np.searchsorted(ends, middle, "right"))
        begin = int(ends[block - 1]) if block else 0
        inside = begin + np.flatnonzero(missing[begin : ends[block]])
        if index == 0:
            # Warm-up call: the first one imports modules and fills tables.
            solve_chunk(Chunk.of(points, [inside[:1]], asked), rtol, solver)
        result = solve_chunk(Chunk.of(points, [inside], asked), rtol, solver)
        timed(result)
        seconds += result.seconds
        count += len(result)
        total += result.seconds / len(result) * sizes[each]
    others = len(rows) - sizes[largest].sum()
    return float(total + seconds / count * others)
