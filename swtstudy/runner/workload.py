"""The work that is left for a study: the points it needs, which are known, and how long the rest takes.

That is estimated from the timing of a few of its points.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from swtstudy.points.canonical import Table, group_rows
from swtstudy.points.chunk import Asked, Solver, chunks, solve_chunk
from swtstudy.points.records import MISSING, Records, look_up, matching
from swtstudy.points.unique import UniquePoints, kinds, unique_points, wanted
from swtstudy.study.definition import Study
from swtstudy.vocabulary.arrays import BoolArray
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
            for mask, names in kinds(np.asarray(some), self.quantities, of):
                yield mask, Asked(names, known)


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
    dropped = known[elsewhere]
    # A kill may have left a record in two places.
    _, group = group_rows(dropped.table)
    _, first = np.unique(group * len(known.runs) + dropped.run, return_index=True)
    dropped = dropped[first].trimmed()
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


#: Seconds that timing points may take, since a plan is quick, and chunks that are timed at most: one point of
#: each, and if that is quick the others. A point that takes longer is timed alone.
_BUDGET, _TIMED = 2.0, 16
#: A loop of more vertices is timed by one with some of its own, no more than so many.
_VERTICES = 200


def estimate(work: Workload, rtol: float, solver: Solver) -> tuple[float, int]:
    """Computing time of what is left in seconds, and how many points have been timed to estimate it.

    Chunks are timed at even distances of the list of all, which is sorted by the length of their cycles; each
    stands for its neighbours.
    """
    lean, growth = _thinned(work.points)
    todo = [chunk for wanted, asked in work.tasks() for chunk in chunks(lean, wanted, asked)]
    if not todo:
        return 0.0, 0
    if sum(map(len, todo)) > 1:
        solve_chunk(todo[-1].at(slice(1)), rtol, solver)  # imports, and compiles
    ends = np.linspace(0, len(todo), min(_TIMED, len(todo)) + 1).astype(int)
    begin, seconds = time.perf_counter(), 0.0
    timed = counted = left = 0
    # The middle one first, then its neighbours: if time is up, those that are timed stand for all.
    order = np.argsort(np.abs(np.arange(len(ends) - 1) - (len(ends) - 1) // 2), kind="stable")
    for number in order.tolist():
        own = todo[ends[number] : ends[number + 1]]
        count = sum(map(len, own))
        spent = time.perf_counter() - begin
        if timed and spent > _BUDGET:
            left += count
            continue
        middle = own[len(own) // 2]
        each = growth.get(int(middle.table["load"][0]), 1.0)
        one = solve_chunk(middle.at(slice(1)), rtol, solver).seconds
        timed += 1
        if len(middle) > 1 and len(middle) * one < (_BUDGET - spent) / len(order):
            one = solve_chunk(middle, rtol, solver).seconds / len(middle)
            timed += len(middle) - 1
        seconds += each * one * count
        counted += count
    return seconds * (1.0 + left / counted), timed


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
