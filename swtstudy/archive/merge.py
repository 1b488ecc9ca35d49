"""Several archives as one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.archive import build, history_line, open_results
from swtstudy.archive.attributes import read_figure
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.recall import found_in, grid_of, request_of
from swtstudy.points.canonical import Definitions, Distinct, canonical_number, describe_point, group_rows
from swtstudy.points.found import Found, join, look_up, matching
from swtstudy.points.grid import Grid
from swtstudy.points.values import Value, as_number
from swtstudy.study.definition import Study
from swtstudy.study.writing import to_toml
from swtstudy.units.reading import read_contact
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import AXES, QUANTITY_AXES
from swtstudy.vocabulary.quantities import Request
from swtstudy.vocabulary.variables import COMPUTED, CONTACT, MISSING

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
    parts = [found_in(dataset) for dataset in datasets]
    known = join(parts)
    sources = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    runs = [(run, path) for path, part in zip(paths, parts, strict=True) for run in part.runs]
    _refuse_several("solver versions", {run.solver_version: path for run, path in reversed(runs)})
    _refuse_other_contacts(paths, datasets)
    grids = [grid_of(dataset) for dataset in datasets]
    controls = {grid.control.name: path for grid, path in zip(grids, paths, strict=True)}
    _refuse_several("prescribed loads", controls)
    grid, asked = _union(grids), _asked(datasets)
    _refuse_conflicts(paths, known, sources, grid.definitions)
    points = Distinct.of(grid, asked)
    # What an archive says is missing is no gap.
    absent = look_up(points.rows, known, np.ones(len(known), bool)) < 0
    made = f"merged from {', '.join(path.name for path in paths)}"
    if absent.any():
        gaps = f"{int(absent[points.index].sum())} of {grid.size} points"
        made += f", {gaps} in none of them"
    merged = matching(points, known, known["status"] != MISSING)
    lacks = merged.lacking(asked)
    if not sparse and (absent.any() or lacks.any()):
        example = describe_point(
            points.rows[np.flatnonzero(absent if absent.any() else lacks)[0]], points.definitions
        )
        words = (
            f"the grid of all values in {_names(paths)} has {gaps} in none of them"
            if absent.any()
            else (
                f"{' or '.join(asked.items)} is known of some points in {_names(paths)}, but not of "
                f"{int(lacks.sum())} others"
            )
        )
        raise GapsError(f"{words}, such as {example}; --sparse (sparse=True in Python) leaves them missing")
    study = _study(paths, datasets, grid, asked)
    history = [history_line(made)]
    history += [line for dataset in datasets for line in dataset.attrs["history"].splitlines()]
    return build(study, points, merged.take(slice(None)), "\n".join(dict.fromkeys(history)), 0.0)


def _asked(datasets: Sequence[xr.Dataset]) -> Request:
    """The quantities that the archives have, all together."""
    own = [request_of(dataset) for dataset in datasets]
    names = dict.fromkeys(name for each in own for name in each.names)
    keyed = {canonical_number(v): v for each in reversed(own) for v in reversed(each.distances)}
    is_axis = any(each.is_axis for each in own) or len(keyed) > 1
    distances = tuple(sorted(keyed.values()))
    return Request(tuple(names), distances, is_axis, any(each.counts for each in own))


def _names(paths: Sequence[Path]) -> str:
    return ", ".join(map(str, paths))


def _refuse_several(what: str, where: Mapping[str, Path]) -> None:
    """Refuse results with several of these, each of which is in one of the archives."""
    if len(where) > 1:
        words = ", ".join(f"{each} in {path}" for each, path in sorted(where.items()))
        raise ConflictError(f"results of different {what} cannot be merged: {words}")


def _refuse_conflicts(
    paths: Sequence[Path], known: Found, sources: NDArray[np.int64], definitions: Definitions
) -> None:
    """Refuse values of one point that differ by more than their estimated errors."""
    computed = np.flatnonzero(known["status"] == COMPUTED)
    first, group = group_rows(known["row"][computed])
    one, other, s = computed[first[group]], computed, known["s"]
    error = known["s_error"][one] + known["s_error"][other]
    # Equal values do not conflict even where the error is not finite.
    equal = np.isclose(s[one], s[other], rtol=_ROUNDING, atol=0, equal_nan=True)
    with np.errstate(invalid="ignore"):
        apart = np.flatnonzero(~equal & ~(np.abs(s[one] - s[other]) <= error))
    if apart.size:
        a, b = (f"{s[row[apart[0]]]:.8g} in {paths[sources[row[apart[0]]]]}" for row in (one, other))
        more = f"; {apart.size - 1} more" if apart.size > 1 else ""
        point = describe_point(known["row"][one[apart[0]]], definitions)
        raise ConflictError(f"conflicting values {a} and {b} at {point}{more}")


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
