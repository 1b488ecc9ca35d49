"""Estimate of the time that a study takes, from the timing of a few of its points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.points.blocks import block_ends
from swtstudy.points.canonical import SHARED_COLUMNS, group_rows
from swtstudy.points.cost import weights
from swtstudy.points.records import Records
from swtstudy.points.unique import UniquePoints
from swtstudy.runner.chunk import ONLY_S, Asked, Chunk, Solver, solve_chunk

#: How many kinds of points (profile and frequency ratio) are timed at most, and seconds that all of it may
#: take: a plan is quick. A point that takes longer is timed alone.
_TIMED_KINDS, _BUDGET = 4, 1.5
#: A loop of more vertices is timed by one with some of its own, no more than so many.
_VERTICES = 200


def estimate(
    points: UniquePoints,
    missing: NDArray[np.bool_],
    rtol: float,
    solver: Solver,
    timed: Callable[[Records], None] = lambda found: None,
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
        Called with the records of each block that was timed.
    asked
        What is asked of the points.
    """
    table, rows = points.table, np.flatnonzero(missing)
    if not len(rows):
        return 0.0
    _, kind = group_rows(table[[*SHARED_COLUMNS]][rows])
    kinds, sizes = np.unique(kind, return_counts=True)
    largest = kinds[np.argsort(-sizes, kind="stable")][:_TIMED_KINDS]
    ends, weight = block_ends(table), weights(table)
    lean, growth = _thinned(points)
    spent, total, work = 0.0, 0.0, 0
    for index, each in enumerate(largest):
        middle = rows[kind == each][(kind == each).sum() // 2]
        block = int(np.searchsorted(ends, middle, "right"))
        begin = int(ends[block - 1]) if block else 0
        inside = (begin + np.flatnonzero(missing[begin : ends[block]]))[: asked.block]
        if index == 0:
            # Warm-up call: the first one imports modules and fills tables.
            result = solve_chunk(Chunk.of(lean, [inside[:1]], asked), rtol, solver)
            spent = result.seconds
        elif spent > _BUDGET:
            break
        if index or spent <= _BUDGET:
            share = (_BUDGET - spent) / (len(largest) - index)
            result, seconds = _timed(lean, inside, asked, rtol, solver, share)
            spent += seconds
        timed(result)
        total += growth.get(float(table["load"][middle]), 1.0) * result.seconds / len(result) * sizes[each]
        work += int(weight[rows[kind == each]].sum())
    others = int(weight[rows].sum()) - work
    return float(total + total / work * others)


def _thinned(points: UniquePoints) -> tuple[UniquePoints, dict[float, float]]:
    """The points with loops of few vertices, and by its code how much longer a loop itself takes."""
    lean, growth = dict(points.definitions), {}
    for code, loop in points.definitions.items():
        if isinstance(loop, LoadPath) and len(loop.vertices) > _VERTICES:
            thin = loop.thinned(_VERTICES)
            lean[code] = thin
            # As k log k: results/vertices.md.
            many, few = (len(each.vertices) for each in (loop, thin))
            growth[code] = many * np.log(many) / (few * np.log(few))
    return replace(points, definitions=lean), growth


def _timed(
    points: UniquePoints, inside: NDArray[np.intp], asked: Asked, rtol: float, solver: Solver, share: float
) -> tuple[Records, float]:
    """The result of as many points of a block as take some share of the time, and the time of all tries."""
    count, spent = 1, 0.0
    while True:
        result = solve_chunk(Chunk.of(points, [inside[:count]], asked), rtol, solver)
        spent += result.seconds
        # Four at a time take some twice as long as one.
        if count >= len(inside) or spent + 2.0 * result.seconds > share:
            return result, spent
        count = min(4 * count, len(inside))
