"""The work that is left of a study: the points it needs, and which of them are known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import Table, group_rows
from swtstudy.points.columns import wanted
from swtstudy.points.records import MISSING, Records, look_up, matching
from swtstudy.points.unique import UniquePoints, unique_points
from swtstudy.runner.chunk import Asked
from swtstudy.study.definition import Study
from swtstudy.vocabulary.version import SOLVER_VERSION


@dataclass(frozen=True)
class Work:
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
    wanted: NDArray[np.bool_]
    dropped: Records
    outdated: int
    coarse: int

    @property
    def missing(self) -> NDArray[np.bool_]:
        """Of which points s is to be computed, shape (n,)."""
        return self.records.status == MISSING

    @property
    def incomplete(self) -> NDArray[np.bool_]:
        """Of which points s is known, but not all quantities, shape (n,)."""
        return np.asarray(self._lacking.any(axis=1))

    @property
    def _lacking(self) -> NDArray[np.bool_]:
        """Which quantities that are asked of computed points are not known, shape (n, len(quantities))."""
        return self.records.lacking(self.quantities) & self.wanted

    @property
    def todo(self) -> int:
        """Number of points of which anything is to be computed."""
        return int((self.missing | self.incomplete).sum())

    def tasks(self) -> Iterator[tuple[NDArray[np.bool_], Asked]]:
        """Masks of points, shape (n,), and what is to be computed of them."""
        missing, lacking = self.missing, self._lacking
        for some, of, known in (
            (missing, self.wanted, None),
            (lacking.any(axis=1), lacking, self.records.solution),
        ):
            for one in np.unique(of[some], axis=0) if of.size else [of[0]] * bool(some.any()):
                names = tuple(name for name, lacks in zip(self.quantities, one, strict=True) if lacks)
                yield some & (of == one).all(axis=1), Asked(names, known)


def assess(study: Study, path: Path, retry_failed: bool = False) -> Work:
    """Find the work that is left of a study whose archive is at `path`; this computes no point."""
    from swtstudy.archive.known import known_records

    points = unique_points(study.grid)
    known = known_records(path)
    records = matching(points.table, known, known.usable(study.rtol, SOLVER_VERSION, retry_failed))
    outdated, coarse = _unusable(points.table[records.status == MISSING], known, study.rtol)
    items, of = wanted(study.grid, study.asked, points)
    dropped = _dropped(points.table, known, records, items)
    records = records.without_others(items)
    return Work(points, records, items, of, dropped, outdated, coarse)


def _dropped(table: Table, known: Records, used: Records, quantities: tuple[str, ...]) -> Records:
    """Known records of points that are not in a table, or of more quantities than are asked.

    The time of a run counts where it is used.
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
