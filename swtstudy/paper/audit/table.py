"""The audited points as a Dataset, and back."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.archive.attributes import defined_in, definitions_text
from swtstudy.mechanics.points import REGIMES
from swtstudy.paper.audit.point import VERDICTS, AuditedPoint
from swtstudy.points.canonical import COLUMNS, ROW, Table
from swtstudy.points.codes import Definitions, code_of, value_of
from swtstudy.vocabulary.parameters import PARAMETERS

if TYPE_CHECKING:
    import xarray as xr

_LENGTH = "in units of a_H = sqrt(R delta0)"
_MEANINGS = {
    "s": "maximum of swt/SWT0 on the surface line, by the solver",
    "s_error": "estimated absolute error of s",
    "s_dense": "maximum of swt/SWT0 on the surface line, by a dense look",
    "shortfall": "how far s and its error are below s_dense, relative",
    "s_surface": "maximum of swt/SWT0 on the circle through the critical point, by the solver",
    "critical_x": f"where that is, {_LENGTH}",
    "s_all_planes": "swt/SWT0 there over all plane orientations",
    "s_body": "maximum of swt/SWT0 in the body over all plane orientations",
    "excess": "s_body/s - 1",
    "remainder": "s_body/s_surface - 1",
    **{f"body_{axis}": f"position of the body's maximum, {_LENGTH}" for axis in "xyz"},
    **{f"normal_{axis}": "unit normal of its critical plane" for axis in "xyz"},
}
_STORED = ("s", "s_error", "s_surface", "critical_x", "s_dense", "s_all_planes", "s_body")
_SCALARS = (*_STORED, "excess", "remainder", "shortfall")
#: What an older audit lacks.
_LATER = {"s_error", "s_dense", "shortfall"}
#: Parameters whose values are names: their columns hold codes.
_WITH_NAMES = {name for name, row in PARAMETERS.items() if row.kind == "name"}


def audit_dataset(rows: Table, points: Sequence[AuditedPoint], definitions: Definitions) -> xr.Dataset:
    """The Dataset of an audit.

    Parameters
    ----------
    rows
        Shape (n,): their canonical rows.
    points
        The audited points, one for each row.
    definitions
        What the user has defined, by its code.

    Returns
    -------
    xarray.Dataset
        One dimension, ``sample``; the parameters are coordinates along it.
    """
    import xarray as xr

    coordinates: dict[str, Any] = {name: ("sample", rows[name]) for name in COLUMNS}
    for name in _WITH_NAMES & {*COLUMNS}:
        names = [str(value_of(code, definitions, name)) for code in rows[name]]
        coordinates[name] = ("sample", np.array(names, dtype=object))
    columns = {name: np.array([getattr(each, name) for each in points], float) for name in _SCALARS}
    for group, prefix in (("position", "body"), ("normal", "normal")):
        values = np.array([getattr(each, group) for each in points], float).reshape(-1, 3)
        columns |= {f"{prefix}_{label}": column for label, column in zip("xyz", values.T, strict=True)}
    variables: dict[str, Any] = {
        name: ("sample", values, {"long_name": _MEANINGS[name], "units": "1"})
        for name, values in columns.items()
    }
    for name, meaning, words in (
        ("regime", "regime of the contact over the stationary cycle", REGIMES),
        ("verdict", "the first assumption of the surface line that the body's maximum breaks", VERDICTS),
    ):
        codes = np.array([words.index(getattr(each, name)) for each in points], dtype=np.int8)
        flags = {"flag_values": np.arange(len(words), dtype=np.int8), "flag_meanings": " ".join(words)}
        variables[name] = ("sample", codes, {"long_name": meaning, **flags})
    dataset = xr.Dataset(variables, coordinates)
    return (
        dataset.assign_attrs(definitions=definitions_text(definitions.values())) if definitions else dataset
    )


def open_audit(path: str | PathLike[str]) -> xr.Dataset:
    """The audit in a file, loaded.

    Raises
    ------
    ValueError
        If the file holds no audit, or is damaged.
    """
    from swtstudy.archive.read import load_file

    dataset = load_file(Path(path))
    if not {"profile", "p", "q"} <= {*dataset.coords} or not {*_MEANINGS, "regime", "verdict"} - _LATER <= {
        *dataset.data_vars
    }:
        raise ValueError(f"{path}: a netCDF file, but not an audit of swtstudy")
    return dataset


def canonical_rows(dataset: xr.Dataset) -> Table:
    """The canonical rows of an audit's points, shape (n,)."""
    known = defined_in(dataset.attrs)
    rows = np.zeros(dataset.sizes["sample"], ROW)
    for name in COLUMNS:
        # What an older audit lacks is what it did not have: forces, loops, bulk stresses, other criteria.
        if name in dataset.coords:
            values = dataset[name].values
            own = known.get(name, {})
            codes = name in _WITH_NAMES
            rows[name] = [code_of(own.get(value, value), name) for value in values] if codes else values
        elif name in PARAMETERS and PARAMETERS[name].kind == "number" and PARAMETERS[name].optional:
            rows[name] = PARAMETERS[name].default
    return rows


def audited_points(dataset: xr.Dataset) -> dict[tuple[float, ...], AuditedPoint]:
    """The points of an audit, by canonical row."""
    unknown = np.full(dataset.sizes["sample"], np.nan)
    values = {name: dataset[name].values if name in dataset else unknown for name in _MEANINGS}
    points = {}
    for i, row in enumerate(canonical_rows(dataset).tolist()):
        position, normal = (
            np.array([values[f"{prefix}_{axis}"][i] for axis in "xyz"]) for prefix in ("body", "normal")
        )
        stored = {name: float(values[name][i]) for name in _STORED}
        regime = REGIMES[int(dataset["regime"].values[i])]
        points[row] = AuditedPoint(**stored, regime=regime, position=position, normal=normal)
    return points
