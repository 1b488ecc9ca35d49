"""The slip front: where the stuck part of the memory meets the line of slip, and what it never reaches.

The permanent stick zone follows from the extremes of the slip lines alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.contact.memory import GROWTH, GrowthTimes, Memory
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import count_below
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray

#: In which intervals springs may slip forward (τ = +w) and backward (τ = −w), each of shape (n, i).
Senses = tuple[BoolArray, BoolArray]


@dataclass(frozen=True)
class SlipStates:
    """Contact states at instants, arrays of shape (n, …).

    Attributes
    ----------
    edge
        Coordinate of the contact edge: the normal load, 0 where the bodies are apart.
    tangential
        The tangential load.
    front
        Coordinate of the slip front, 0 ≤ front ≤ edge: from there outwards the springs slip.
    sign
        do/dG outside of the front: +1 for forward slip, −1 for backward slip.
    piece
        Number of the piece in which the front lies.
    """

    edge: FloatArray
    tangential: FloatArray
    front: FloatArray
    sign: FloatArray
    piece: IndexArray


def slip_states(
    load: Load, memory: Memory, senses: Senses, times: GrowthTimes, interval: IndexArray, instant: FloatArray
) -> SlipStates:
    """Where the springs slip at instants.

    Forward slip brings the spring at G to o = ℓ + G. Since h(G) = o(G) − G never rises, the front is
    where h = ℓ; backward slip is its mirror image, o → −o, T → −T.

    Parameters
    ----------
    load
        n loads.
    memory
        Pieces inside of the front, shape (n, i, d).
    senses
        Of shape (n, i).
    times
        When the memory's growths were.
    interval, instant
        Shape (n, …) or broadcast to it: instants φ and their intervals.
    """
    edge, tangential = np.maximum(load.normal(instant), 0.0), load.tangential(instant)
    n, intervals, _ = memory.start.shape
    place = np.arange(n).reshape((n,) + (1,) * (edge.ndim - 1)) * intervals + interval
    place = np.broadcast_to(place, edge.shape).ravel()
    front, sign, ground = edge.ravel().copy(), np.ones(edge.size), edge.ravel()
    # Where nothing slips the front is the edge, and during unloading that need not be in the last piece.
    piece = count_below(memory.start, place, ground) - 1
    for sense, where in zip((1.0, -1.0), senses, strict=True):
        active = np.flatnonzero(where.take(place))
        if not active.size:
            continue
        slip_line, of = sense * tangential.take(active) - ground[active], place[active]
        inside = count_below(memory.start - sense * memory.offset, of, -slip_line) - 1
        found = _front_in_piece(load, memory, sense, times, slip_line, of, inside)
        nearer = found < front[active]
        slips = active[nearer]
        front[slips], sign[slips], piece[slips] = np.maximum(found[nearer], 0.0), sense, inside[nearer]
    shape, piece = edge.shape, np.maximum(piece, 0)
    return SlipStates(edge, tangential, front.reshape(shape), sign.reshape(shape), piece.reshape(shape))


def _front_in_piece(
    load: Load,
    memory: Memory,
    sense: float,
    times: GrowthTimes,
    slip_line: FloatArray,
    place: IndexArray,
    piece: IndexArray,
) -> FloatArray:
    """Solve sense·o(G) − G = slip line in the given piece of the stacks ``place``; −inf where piece < 0."""
    last = memory.start.shape[-1] - 1
    known = np.maximum(piece, 0)
    at = place * (last + 1) + known
    start, offset, slope = (values.take(at) for values in (memory.start, memory.offset, memory.slope))
    grown = slope == GROWTH
    steep = 1.0 - sense * np.where(grown, 0.0, slope)
    fall = np.where(piece < 0, 0.0, sense * offset - start - slip_line)
    # On a line of the same sense h is constant: the front is at its end, in a tie that recurs every cycle.
    end = np.where(known == last, np.inf, memory.start.take(at + (known < last)))
    front = np.where(steep > 0.0, start + fall / np.where(steep > 0.0, steep, 1.0), end)
    if load.grows_in_lines:
        # A line may be nearly as steep as the slip line: rounding leads out of its piece.
        front = np.clip(front, start, end)
    grown = np.flatnonzero(grown & (piece >= 0))
    if grown.size:
        row = place[grown] // memory.start.shape[1]
        brackets = times.slip_line_brackets(sense, row, memory.growth.take(at[grown]))
        several = load.take(row)
        # The front is where the edge was when the slip line had this value.
        front[grown] = several.normal(several.slip_line_instant(sense, slip_line[grown], brackets))
    return np.where(piece < 0, -np.inf, front)


def stick_coordinate(load: Load) -> FloatArray:
    """Coordinate G = (min(T + N) − max(T − N))/2 up to which springs stick all through the stationary cycle.

    A spring at G can keep one offset if that fits into all of its bounds [T − N + G, T + N − G]. Negative
    if the whole contact slides, or is lost, once a cycle.

    Returns
    -------
    Shape (n,).
    """
    instants = load.turning_instants()
    normal, tangential = load.normal(instants), load.tangential(instants)
    return 0.5 * ((tangential + normal).min(axis=1) - (tangential - normal).max(axis=1))
