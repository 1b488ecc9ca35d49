"""Audit random points of a study."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from swtstudy.study.definition import Study, require_study
from swtstudy.study.sample import drawn_rows

if TYPE_CHECKING:
    from swtstudy.paper.audit.point import AuditedPoint

#: Seconds between two saves of what is audited so far: short enough to lose, long against a save.
_SAVE_EVERY = 20.0


def audit_study(
    study: Study,
    path: str | PathLike[str],
    points: int = 1000,
    seed: int = 0,
    workers: int = 2,
    dense: bool = False,
    progress: Callable[[int], object] | None = None,
) -> xr.Dataset:
    """Solve random points of a study without the surface line's assumptions.

    Parameters
    ----------
    study
        From `Study.from_toml`.
    path
        netCDF file for the audit. Points that it already holds are not audited again: a killed audit goes on,
        and one with more points extends it.
    points
        Number of points to draw at random without repetition; all if the study has fewer.
    seed
        Seed of the random numbers.
    workers
        Number of worker processes.
    dense
        Whether the surface line is looked at densely, too: 400 positions between any two cusps, on 64 planes.
    progress
        Called with the number of points that have been finished since its last call.

    Returns
    -------
    xarray.Dataset
        Along ``sample``: s, the body's maximum ``s_body``, where it is, on which plane, and ``verdict``, the
        assumption that it breaks.

    Raises
    ------
    ValueError
        If the file exists but holds no audit, or ``study`` is not a Study.
    """
    require_study(study)
    from swtstudy.archive.netcdf import save
    from swtstudy.paper.audit.point import audit_point
    from swtstudy.paper.audit.report import audit_dataset, audited_points, open_audit
    from swtstudy.runner.workers import start_workers

    rows, definitions = drawn_rows(study.grid, points, seed), study.grid.definitions
    audit = partial(audit_point, definitions=definitions, dense=dense)
    keys = rows.tolist()
    known: dict[tuple[float, ...], AuditedPoint] = {}
    if Path(path).exists():
        known = audited_points(open_audit(path))
    if dense:
        known = {
            key: each for key, each in known.items() if np.isfinite(each.s_dense) or not np.isfinite(each.s)
        }
    missing = [key for key in keys if key not in known]
    count = progress or (lambda finished: None)
    count(len(keys) - len(missing))

    def dataset() -> xr.Dataset:
        done = [key in known for key in keys]
        found = audit_dataset(rows[done], [known[key] for key in keys if key in known], definitions)
        return found.assign_attrs(title=study.title, study=study.text, seed=seed)

    saved = time.monotonic()
    try:
        with start_workers(workers) as pool:
            for key, point in zip(missing, pool.map(audit, missing), strict=True):
                known[key] = point
                count(1)
                if time.monotonic() - saved > _SAVE_EVERY:
                    save(dataset(), path)
                    saved = time.monotonic()
    finally:
        save(dataset(), path)
    return dataset()
