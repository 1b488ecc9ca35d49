"""Columns of the quantities that are asked of the distinct points, spread to all points of the grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray
from swtstudy.points.grid import Grid
from swtstudy.points.unique import UniquePoints
from swtstudy.vocabulary.quantities import NONLOCAL, Request, columns_in, columns_of, item_of


def wanted(grid: Grid, asked: Request, points: UniquePoints) -> tuple[tuple[str, ...], NDArray[np.bool_]]:
    """Items that are asked of some points, and of which, shape (len(points.table), number of items)."""
    distances, at = grid.items(asked)
    of = np.zeros((len(points.table), len(asked.same) + len(distances)), bool)
    of[:, : len(asked.same)] = True
    for each in at:
        of[points.index, len(asked.same) + each] = True
    return (*asked.same, *distances), of


def columns_at(
    grid: Grid, asked: Request, points: UniquePoints, known: Callable[[str], FloatArray]
) -> dict[str, FloatArray]:
    """Spread columns of distinct points to the points of a grid, each of shape (grid.size,).

    ``known`` gives a column of the distinct points by its name. Points that are mirrored have places with the
    other sign.
    """
    found = {name: known(name)[points.index] for name in columns_of(asked.same)}
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

    def put(name: str, rows: NDArray[np.intp], values: FloatArray) -> None:
        found.setdefault(name, np.full(size, np.nan))[points.index[rows]] = values

    every = np.arange(grid.size)
    for name in columns_of(asked.same):
        put(name, every, columns[name])
    items, at = grid.items(asked)
    for distance, each in zip(asked.distances, at, strict=True):
        for name, known, rows, is_place in _columns(item_of(distance), items, each):
            put(known, rows, _mirrored(columns[name][rows], points, rows, is_place))
    return found


def _mirrored(values: FloatArray, points: UniquePoints, rows: NDArray[np.intp], is_place: bool) -> FloatArray:
    """Values at some points; places of points that are mirrored have the other sign."""
    return np.where(points.mirrored[rows], -values, values) + 0.0 if is_place else values


def _columns(
    asked: str, items: tuple[str, ...], at: NDArray[np.int64]
) -> Iterator[tuple[str, str, NDArray[np.intp], bool]]:
    """The columns of an item as it is asked, of the item that it is at some points, these, and if a place."""
    for number in np.unique(at).tolist():
        rows = np.flatnonzero(at == number)
        for row in NONLOCAL.values():
            for variable in row.variables:
                pairs = zip(
                    columns_in(row, variable, asked), columns_in(row, variable, items[number]), strict=True
                )
                yield from ((name, known, rows, row.is_place) for name, known in pairs)
