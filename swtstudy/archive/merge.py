"""Several archives as one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.archive import build, history_line, open_results
from swtstudy.archive.attributes import read_figure, read_runs
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.recall import grid_of, records_of
from swtstudy.points.canonical import Definitions, canonical_number, describe_point, group_rows
from swtstudy.points.grid import Grid
from swtstudy.points.records import COMPUTED, MISSING, Records, completed, join, look_up, made_by, matching
from swtstudy.points.requested import CONTACT, has_units, request_of
from swtstudy.points.unique import unique_points, wanted
from swtstudy.points.values import Value, as_number
from swtstudy.study.definition import Study
from swtstudy.study.writing import to_toml
from swtstudy.units.reading import read_contact
from swtstudy.vocabulary.arrays import BoolArray
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import AXES, QUANTITY_AXES
from swtstudy.vocabulary.quantities import DISTANCE, Request

#: Relative difference of s from rounding alone, between two machines.
_ROUNDING = 1e-12


class ConflictError(ValueError):
    """Archives with contradictory values."""


class GapsError(ValueError):
    """Archives that do not fill the grid spanned by all their values."""


def merge(paths: Sequence[Path], sparse: bool = False) -> xr.Dataset:
    """One Dataset with the results of several archives, on the grid that all their values span.

    Parameters
    ----------
    paths
        The archives.
    sparse
        Whether this grid may have points that are in none of the archives: NaN, with the status "missing".

    Raises
    ------
    ConflictError
        A ValueError, if they come from different versions of the solver, prescribe forces in one and
        displacements in another, or have values of one point that differ by more than their estimated
        errors.
    GapsError
        A ValueError, if points of the grid are in none of them and `sparse` is False.
    """
    datasets = [open_results(path) for path in paths]
    parts = [records_of(dataset, path) for dataset, path in zip(datasets, paths, strict=True)]
    records = join(parts)
    sources = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    runs = [(run, path) for path, part in zip(paths, parts, strict=True) for run in part.trimmed().runs]
    _refuse_several("solver versions", {run.solver_version: path for run, path in reversed(runs)})
    _refuse_other_contacts(paths, datasets)
    grids = [grid_of(dataset) for dataset in datasets]
    controls = {grid.control.name: path for grid, path in zip(grids, paths, strict=True)}
    _refuse_several("prescribed loads", controls)
    grid = _union(grids)
    _refuse_conflicts(paths, records, sources, grid.definitions)
    points = unique_points(grid)
    made = f"merged from {', '.join(path.name for path in paths)}"
    absent = look_up(points.table, records, np.ones(len(records), bool)) < 0
    if absent.any():
        gaps = f"{int(absent[points.index].sum())} of {grid.size} points"
        if not sparse:
            example = describe_point(points.table[np.flatnonzero(absent)[0]], points.definitions)
            raise GapsError(
                f"the grid of all values in {_names(paths)} has {gaps} in none of them, such as {example}; "
                "--sparse (sparse=True in Python) leaves them missing"
            )
        made += f", {gaps} in none of them"
    merged = completed(matching(points.table, records, records.status != MISSING), records)
    axis = any(DISTANCE in dataset.dims for dataset in datasets)
    asked = _asked(datasets, made_by(records.runs), axis)
    if not sparse:
        _refuse_gaps_in_quantities(paths, merged, wanted(grid, asked, points), points.definitions)
    study = _study(paths, datasets, grid, asked)
    history = [history_line(made)]
    history += [line for dataset in datasets for line in dataset.attrs["history"].splitlines()]
    return build(study, points, merged.trimmed(), "\n".join(dict.fromkeys(history)), 0.0)


def _asked(datasets: Sequence[xr.Dataset], items: tuple[str, ...], axis: bool) -> Request:
    """Return the request that the archives have in common; distances of real contacts are lengths."""
    if not has_units(datasets[0]):
        return Request.of(items, axis)
    own = [request_of(dataset, made_by(read_runs(dataset.attrs["runs"]))) for dataset in datasets]
    lengths = sorted({length for each in own for length in each.distances})
    names = sorted({name for each in own for name in each.names})
    counts = any(each.counts for each in own)
    return Request(tuple(names), tuple(lengths), axis or len(lengths) > 1, counts)


def _names(paths: Sequence[Path]) -> str:
    return ", ".join(map(str, paths))


def _refuse_several(what: str, where: Mapping[str, Path]) -> None:
    """Refuse results with several of these, each of which is in one of the archives."""
    if len(where) > 1:
        words = ", ".join(f"{each} in {path}" for each, path in sorted(where.items()))
        raise ConflictError(f"results of different {what} cannot be merged: {words}")


def _refuse_conflicts(
    paths: Sequence[Path], records: Records, sources: NDArray, definitions: Definitions
) -> None:
    computed = np.flatnonzero(records.status == COMPUTED)
    first, group = group_rows(records.table[computed])
    one, other = computed[first[group]], computed
    error = records.solution.s_error[one] + records.solution.s_error[other]
    # Equal values do not conflict even where the error is not finite.
    s = records.solution.s
    equal = np.isclose(s[one], s[other], rtol=_ROUNDING, atol=0, equal_nan=True)
    with np.errstate(invalid="ignore"):
        apart = ~equal & ~(np.abs(s[one] - s[other]) <= error)
    if apart.any():
        index = int(np.flatnonzero(apart)[0])
        a, b = (f"{s[row[index]]:.8g} in {paths[sources[row[index]]]}" for row in (one, other))
        more = f"; {int(apart.sum()) - 1} more" if apart.sum() > 1 else ""
        point = describe_point(records.table[one[index]], definitions)
        raise ConflictError(f"conflicting values {a} and {b} at {point}{more}")


def _refuse_gaps_in_quantities(
    paths: Sequence[Path], merged: Records, asked: tuple[tuple[str, ...], BoolArray], definitions: Definitions
) -> None:
    names, of = asked
    for name, lacks in zip(names, (merged.lacking(names) & of).T, strict=True):
        if lacks.any():
            example = describe_point(merged.table[np.flatnonzero(lacks)[0]], definitions)
            raise GapsError(
                f"{name} is known of some points in {_names(paths)}, but not of {int(lacks.sum())} others, "
                f"such as {example}; --sparse (sparse=True in Python) leaves it NaN, and a run computes it"
            )


def _refuse_other_contacts(paths: Sequence[Path], datasets: Sequence[xr.Dataset]) -> None:
    first = datasets[0].attrs.get(CONTACT)
    for path, other in zip(paths, (dataset.attrs.get(CONTACT) for dataset in datasets), strict=True):
        if other == first:
            continue
        names = ["units"]
        if first and other:
            one, two = vars(read_contact(first)), vars(read_contact(other))
            names = [name.replace("_", " ") for name in one if one[name] != two[name]]
        words = f"results with other {' and '.join(names)} cannot be merged"
        raise ConflictError(f"{words}: those in {paths[0]} and in {path}")


def _union(grids: list[Grid]) -> Grid:
    """The grid that the values of all grids span; dimensions in the order of the first.

    The points of samples of the same parameters are one sample.
    """
    sampled = [tuple(sorted(grid.samples)) for grid in grids]
    if len({*sampled}) > 1 or any({*sampled[0]} & {*grid.axes} for grid in grids):
        found = "; ".join(", ".join(names) or "none" for names in sampled)
        raise ValueError(
            f"found samples of different parameters ({found}); allowed: samples of the same ones"
        )
    points = dict.fromkeys(
        point for grid in grids for point in zip(*(grid.samples[name] for name in sampled[0]), strict=True)
    )
    samples = dict(zip(sampled[0], zip(*points, strict=True), strict=True)) if points else {}
    names = list(dict.fromkeys(name for grid in grids for name in grid.axes))
    # That of a load which was measured is no value of its own.
    every = [name for name in AXES if any(name in grid.names for grid in grids)]
    values = {name: _distinct([v for grid in grids for v in grid.values(name)]) for name in every}
    others = [name for name in every if name not in (*names, *samples)]
    names += [name for name in others if len(values[name]) > 1]
    fixed = {name: values[name][0] for name in others if name not in names and values[name]}
    return replace(grids[0], fixed=fixed, axes={name: values[name] for name in names}, samples=samples)


def _distinct(values: list[Value]) -> tuple[Value, ...]:
    """Distinct values, numbers in increasing order."""
    if any(isinstance(value, str | Definition) for value in values):
        distinct = tuple(dict.fromkeys(values))
        names = [str(value) for value in distinct]
        if several := sorted({name for name in names if names.count(name) > 1}):
            raise ConflictError(f"{', '.join(several)}: of this name each archive defines another one")
        return distinct
    keyed = {canonical_number(v) if isinstance(v, float) else v: v for v in reversed(values)}
    return tuple(sorted(keyed.values(), key=as_number))


def _study(paths: Sequence[Path], datasets: list[xr.Dataset], grid: Grid, asked: Request) -> Study:
    """A study whose result the merged archive is; with the figure of the first archive, if it fits."""
    titles = dict.fromkeys(str(dataset.attrs["title"]) for dataset in datasets)
    rtol = max(float(dataset.attrs["rtol"]) for dataset in datasets)
    figure = None
    if "figure" in datasets[0].attrs:
        layout = read_figure(datasets[0].attrs["figure"], [str(name) for name in datasets[0].data_vars])
        if {name for _, name in layout.roles()} - {*QUANTITY_AXES} == set(grid.dims):
            figure = layout
    text = to_toml(" + ".join(titles), rtol, grid, figure, asked)
    try:
        return Study.from_text(text, "the merged study")
    except ValueError as error:
        raise ArchiveError(f"{_names(paths)}: these archives do not make one study:\n{error}") from None
