"""The slip front: where the stuck part of the memory meets the line of slip."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.memory import GROWTH, Memory
from swtstudy.mechanics.load.bimodal import Protocol
from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import FloatArray


def slip_front(
    protocol: Protocol,
    memory: Memory,
    forward: NDArray[np.bool_],
    backward: NDArray[np.bool_],
    interval: NDArray[np.intp],
    depth: FloatArray,
    displacement: FloatArray,
) -> tuple[FloatArray, FloatArray, NDArray[np.intp]]:
    """Depth G of the slip front: from there outwards the springs slip.

    Forward slip brings the spring at G to o = ℓ + G. Since h(G) = o(G) − G never rises, the front is
    where h = ℓ; backward slip is its mirror image, o → −o, u → −u.

    Parameters
    ----------
    protocol
        n protocols.
    memory
        Pieces inside of the front, shape (n, i, d).
    forward, backward
        Shape (n, i): the senses in which springs may slip.
    interval
        Shape (n, …) or broadcast to it: the interval of each instant.
    depth, displacement
        Shape (n, …): δ ≥ 0 and u at the instants.

    Returns
    -------
    front, sign, piece
        Shape (n, …): the depth of the front, 0 ≤ front ≤ δ; do/dG outside of it, +1 for forward slip,
        −1 for backward slip; the number of the piece in which the front lies.
    """
    n, intervals, pieces = memory.start.shape
    place = np.arange(n).reshape((n,) + (1,) * (depth.ndim - 1)) * intervals + interval
    front, sign = depth, np.ones_like(depth)
    # Where nothing slips the front is the edge, and during unloading that need not be in the last piece.
    piece = (memory.start.reshape(-1, pieces).take(place, axis=0) < depth[..., None]).sum(axis=-1) - 1
    for sense, senses in ((1.0, forward), (-1.0, backward)):
        if not np.any(senses):
            continue
        active = np.broadcast_to(senses.take(place), depth.shape)
        target = sense * displacement - depth
        height = (sense * memory.offset - memory.start).reshape(-1, pieces).take(place, axis=0)
        inside = (height > target[..., None]).sum(axis=-1) - 1
        found = _front_in_piece(protocol, memory, sense, target, place, inside, active)
        nearer = active & (found < front)
        front, sign = np.where(nearer, np.maximum(found, 0.0), front), np.where(nearer, sense, sign)
        piece = np.where(nearer, inside, piece)
    return front, sign, np.maximum(piece, 0)


def _front_in_piece(
    protocol: Protocol,
    memory: Memory,
    sense: float,
    target: FloatArray,
    place: NDArray[np.intp],
    piece: NDArray[np.intp],
    active: NDArray[np.bool_],
) -> FloatArray:
    """Solve sense·o(G) − G = target in the given piece; −inf where piece < 0."""
    last = memory.start.shape[-1] - 1
    known = np.maximum(piece, 0)
    at = place * (last + 1) + known
    start, offset, slope = (values.take(at) for values in (memory.start, memory.offset, memory.slope))
    steep = 1.0 - sense * np.where(slope == GROWTH, 0.0, slope)
    fall = np.where(piece < 0, 0.0, sense * offset - start - target)
    # On a line of the same sense h is constant: the front is at its end, in a tie that recurs every cycle.
    end = np.where(known == last, np.inf, memory.start.take(at + (known < last)))
    front = np.where(steep > 0.0, start + fall / np.where(steep > 0.0, steep, 1.0), end)
    grown = active & (slope == GROWTH) & (piece >= 0)
    if np.any(grown):
        pieces = np.flatnonzero((memory.slope == GROWTH) & np.isfinite(memory.start))
        brackets = _growth_brackets(protocol, memory, sense, pieces)
        brackets = brackets.take(np.searchsorted(pieces, at[grown]))
        one = protocol.take(np.nonzero(grown)[0])
        front[grown] = one.depth(one.slip_line_instant(sense, target[grown], brackets))
    return np.where(piece < 0, -np.inf, front)


def _growth_brackets(protocol: Protocol, memory: Memory, sense: float, pieces: NDArray[np.intp]) -> Brackets:
    """Instants at which growths, pieces numbered along the flattened memory, began and ended."""
    one = protocol.take(pieces // (memory.slope.size // len(protocol)))
    branch = memory.branch.take(pieces)
    low, high = (one.touch_down(v.take(pieces), branch) for v in (memory.start, memory.stop))
    return one.slip_line_brackets(sense, low, high)
