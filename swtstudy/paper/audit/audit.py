"""Audit random points of a study."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in
from swtstudy.paper.audit.report import audit_dataset, audited_points, open_audit
from swtstudy.points.canonical import ROW, Definitions
from swtstudy.study.definition import Study, require_study
from swtstudy.study.sample import drawn_rows
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION

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
        netCDF file for the audit. Points that it already holds, by the same version of the solver, are kept,
        and not audited again: a killed audit goes on, and one with more points extends it.
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
        Of the points that are drawn, along ``sample``: s, the body's maximum ``s_body``, where it is, on
        which plane, and ``verdict``, the assumption that it breaks.

    Raises
    ------
    ValueError
        If the file exists but holds no audit, or ``study`` is not a Study.
    """
    require_study(study)
    from swtstudy.archive.netcdf import save
    from swtstudy.paper.audit.point import audit_point
    from swtstudy.runner.workers import start_workers

    keys = drawn_rows(study.grid, points, seed).tolist()
    known, definitions = _known(path, study.grid.definitions)
    audit = partial(audit_point, definitions=definitions, dense=dense)

    def lacks(key: tuple[float, ...]) -> bool:
        point = known.get(key)
        return point is None or (dense and bool(np.isnan(point.s_dense) and np.isfinite(point.s)))

    missing = [key for key in keys if lacks(key)]

    def dataset(some: Iterable[tuple[float, ...]]) -> xr.Dataset:
        done = [key for key in some if key in known]
        found = audit_dataset(np.array(done, ROW), [known[key] for key in done], definitions)
        own = {"title": study.title, "study": study.text, "seed": seed, "solver_version": SOLVER_VERSION}
        return found.assign_attrs(own)

    saved = time.monotonic()
    try:
        with start_workers(workers) as pool, Progress(len(keys), Path(path).stem) as shown:
            told = (shown.add, *((progress,) if progress else ()))
            for count in told:
                count(len(keys) - len(missing))
            for key, point in zip(missing, pool.map(audit, missing), strict=True):
                known[key] = point
                for count in told:
                    count(1)
                if time.monotonic() - saved > _SAVE_EVERY:
                    save(dataset(known), path)
                    saved = time.monotonic()
    finally:
        save(dataset(known), path)
    return dataset(keys)


def _known(
    path: str | PathLike[str], own: Definitions
) -> tuple[dict[tuple[float, ...], AuditedPoint], Definitions]:
    """The points of an audit that is there, and what is defined in it and by the study.

    None of another version of the solver, nor if one name stands for two things.
    """
    if not Path(path).exists():
        return {}, own
    audit = open_audit(path)
    # An audit of the time before versions were written down is taken as it is.
    current = audit.attrs.get("solver_version", SOLVER_VERSION) == SOLVER_VERSION
    both = {each.code: each for named in defined_in(audit.attrs).values() for each in named.values()}
    both |= own
    names = {(each.parameter, each.name) for each in both.values()}
    if not current or len(names) < len(both):
        return {}, own
    return audited_points(audit), both
