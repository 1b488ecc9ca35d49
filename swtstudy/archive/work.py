"""The work that is left for a study: the points it needs, which are known, and how long the rest takes."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from swtstudy.archive.parts import known_points
from swtstudy.points.canonical import Distinct, group_rows
from swtstudy.points.chunk import Found, chunk_of, cut, look_up, matching, solve_chunk
from swtstudy.solver.load_path import LoadPath
from swtstudy.study.definition import Study
from swtstudy.vocabulary.arrays import BoolArray, IndexArray
from swtstudy.vocabulary.quantities import MISSING, Request
from swtstudy.vocabulary.version import SOLVER_VERSION


@dataclass
class Work:
    """The points that a study needs, and which of them are known.

    Attributes
    ----------
    points
        The distinct points of the study.
    asked
        The quantities beside s.
    found
        Known values of these points; a run fills in the others.
    others
        Known values of points and quantities that the study does not have.
    outdated, coarse
        Number of points known only from another version of the solver, or only with less accuracy.
    """

    points: Distinct
    asked: Request
    found: Found
    others: Found
    outdated: int
    coarse: int

    @property
    def incomplete(self) -> BoolArray:
        """True where s is known, but a quantity is not, shape (n,): these points are computed again."""
        return self.found.lacking(self.asked)

    @property
    def todo(self) -> BoolArray:
        """Which points are to be computed, shape (n,)."""
        return np.asarray((self.found["status"] == MISSING) | self.incomplete)


def assess(study: Study, path: Path, retry_failed: bool = False) -> Work:
    """Find the work that is left of a study whose archive is at `path`; this computes no point."""
    points = Distinct.of(study.grid, study.asked)
    known = known_points(path)
    found = matching(points, known, known.usable(study.rtol, SOLVER_VERSION, retry_failed))
    lost, own = points.rows[found["status"] == MISSING], known.usable(np.inf, SOLVER_VERSION)
    candidates = (known["status"] != MISSING) & ~own, own & ~known.usable(study.rtol, SOLVER_VERSION)
    outdated, coarse = (int((look_up(lost, known, some) >= 0).sum()) for some in candidates)
    return Work(points, study.asked, found, not_in(points, study.asked, known), outdated, coarse)


def not_in(points: Distinct, asked: Request, known: Found) -> Found:
    """All that is known of points that are not among these, or of more quantities than are asked."""
    if not len(known):
        return known
    own = Found.blank(points.rows)
    elsewhere = look_up(known["row"], own, np.ones(len(own), bool)) < 0
    elsewhere |= known.of_runs((not {*run.quantities} <= {*asked.items} for run in known.runs), False)
    others = known.take(elsewhere & (known["status"] != MISSING))
    # A kill may have left a value in two places.
    first, _ = group_rows(others["row"], others["run"])
    return others.take(np.sort(first))


#: Seconds that timing points may take, since a plan is quick, and groups of chunks that are timed.
_BUDGET, _TIMED = 4.0, 16
#: A loop of more vertices is timed by one with some of its own, no more than so many.
_VERTICES = 200


def estimate(work: Work, rtol: float) -> tuple[float, int, int]:
    """Estimate the time of what is left from some points that are solved.

    Chunks are timed at even distances of the list of all, which is sorted by the length of their cycles; each
    stands for its neighbours.

    Returns
    -------
    seconds
        Computing time.
    timed
        Number of points that have been timed.
    parts
        Number of chunks, which workers share.
    """
    lean, growth = dict(work.points.definitions), dict[int, float]()
    for code, loop in work.points.definitions.items():
        if isinstance(loop, LoadPath) and len(loop.vertices) > _VERTICES:
            lean[code] = thin = loop.thinned(_VERTICES)
            # As k log k: results/vertices.md.
            many, few = len(loop.vertices), len(thin.vertices)
            growth[code] = many * np.log(many) / (few * np.log(few))
    points = replace(work.points, definitions=lean)
    todo = cut(points, work.todo, work.asked)
    if not todo:
        return 0.0, 0, 0

    def timed(places: IndexArray) -> float:
        """Time for each of some points."""
        return float(solve_chunk(chunk_of(points, places, work.asked), rtol)[1]["seconds"].mean())

    timed(todo[-1][:1])  # imports, and compiles
    groups = np.array_split(np.arange(len(todo)), min(_TIMED, len(todo)))
    begin, seconds, count, counted = time.perf_counter(), 0.0, 0, 0
    # The middle groups first: if time is up, the timed groups stand for all.
    for group in sorted(groups, key=lambda each: abs(int(each[0]) - len(todo) // 2)):
        places = todo[group[len(group) // 2]]
        left = _BUDGET - (time.perf_counter() - begin)
        if count and left < 0.0:
            break
        one, own = timed(places[:1]), 1
        if len(places) * one < left / len(groups):
            one, own = timed(places), len(places)
        of_group = sum(len(todo[k]) for k in group)
        seconds += growth.get(int(points.rows["load"][places[0]]), 1.0) * one * of_group
        count, counted = count + own, counted + of_group
    return seconds * sum(map(len, todo)) / counted, count, len(todo)
