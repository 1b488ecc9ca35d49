"""Points that are solved in one call: blocks of a table of distinct points."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import IntArray
from swtstudy.points.canonical import LOAD_COLUMNS, SHARED_COLUMNS, Table
from swtstudy.points.cost import weights

#: Points in a block, times their weight: one or two seconds of work. In small blocks each point costs more:
#: with half of it, and of the solver's batches, a tenth at long cycles.
_BLOCK_SIZE = 1024
_SMALLEST_BLOCK = 4
#: Points that are worth more than one block: then there are as many for one of two workers as for the other.
_WORTH_SHARING = 64


def block_ends(table: Table) -> IntArray:
    """Ends of the blocks of a table; what is solved in one call does not depend on the run.

    The last bits of a value depend on what it is solved together with. Blocks that depend on the table
    alone make an interrupted run end with the very values of an undisturbed one.

    A block has one profile and one frequency ratio, and ends between two loads where it can: points with
    the same load share their contact solution.
    """
    load_end = _stretch_ends(table, ("profile", *LOAD_COLUMNS))
    load_begin = np.append(0, load_end)
    ends, begin = [], 0
    for end in _stretch_ends(table, SHARED_COLUMNS).tolist():
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


def _stretch_ends(table: Table, names: tuple[str, ...]) -> IntArray:
    columns = table[[*names]]
    return np.append(np.flatnonzero(columns[1:] != columns[:-1]) + 1, len(columns))
