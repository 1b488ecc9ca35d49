"""Values of points as plain arrays by name: solved in chunks, or known from runs before."""

from __future__ import annotations

import math
import platform
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.lib.recfunctions import append_fields
from numpy.typing import NDArray

from swtstudy.points.grid import COST, ROW, Distinct, Table, alike, group_rows, points_from
from swtstudy.solver import points as mechanics
from swtstudy.solver.points import Points, Solution
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray, IntArray
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.files import read_json
from swtstudy.vocabulary.mistakes import literal
from swtstudy.vocabulary.quantities import COMPUTED, FAILED, ITEMS, MISSING, NONLOCAL, SOLVED, Request
from swtstudy.vocabulary.version import SOLVER_VERSION, __version__

#: Arrays of shape (n, …) by name.
Arrays = dict[str, NDArray[Any]]
#: Solves points to a relative accuracy; None for `swtstudy.solver.points.solve_points`.
Solver = Callable[[Points, float], Solution] | None

#: Pieces of the load cycles of a chunk, all together, and what a point counts at least for the largest stress
#: or each mean over the body that is asked: some 0.1 s of work, short enough to lose.
PIECES, PIECES_OF_BODY = 128, 16
#: Packages whose versions can affect the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")


def cut(points: Distinct, wanted: BoolArray, asked: Request) -> list[IndexArray]:
    """Places of the wanted points of a table, cut into chunks, long cycles first.

    The points of a chunk are solved in one call: they share profile family, criterion, control, loop and
    critical distances. Long cycles are first, so that no worker waits for another's.

    Parameters
    ----------
    points
        The points of the study.
    wanted
        Shape (len(points.rows),): the points to be solved.
    asked
        The quantities beside s.
    """
    places = np.flatnonzero(wanted)
    pieces = points.rows["p"] + points.rows["q"] + points.rows[COST]
    if asked.is_of_body:
        pieces = np.maximum(pieces, PIECES_OF_BODY * max(1, len(asked.distances)))
    found: list[IndexArray] = []
    for own in alike(points.rows if wanted.all() else points.rows[places], *points.distances[places].T):
        own = places[own]
        own = own[np.argsort(-pieces[own], kind="stable")]
        number = (np.cumsum(pieces[own]) - 1) // PIECES
        found += np.split(own, np.flatnonzero(np.diff(number)) + 1)
    return sorted(found, key=lambda each: -int(pieces[each[0]]))


def task_of(points: Distinct, places: IndexArray, asked: Request) -> tuple[Points, Request]:
    """A chunk as points for the solver, and what is asked of them, with their distances in a_H."""
    own = replace(asked, distances=tuple(points.distances[places[0]].tolist()))
    return points_from(points.rows[places], points.definitions), own


def solve_chunk(points: Points, asked: Request, rtol: float, solver: Solver = None) -> tuple[str, Arrays]:
    """Solve the points of a chunk, in a worker, and find what is asked of them.

    Returns
    -------
    str
        Version of the solver.
    dict
        Values of the points, in order. A point that fails does so alone, with its message and what it has.
    """
    begin, arrays = time.perf_counter(), blank(len(points), FAILED)
    try:
        fill(arrays, points, asked, rtol, solver)
    except Exception as error:
        if len(points) > 1:
            alone = (solve_chunk(points[[k]], asked, rtol, solver)[1] for k in range(len(points)))
            return SOLVER_VERSION, stacked([*alone])
        arrays["message"][:] = f"{type(error).__name__}: {error}"
    arrays["seconds"][:] = (time.perf_counter() - begin) / len(points)
    return SOLVER_VERSION, arrays


def fill(arrays: Arrays, points: Points, asked: Request, rtol: float, solver: Solver = None) -> None:
    """Solve points, and find what else is asked of them; raises if one has no value."""
    # The caller's np.seterr is not meant for the solver, in which NaN and inf are values.
    with np.errstate(all="ignore"):
        solution = (solver or mechanics.solve_points)(points, rtol)
        arrays.update(solution._asdict())
        lost = ~np.isin(solution.regime, [REGIMES.index(name) for name in WITHOUT_S]) & np.isnan(solution.s)
        if lost.any():
            raise ArithmeticError("the solver found no value")
        if asked.items:
            from swtstudy.solver.quantities import quantities_of

            arrays.update(quantities_of(points, asked, solution))
        if asked.distances:
            arrays["distance"] = np.tile(asked.distances, (len(points), 1))
    arrays["status"][:] = COMPUTED


def blank(n: int, status: int = MISSING, message: str = "") -> Arrays:
    """Arrays of n points without values, all in one state."""
    return {name: np.full(n, np.nan) for name in SOLVED} | {
        "regime": np.full(n, REGIMES.index("not_finite"), np.int8),
        "status": np.full(n, status, np.int8),
        "run": np.full(n, -1, np.int32),
        "message": np.full(n, message, object),
        "seconds": np.zeros(n),
    }


def stacked(parts: Sequence[Arrays]) -> Arrays:
    """Arrays one after another; NaN where one lacks a name, or is narrower than the widest."""

    def padded(part: Arrays, name: str, tail: Any) -> NDArray[Any]:
        values = part.get(name, np.full((len(part["status"]), *tail), np.nan))
        more = [(0, most - size) for most, size in zip(tail, values.shape[1:], strict=True)]
        return np.pad(values, [(0, 0), *more], constant_values=np.nan) if any(map(max, more)) else values

    found = {}
    for name in dict.fromkeys(name for part in parts for name in part):
        tail = np.max([part[name].shape[1:] for part in parts if name in part], axis=0).astype(int)
        found[name] = np.concatenate([padded(part, name, tail) for part in parts])
    return found


def put(arrays: Arrays, index: IndexArray, some: Arrays) -> None:
    """Write values of some points in their places."""
    for name, values in some.items():
        if name not in arrays:
            arrays[name] = np.full((len(arrays["status"]), *values.shape[1:]), np.nan)
        arrays[name][index] = values


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


@cache
def versions() -> str:
    """Versions of Python, of this package and of packages that affect its numbers and files."""
    from importlib.metadata import version

    packages = (f"{name} {version(name)}" for name in _PACKAGES)
    return ", ".join([f"python {platform.python_version()}", f"swtstudy {__version__}", *packages])


def read_runs(text: object) -> tuple[Run, ...]:
    """The runs that made the values of an archive, from its attribute.

    Raises
    ------
    ValueError
        With the reason, if the text is not what `Run.to_json` makes.
    """
    runs: tuple[Run, ...] = read_json(tuple[Run, ...], text)
    for run in runs:
        if not {*run.quantities} <= {*ITEMS}:
            raise ValueError(f"quantities of a run: {literal(run.quantities)}")
        if not 0.0 <= run.seconds < math.inf:
            raise ValueError(f"seconds of a run: {literal(run.seconds)}")
    return runs


@dataclass
class Found:
    """Values of n points.

    Attributes
    ----------
    arrays
        By name: ``row``, what the point is (`swtstudy.points.grid.ROW`); what the solver finds;
        ``status``; ``run``, an index into the runs, -1 where missing; ``message``, why a point failed;
        ``seconds`` of computing; and quantities, those over critical distances with ``distance``, shape
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
    return np.append(index, np.full(len(rows), -1))[first[group[len(index) :]]]


def matching(points: Distinct, known: Found, candidates: BoolArray) -> Found:
    """All that is known of each of some points: "missing" where that is nothing.

    One row may stand for contacts of several sizes, each of which has critical distances of its own: what is
    about these is looked up by row and distance.
    """
    found, at = Found.blank(points.rows), look_up(points.rows, known, candidates)
    found.runs, there = known.runs, np.flatnonzero(at >= 0)
    own = {name: values for name, values in known.arrays.items() if name not in {*_OF_DISTANCE, "row"}}
    put(found.arrays, there, {name: values[at[there]] for name, values in own.items()})
    if points.distances.size and "distance" in known.arrays:
        i, k = np.nonzero(np.isfinite(known["distance"]) & candidates[:, None])
        pairs = Found({name: known[name][i] for name in ("status", "run")}, known.runs)
        pairs.arrays["row"] = _with_distance(known["row"][i], known["distance"][i, k])
        each = _with_distance(points.rows.repeat(points.distances.shape[1]), points.distances.ravel())
        at = look_up(each, pairs, np.ones(len(i), bool))
        there = np.flatnonzero(at >= 0)
        for name in _OF_DISTANCE & known.arrays.keys():
            values = np.full((len(each), *known[name].shape[2:]), np.nan)
            values[there] = known[name][i[at[there]], k[at[there]]]
            found.arrays[name] = values.reshape(*points.distances.shape, *values.shape[1:])
    return found


def _with_distance(rows: Table, distance: FloatArray) -> Table:
    """Rows with a critical distance each."""
    return append_fields(rows, "distance", distance, usemask=False)
