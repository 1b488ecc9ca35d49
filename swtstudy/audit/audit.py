"""Audit random points of a study."""

from __future__ import annotations

import time
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.grid.grid import Grid
from swtstudy.mechanics.points import FloatArray
from swtstudy.study.definition import Study, require_study

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.audit.point import Finding

#: Told how many more points are done.
Progress = Callable[[int], object]

#: Points of a larger grid cannot be numbered.
LARGEST_SAMPLED = 2**63 - 1

#: Seconds between two savings of what has been found so far.
_SAVE_EVERY = 20.0


def audit_study(
    study: Study,
    path: str | PathLike[str],
    points: int = 1000,
    seed: int = 0,
    workers: int = 2,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Solve random points of a study without the surface line's assumptions.

    Parameters
    ----------
    study
        From `Study.from_toml`.
    path
        netCDF file that keeps the findings. Points that it has already are not audited again: an audit that
        was killed goes on, and one with more points extends it.
    points
        How many points to take, at random and without repetition; all if the study has fewer.
    seed
        Of the random numbers.
    workers
        Worker processes.
    progress
        Called with the number of points that are done since it was called last.

    Returns
    -------
    xarray.Dataset
        Along ``sample``: s, the body's maximum ``s_body``, where it is, on which plane, and ``verdict``, the
        assumption that it breaks.

    Raises
    ------
    ValueError
        If the file is there and holds no audit, or `study` is no Study.
    """
    require_study(study)
    from swtstudy.archive.write import save
    from swtstudy.audit.point import audit_point
    from swtstudy.audit.table import findings_dataset, open_audit, read_findings
    from swtstudy.runner.workers import start_workers

    rows = sample_rows(study.grid, points, seed)
    keys = list(map(tuple, rows.tolist()))
    known: dict[tuple[float, ...], Finding] = read_findings(open_audit(path)) if Path(path).exists() else {}
    missing = [key for key in keys if key not in known]
    if progress is not None:
        progress(len(keys) - len(missing))

    def dataset() -> xr.Dataset:
        done = [key in known for key in keys]
        found = findings_dataset(rows[done], [known[key] for key in keys if key in known])
        return found.assign_attrs(title=study.title, study=study.text, seed=seed)

    saved = time.monotonic()
    try:
        with start_workers(workers) as pool:
            for key, finding in zip(missing, pool.map(audit_point, missing), strict=True):
                known[key] = finding
                if progress is not None:
                    progress(1)
                if time.monotonic() - saved > _SAVE_EVERY:
                    save(dataset(), path)
                    saved = time.monotonic()
    finally:
        save(dataset(), path)
    return dataset()


def sample_rows(grid: Grid, points: int, seed: int) -> FloatArray:
    """Canonical rows of random points of a grid, without repetition, shape (n, columns).

    Raises
    ------
    ValueError
        If it has more than `LARGEST_SAMPLED` points.
    """
    if grid.size > LARGEST_SAMPLED:
        raise ValueError(f"{grid.size} points are too many to sample, at most {LARGEST_SAMPLED}")
    rng = np.random.default_rng(seed)
    # More than are asked for: two points of the grid can be one physically.
    many = 2 * points
    if grid.size <= 2 * many:
        index = rng.permutation(grid.size)
    else:
        _, first = np.unique(index := rng.integers(grid.size, size=many), return_index=True)
        index = index[np.sort(first)]
    rows = np.concatenate([grid.canonical(i, i + 1)[0] for i in map(int, index)])
    _, first = np.unique(rows, axis=0, return_index=True)
    return rows[np.sort(first)[:points]]
