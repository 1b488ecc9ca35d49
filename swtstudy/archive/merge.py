"""Several archives as one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from swtstudy.archive.archive import build, history_line
from swtstudy.archive.read import ArchiveError, open_results
from swtstudy.archive.recall import grid_of, records_of
from swtstudy.grid.canonical import canonical_number, describe_point, group_rows
from swtstudy.grid.grid import Grid
from swtstudy.grid.unique import unique_points
from swtstudy.grid.values import Value
from swtstudy.parameters import PARAMETERS
from swtstudy.records.records import COMPUTED, MISSING, Records, join, look_up
from swtstudy.study.definition import Study
from swtstudy.study.figure import FigureLayout
from swtstudy.study.writing import to_toml


class ConflictError(ValueError):
    """Archives that contradict each other."""


def merge(paths: Sequence[Path]) -> xr.Dataset:
    """One Dataset with all that is in several archives.

    Its grid spans the values of all of them; what none of them has is NaN with the status "missing".

    Raises
    ------
    ConflictError
        A ValueError, if they come from different versions of the solver, or have values of one point that
        differ by more than their estimated errors.
    """
    datasets = [open_results(path) for path in paths]
    records = join(records_of(dataset) for dataset in datasets)
    versions = sorted({records.runs[run].solver_version for run in np.unique(records.run) if run >= 0})
    if len(versions) > 1:
        raise ConflictError(f"results of different solver versions cannot be merged: {', '.join(versions)}")
    _refuse_conflicts(records)
    grid = _union([grid_of(dataset) for dataset in datasets])
    points = unique_points(grid)
    found = look_up(points.table, records, records.status != MISSING)
    merged = Records.missing(points.table)
    merged = merged.put(np.flatnonzero(found >= 0), records.take(found[found >= 0]))
    study = _study(datasets, grid)
    history = [history_line(f"merged from {', '.join(path.name for path in paths)}")]
    history += [line for dataset in datasets for line in dataset.attrs["history"].splitlines()]
    return build(study, points, merged.trimmed(), "\n".join(dict.fromkeys(history)), 0.0)


def _refuse_conflicts(records: Records) -> None:
    computed = np.flatnonzero(records.status == COMPUTED)
    first, group = group_rows(records.table[computed])
    one, other = computed[first[group]], computed
    error = records.solution.s_error[one] + records.solution.s_error[other]
    # Exactly equal values do not conflict even where the error is not finite.
    equal = np.isclose(records.solution.s[one], records.solution.s[other], rtol=1e-12, atol=0, equal_nan=True)
    with np.errstate(invalid="ignore"):
        apart = ~equal & ~(np.abs(records.solution.s[one] - records.solution.s[other]) <= error)
    if apart.any():
        index = int(np.flatnonzero(apart)[0])
        a, b = records.solution.s[one[index]], records.solution.s[other[index]]
        more = f"; {int(apart.sum()) - 1} more" if apart.sum() > 1 else ""
        point = describe_point(records.table[one[index]])
        raise ConflictError(f"conflicting values {a:.8g} and {b:.8g} at {point}{more}")


def _union(grids: list[Grid]) -> Grid:
    """The grid that spans the values of all grids; the dimensions in the order of the first."""
    names = list(dict.fromkeys(name for grid in grids for name in grid.axes))
    values = {name: _distinct([v for grid in grids for v in grid.values(name)]) for name in PARAMETERS}
    names += [name for name in PARAMETERS if name not in names and len(values[name]) > 1]
    fixed = {name: values[name][0] for name in PARAMETERS if name not in names and values[name]}
    return Grid(fixed, {name: values[name] for name in names})


def _distinct(values: list[Value]) -> tuple[Value, ...]:
    """Distinct values, numbers in increasing order."""
    keyed = {canonical_number(v) if isinstance(v, float) else v: v for v in reversed(values)}
    if any(isinstance(value, str) for value in values):
        return tuple(dict.fromkeys(values))
    return tuple(sorted(keyed.values()))


def _study(datasets: list[xr.Dataset], grid: Grid) -> Study:
    """The study that the merged archive is the result of; with the figure of the first, if it fits."""
    titles = dict.fromkeys(str(dataset.attrs["title"]) for dataset in datasets)
    rtol = max(float(dataset.attrs["rtol"]) for dataset in datasets)
    figure = None
    if "figure" in datasets[0].attrs:
        layout = FigureLayout.from_json(datasets[0].attrs["figure"])
        if {name for _, name in layout.roles()} == set(grid.dims):
            figure = layout
    text = to_toml(" + ".join(titles), rtol, grid, figure)
    try:
        return Study.from_text(text, "the merged study")
    except ValueError as error:
        raise ArchiveError(f"these archives do not make one study:\n{error}") from None
