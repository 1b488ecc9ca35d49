"""What has to be computed: the distinct points of a grid, in a good order, cut into blocks and chunks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.canonical import COLUMNS, group_rows
from swtstudy.grid.grid import Grid
from swtstudy.runner.chunk import Chunk

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray, IntArray

_P, _Q, _PHASE = (COLUMNS.index(name) for name in ("p", "q", "phase"))
#: Columns that the points of a block share: profile and frequency ratio.
_FAMILY = slice(0, _Q + 1)
#: Columns that make the load.
_LOAD = slice(1, _PHASE + 1)

#: Points in a block, times their weight: about a second of work. In small blocks each point costs more.
_BLOCK_SIZE = 512
_SMALLEST_BLOCK = 4
#: Points that are worth more than one block: then there are as many for one of two workers as for the other.
_WORTH_SHARING = 64

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
        Shape (m, len(COLUMNS)), sorted by profile and frequency ratio, then by load.
    index
        Shape (grid.size,): row of `table` for every grid point.
    mirrored
        Shape (grid.size,): True where x is mirrored with respect to that row.
    """

    table: FloatArray
    index: IntArray
    mirrored: NDArray[np.bool_]


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
    rows = np.empty((grid.size, len(COLUMNS)))
    mirrored = np.empty(grid.size, bool)
    # In slabs: the working memory for a point is several times that of its row.
    for start in range(0, grid.size, _SLAB):
        stop = min(start + _SLAB, grid.size)
        rows[start:stop], mirrored[start:stop] = grid.canonical(start, stop)
    first, index = group_rows(rows)
    return UniquePoints(rows[first], index, mirrored)


def weights(table: FloatArray) -> IntArray:
    """Rough relative cost of points: long cycles cost more."""
    return (table[:, _P] + table[:, _Q]).astype(np.int64)


def block_ends(table: FloatArray) -> IntArray:
    """Ends of the blocks of a table; what is solved in one call does not depend on the run.

    The last bits of a value depend on what it is solved together with. Blocks that depend on the table
    alone make an interrupted run end with the very values of an undisturbed one.

    A block has one profile and one frequency ratio, and ends between two loads where it can: points with
    the same load share their contact solution.
    """
    load_end = _stretch_ends(table[:, : _PHASE + 1])
    load_begin = np.append(0, load_end)
    ends, begin = [], 0
    for end in _stretch_ends(table[:, _FAMILY]).tolist():
        length = end - begin
        size = max(_BLOCK_SIZE // int(weights(table[begin:end]).max(initial=1)), _SMALLEST_BLOCK)
        share = 2 if length >= _WORTH_SHARING else 1
        count = max(share * -(-length // (share * size)), 1)
        cuts = begin + length * np.arange(1, count + 1) // count
        # Where the last load begins; but not at the cost of half a block.
        between = load_begin[np.searchsorted(load_end, cuts, "right")]
        ends.append(np.where(cuts - between <= length / count / 2.0, between, cuts))
        begin = end
    return np.concatenate(ends)


def _stretch_ends(columns: FloatArray) -> IntArray:
    changes = np.flatnonzero((columns[1:] != columns[:-1]).any(axis=1)) + 1
    return np.append(changes, len(columns))


def chunks(table: FloatArray, wanted: NDArray[np.bool_], size: Callable[[], float]) -> Iterator[Chunk]:
    """Chunks of the wanted points of a table: whole blocks, about `size()` in weight when cut.

    Parameters
    ----------
    table
        Canonical rows in the order of `unique_points`.
    wanted
        Shape (len(table),): the points to be solved.
    size
        Asked anew for every chunk.
    """
    weight = weights(table)
    blocks: list[IntArray] = []
    heaviness = 0
    begin = 0
    for end in block_ends(table).tolist():
        rows = begin + np.flatnonzero(wanted[begin:end])
        begin = end
        if not len(rows):
            continue
        block_weight = int(weight[rows].sum())
        if blocks and heaviness + block_weight > size():
            yield Chunk.of(table, blocks)
            blocks, heaviness = [], 0
        blocks.append(rows)
        heaviness += block_weight
    if blocks:
        yield Chunk.of(table, blocks)


def loads(table: FloatArray) -> int:
    """Number of distinct loads, each of which needs one contact solution."""
    return len(group_rows(table[:, _LOAD])[0])
