"""Audit random points of a study."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.grid.grid import Grid
from swtstudy.mechanics.points import FloatArray
from swtstudy.study.definition import Study

if TYPE_CHECKING:
    import xarray as xr

#: Told how many more points are done.
Progress = Callable[[int], object]


def audit_study(
    study: Study, points: int = 1000, seed: int = 0, workers: int = 2, progress: Progress | None = None
) -> xr.Dataset:
    """Solve random points of a study without the surface line's assumptions.

    Parameters
    ----------
    study
        From `Study.from_toml`.
    points
        How many points to take, at random and without repetition; all if the study has fewer.
    seed
        Of the random numbers.
    workers
        Worker processes.
    progress
        Called with 1 after each point.

    Returns
    -------
    xarray.Dataset
        Along ``sample``: s, the body's maximum ``s_body``, where it is, on which plane, and ``verdict``, the
        assumption that it breaks.
    """
    from swtstudy.audit.point import audit_point
    from swtstudy.audit.table import findings_dataset
    from swtstudy.runner.workers import start_workers

    rows = sample_rows(study.grid, points, seed)
    findings = []
    with start_workers(workers) as pool:
        for finding in pool.map(audit_point, rows):
            findings.append(finding)
            if progress is not None:
                progress(1)
    return findings_dataset(rows, findings)


def sample_rows(grid: Grid, points: int, seed: int) -> FloatArray:
    """Canonical rows of random points of a grid, without repetition, shape (n, columns)."""
    index = np.random.default_rng(seed).permutation(grid.size)[: 2 * points]
    rows = np.concatenate([grid.canonical(i, i + 1)[0] for i in map(int, index)])
    _, first = np.unique(rows, axis=0, return_index=True)
    return rows[np.sort(first)[:points]]
