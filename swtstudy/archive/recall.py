"""The records in an archive, by canonical point: the way back from labelled results."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import read_failures, read_runs
from swtstudy.archive.error import ArchiveError
from swtstudy.grid.grid import Grid
from swtstudy.grid.shapes import shapes_needed
from swtstudy.grid.unique import unique_points
from swtstudy.grid.values import Value, read_value
from swtstudy.mechanics.points import Solution
from swtstudy.mistakes import Mistake, StudyError, literal
from swtstudy.parameters import OPTIONAL_PARTS, PARAMETERS, Parameter
from swtstudy.records.labelled import arrays_of
from swtstudy.records.records import FAILED, Records


def grid_of(dataset: xr.Dataset) -> Grid:
    """The grid of an archive, from its coordinates.

    Raises
    ------
    StudyError
        With every coordinate that no study can have.
    """
    values: dict[str, tuple[Value, ...]] = {}
    mistakes: list[Mistake] = []
    dims = [str(name) for name in dataset.s.dims]
    for name in dims:
        if name not in PARAMETERS or name not in dataset.coords:
            mistakes.append(Mistake(name, "a dimension without values of a parameter", ", ".join(PARAMETERS)))
    for name, parameter in PARAMETERS.items():
        if name not in dataset.coords:
            continue
        coordinate = dataset[name]
        if coordinate.dims != ((name,) if name in dims else ()):
            mistakes.append(Mistake(name, f"dimensions {coordinate.dims}", "an axis of s, or a single value"))
            continue
        values[name] = tuple(_values(parameter, np.atleast_1d(coordinate.values).tolist(), mistakes))
    profiles = [value for value in values.get("profile", ()) if isinstance(value, str)]
    for name, parameter in PARAMETERS.items():
        if parameter.part in OPTIONAL_PARTS and parameter.default is not None and name not in dataset:
            # Older archives do not have them.
            values[name] = (read_value(parameter, parameter.default),)
    required = [name for name, parameter in PARAMETERS.items() if parameter.default is not None]
    for name in (*required, *shapes_needed(profiles)):
        if name not in values and name not in dims:
            mistakes.append(Mistake(name, "nothing", PARAMETERS[name].allowed))
    if mistakes:
        raise StudyError(mistakes)
    fixed = {name: value[0] for name, value in values.items() if name not in dims}
    return Grid(fixed, {name: values[name] for name in dims})


def _values(parameter: Parameter, raw: list[object], mistakes: list[Mistake]) -> Iterator[Value]:
    """Values of a coordinate, up to the first invalid one, which is a mistake."""
    for value in raw:
        try:
            yield read_value(parameter, value)
        except ValueError as error:
            mistakes.append(Mistake(parameter.name, f"{literal(value)} ({error})", parameter.allowed))
            return


def records_of(dataset: xr.Dataset, source: object = "archive") -> Records:
    """The results in an archive, by canonical point; `source` names it in messages.

    Raises
    ------
    ArchiveError
        If a variable of an archive is missing.
    """
    lacking = [item.name for item in fields(Solution) if item.name not in dataset]
    if lacking:
        raise ArchiveError(
            f"{source}: an archive of another version of swtstudy, without {', '.join(lacking)}"
        )
    points = unique_points(grid_of(dataset))
    at = np.zeros(len(points.table), np.int64)
    at[points.index] = np.arange(len(points.index))
    flat = {
        name: dataset[name].transpose(*dataset.s.dims).values.reshape(-1)[at]
        for name in (*(item.name for item in fields(Solution)), "status", "run")
    }
    status, run = flat.pop("status").astype(np.int8), flat.pop("run").astype(np.int32)
    # Mirroring a second time gives the canonical point back.
    solution = Solution(**arrays_of(Solution(**flat), points.mirrored[at]))
    failures = read_failures(dataset.status.attrs["failures"])
    reason = {tuple(failure["row"]): failure["message"] for failure in failures}
    failed = np.flatnonzero(status == FAILED)
    rows = zip(failed.tolist(), map(tuple, points.table[failed].tolist()), strict=True)
    messages = {index: reason[row] for index, row in rows if row in reason}
    return Records(points.table, solution, status, run, read_runs(dataset.attrs["runs"]), messages)
