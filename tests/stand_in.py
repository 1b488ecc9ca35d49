"""Stand-ins for the solver of the mechanics, importable by worker processes."""

from __future__ import annotations

import os
import signal
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy import Study, run

if TYPE_CHECKING:
    import xarray as xr

#: Where a stand-in goes when there is no argument for it: on the command line and in a search.
SOLVER = "swtstudy.solver.points.solve_points"
#: Where one for the quantities on request goes.
QUANTITIES = "swtstudy.solver.quantities.quantities_of"


#: What a solver is asked for: arrays by the names of the parameters.
Points = Any


class Solution(NamedTuple):
    """What a solver finds of n points, arrays of shape (n,)."""

    s: NDArray[np.float64]
    s_error: NDArray[np.float64]
    critical_x: NDArray[np.float64]
    critical_angle: NDArray[np.float64]
    regime: NDArray[np.int8]
    s_surface: NDArray[np.float64]


def smooth(points: Points, rtol: float) -> Solution:
    """A cheap function of every parameter."""
    s = 0.1 + 0.01 * points.normal_amplitude * np.cos(points.phase) + points.friction
    s = s + points.p / points.q + 0.1 * points.tangential_amplitude + points.poisson_ratio
    for index, shape in enumerate(points.shape.values()):
        s = s + (index + 1) * shape
    angle = 10 * np.sin(points.phase)
    return Solution(s, rtol * s, 1 + points.phase, angle, np.ones(len(points), np.int8), s)


def computed(text: str, path: Path, solver: Callable[..., Solution] = smooth) -> xr.Dataset:
    """Results of a study by a stand-in for the solver and by one for the quantities on request."""
    from unittest.mock import patch  # workers do without

    with patch(QUANTITIES, asked):
        return run(Study.from_text(text), path, workers=1, solver=solver)


def slow(points: Points, rtol: float) -> Solution:
    """Like `smooth`, 5 ms a point."""
    time.sleep(0.005 * len(points))
    return smooth(points, rtol)


def up_to(friction: float, gate: str, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but from a friction on it waits at a gate, a pipe into which nobody writes."""
    if (points.friction > friction).any():
        open(gate).close()
    return smooth(points, rtol)


def process(points: Points, rtol: float) -> Solution:
    """Like `slow`, but critical_x is the number of the process and s its number of BLAS threads."""
    solution = slow(points, rtol)
    threads = float(os.environ.get("OPENBLAS_NUM_THREADS", "nan"))
    return Solution(
        np.full(len(points), threads),
        solution.s_error,
        np.full(len(points), float(os.getpid())),
        solution.critical_angle,
        solution.regime,
        solution.s_surface,
    )


def kill_once(mark: str, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but the first worker that comes here is killed; `mark` is a file that says so."""
    try:
        os.close(os.open(mark, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return slow(points, rtol)
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def fail_at(friction: float, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but it fails at one value of the friction."""
    if np.isclose(points.friction, friction).any():
        raise ZeroDivisionError("an injected failure")
    return smooth(points, rtol)


def kill_at(friction: float, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but it kills its process at one value of the friction."""
    if np.isclose(points.friction, friction).any():
        os.kill(os.getpid(), signal.SIGKILL)
    return smooth(points, rtol)


def lose_at(friction: float, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but it finds no value at one value of the friction."""
    solution = smooth(points, rtol)
    s = np.where(np.isclose(points.friction, friction), np.nan, solution.s)
    return solution._replace(s=s)


def none(points: Points, rtol: float) -> Solution:
    """For runs that have nothing to compute."""
    raise AssertionError(f"{len(points)} points are computed")


class Counting:
    """`smooth` in this process, with the number of points that it was asked for."""

    def __init__(self) -> None:
        self.points = 0

    def __call__(self, points: Points, rtol: float) -> Solution:
        self.points += len(points)
        return smooth(points, rtol)


class Interrupting(Counting):
    """Like `Counting`, but Ctrl-C comes after a number of points."""

    def __init__(self, after: int) -> None:
        super().__init__()
        self.after = after

    def __call__(self, points: Points, rtol: float) -> Solution:
        if self.points >= self.after:
            raise KeyboardInterrupt
        return super().__call__(points, rtol)


def distinct(study: Study) -> int:
    """How many points a run of a study computes: equal ones count once."""
    counting = Counting()
    with tempfile.TemporaryDirectory() as folder:
        run(study, Path(folder) / "counted.nc", workers=1, solver=counting)
    return counting.points


def asked(points: Points, request: Any, solution: Solution) -> dict[str, NDArray[np.float64]]:
    """Quantities that grow with s, an error a thousandth of each; one strain cycle and three small ones."""
    found: dict[str, NDArray[np.float64]] = {}
    for number, row in enumerate(request.rows):
        sizes = [request.sizes[dim] for dim in row.dims]
        values = np.broadcast_to(solution.s.reshape(-1, *[1] * len(sizes)), (len(points), *sizes)).copy()
        if "critical_distance" in row.dims:
            lower = 1.0 / (1.0 + np.array(request.distances))
            values *= lower.reshape(1, -1, *[1] * (len(sizes) - 1))
        found |= dict(zip(row.variables, (values / (1 + number), 1e-3 * values), strict=False))
    if request.counts:
        for name, cycles in (("counted", (1.0, 0.5)), ("counted_number", (1.0, 3.0))):
            found[name] = np.full_like(found[name], np.nan)
            found[name][:, 0, :2] = cycles
    return found
