"""Several archives as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.archive import build, history_line, open_results
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.recall import found_in, grid_of, request_of
from swtstudy.points.chunk import Found, join, look_up, matching
from swtstudy.points.grid import Distinct, Grid, Table, canonical_number, group_rows
from swtstudy.points.values import Value, as_number
from swtstudy.study.definition import Study
from swtstudy.study.figure import read_figure
from swtstudy.study.units.reading import read_contact
from swtstudy.study.writing import to_toml
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import AXES, QUANTITY_AXES
from swtstudy.vocabulary.quantities import COMPUTED, CONTACT, MISSING, Request, error_of
from swtstudy.vocabulary.wording import line_words, unit_words

#: Relative difference of s from rounding alone, between two machines.
_ROUNDING = 1e-12


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
    ValueError
        If they come from different versions of the solver, prescribe forces in one and displacements in
        another, or have values of one point that differ by more than their estimated errors; or if points of
        the grid are in none of them and `sparse` is False.
    """
    datasets = [open_results(path) for path in paths]
    parts, grids = [found_in(dataset) for dataset in datasets], [grid_of(dataset) for dataset in datasets]
    known = join(parts)
    versions = {run.solver_version: p for p, part in zip(paths, parts, strict=True) for run in part.runs}
    controls = {grid.control.name: path for grid, path in zip(grids, paths, strict=True)}
    for what, where in (("solver versions", versions), ("prescribed loads", controls)):
        if len(where) > 1:
            words = ", ".join(f"{each} in {path}" for each, path in sorted(where.items()))
            raise ValueError(f"results of different {what} cannot be merged: {words}")
    _refuse_other_contacts(paths, datasets)
    grid, asked = _union(grids), _asked([request_of(dataset) for dataset in datasets])
    sources = [str(path) for path, part in zip(paths, parts, strict=True) for _ in range(len(part))]
    points, names = Distinct.of(grid, asked), ", ".join(map(str, paths))
    _refuse_conflicts(sources, known, grid, points)
    # A point that an archive calls missing is no gap.
    absent = look_up(points.rows, known, np.ones(len(known), bool)) < 0
    gaps = f"{int(absent[points.index].sum())} of {grid.size} points in none of them" if absent.any() else ""
    merged = matching(points, known, known["status"] != MISSING)
    lacks = merged.lacking(asked)
    if not sparse and (gaps or lacks.any()):
        words = f"the grid of all values in {names} has {gaps}"
        if not gaps:
            words = f"{' or '.join(asked.items)} is known of some points in {names}, but not of "
            words += f"{int(lacks.sum())} others"
        example = np.flatnonzero(absent if gaps else lacks)[:1]
        words += f", such as {_place_of(points.rows[example], grid, points)}"
        raise ValueError(f"{words}; --sparse (sparse=True in Python) leaves them missing")
    study = _study(names, datasets, grid, asked)
    made = f"merged from {', '.join([*(path.name for path in paths), *filter(None, [gaps])])}"
    history = [line for dataset in datasets for line in dataset.attrs["history"].splitlines()]
    lines = dict.fromkeys([history_line(made), *history])
    return build(study, points, merged, "\n".join(lines), 0.0)


def _asked(own: Sequence[Request]) -> Request:
    """The quantities of several requests, all together."""
    names = dict.fromkeys(name for each in own for name in each.names)
    distances = distinct([distance for each in own for distance in each.distances])
    is_axis = any(each.is_axis for each in own) or len(distances) > 1
    return Request(tuple(names), distances, is_axis, any(each.counts for each in own))  # type: ignore[arg-type]


def _place_of(row: Table, grid: Grid, points: Distinct) -> str:
    """The first place of a grid with a distinct point, (1,), in words: the values along all dimensions."""
    flat = np.flatnonzero(points.rows[points.index] == row)[0]
    at = dict(zip(grid.dims, np.unravel_index(flat, grid.shape), strict=True))
    words = []
    for name in (each for each in grid.names if grid.dimension(each)):
        value: Any = grid.values(name)[at[str(grid.dimension(name))]]
        unit = grid.row(name).units
        words.append(f"{name} = {line_words(name, value, {'units': unit})}{unit_words(unit)}")
    return ", ".join(words) or "the point"


def _refuse_conflicts(sources: Sequence[str], known: Found, grid: Grid, points: Distinct) -> None:
    """Refuse values of one point that differ by more than their estimated errors."""
    computed = np.flatnonzero(known["status"] == COMPUTED)
    for name in (each for each in known.arrays if error_of(each) in known.arrays):
        values, errors = known[name], known[error_of(name)]
        if values.ndim > 1:  # over critical distances, of which each archive may have others
            continue
        other = computed if name == "s" else computed[np.isfinite(values[computed])]  # others may be unknown
        first, group = group_rows(known["row"][other])
        one = other[first[group]]
        # Equal values do not conflict even where the error is not finite.
        equal = np.isclose(values[one], values[other], rtol=_ROUNDING, atol=0, equal_nan=True)
        with np.errstate(invalid="ignore"):
            near = np.abs(values[one] - values[other]) <= errors[one] + errors[other]
        apart = np.flatnonzero(~equal & ~near)
        if apart.size:
            a, b = (f"{values[rows[apart[0]]]:.8g} in {sources[rows[apart[0]]]}" for rows in (one, other))
            point = _place_of(known["row"][one[apart[:1]]], grid, points)
            of = "" if name == "s" else f" of {name}"
            more = f"; {apart.size - 1} more" if apart.size > 1 else ""
            raise ValueError(f"conflicting values{of} {a} and {b} at {point}{more}")


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
        raise ValueError(f"{words}: those in {paths[0]} and in {path}")


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
    # The mean load of a measured load is no value of its own.
    every = [name for name in AXES if any(name in grid.names for grid in grids) and name not in samples]
    values = {name: distinct([v for grid in grids for v in grid.values(name)]) for name in every}
    axes = dict.fromkeys(name for grid in grids for name in grid.axes)
    axes |= dict.fromkeys(name for name in every if len(values[name]) > 1)
    fixed = {name: values[name][0] for name in every if name not in axes and values[name]}
    return replace(grids[0], fixed=fixed, axes={name: values[name] for name in axes}, samples=samples)


def distinct(values: Sequence[Value]) -> tuple[Value, ...]:
    """Distinct values, numbers in increasing order."""
    if any(isinstance(value, str | Definition) for value in values):
        found = tuple(dict.fromkeys(values))
        names = [str(value) for value in found]
        if several := sorted({name for name in names if names.count(name) > 1}):
            raise ValueError(f"{', '.join(several)}: of this name each archive defines another one")
        return found
    keyed = {canonical_number(v) if isinstance(v, float) else v: v for v in reversed(values)}
    return tuple(sorted(keyed.values(), key=as_number))


def _study(names: str, datasets: list[xr.Dataset], grid: Grid, asked: Request) -> Study:
    """A study whose result the merged archive is; with the figure of the first archive, if all axes fit.

    An axis that is new takes a free role: the lines, or else the panels.
    """
    titles = dict.fromkeys(str(dataset.attrs["title"]) for dataset in datasets)
    rtol, figure = max(float(dataset.attrs["rtol"]) for dataset in datasets), None
    if "figure" in datasets[0].attrs:
        layout = read_figure(datasets[0].attrs["figure"], [str(name) for name in datasets[0].data_vars])
        roles = [name for _, name in layout.roles() if name not in QUANTITY_AXES]
        new = [dim for dim in grid.dims if dim not in roles]
        if {*roles} <= {*grid.dims} and len(new) <= len(layout.free):
            placed: dict[str, Any] = dict(zip(layout.free, new, strict=False))
            figure = replace(layout, **placed)
    try:
        return Study.from_text(to_toml(" + ".join(titles), rtol, grid, figure, asked), "the merged study")
    except ValueError as error:
        raise ArchiveError(f"{names}: these archives do not make one study:\n{error}") from None
