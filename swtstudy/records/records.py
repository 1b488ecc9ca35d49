"""Results by canonical point, with the origin of each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.canonical import COLUMNS, group_rows
from swtstudy.mechanics.points import FloatArray, IntArray, Solution
from swtstudy.records.result import Result
from swtstudy.records.solutions import blank, joined, solution_at

#: States of a point, in the order of their flag values.
STATES = ("computed", "failed", "missing")
COMPUTED, FAILED, MISSING = range(3)


@dataclass(frozen=True)
class Run:
    """The run that made some of the results.

    Attributes
    ----------
    solver_version
        Version of the solver; it changes when values do.
    rtol
        Relative accuracy asked of s.
    study
        Text of the study file.
    versions
        Versions of Python and of the packages that affect the numbers.
    started
        Date and time of its first result, ISO 8601.
    seconds
        Computing time in seconds, summed over all workers.
    """

    solver_version: str
    rtol: float
    study: str
    versions: str
    started: str = field(default="", compare=False)
    seconds: float = field(default=0.0, compare=False)


@dataclass(frozen=True)
class Records:
    """Results of n canonical points.

    Attributes
    ----------
    table
        Canonical rows, shape (n, len(COLUMNS)).
    solution
        Their solutions, arrays of shape (n,).
    status
        Index into `STATES`, shape (n,).
    run
        Index into `runs`, -1 where missing, shape (n,).
    runs
        The runs that made them.
    messages
        Why a point failed, by its index.
    """

    table: FloatArray
    solution: Solution
    status: NDArray[np.int8]
    run: NDArray[np.int32]
    runs: tuple[Run, ...] = ()
    messages: dict[int, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.table)

    @classmethod
    def missing(cls, table: FloatArray) -> Records:
        """Records of points that are all missing."""
        n = len(table)
        return cls(table, blank(n), np.full(n, MISSING, np.int8), np.full(n, -1, np.int32))

    @classmethod
    def of(cls, result: Result, table: FloatArray, run: Run) -> Records:
        """Records of one result, whose canonical rows are `table`."""
        run = replace(run, seconds=result.seconds)
        status = np.where(result.failed, FAILED, COMPUTED).astype(np.int8)
        return cls(table, result.solution, status, np.zeros(len(table), np.int32), (run,), result.messages)

    def take(self, rows: NDArray) -> Records:
        """The records at the given indices; all runs are kept."""
        rows = np.flatnonzero(rows) if rows.dtype == bool else rows
        messages = {i: self.messages[j] for i, j in enumerate(rows.tolist()) if j in self.messages}
        return Records(
            self.table[rows],
            solution_at(self.solution, rows),
            self.status[rows],
            self.run[rows],
            self.runs,
            messages,
        )

    def fill(self, rows: IntArray, part: Records) -> Records:
        """Fill in other records at `rows`, in place; returned are these records with the runs of both."""
        runs, index = _with_runs(self.runs, part.runs)
        for item in fields(Solution):
            getattr(self.solution, item.name)[rows] = getattr(part.solution, item.name)
        self.status[rows] = part.status
        self.run[rows] = index[part.run]
        self.messages.update({int(rows[i]): message for i, message in part.messages.items()})
        return replace(self, runs=runs)

    def usable(self, rtol: float, solver_version: str, retry_failed: bool) -> NDArray[np.bool_]:
        """Which records can be used for a study with this accuracy and solver, shape (n,)."""
        good = [run.rtol <= rtol and run.solver_version == solver_version for run in self.runs]
        worst = COMPUTED if retry_failed else FAILED
        return np.array([*good, False])[self.run] & (self.status <= worst)

    def trimmed(self) -> Records:
        """These records without the runs that made none of them."""
        used = np.unique(self.run[self.run >= 0])
        index = np.full(len(self.runs) + 1, -1, np.int32)
        index[used] = np.arange(len(used))
        return replace(self, run=index[self.run], runs=tuple(self.runs[i] for i in used))


def join(parts: Iterable[Records]) -> Records:
    """Records concatenated; equal runs become one, with their computing times added."""
    parts = list(parts)
    if not parts:
        return Records.missing(np.empty((0, len(COLUMNS))))
    runs: tuple[Run, ...] = ()
    run, messages, start = [], {}, 0
    for part in parts:
        runs, index = _with_runs(runs, part.runs)
        run.append(index[part.run])
        messages.update({start + i: message for i, message in part.messages.items()})
        start += len(part)
    return Records(
        np.concatenate([part.table for part in parts]),
        joined([part.solution for part in parts]),
        np.concatenate([part.status for part in parts]),
        np.concatenate(run),
        runs,
        messages,
    )


def _with_runs(runs: tuple[Run, ...], more: tuple[Run, ...]) -> tuple[tuple[Run, ...], NDArray[np.int32]]:
    """Runs with others added, and the index of each of these others among them, with -1 at the end."""
    every, indices = list(runs), []
    for run in more:
        if run in every:
            index = every.index(run)
            started = min(filter(None, (every[index].started, run.started)), default="")
            total = every[index].seconds + run.seconds
            every[index] = replace(every[index], started=started, seconds=total)
        else:
            index = len(every)
            every.append(run)
        indices.append(index)
    return tuple(every), np.array([*indices, -1], np.int32)


def look_up(table: FloatArray, records: Records, candidates: NDArray[np.bool_]) -> IntArray:
    """Index of the record of every canonical row of a table, -1 if there is none, shape (len(table),).

    Of several candidates for one point a computed one is preferred to a failed one, then the most accurate
    one, then the latest.
    """
    index = np.flatnonzero(candidates)
    if not len(index):
        return np.full(len(table), -1)
    tolerance = np.array([*(run.rtol for run in records.runs), np.inf])[records.run[index]]
    order = np.lexsort((-index, tolerance, records.status[index]))
    index = index[order]
    # The first of equal rows wins: candidates come in order of preference, followed by the table itself.
    first, group = group_rows(np.concatenate([records.table[index], table]))
    winner = first[group[len(index) :]]
    return np.where(winner < len(index), np.append(index, -1)[np.minimum(winner, len(index))], -1)


def matching(table: FloatArray, records: Records, candidates: NDArray[np.bool_]) -> Records:
    """Records of the rows of a table: what `look_up` finds for each, "missing" for the others."""
    found = look_up(table, records, candidates)
    return Records.missing(table).fill(np.flatnonzero(found >= 0), records.take(found[found >= 0]))
