"""Audit random points of a study."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from functools import partial
from os import PathLike
from pathlib import Path

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in
from swtstudy.paper.audit.dataset import AUDITED, FOUND, TOLERANCE, audit_dataset, audited_points, open_audit
from swtstudy.points.canonical import ROW, Definitions, points_from
from swtstudy.study.definition import Study, require_study
from swtstudy.study.sample import drawn_rows
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION

#: Seconds between two saves of what is audited so far: short enough to lose, long against a save.
_SAVE_EVERY = 20.0


def audit_study(
    study: Study,
    path: str | PathLike[str],
    points: int = 1000,
    seed: int = 0,
    workers: int = 2,
    dense: bool = False,
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
        Whether the surface line gets a dense grid, too: 400 positions between any two cusps, on 64 planes.

    Returns
    -------
    xarray.Dataset
        For the points that are drawn, along ``sample``: s, the body's maximum ``s_body``, where it is, on
        which plane, and ``verdict``, the assumption that it breaks.

    Raises
    ------
    ValueError
        If the file exists but holds no audit, or ``study`` is not a Study.
    """
    require_study(study)
    from swtstudy.archive.netcdf import save
    from swtstudy.runner.workers import start_workers

    keys = drawn_rows(study.grid, points, seed).tolist()
    known, definitions = _known(Path(path), study.grid.definitions)
    missing = [key for key in keys if key not in known or (dense and _not_dense(known[key]))]

    def dataset(some: Iterable[tuple[float, ...]]) -> xr.Dataset:
        done = [key for key in some if key in known]
        audited = np.array([known[key] for key in done], AUDITED)
        found = audit_dataset(np.array(done, ROW), audited, definitions)
        own = {"title": study.title, "study": study.text, "seed": seed, "solver_version": SOLVER_VERSION}
        return found.assign_attrs(own)

    saved = time.monotonic()
    try:
        with start_workers(workers) as pool, Progress(len(keys), Path(path).stem) as shown:
            shown.add(len(keys) - len(missing))
            one = partial(audit_point, definitions=definitions, dense=dense)
            for key, point in zip(missing, pool.map(one, missing), strict=True):
                known[key] = point
                shown.add(1)
                if time.monotonic() - saved > _SAVE_EVERY:
                    save(dataset(known), path)
                    saved = time.monotonic()
    finally:
        save(dataset(known), path)
    return dataset(keys)


def _known(path: Path, own: Definitions) -> tuple[dict[tuple[float, ...], np.void], Definitions]:
    """Audited points in a file, by canonical row, and definitions of the user in it and in the study.

    There are none by another version of the solver, nor if one name stands for two things.
    """
    if path.exists():
        audit = open_audit(path)
        there = {each.code: each for named in defined_in(audit.attrs).values() for each in named.values()}
        both = {**there, **own}
        distinct = {(each.parameter, each.name) for each in both.values()}
        if audit.attrs.get("solver_version") == SOLVER_VERSION and len(distinct) == len(both):
            return audited_points(audit), both
    return {}, own


def _not_dense(point: np.void) -> bool:
    """Return whether a point with a finite s lacks a dense grid."""
    return bool(np.isnan(point["s_dense"]) and np.isfinite(point["s"]))


def audit_point(row: Sequence[float], definitions: Definitions, dense: bool = False) -> np.void:
    """Audit one canonical row (`swtstudy.points.canonical`).

    Parameters
    ----------
    row
        The row.
    definitions
        Definitions of the user, by code.
    dense
        Whether its surface line gets a dense grid, too (`swtstudy.paper.audit.dense`).

    Returns
    -------
    record
        Of `AUDITED`.
    """
    from swtstudy.paper.audit.body_maximum import body_maximum
    from swtstudy.paper.audit.dense import dense_maximum
    from swtstudy.solver.points import solve_points

    points = points_from(np.array([tuple(row)], ROW), definitions)
    line = solve_points(points, TOLERANCE / 10.0)
    found = np.zeros(1, AUDITED)[0]
    for name in FOUND:
        found[name] = np.nan
    for name in ("s", "s_error", "s_surface", "critical_x", "regime"):
        found[name] = getattr(line, name)[0]
    if dense and np.isfinite(found["s"]):
        found["s_dense"] = dense_maximum(points)[0]
    if np.isfinite(found["s_surface"]):
        # The field handles gross slip and the 0/0 of a vanishing contact: NumPy's warnings would only alarm.
        with np.errstate(all="ignore"):
            body, at_line = body_maximum(points, float(found["critical_x"]))
        found["s_all_planes"], found["s_body"] = at_line.swt, body.swt
        for axis, position, normal in zip("xyz", body.position, body.normal, strict=True):
            found[f"body_{axis}"], found[f"normal_{axis}"] = position, normal
    return found
