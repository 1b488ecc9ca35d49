"""Cutting the missing points into chunks of whole blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import IntArray
from swtstudy.points.blocks import block_ends
from swtstudy.points.canonical import Table
from swtstudy.points.cost import weights
from swtstudy.points.unique import UniquePoints
from swtstudy.runner.chunk import ONLY_S, Asked, Chunk


def chunks(
    points: UniquePoints, wanted: NDArray[np.bool_], size: Callable[[], float], asked: Asked = ONLY_S
) -> Iterator[Chunk]:
    """Chunks of the wanted points of a table: whole blocks, with a weight of about `size()`.

    Parameters
    ----------
    points
        The points of the study.
    wanted
        Shape (len(points.table),): the points to be solved.
    size
        Called for every chunk, so that later chunks follow the timing of earlier ones.
    asked
        What is asked of the points.
    """
    weight = weights(points.table)
    blocks: list[IntArray] = []
    heaviness = 0
    for rows in _long_cycles_first(points.table, wanted, weight):
        for block in np.array_split(rows, -(-len(rows) // (asked.block or len(rows)))):
            block_weight = int(weight[block].sum())
            if blocks and heaviness + block_weight > size():
                yield Chunk.of(points, blocks, asked)
                blocks, heaviness = [], 0
            blocks.append(block)
            heaviness += block_weight
    if blocks:
        yield Chunk.of(points, blocks, asked)


def _long_cycles_first(table: Table, wanted: NDArray[np.bool_], weight: IntArray) -> list[IntArray]:
    """The wanted rows of each block that has some, long cycles first, and of these the largest blocks.

    So the last blocks let no worker wait, nor do the first ones, which are solved beside one another.
    """
    begin, found = 0, []
    for end in block_ends(table).tolist():
        rows = begin + np.flatnonzero(wanted[begin:end])
        begin = end
        if len(rows):
            found.append(rows)
    return sorted(found, key=lambda rows: (-int(weight[rows].max()), -len(rows)))
