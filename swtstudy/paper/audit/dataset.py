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
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.tables import read_table

#: Which of the surface line's assumptions the body's maximum breaks, in the order of the flag values; the
#: last one is for points without a finite s, or with their maximum where the pressure is unbounded.
VERDICTS = ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")
#: Attributes of the variables: what is found, and what follows from it.
_ATTRIBUTES = read_table(__file__, "dataset")
for _name, _flags in (("regime", REGIMES), ("verdict", VERDICTS)):
    _values = np.arange(len(_flags), dtype=np.int8)
    _ATTRIBUTES[_name] |= {"flag_values": _values, "flag_meanings": " ".join(_flags)}
#: Numbers that the audit of a point finds.
FOUND = [
    name for name in _ATTRIBUTES if name not in ("excess", "remainder", "shortfall", "regime", "verdict")
]
#: An audited point, in an array: its numbers, and its regime's flag value.
AUDITED = np.dtype([*((name, np.float64) for name in FOUND), ("regime", np.int8)])
#: Columns of the rows that an audit holds: the loop knows what it costs. And the columns of names.
_COLUMNS = [name for name in COLUMNS if name != COST]
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
    from swtstudy.archive.netcdf import load_file

    dataset = load_file(Path(path))
    if not {*_COLUMNS, *_ATTRIBUTES} <= {*dataset.variables}:
        raise ValueError(f"{path}: a netCDF file, but not an audit of swtstudy")
    return dataset


def canonical_rows(dataset: xr.Dataset) -> Table:
    """The canonical rows of an audit's points, shape (n,)."""
    known, rows = defined_in(dataset.attrs), np.zeros(dataset.sizes["sample"], ROW)
    for name in _COLUMNS:
        own, values = known.get(name, {}), dataset[name].values
        rows[name] = [code_of(own.get(each, each), name) for each in values] if name in _NAMES else values
    loads = known.get("load", {})
    rows[COST] = [loads[each].cost if each in loads else 0 for each in dataset["load"].values]
    return rows


def audited_points(dataset: xr.Dataset) -> dict[tuple[float, ...], np.void]:
    """The points of an audit, each of `AUDITED`, by canonical row."""
    points = np.empty(dataset.sizes["sample"], AUDITED)
    for name in AUDITED.names or ():
        points[name] = dataset[name].values
    return dict(zip(canonical_rows(dataset).tolist(), points, strict=True))
