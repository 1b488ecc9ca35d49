"""Run a study: plan, compute, write the archive."""

from __future__ import annotations

import time
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.archive.files import check_writable
from swtstudy.runner.chunk import Result, Solver, solve_points
from swtstudy.runner.engines import Here, LocalWorkers
from swtstudy.runner.pace import PROBE_POINTS, Pace
from swtstudy.runner.plan import UniquePoints, cut, unique_points
from swtstudy.runner.progress import Progress
from swtstudy.runner.values import Values
from swtstudy.study.definition import Study

if TYPE_CHECKING:
    import xarray as xr

#: Less work than this is done before a worker process has started.
_SMALL_SECONDS = 0.5


def run(
    study: Study, path: str | PathLike[str], *, workers: int = 2, solver: Solver = solve_points
) -> xr.Dataset:
    """Compute a study and leave its archive at `path`.

    Parameters
    ----------
    study
        The study.
    path
        Where the netCDF archive goes; an archive that is there is replaced once the new one is complete.
    workers
        Number of worker processes; a study of less than about half a second is computed without.
    solver
        What solves a batch of points; a function that worker processes can import.

    Returns
    -------
    xarray.Dataset
        The archive, loaded.

    Raises
    ------
    OSError
        If the archive cannot be written; found out before anything is computed.
    """
    check_writable(path)
    begin = time.perf_counter()
    points = unique_points(study.grid)
    values = compute(points, study.rtol, workers, solver)

    from swtstudy.archive.archive import build
    from swtstudy.archive.files import save
    from swtstudy.archive.read import open_results

    dataset = build(study, points, values, time.perf_counter() - begin)
    save(dataset, path)
    return open_results(path)


def compute(points: UniquePoints, rtol: float, workers: int, solver: Solver) -> Values:
    """The values of all distinct points, computed here or by workers, whichever is sooner."""
    values = Values.empty(len(points.table))
    progress, pace = Progress(len(points.table)), Pace()

    def deliver(result: Result) -> None:
        values.put(np.arange(result.start, result.start + len(result)), result.solution)
        pace.update(result)
        progress.add(len(result))

    try:
        # A few points here first: their timing decides on the chunks, and whether workers are worth it.
        probe = next(cut(points.table, 0, lambda: PROBE_POINTS))
        Here().solve([probe], rtol, solver, deliver)
        left = len(points.table) - len(probe)
        chunks = cut(points.table, len(probe), pace.chunk_size)
        if left * pace.seconds_per_point < _SMALL_SECONDS or workers < 2:
            Here().solve(chunks, rtol, solver, deliver)
        else:
            with LocalWorkers(workers) as engine:
                engine.solve(chunks, rtol, solver, deliver)
    finally:
        progress.close()
    return values
