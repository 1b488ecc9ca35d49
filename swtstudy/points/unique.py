"""The distinct canonical points behind a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import IntArray
from swtstudy.points.canonical import LOAD_COLUMNS, ROW, Table, group_rows
from swtstudy.points.codes import Definitions
from swtstudy.points.grid import Grid

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
        Shape (m,) of `ROW`, sorted by profile and frequency ratio, then by load.
    index
        Shape (grid.size,): row of `table` for every grid point.
    mirrored
        Shape (grid.size,): True where x is mirrored with respect to that row.
    definitions
        What the user has defined, by its code.
    """

    table: Table
    index: IntArray
    mirrored: NDArray[np.bool_]
    definitions: Definitions


def unique_points(grid: Grid) -> UniquePoints:
    """The distinct canonical points of a grid, in the order in which they are best computed.

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


def loads(table: Table) -> int:
    """Number of distinct loads, each of which needs one contact solution."""
    return len(group_rows(table[[*LOAD_COLUMNS]])[0])
