"""The findings of an audit as a Dataset, as a table in a text file, and in words."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.archive.files import replacing
from swtstudy.audit.point import TOLERANCE, VERDICTS, Finding
from swtstudy.grid.canonical import COLUMNS, PROFILES
from swtstudy.mechanics.points import FloatArray

if TYPE_CHECKING:
    import xarray as xr

_LENGTH = "in units of a_H = sqrt(R delta0)"
_MEANINGS = {
    "s": "maximum of swt/SWT0 on the surface line, by the solver",
    "critical_x": f"where that is, {_LENGTH}",
    "s_all_planes": "swt/SWT0 there over all plane orientations",
    "s_body": "maximum of swt/SWT0 in the body over all plane orientations",
    "excess": "s_body/s - 1",
    **{f"body_{axis}": f"position of the body's maximum, {_LENGTH}" for axis in "xyz"},
    **{f"normal_{axis}": "unit normal of its critical plane" for axis in "xyz"},
}


def findings_dataset(rows: FloatArray, findings: Sequence[Finding]) -> xr.Dataset:
    """The findings of an audit.

    Parameters
    ----------
    rows
        Shape (n, len(COLUMNS)): the audited canonical points.
    findings
        One for each row.

    Returns
    -------
    xarray.Dataset
        One dimension, ``sample``; the parameters are coordinates along it.
    """
    import xarray as xr

    coordinates: dict[str, Any] = {name: ("sample", rows[:, i]) for i, name in enumerate(COLUMNS)}
    names = np.array([PROFILES[int(code)] for code in rows[:, COLUMNS.index("profile")]], dtype=object)
    coordinates["profile"] = ("sample", names)
    columns = {name: np.array([getattr(f, name) for f in findings]) for name in list(_MEANINGS)[:5]}
    for group, prefix in (("position", "body"), ("normal", "normal")):
        for axis, label in enumerate("xyz"):
            columns[f"{prefix}_{label}"] = np.array([getattr(f, group)[axis] for f in findings])
    variables: dict[str, Any] = {
        name: ("sample", values, {"long_name": _MEANINGS[name], "units": "1"})
        for name, values in columns.items()
    }
    flags = {"flag_values": np.arange(len(VERDICTS), dtype=np.int8), "flag_meanings": " ".join(VERDICTS)}
    codes = np.array([VERDICTS.index(f.verdict) for f in findings], dtype=np.int8)
    meaning = "the first assumption of the surface line that the body's maximum breaks"
    variables["verdict"] = ("sample", codes, {"long_name": meaning, **flags})
    return xr.Dataset(variables, coordinates)


def write_table(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write the findings as comma-separated values, one line a sample."""
    names = [*map(str, dataset.coords), *map(str, dataset.data_vars)]
    columns = [dataset[name].values for name in names]
    columns[names.index("verdict")] = np.array(VERDICTS)[dataset["verdict"].values]
    with replacing(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        for row in zip(*columns, strict=True):
            writer.writerow([f"{value:.9g}" if isinstance(value, float) else value for value in row])


def summary(dataset: xr.Dataset) -> list[str]:
    """What the audit found, in lines."""
    excess, verdict = dataset["excess"].values, dataset["verdict"].values
    count = len(excess)
    finite = np.isfinite(excess)
    exceeded = finite & (verdict > 0)
    lines = [
        f"{count} points, {int((~finite).sum())} of them without a finite s; the body's maximum exceeds s by "
        f"more than {TOLERANCE:g} in {int(exceeded.sum())}"
    ]
    for code, name in enumerate(VERDICTS):
        where = finite & (verdict == code)
        if code and where.any():
            lines.append(f"  {name}: {int(where.sum())}, by up to {100 * excess[where].max():.2g} %")
    away = np.abs(dataset["s_all_planes"].values / dataset["s"].values - 1.0)
    lines.append(f"two ways to swt at the critical point differ by up to {np.nanmax(away):.1e}")
    for name in map(str, dataset.coords):
        values = dataset[name].values
        distinct = np.unique(values)
        if 1 < len(distinct) <= 12:
            shares = (
                f"{value if isinstance(value, str) else format(value, 'g')}: "
                f"{int(exceeded[values == value].sum())}/{int((values == value).sum())}"
                for value in distinct
            )
            lines.append(f"  exceeded by {name}: {', '.join(shares)}")
    return lines
