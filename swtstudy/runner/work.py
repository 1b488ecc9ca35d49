"""What is left to do for a study: the points it needs, and which of them are known."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.canonical import group_rows
from swtstudy.grid.unique import UniquePoints, unique_points
from swtstudy.mechanics.points import FloatArray
from swtstudy.records.records import MISSING, Records, look_up, matching
from swtstudy.study.definition import Study
from swtstudy.version import SOLVER_VERSION


@dataclass(frozen=True)
class Work:
    """The points that a study needs, and which of them are known.

    Attributes
    ----------
    points
        The distinct points of the study.
    records
        Records of these points, "missing" where no known one can be used; a run fills them in place.
    dropped
        Known records of points that the study does not have.
    outdated, coarse
        Number of points known only from another version of the solver, or only with less accuracy.
    """

    points: UniquePoints
    records: Records
    dropped: Records
    outdated: int
    coarse: int

    @property
    def missing(self) -> NDArray[np.bool_]:
        """Which points are to be computed, shape (n,)."""
        return self.records.status == MISSING

    @property
    def todo(self) -> int:
        """Number of points to be computed."""
        return int(self.missing.sum())


def assess(study: Study, path: Path, retry_failed: bool = False) -> Work:
    """What is left to do for a study whose archive is at `path`; computes nothing."""
    from swtstudy.archive.known import known_records

    points = unique_points(study.grid)
    known = known_records(path)
    records = matching(points.table, known, known.usable(study.rtol, SOLVER_VERSION, retry_failed))
    outdated, coarse = _unusable(points.table[records.status == MISSING], known, study.rtol)
    return Work(points, records, _dropped(points.table, known, records), outdated, coarse)


def _dropped(table: FloatArray, known: Records, used: Records) -> Records:
    """Known records of points that are not in a table; the time of a run counts where it is used."""
    everything = Records.missing(table)
    elsewhere = look_up(known.table, everything, everything.status == MISSING) < 0
    rows = np.flatnonzero(elsewhere & (known.status != MISSING))
    # A kill may have left a record in two places.
    first, _ = group_rows(np.column_stack([known.table[rows], known.run[rows]]))
    dropped = known.take(rows[first]).trimmed()
    counted = used.trimmed().runs
    runs = tuple(replace(run, seconds=0.0) if run in counted else run for run in dropped.runs)
    return replace(dropped, runs=runs)


def _unusable(table: FloatArray, known: Records, rtol: float) -> tuple[int, int]:
    """Number of points known only from another version of the solver, or only with less accuracy."""
    if not len(known):
        return 0, 0
    there = known.status != MISSING
    versions = np.array([*(run.solver_version == SOLVER_VERSION for run in known.runs), True])[known.run]
    tolerance = np.array([*(run.rtol for run in known.runs), 0.0])[known.run]
    outdated = look_up(table, known, there & ~versions) >= 0
    coarse = look_up(table, known, there & versions & (tolerance > rtol)) >= 0
    return int(outdated.sum()), int(coarse.sum())
