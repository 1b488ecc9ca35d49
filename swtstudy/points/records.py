"""Results by canonical point, with the origin of each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import ROW, Table, group_rows
from swtstudy.solver.points import Solution
from swtstudy.vocabulary.arrays import BoolArray, Columns, FloatArray, IntArray
from swtstudy.vocabulary.quantities import columns_of

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
    quantities
        What its points have beside s, as in `swtstudy.vocabulary.quantities.Request.items`.
    """

    solver_version: str
    rtol: float
    study: str
    versions: str
    started: str = field(default="", compare=False)
    seconds: float = field(default=0.0, compare=False)
    quantities: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """The run as JSON has it; without quantities, if there are none."""
        return {name: value for name, value in asdict(self).items() if value != ()}

    @classmethod
    def from_json(cls, raw: Mapping[str, Any]) -> Run:
        """The run from `to_json`."""
        return cls(**{**raw, "quantities": tuple(raw.get("quantities", ()))})


@dataclass(frozen=True)
class Records(Columns):
    """Results of n canonical points; of those that are taken all runs are kept.

    Attributes
    ----------
    table
        Canonical rows, shape (n,).
    solution
        Their solutions, arrays of shape (n,).
    status
        Index into `STATES`, shape (n,).
    run
        Index into `runs`, -1 where missing, shape (n,).
    message
        Why a point failed, empty for others, shape (n,).
    runs
        The runs that made them.
    quantities
        What some of the points have beside s, by `swtstudy.vocabulary.quantities.columns_of`, each of shape
        (n,); a point's run says whether it is known.
    """

    table: Table
    solution: Solution
    status: NDArray[np.int8]
    run: NDArray[np.int32]
    message: NDArray[np.object_]
    runs: tuple[Run, ...] = ()
    quantities: dict[str, FloatArray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.table)

    @classmethod
    def missing(cls, table: Table) -> Records:
        """Records of points that are all missing."""
        return cls.of(table, Solution.blank(len(table)), MISSING)

    @classmethod
    def of(cls, table: Table, solution: Solution, status: int, message: str = "") -> Records:
        """Records of points that are all in one state; they have no run yet."""
        n = len(table)
        state, run = np.full(n, status, np.int8), np.full(n, -1, np.int32)
        return cls(table, solution, state, run, np.full(n, message, object))

    @property
    def seconds(self) -> float:
        """Computing time of all runs, in seconds."""
        return sum(run.seconds for run in self.runs)

    def extended(self, more: Records) -> Records:
        """These records with more quantities, known from one run of exactly them."""
        share, items = more.seconds / len(self), made_by(more.runs)
        counts = np.bincount(self.run, minlength=len(self.runs))
        runs = tuple(
            replace(run, seconds=share * count, quantities=tuple(sorted({*run.quantities, *items})))
            for run, count in zip(self.runs, counts.tolist(), strict=True)
        )
        status = np.where(more.status == FAILED, more.status, self.status)
        known = self.quantities | more.quantities
        return replace(self, status=status, message=more.message, runs=runs, quantities=known)

    def fill(self, rows: IntArray, part: Records) -> Records:
        """Fill in other records at `rows`, in place; returned are these records with the runs of both."""
        runs, index = _with_runs(self.runs, part.runs)
        self.solution[rows] = part.solution
        for name in {**self.quantities, **part.quantities}:
            values = self.quantities.setdefault(name, np.full(len(self), np.nan))
            values[rows] = part.quantities.get(name, np.nan)
        self.status[rows] = part.status
        self.run[rows] = index[part.run]
        self.message[rows] = part.message
        return replace(self, runs=runs)

    def usable(self, rtol: float, solver_version: str, retry_failed: bool) -> BoolArray:
        """Which records can be used for a study with this accuracy and solver, shape (n,)."""
        good = [run.rtol <= rtol and run.solver_version == solver_version for run in self.runs]
        worst = COMPUTED if retry_failed else FAILED
        return np.array([*good, False])[self.run] & (self.status <= worst)

    def quantity(self, column: str) -> FloatArray:
        """A column of the quantities, NaN where it is not known, shape (n,)."""
        return self.quantities.get(column, np.full(len(self), np.nan))

    def lacking(self, names: Sequence[str]) -> BoolArray:
        """Which quantities are not known of which computed points, shape (n, len(names))."""
        known = [[name in run.quantities for name in names] for run in self.runs]
        # The last row is for missing points, and for those that a run has filled in since.
        table = np.array([*known, [True] * len(names)], bool)
        return ~table[np.minimum(self.run, len(known))] & (self.status == COMPUTED)[:, None]

    def without_others(self, names: Sequence[str]) -> Records:
        """These records with no quantities but the named ones."""
        if {*made_by(self.runs)} <= {*names}:
            return self
        kept = {name: self.quantities[name] for name in columns_of(names) if name in self.quantities}
        return replace(self, runs=_with_items(self.runs, names.__contains__), quantities=kept)

    def without_unknown(self) -> Records:
        """These records without quantities of which not all is there, as in those of another version."""
        known = self.quantities.keys()
        return replace(self, runs=_with_items(self.runs, lambda item: {*columns_of([item])} <= known))

    def trimmed(self) -> Records:
        """These records without the runs that made none of them.

        The time of one whose points have all got more quantities is time of the run that has these points.
        """
        used = np.unique(self.run[self.run >= 0])
        index = np.full(len(self.runs) + 1, -1, np.int32)
        index[used] = np.arange(len(used))
        runs = [self.runs[i] for i in used]
        for unused in (run for i, run in enumerate(self.runs) if i not in used):
            for i, run in enumerate(runs):
                more = {*run.quantities} > {*unused.quantities}
                if more and replace(run, quantities=unused.quantities) == unused:
                    runs[i] = replace(run, seconds=run.seconds + unused.seconds)
                    break
        return replace(self, run=index[self.run], runs=tuple(runs))


def _with_items(runs: tuple[Run, ...], kept: Callable[[str], bool]) -> tuple[Run, ...]:
    return tuple(replace(run, quantities=tuple(filter(kept, run.quantities))) for run in runs)


def made_by(runs: Iterable[Run]) -> tuple[str, ...]:
    """Quantities that some of the runs have computed, in alphabetical order."""
    return tuple(sorted({name for run in runs for name in run.quantities}))


def join(parts: Iterable[Records]) -> Records:
    """Records concatenated; equal runs become one, with their computing times added."""
    parts = list(parts)
    if not parts:
        return Records.missing(np.empty(0, ROW))
    runs: tuple[Run, ...] = ()
    names, alike = dict.fromkeys(name for part in parts for name in part.quantities), []
    for part in parts:
        runs, index = _with_runs(runs, part.runs)
        quantities = {name: part.quantity(name) for name in names}
        alike.append(replace(part, run=index[part.run], quantities=quantities))
    return replace(Records.joined(alike), runs=runs)


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


def look_up(table: Table, records: Records, candidates: BoolArray) -> IntArray:
    """Index of the record of every canonical row of a table, -1 if there is none, shape (len(table),).

    Of several candidates for one point a computed one is preferred to a failed one, then the most accurate
    one, then the one with most quantities, then the latest.
    """
    index = np.flatnonzero(candidates)
    if not len(index):
        return np.full(len(table), -1)
    tolerance = np.array([*(run.rtol for run in records.runs), np.inf])[records.run[index]]
    count = np.array([*(len(run.quantities) for run in records.runs), 0])[records.run[index]]
    order = np.lexsort((-index, -count, tolerance, records.status[index]))
    index = index[order]
    # The first of equal rows wins: candidates come in order of preference, followed by the table itself.
    first, group = group_rows(np.concatenate([records.table[index], table]))
    winner = first[group[len(index) :]]
    return np.where(winner < len(index), np.append(index, -1)[np.minimum(winner, len(index))], -1)


def matching(table: Table, records: Records, candidates: BoolArray) -> Records:
    """Records of the rows of a table: what `look_up` finds for each, "missing" for the others."""
    found = look_up(table, records, candidates)
    return Records.missing(table).fill(np.flatnonzero(found >= 0), records[found[found >= 0]])


def completed(chosen: Records, others: Records) -> Records:
    """The chosen records with those quantities, too, that others of the same points have.

    One row may stand for contacts of several sizes, each of which has critical distances of its own.
    """
    items = made_by(others.runs)
    more, known = np.zeros((len(chosen), len(items)), bool), dict(chosen.quantities)
    for number, item in enumerate(items):
        lacks = np.flatnonzero(chosen.lacking([item])[:, 0])
        has = (others.status == COMPUTED) & ~others.lacking([item])[:, 0]
        found = look_up(chosen.table[lacks], others, has)
        rows, found = lacks[found >= 0], found[found >= 0]
        more[rows, number] = True
        for column in columns_of([item]) if rows.size else ():
            known[column] = chosen.quantity(column).copy()
            known[column][rows] = others.quantity(column)[found]
    changed = np.flatnonzero(more.any(axis=1))
    kinds, kind = np.unique(
        np.column_stack([chosen.run[changed], more[changed]]), axis=0, return_inverse=True
    )
    made = []
    for own, *added in kinds:
        before = chosen.runs[own]
        names = {*before.quantities, *(item for item, has in zip(items, added, strict=True) if has)}
        made.append(replace(before, quantities=tuple(sorted(names)), seconds=0.0))
    (runs, index), run = _with_runs(chosen.runs, tuple(made)), chosen.run.copy()
    run[changed] = index[kind.ravel()]
    return replace(chosen, runs=runs, run=run, quantities=known)
