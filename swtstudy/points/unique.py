"""The distinct canonical points behind a grid, and the way back.

Columns of the quantities that are asked of them are spread to all points of the grid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import ROW, Definitions, Table, canonical_cycles, group_rows
from swtstudy.points.grid import Grid
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray, IntArray
from swtstudy.vocabulary.quantities import (
    NONLOCAL,
    STICK_ENDS,
    Request,
    columns_in,
    columns_of,
    item_of,
    rows_of,
)

#: More grid points than this need more memory than most machines have (about 0.3 kB each).
LARGEST_GRID = 50_000_000

#: Grid points that are made canonical at once.
_SLAB = 100_000


@dataclass(frozen=True)
class UniquePoints:
    """The distinct canonical points behind a grid.

    Attributes
    ----------
    table
        Shape (m,) of `ROW`, in lexicographic order.
    index
        Shape (grid.size,): row of `table` for every grid point.
    mirrored
        Shape (grid.size,): True where x is mirrored with respect to that row.
    definitions
        What the user has defined, by its code.
    """

    table: Table
    index: IntArray
    mirrored: BoolArray
    definitions: Definitions


def unique_points(grid: Grid) -> UniquePoints:
    """The distinct canonical points of a grid.

    Raises
    ------
    ValueError
        If it has more than `LARGEST_GRID` points.
    """
    if grid.size > LARGEST_GRID:
        found = f"{grid.size} points are too many to compute, at most {LARGEST_GRID}"
        raise ValueError(f"{found}; swtstudy audit samples them")
    rows = np.empty(grid.size, ROW)
    mirrored = np.empty(grid.size, bool)
    # In slabs: the working memory for a point is several times that of its row.
    for start in range(0, grid.size, _SLAB):
        stop = min(start + _SLAB, grid.size)
        rows[start:stop], mirrored[start:stop] = grid.canonical(start, stop)
    first, index = group_rows(rows)
    return UniquePoints(rows[first], index, mirrored, grid.definitions)


def wanted(grid: Grid, asked: Request, points: UniquePoints) -> tuple[tuple[str, ...], BoolArray]:
    """Items that are asked of some points, and of which, shape (len(points.table), number of items)."""
    distances, at = grid.items(asked)
    of = np.zeros((len(points.table), len(asked.same) + len(distances)), bool)
    of[:, : len(asked.same)] = True
    for each in at:
        of[points.index, len(asked.same) + each] = True
    return (*asked.same, *distances), of


def kinds(
    some: BoolArray, items: tuple[str, ...], of: BoolArray
) -> Iterator[tuple[BoolArray, tuple[str, ...]]]:
    """Masks of those of some points of which the same items are wanted, and these; see `wanted`."""
    for one in np.unique(of[some], axis=0) if of.size else [of[0]] * bool(some.any()):
        yield some & (of == one).all(axis=1), tuple(np.array(items, object)[one])


def columns_at(
    grid: Grid, asked: Request, points: UniquePoints, known: Callable[[str], FloatArray]
) -> dict[str, FloatArray]:
    """Spread columns of distinct points to the points of a grid, each of shape (grid.size,).

    ``known`` gives a column of the distinct points by its name. Points that are mirrored have places with the
    other sign; what counts per load cycle is that of the common period of the point's own frequencies.
    """
    found = {name: known(name)[points.index] for name in columns_of(asked.same)}
    if per_cycle := _columns_per_cycle(asked):
        cycles = _canonical_cycles(grid)
        found |= {name: cycles * found[name] for name in per_cycle}
    _swap_ends(found, points.mirrored)
    items, at = grid.items(asked)
    for distance, each in zip(asked.distances, at, strict=True):
        found |= {name: np.full(grid.size, np.nan) for name in columns_of([item_of(distance)])}
        for name, column, rows, is_place in _columns(item_of(distance), items, each):
            found[name][rows] = _mirrored(known(column)[points.index[rows]], points, rows, is_place)
    return found


def columns_back(
    grid: Grid, asked: Request, points: UniquePoints, columns: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """The inverse of `columns_at`: what the distinct points have, each of shape (len(points.table),)."""
    size = len(points.table)
    found: dict[str, FloatArray] = {}
    columns = dict(columns)
    _swap_ends(columns, points.mirrored)

    def put(name: str, rows: IndexArray, values: FloatArray) -> None:
        found.setdefault(name, np.full(size, np.nan))[points.index[rows]] = values

    every = np.arange(grid.size)
    per_cycle = _columns_per_cycle(asked)
    cycles = _canonical_cycles(grid) if per_cycle else np.ones(1)
    for name in columns_of(asked.same):
        put(name, every, columns[name] / cycles if name in per_cycle else columns[name])
    items, at = grid.items(asked)
    for distance, each in zip(asked.distances, at, strict=True):
        for name, known, rows, is_place in _columns(item_of(distance), items, each):
            put(known, rows, _mirrored(columns[name][rows], points, rows, is_place))
    return found


def _swap_ends(columns: dict[str, FloatArray], mirrored: BoolArray) -> None:
    """Make the left end of the stick zone the right one at points that are mirrored, in place."""
    if {*STICK_ENDS} <= columns.keys():
        left, right = (columns[name] for name in STICK_ENDS)
        ends = np.where(mirrored, -right, left) + 0.0, np.where(mirrored, -left, right) + 0.0
        columns |= zip(STICK_ENDS, ends, strict=True)


def _columns_per_cycle(asked: Request) -> set[str]:
    """Columns whose values grow with the number of load cycles."""
    return {
        column
        for item in asked.same
        for row in rows_of(item)
        if row.per_cycle
        for variable in row.variables
        for column in columns_in(row, variable, item)
    }


def _canonical_cycles(grid: Grid) -> FloatArray:
    """`canonical_cycles` of all points of a grid, shape (grid.size,)."""
    found = np.empty(grid.size)
    for start in range(0, grid.size, _SLAB):
        stop = min(start + _SLAB, grid.size)
        found[start:stop] = canonical_cycles(grid.columns(start, stop))
    return found


def _mirrored(values: FloatArray, points: UniquePoints, rows: IndexArray, is_place: bool) -> FloatArray:
    """Values at some points; places of points that are mirrored have the other sign."""
    return np.where(points.mirrored[rows], -values, values) + 0.0 if is_place else values


def _columns(
    asked: str, items: tuple[str, ...], at: NDArray[np.int64]
) -> Iterator[tuple[str, str, IndexArray, bool]]:
    """The columns of an item as it is asked, of the item that it is at some points, these, and if a place."""
    for number in np.unique(at).tolist():
        rows = np.flatnonzero(at == number)
        for row in NONLOCAL.values():
            for variable in row.variables:
                pairs = zip(
                    columns_in(row, variable, asked), columns_in(row, variable, items[number]), strict=True
                )
                yield from ((name, known, rows, row.is_place) for name, known in pairs)
