"""Values of points by name, from the solver, parts of a run or an archive, and the runs that made them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import ROW, Distinct, Table, group_rows
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IntArray
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.quantities import NONLOCAL, Request
from swtstudy.vocabulary.variables import COMPUTED, FAILED, MISSING, SOLVED


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
        What its points have beside s, as in `swtstudy.vocabulary.quantities.Request.items`.
    """

    solver_version: str
    rtol: float
    study: str
    versions: str
    started: str = field(default="", compare=False)
    quantities: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """The run as JSON has it; without quantities, if there are none."""
        return {name: value for name, value in asdict(self).items() if value != ()}

    @classmethod
    def from_json(cls, raw: Mapping[str, Any]) -> Run:
        """The run from `to_json`."""
        own = {name: raw[name] for name in cls.__dataclass_fields__ if name in raw}
        return cls(**{**own, "quantities": tuple(raw.get("quantities", ()))})


@dataclass(frozen=True)
class Found:
    """Values of n points.

    Attributes
    ----------
    arrays
        By name, each of shape (n, …): ``row``, what the point is (`swtstudy.points.canonical.ROW`); what the
        solver finds; ``status``; ``run``, an index into the runs, -1 where missing; ``message``, why a point
        failed; ``seconds`` of computing; and quantities, those over critical distances with ``distance``,
        shape (n, k), in a_H: NaN where nothing is known of it.
    runs
        The runs that made them.
    """

    arrays: dict[str, NDArray[Any]]
    runs: tuple[Run, ...] = ()

    def __len__(self) -> int:
        return len(self.arrays["row"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.arrays[name]

    @classmethod
    def blank(cls, rows: Table, status: int = MISSING, message: str = "") -> Found:
        """Points without values, all in one state."""
        n = len(rows)
        arrays: dict[str, NDArray[Any]] = {name: np.full(n, np.nan) for name in SOLVED}
        arrays["regime"] = np.full(n, REGIMES.index("not_finite"), np.int8)
        arrays |= {"row": rows, "status": np.full(n, status, np.int8), "run": np.full(n, -1, np.int32)}
        return cls(arrays | {"message": np.full(n, message, object), "seconds": np.zeros(n)})

    def take(self, index: Any) -> Found:
        """The points at an index of NumPy's, with the runs that made them."""
        arrays = {name: values[index] for name, values in self.arrays.items()}
        used = np.unique(arrays["run"][arrays["run"] >= 0])
        number = np.full(len(self.runs) + 1, -1, np.int32)
        number[used] = np.arange(len(used))
        return Found(arrays | {"run": number[arrays["run"]]}, tuple(self.runs[k] for k in used))

    def put(self, index: IntArray, part: Found) -> Found:
        """Write other values in some places, in place; returned are these values with the runs of both."""
        runs = tuple(dict.fromkeys((*self.runs, *part.runs)))
        for name in {**self.arrays, **part.arrays}:
            own, other = (each.wide(name, (self, part)) for each in (self, part))
            own[index] = _renumbered(part, runs) if name == "run" else other
            self.arrays[name] = own
        return Found(self.arrays, runs)

    def wide(self, name: str, several: Iterable[Found]) -> NDArray[Any]:
        """An array, with NaN as wide as the widest of several; the array itself where it is that."""
        shapes = [each.arrays[name].shape[1:] for each in several if name in each.arrays]
        tail = tuple(map(max, *shapes)) if len(shapes) > 1 else shapes[0]
        own = self.arrays.get(name, np.full((len(self), *(0,) * len(tail)) if tail else len(self), np.nan))
        if own.shape[1:] == tail:
            return own
        more = [(0, most - size) for most, size in zip(tail, own.shape[1:], strict=True)]
        return np.pad(own, [(0, 0), *more], constant_values=np.nan)

    def of_runs(self, values: Iterable[Any], without: Any) -> NDArray[Any]:
        """A value of each run at every point of it, and what stands where there is no run; shape (n,)."""
        return np.array([*values, without])[self["run"]]

    def usable(self, rtol: float, solver_version: str, retry_failed: bool = False) -> BoolArray:
        """Which values can be used for a study with this accuracy and solver, shape (n,)."""
        good = (run.rtol <= rtol and run.solver_version == solver_version for run in self.runs)
        worst = COMPUTED if retry_failed else FAILED
        return self.of_runs(good, False) & (self["status"] <= worst)

    def lacking(self, asked: Request) -> BoolArray:
        """Which computed points do not have all quantities that are asked, shape (n,)."""
        less = ({*asked.items} > {*run.quantities} & {*asked.items} for run in self.runs)
        lacks = self.of_runs(less, False)
        if asked.distances:
            lacks |= np.isnan(self.arrays["distance"]).any(axis=1) if "distance" in self.arrays else True
        return lacks & (self["status"] == COMPUTED)


def join(parts: Iterable[Found]) -> Found:
    """Values of several, one after another; equal runs are one."""
    parts = list(parts) or [Found.blank(np.empty(0, ROW))]
    runs = tuple(dict.fromkeys(run for part in parts for run in part.runs))
    arrays = {
        name: np.concatenate([part.wide(name, parts) for part in parts])
        for name in dict.fromkeys(name for part in parts for name in part.arrays)
    }
    return Found(arrays | {"run": np.concatenate([_renumbered(part, runs) for part in parts])}, runs)


def _renumbered(part: Found, runs: tuple[Run, ...]) -> NDArray[np.int32]:
    """Indices into runs among which those of a part are."""
    return np.array([*map(runs.index, part.runs), -1], np.int32)[part["run"]]


def look_up(rows: Table, found: Found, candidates: BoolArray) -> IntArray:
    """Index of the values of every point of a table, -1 if there are none, shape (len(rows),).

    Of several candidates for one point a computed one is preferred to a failed one, then the one with most
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


def matching(points: Distinct, found: Found, candidates: BoolArray) -> Found:
    """All that is found of each of some points: "missing" where that is nothing.

    One row may stand for contacts of several sizes, each of which has critical distances of its own: what is
    about these is looked up by row and distance.
    """
    at = look_up(points.rows, found, candidates)
    known = np.flatnonzero(at >= 0)
    of_distance = ["distance", *(name for row in NONLOCAL.values() for name in row.variables)]
    plain = {name: values for name, values in found.arrays.items() if name not in of_distance}
    result = Found.blank(points.rows).put(known, Found(plain, found.runs).take(at[known]))
    if points.distances.size and "distance" in found.arrays:
        i, k = np.nonzero(np.isfinite(found["distance"]) & candidates[:, None])
        pairs = Found({name: found[name][i] for name in ("status", "run")}, found.runs)
        pairs.arrays["row"] = _keyed(found["row"][i], found["distance"][i, k])
        for name in (name for name in of_distance if name in found.arrays):
            shape = len(points.rows), points.distances.shape[1], *found[name].shape[2:]
            result.arrays[name] = np.full(shape, np.nan)
        for j, distance in enumerate(points.distances.T):
            at = look_up(_keyed(points.rows, distance), pairs, np.ones(len(i), bool))
            ok = np.flatnonzero(at >= 0)
            for name in (name for name in of_distance if name in found.arrays):
                result[name][ok, j] = found[name][i[at[ok]], k[at[ok]]]
    return result


def _keyed(rows: Table, distance: FloatArray) -> Table:
    """Rows with a critical distance each."""
    found = np.empty(len(rows), [*ROW.descr, ("distance", np.float64)])
    for name in ROW.names or ():
        found[name] = rows[name]
    found["distance"] = distance
    return found
