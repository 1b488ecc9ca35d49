"""Audited points as a Dataset, and back."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.attributes import defined_in, definitions_text
from swtstudy.points.canonical import COLUMNS, COST, ROW, Definitions, Table, code_of, value_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.parameters import PARAMETERS

_LENGTH = "in units of a_H = sqrt(R delta0)"
#: Numbers that the audit of a point finds.
FOUND = {
    "s": "maximum of swt/SWT0 on the surface line, by the solver",
    "s_error": "estimated absolute error of s",
    "s_surface": "maximum of swt/SWT0 on the circle through the critical point, by the solver",
    "critical_x": f"position of the maximum on the surface line, {_LENGTH}",
    "s_dense": "maximum of swt/SWT0 on the surface line, by a dense grid; NaN without one",
    "s_all_planes": "swt/SWT0 there over all plane orientations, from the field of the body",
    "s_body": "maximum of swt/SWT0 in the body over all plane orientations",
    **{f"body_{axis}": f"position of the body's maximum, {_LENGTH}" for axis in "xyz"},
    **{f"normal_{axis}": "unit normal of its critical plane" for axis in "xyz"},
}
#: Variables that follow from them.
_DERIVED = {
    "excess": "s_body/s - 1",
    "remainder": "s_body/s_surface - 1",
    "shortfall": "how far s and its error are below s_dense, relative",
}
#: Which of the surface line's assumptions the body's maximum breaks, in the order of the flag values; the
#: last one is for points without a finite s, or with their maximum where the pressure is unbounded.
VERDICTS = ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")
_FLAGS = {
    "regime": ("regime of the contact over the stationary cycle", REGIMES),
    "verdict": ("the first assumption of the surface line that the body's maximum breaks", VERDICTS),
}
#: An audited point, in an array: its numbers, and its regime's flag value.
AUDITED = np.dtype([*((name, np.float64) for name in FOUND), ("regime", np.int8)])
#: Parameters whose values are names: their columns hold codes.
_WITH_NAMES = {name for name, row in PARAMETERS.items() if row.kind == "name"}

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
    # The cost of loops is known with them.
    coordinates: dict[str, Any] = {name: ("sample", rows[name]) for name in COLUMNS if name != COST}
    for name in _WITH_NAMES & {*COLUMNS}:
        names = [str(value_of(code, definitions, name)) for code in rows[name]]
        coordinates[name] = ("sample", np.array(names, dtype=object))
    s, dense, body = (points[name] for name in ("s", "s_dense", "s_body"))
    excess, remainder = _above(body, s), _above(body, points["s_surface"])
    with np.errstate(invalid="ignore", divide="ignore"):
        short = np.where(dense > 0.0, np.maximum(dense - s - points["s_error"], 0.0) / dense, 0.0)
    breaks = {
        "not_finite": ~np.isfinite(points["s_surface"]),
        "none": excess <= TOLERANCE,
        "surface": points["body_z"] > _ZERO,
        "symmetry_line": np.abs(points["body_y"]) > _ZERO,
        "plane_through_y": np.abs(points["normal_y"]) > _ZERO,
    }
    verdict = np.select([*breaks.values()], [*map(VERDICTS.index, breaks)], VERDICTS.index("line_search"))
    values = {name: points[name] for name in AUDITED.names or ()}
    values |= {"excess": excess, "remainder": remainder, "verdict": verdict.astype(np.int8)}
    values["shortfall"] = np.where(np.isfinite(dense), short, np.nan)
    variables: dict[str, Any] = {
        name: ("sample", values[name], {"long_name": meaning, "units": "1"})
        for name, meaning in (FOUND | _DERIVED).items()
    }
    for name, (meaning, words) in _FLAGS.items():
        flags = {"flag_values": np.arange(len(words), dtype=np.int8), "flag_meanings": " ".join(words)}
        variables[name] = ("sample", values[name], {"long_name": meaning, **flags})
    own = {"definitions": definitions_text(definitions.values())} if definitions else {}
    return xr.Dataset(variables, coordinates, own)


def _above(value: FloatArray, s: FloatArray) -> FloatArray:
    """Relative excess of values over s; all or nothing where s is 0."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(s != 0.0, value / s - 1.0, value > 0.0)


def open_audit(path: str | PathLike[str]) -> xr.Dataset:
    """The audit in a file, loaded.

    Raises
    ------
    ValueError
        If the file holds no audit, or is damaged.
    """
    from swtstudy.archive.netcdf import load_file

    dataset = load_file(Path(path))
    if not {*COLUMNS, *FOUND, *_DERIVED, *_FLAGS} - {COST} <= {*dataset.variables}:
        raise ValueError(f"{path}: a netCDF file, but not an audit of swtstudy")
    return dataset


def canonical_rows(dataset: xr.Dataset) -> Table:
    """The canonical rows of an audit's points, shape (n,)."""
    known = defined_in(dataset.attrs)
    rows = np.zeros(dataset.sizes["sample"], ROW)
    for name in COLUMNS:
        own = known.get("load" if name == COST else name, {})
        if name == COST:
            rows[name] = [own[value].cost if value in own else 0 for value in dataset["load"].values]
        elif name in _WITH_NAMES:
            rows[name] = [code_of(own.get(value, value), name) for value in dataset[name].values]
        else:
            rows[name] = dataset[name].values
    return rows


def audited_points(dataset: xr.Dataset) -> dict[tuple[float, ...], np.void]:
    """The points of an audit, each of `AUDITED`, by canonical row."""
    points = np.empty(dataset.sizes["sample"], AUDITED)
    for name in AUDITED.names or ():
        points[name] = dataset[name].values
    return dict(zip(canonical_rows(dataset).tolist(), points, strict=True))
