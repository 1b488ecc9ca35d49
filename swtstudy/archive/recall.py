"""What an archive holds, by canonical point: the way back from labels to records."""

from __future__ import annotations

import json
from dataclasses import fields

import numpy as np
import xarray as xr

from swtstudy.archive.read import ArchiveError
from swtstudy.grid.grid import Grid
from swtstudy.grid.unique import unique_points
from swtstudy.grid.values import Value, read_value
from swtstudy.mechanics.points import Solution
from swtstudy.parameters import PARAMETERS
from swtstudy.records.labelled import arrays_of
from swtstudy.records.records import STATES, Records, Run


def grid_of(dataset: xr.Dataset) -> Grid:
    """The grid of an archive, from its coordinates.

    Raises
    ------
    ArchiveError
        If they are not those of a grid.
    """
    fixed: dict[str, Value] = {}
    axes: dict[str, tuple[Value, ...]] = {}
    try:
        for name in map(str, dataset.s.dims):
            axes[name] = tuple(read_value(PARAMETERS[name], value) for value in dataset[name].values.tolist())
        for name, parameter in PARAMETERS.items():
            if name in dataset.coords and name not in axes:
                fixed[name] = read_value(parameter, dataset[name].item())
    except (KeyError, ValueError) as error:
        raise ArchiveError(f"its coordinates are not those of a study ({error})") from None
    return Grid(fixed, axes)


def records_of(dataset: xr.Dataset) -> Records:
    """The results in an archive, by canonical point.

    Raises
    ------
    ArchiveError
        If something that belongs to an archive is not there.
    """
    lacking = [item.name for item in fields(Solution) if item.name not in dataset]
    if lacking:
        raise ArchiveError(f"an archive of another version of swtstudy, without {', '.join(lacking)}")
    points = unique_points(grid_of(dataset))
    at = np.zeros(len(points.table), np.int64)
    at[points.index] = np.arange(len(points.index))
    try:
        flat = {
            item.name: dataset[item.name].transpose(*dataset.s.dims).values.reshape(-1)[at]
            for item in fields(Solution)
        }
        # Mirroring a second time gives the canonical point back.
        solution = Solution(**arrays_of(Solution(**flat), points.mirrored[at]))
        status, run = (
            dataset[name].transpose(*dataset.s.dims).values.reshape(-1)[at] for name in ("status", "run")
        )
        runs = tuple(Run(**each) for each in json.loads(dataset.attrs["runs"]))
        failures = json.loads(dataset.status.attrs["failures"])
        messages = {tuple(failure["row"]): failure["message"] for failure in failures}
    except (KeyError, ValueError, TypeError, IndexError) as error:
        raise ArchiveError(f"not a complete archive of swtstudy ({error!r})") from None
    if not (np.isin(status, range(len(STATES))).all() and np.isin(run, range(-1, len(runs))).all()):
        raise ArchiveError("a damaged archive: it has a status or a run that there is not")
    records = Records(points.table, solution, status.astype(np.int8), run.astype(np.int32), runs)
    if messages:
        for index, row in enumerate(points.table.tolist()):
            if tuple(row) in messages:
                records.messages[index] = messages[tuple(row)]
    return records
