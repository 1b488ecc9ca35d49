"""The work that is left for a study: the points it needs, which are known, and how long the rest takes.

That is estimated from the timing of a few of its points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from swtstudy.mechanics.points import BoolArray, IndexArray
from swtstudy.points.canonical import SHARED_COLUMNS, Table, group_rows
from swtstudy.points.records import MISSING, Records, look_up, matching
from swtstudy.points.unique import UniquePoints, block_ends, unique_points, wanted, weights
from swtstudy.runner.chunk import ONLY_S, Asked, Chunk, Solver, solve_chunk
from swtstudy.study.definition import Study
from swtstudy.vocabulary.version import SOLVER_VERSION


@dataclass(frozen=True)
class Workload:
    """The points that a study needs, and which of them are known.

    Attributes
    ----------
    points
        The distinct points of the study.
    records
        Records of these points, "missing" where no known one can be used; a run fills them in place.
    quantities
        What the study asks beside s, as in `swtstudy.vocabulary.quantities.Request.items`.
    wanted
        Of which points it asks each of them, shape (n, len(quantities)).
    dropped
        Known records of points, or with quantities, that the study does not have.
    outdated, coarse
        Number of points known only from another version of the solver, or only with less accuracy.
    """

    points: UniquePoints
    records: Records
    quantities: tuple[str, ...]
    wanted: BoolArray
    dropped: Records
    outdated: int
    coarse: int

    @property
    def missing(self) -> BoolArray:
        """Of which points s is to be computed, shape (n,)."""
        return self.records.status == MISSING

    @property
    def incomplete(self) -> BoolArray:
        """Of which points s is known, but not all quantities, shape (n,)."""
        return np.asarray(self._lacking.any(axis=1))

    @property
    def _lacking(self) -> BoolArray:
        """Which quantities that are asked of computed points are not known, shape (n, len(quantities))."""
        return self.records.lacking(self.quantities) & self.wanted

    @property
    def todo(self) -> int:
        """Number of points of which anything is to be computed."""
        return int((self.missing | self.incomplete).sum())

    def tasks(self) -> Iterator[tuple[BoolArray, Asked]]:
        """Masks of points, shape (n,), and what is to be computed of them."""
        missing, lacking = self.missing, self._lacking
        for some, of, known in (
            (missing, self.wanted, None),
            (lacking.any(axis=1), lacking, self.records.solution),
        ):
            for one in np.unique(of[some], axis=0) if of.size else [of[0]] * bool(some.any()):
                names = tuple(name for name, lacks in zip(self.quantities, one, strict=True) if lacks)
                yield some & (of == one).all(axis=1), Asked(names, known)


def assess(study: Study, path: Path, retry_failed: bool = False) -> Workload:
    """Find the work that is left of a study whose archive is at `path`; this computes no point."""
    from swtstudy.archive.parts import known_records

    points = unique_points(study.grid)
    known = known_records(path)
    records = matching(points.table, known, known.usable(study.rtol, SOLVER_VERSION, retry_failed))
    outdated, coarse = _unusable(points.table[records.status == MISSING], known, study.rtol)
    items, of = wanted(study.grid, study.asked, points)
    dropped = dropped_records(points.table, known, records, items)
    records = records.without_others(items)
    return Workload(points, records, items, of, dropped, outdated, coarse)


def dropped_records(table: Table, known: Records, used: Records, quantities: tuple[str, ...]) -> Records:
    """Known records of points that are not in a table, or of more quantities than are asked.

    The time of a run counts where its records are ``used``.
    """
    everything = Records.missing(table)
    elsewhere = look_up(known.table, everything, everything.status == MISSING) < 0
    more = [not {*run.quantities} <= {*quantities} for run in known.runs]
    elsewhere |= np.array([*more, False])[known.run]
    elsewhere &= known.status != MISSING
    dropped = known.take(elsewhere)
    # A kill may have left a record in two places.
    _, group = group_rows(dropped.table)
    _, first = np.unique(group * len(known.runs) + dropped.run, return_index=True)
    dropped = dropped.take(first).trimmed()
    counted = used.trimmed().runs
    same = [replace(run, quantities=()) for run in counted]
    runs = tuple(
        replace(run, seconds=0.0) if replace(run, quantities=()) in same else run for run in dropped.runs
    )
    return replace(dropped, runs=runs)


def _unusable(table: Table, known: Records, rtol: float) -> tuple[int, int]:
    """Number of points known only from another version of the solver, or only with less accuracy."""
    if not len(known):
        return 0, 0
    there = known.status != MISSING
    versions = np.array([*(run.solver_version == SOLVER_VERSION for run in known.runs), True])[known.run]
    tolerance = np.array([*(run.rtol for run in known.runs), 0.0])[known.run]
    outdated = look_up(table, known, there & ~versions) >= 0
    coarse = look_up(table, known, there & versions & (tolerance > rtol)) >= 0
    return int(outdated.sum()), int(coarse.sum())


#: How many kinds of points (profile and frequency ratio) are timed at most, and seconds that all of it may
#: take: a plan is quick. A point that takes longer is timed alone.
_TIMED_KINDS, _BUDGET = 4, 1.5
#: A loop of more vertices is timed by one with some of its own, no more than so many.
_VERTICES = 200


def estimate(
    points: UniquePoints,
    missing: BoolArray,
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
        total += growth.get(int(table["load"][middle]), 1.0) * result.seconds / len(result) * sizes[each]
        work += int(weight[rows[kind == each]].sum())
    others = int(weight[rows].sum()) - work
    return float(total + total / work * others)


def _thinned(points: UniquePoints) -> tuple[UniquePoints, dict[int, float]]:
    """The points with loops of few vertices, and by its code how much longer a loop itself takes."""
    from swtstudy.loads.load_path import LoadPath

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
    points: UniquePoints, inside: IndexArray, asked: Asked, rtol: float, solver: Solver, share: float
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
