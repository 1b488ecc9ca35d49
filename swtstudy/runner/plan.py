"""What has to be computed: the distinct points of a grid, in a good order, and cut into chunks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.canonical import COLUMNS, group_rows
from swtstudy.grid.grid import Grid
from swtstudy.mechanics.points import FloatArray, IntArray
from swtstudy.runner.chunk import Chunk

#: Columns that make the load; they follow the profile, so that points of one load are neighbours.
_LOAD = slice(1, COLUMNS.index("phase") + 1)


@dataclass(frozen=True)
class UniquePoints:
    """The distinct canonical points behind a grid.

    Attributes
    ----------
    table
        Shape (m, len(COLUMNS)), sorted by profile, then by load.
    index
        Shape (grid.size,): row of `table` for every grid point.
    mirrored
        Shape (grid.size,): True where x is mirrored with respect to that row.
    """

    table: FloatArray
    index: IntArray
    mirrored: NDArray[np.bool_]


def unique_points(grid: Grid) -> UniquePoints:
    """The distinct canonical points of a grid, in the order in which they are best computed."""
    rows, mirrored = grid.canonical()
    first, index = group_rows(rows)
    return UniquePoints(rows[first], index, mirrored)


def take(table: FloatArray, start: int, size: int) -> int:
    """End of the chunk of about `size` points that begins at `start`.

    A chunk has one profile, and ends between two loads where it can: points with the same load share
    their contact solution only within a chunk.
    """
    stop = min(start + size, len(table))
    other_profile = np.flatnonzero(table[start:stop, 0] != table[start, 0])
    if len(other_profile):
        return start + int(other_profile[0])
    if stop == len(table):
        return stop
    same_load = (table[start:stop, _LOAD] == table[stop, _LOAD]).all(axis=1)
    begins = stop - int(np.argmin(same_load[::-1])) if not same_load.all() else stop
    # Only a cut that keeps at least half of the wanted size is worth it.
    return begins if begins - start >= size / 2 else stop


def loads(table: FloatArray) -> int:
    """Number of distinct loads, each of which needs one contact solution."""
    return len(group_rows(table[:, _LOAD])[0])


def cut(table: FloatArray, begin: int, size: Callable[[], int]) -> Iterator[Chunk]:
    """Chunks of the rows of a table from `begin` on, each cut to `size()` points when it is asked for."""
    while begin < len(table):
        stop = take(table, begin, size())
        yield Chunk(begin, table[begin:stop])
        begin = stop
