"""Pieces of the memory diagram: the offset of the springs over the diagram's coordinate."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.bimodal import Protocol
from swtstudy.mechanics.points import FloatArray

#: Value of `Memory.slope` that marks a piece left by growth in stick.
GROWTH = 2.0


@dataclass(frozen=True)
class Memory:
    """Stacks of pieces of o(G), from the centre outwards, along the last axis d.

    Attributes
    ----------
    start
        Depth G at which the piece begins; +inf behind the last piece.
    offset
        o at the start.
    slope
        do/dG of the piece: −1, 0, +1 or `GROWTH`.
    branch, stop
        Of a growth: 2πk of its branch of δ (`Protocol.touch_down`) and the depth at which it ended.
    """

    start: FloatArray
    offset: FloatArray
    slope: FloatArray
    branch: FloatArray
    stop: FloatArray

    def take(self, index: tuple[NDArray[np.intp] | slice, ...]) -> Memory:
        """The stacks at ``index`` of the leading axes."""
        return Memory(*(getattr(self, field.name)[index] for field in fields(self)))


def held_offset(protocol: Protocol, pieces: Memory, depth: FloatArray) -> FloatArray:
    """o(G) of the springs at ``depth`` where they stick, each in its own piece.

    Parameters
    ----------
    protocol
        n protocols.
    pieces
        One piece for each spring, shape (n, …).
    depth
        Shape (n, …).
    """
    grown = pieces.slope == GROWTH
    distance = np.where(np.isfinite(pieces.start), depth - pieces.start, 0.0)
    held = pieces.offset + np.where(grown, 0.0, pieces.slope) * distance
    if np.any(grown):
        held = np.where(grown, protocol.displacement(protocol.touch_down(depth, pieces.branch)), held)
    return held
