"""The audit: random points of a study solved without the surface line's assumptions.

The solver looks for s on the line y = 0 of the surface, on planes through y. The audit searches the whole
body and all planes, by another route from the contact to the stress, and reports where the two differ.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points.grid import COST, ROW, SHAPE_COLUMNS, Definitions, Table, code_of, points_from, value_of
from swtstudy.study.definition import Study, require_study
from swtstudy.study.sample import drawn_rows
from swtstudy.study.writing import defined_in, definitions_text
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.files import read_table
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import flag_attributes
from swtstudy.vocabulary.version import SOLVER_VERSION

#: An audit's files have this before the name of the study.
AUDIT_PREFIX = "audit_"
#: Which of the surface line's assumptions the body's maximum breaks, in the order of the flag values; the
#: last one is for points without a finite s, or with their maximum where the pressure is unbounded.
VERDICTS = ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")
#: Attributes of the variables: what is found, and what follows from it.
_ATTRIBUTES = read_table(__file__, "audit")
_ATTRIBUTES["regime"] |= flag_attributes(REGIMES)
_ATTRIBUTES["verdict"] |= flag_attributes(VERDICTS)
#: The numbers that the audit of a point finds; the others follow from these.
FOUND = [n for n in _ATTRIBUTES if n not in ("excess", "remainder", "shortfall", "verdict", "regime")]
#: An audited point, in an array: its numbers, and its regime's flag value.
AUDITED = np.dtype([*((name, np.float64) for name in FOUND), ("regime", np.int8)])
#: Columns of the rows that an audit holds: the loop knows what it costs. And the columns of names.
_COLUMNS = [name for name in ROW.names or () if name != COST]
_NAMES = ("profile", "criterion", "load")

#: Relative excess of the body's maximum that counts; s itself is computed to a tenth of this.
TOLERANCE = 1e-3
#: Distances and direction cosines that count as 0.
_ZERO = 1e-6


def audit_dataset(rows: Table, points: NDArray[np.void], definitions: Definitions) -> xr.Dataset:
    """The Dataset of an audit.

    Parameters
    ----------
    rows
        Shape (n,): the canonical rows of the points.
    points
        Shape (n,) of `AUDITED`.
    definitions
        Definitions of the user, by code.

    Returns
    -------
    xarray.Dataset
        One dimension, ``sample``; the parameters are coordinates along it.
    """
    columns: dict[str, NDArray[Any]] = {name: rows[name] for name in _COLUMNS}
    for name in _NAMES:
        names = [str(value_of(code, definitions, name)) for code in rows[name]]
        columns[name] = np.array(names, dtype=object)
    values = {name: points[name] for name in AUDITED.names or ()}
    s, dense, body = values["s"], values["s_dense"], values["s_body"]
    with np.errstate(invalid="ignore", divide="ignore"):
        # All or nothing above 0.
        excess, remainder = (
            np.where(known != 0.0, body / known - 1.0, body > 0.0) for known in (s, values["s_surface"])
        )
        short = np.where(dense > 0.0, np.maximum(dense - s - values["s_error"], 0.0) / dense, 0.0)
    breaks = {
        "not_finite": ~np.isfinite(values["s_surface"]),
        "none": excess <= TOLERANCE,
        "surface": values["body_z"] > _ZERO,
        "symmetry_line": np.abs(values["body_y"]) > _ZERO,
        "plane_through_y": np.abs(values["normal_y"]) > _ZERO,
    }
    verdict = np.select([*breaks.values()], [*map(VERDICTS.index, breaks)], VERDICTS.index("line_search"))
    values |= {"excess": excess, "remainder": remainder, "verdict": verdict.astype(np.int8)}
    values["shortfall"] = np.where(np.isfinite(dense), short, np.nan)
    return xr.Dataset(
        {name: ("sample", values[name], attributes) for name, attributes in _ATTRIBUTES.items()},
        {name: ("sample", column) for name, column in columns.items()},
        {"definitions": definitions_text(definitions.values())} if definitions else {},
    )


def open_audit(path: str | PathLike[str]) -> xr.Dataset:
    """The audit in a file, loaded.

    Raises
    ------
    ValueError
        If the file holds no audit, or is damaged.
    """
    from swtstudy.archive.archive import load_file

    dataset = load_file(Path(path))
    # An audit may be older than a shape parameter, which then no profile of it has.
    if not {*_COLUMNS, *_ATTRIBUTES} - {*SHAPE_COLUMNS} <= {*dataset.variables}:
        raise ValueError(f"{path}: a netCDF file, but not an audit of swtstudy")
    return dataset


def canonical_rows(dataset: xr.Dataset) -> Table:
    """The canonical rows of an audit's points, shape (n,)."""
    known, rows = defined_in(dataset.attrs), np.zeros(dataset.sizes["sample"], ROW)
    for name in (name for name in _COLUMNS if name in dataset):
        own, values = known.get(name, {}), dataset[name].values
        rows[name] = [code_of(own.get(each, each), name) for each in values] if name in _NAMES else values
    loads = known.get("load", {})
    rows[COST] = [loads[each].cost if each in loads else 0 for each in dataset["load"].values]
    return rows


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
    from swtstudy.archive.archive import save
    from swtstudy.archive.workers import start_workers

    keys = drawn_rows(study.grid, points, seed).tolist()
    known, definitions = _known(Path(path), study.grid.definitions)
    # Of a point with a finite s the dense grid may lack.
    missing = [
        key
        for key in keys
        if key not in known or (dense and np.isnan(known[key]["s_dense"]) and np.isfinite(known[key]["s"]))
    ]

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
            points = np.rec.fromarrays([audit[name].values for name in AUDITED.names or ()], AUDITED)
            return dict(zip(canonical_rows(audit).tolist(), points, strict=True)), both
    return {}, own


def audit_point(row: Sequence[float], definitions: Definitions, dense: bool = False) -> np.void:
    """Audit one canonical row (`swtstudy.points.grid`).

    Parameters
    ----------
    row
        The row.
    definitions
        Definitions of the user, by code.
    dense
        Whether its surface line gets a dense grid, too (`swtstudy.paper.maxima`).

    Returns
    -------
    record
        Of `AUDITED`.
    """
    from swtstudy.paper.maxima import body_maximum, dense_maximum
    from swtstudy.solver.points import solve_points

    points = points_from(np.array([tuple(row)], ROW), definitions)
    line = solve_points(points, TOLERANCE / 10.0)
    found = dict.fromkeys(FOUND, np.nan)
    found |= {name: getattr(line, name)[0] for name in ("s", "s_error", "s_surface", "critical_x", "regime")}
    if dense and np.isfinite(found["s"]):
        found["s_dense"] = dense_maximum(points)[0]
    if np.isfinite(found["s_surface"]):
        # The field handles gross slip and the 0/0 of a vanishing contact: NumPy's warnings would only alarm.
        with np.errstate(all="ignore"):
            body, at_line = body_maximum(points, float(found["critical_x"]))
        found["s_all_planes"], found["s_body"] = at_line.swt, body.swt
        for axis, position, normal in zip("xyz", body.position, body.normal, strict=True):
            found[f"body_{axis}"], found[f"normal_{axis}"] = position, normal
    return np.array([tuple(found[name] for name in AUDITED.names or ())], AUDITED)[0]
