"""Values of points as plain arrays by name, and the runs that made them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.lib.recfunctions import append_fields
from numpy.typing import NDArray

from swtstudy.points.canonical import ROW, Distinct, Table, group_rows
from swtstudy.points.chunk import Arrays, blank, put, stacked
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IntArray
from swtstudy.vocabulary.quantities import NONLOCAL, Request
from swtstudy.vocabulary.variables import COMPUTED, FAILED

#: Names of arrays whose second axis is the critical distance.
_OF_DISTANCE = {"distance", *(name for row in NONLOCAL.values() for name in row.variables)}


@dataclass(frozen=True)
class Run:
    """The run that made some values.

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
    quantities
        The variables of its points beside s, as in `swtstudy.vocabulary.quantities.Request.items`.
    seconds
        Time that it has taken to compute what an archive has of it.
    """

    solver_version: str
    rtol: float
    study: str
    versions: str
    started: str = field(default="", compare=False)
    quantities: tuple[str, ...] = ()
    seconds: float = field(default=0.0, compare=False)

    def to_json(self) -> dict[str, Any]:
        """The run as JSON has it; without quantities, if there are none."""
        return {name: value for name, value in asdict(self).items() if value != ()}


@dataclass
class Found:
    """Values of n points.

    Attributes
    ----------
    arrays
        By name: ``row``, what the point is (`swtstudy.points.canonical.ROW`); what the solver finds;
        ``status``; ``run``, an index into the runs, -1 where missing; ``message``, why a point failed;
        ``seconds`` of computing; and quantities, nonlocal ones with their critical ``distance``, shape
        (n, k), in a_H: NaN where nothing is known of it.
    runs
        The runs that made them.
    """

    arrays: Arrays
    runs: tuple[Run, ...] = ()

    def __len__(self) -> int:
        return len(self.arrays["row"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.arrays[name]

    @classmethod
    def blank(cls, rows: Table) -> Found:
        """Points without values."""
        return cls(blank(len(rows)) | {"row": rows})

    def take(self, index: Any) -> Found:
        """The points at an index of NumPy's, with the runs that made them."""
        arrays = {name: values[index] for name, values in self.arrays.items()}
        used = np.unique(arrays["run"][arrays["run"] >= 0])
        number = np.full(len(self.runs) + 1, -1, np.int32)
        number[used] = np.arange(len(used))
        return Found(arrays | {"run": number[arrays["run"]]}, tuple(self.runs[k] for k in used))

    def of_runs(self, values: Iterable[Any], without: Any) -> NDArray[Any]:
        """A value of each run at every point of it, and what stands where there is no run; shape (n,)."""
        return np.array([*values, without])[self["run"]]

    def usable(self, rtol: float, solver_version: str, retry_failed: bool = False) -> BoolArray:
        """Which values can be used for a study with this accuracy and solver, shape (n,)."""
        good = (run.rtol <= rtol and run.solver_version == solver_version for run in self.runs)
        return self.of_runs(good, False) & (self["status"] <= (COMPUTED if retry_failed else FAILED))

    def lacking(self, asked: Request) -> BoolArray:
        """Which computed points do not have all quantities that are asked, shape (n,)."""
        lacks = self.of_runs((not {*asked.items} <= {*run.quantities} for run in self.runs), False)
        if asked.distances:
            lacks |= np.isnan(self.arrays["distance"]).any(axis=1) if "distance" in self.arrays else True
        return lacks & (self["status"] == COMPUTED)


def join(parts: Iterable[Found]) -> Found:
    """Values of several, one after another; equal runs are one."""
    parts = list(parts) or [Found.blank(np.empty(0, ROW))]
    runs = tuple(dict.fromkeys(run for part in parts for run in part.runs))
    numbers = [part.of_runs(map(runs.index, part.runs), -1).astype(np.int32) for part in parts]
    return Found(stacked([part.arrays for part in parts]) | {"run": np.concatenate(numbers)}, runs)


def look_up(rows: Table, found: Found, candidates: BoolArray) -> IntArray:
    """Index of the values of every point of a table, -1 if there are none, shape (len(rows),).

    A computed candidate for a point is preferred to a failed one, then the one with most
    quantities, then the most accurate one, then the latest.
    """
    index = np.flatnonzero(candidates)
    if not len(index) or not len(rows):
        return np.full(len(rows), -1)
    tolerance = found.of_runs((run.rtol for run in found.runs), np.inf)[index]
    count = found.of_runs((len(run.quantities) for run in found.runs), 0)[index]
    index = index[np.lexsort((-index, tolerance, -count, found["status"][index]))]
    # The first of equal rows wins: candidates come in order of preference, followed by the table itself.
    first, group = group_rows(np.concatenate([found["row"][index], rows]))
    winner = first[group[len(index) :]]
    return np.where(winner < len(index), np.append(index, -1)[np.minimum(winner, len(index))], -1)


def matching(points: Distinct, known: Found, candidates: BoolArray) -> Found:
    """Known values of each of some points: "missing" where there are none.

    One row may stand for contacts of several sizes, each with critical distances of its own: values
    at these are looked up by row and distance.
    """
    found, at = Found.blank(points.rows), look_up(points.rows, known, candidates)
    found.runs, there = known.runs, np.flatnonzero(at >= 0)
    own = {name: values for name, values in known.arrays.items() if name not in {*_OF_DISTANCE, "row"}}
    put(found.arrays, there, {name: values[at[there]] for name, values in own.items()})
    if points.distances.size and "distance" in known.arrays:
        i, k = np.nonzero(np.isfinite(known["distance"]) & candidates[:, None])
        pairs = Found({name: known[name][i] for name in ("status", "run")}, known.runs)
        pairs.arrays["row"] = _with_distance(known["row"][i], known["distance"][i, k])
        for j, distance in enumerate(points.distances.T):
            at = look_up(_with_distance(points.rows, distance), pairs, np.ones(len(i), bool))
            there = np.flatnonzero(at >= 0)
            for name in _OF_DISTANCE & known.arrays.keys():
                if j == 0:
                    shape = *points.distances.shape, *known[name].shape[2:]
                    found.arrays[name] = np.full(shape, np.nan)
                found[name][there, j] = known[name][i[at[there]], k[at[there]]]
    return found


def _with_distance(rows: Table, distance: FloatArray) -> Table:
    """Rows with a critical distance each."""
    return append_fields(rows, "distance", distance, usemask=False)
