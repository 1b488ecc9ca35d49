"""The contact solution: the memory diagram of the MDR springs in the depth coordinate G = g(ξ)/δ0.

A spring at G carries the normal compression w = δ − G and the tangential force τ = u − o, |τ| ≤ w. Its
offset o(G, t) is the only memory: while in contact it is clipped to [ℓ + G, r − G] with ℓ = u − δ and
r = u + δ, and it starts with o = u at touch-down. Hence o(G) is made of few pieces: lines of slope ±1 left
by slip (o = ℓ + G, o = r − G), the curve o = u(touch-down of G) left by growth in stick, and o = 0 where
nothing ever slipped. They form a stack: slip pops pieces from the edge and pushes one, the loss of contact
pops. The solution does not depend on the profile.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.bimodal import Protocol, stick_depth, turning_instants
from swtstudy.mechanics.numerics.arrays import packed
from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import FloatArray

#: Value of `Memory.slope` that marks a piece left by growth in stick.
GROWTH = 2.0
#: Growth of the depth below which there is none, in δ0.
NO_GROWTH = 1e-12
#: No slip in shorter intervals, rad, nor with the slip front nearer to the edge, as a share of the depth.
NO_SLIP = 1e-13


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


@dataclass(frozen=True)
class SlipStates:
    """Contact states at instants, arrays of shape (n, …).

    Attributes
    ----------
    depth, displacement
        δ ≥ 0 and u.
    front, sign, piece
        See `slip_front`.
    """

    depth: FloatArray
    displacement: FloatArray
    front: FloatArray
    sign: FloatArray
    piece: NDArray[np.intp]


@dataclass(frozen=True)
class Cycle:
    """The stationary cycle of n protocols, cut into i intervals between turning instants.

    Within an interval δ, u − δ and u + δ are monotone, the slip front only moves inwards, and the memory
    inside of the front does not change.

    Attributes
    ----------
    protocol
        The n protocols.
    begin, end
        Shape (n, i): first and last instants of the intervals, φ in [0, 2π], ascending.
    number
        Shape (n, i): number of the interval in the division from which it was selected.
    memory
        Pieces inside of the front, shape (n, i, d); during growth, with the growing piece.
    forward, backward
        Shape (n, i): whether u − δ rises, so that springs slip at τ = +w, and whether u + δ falls, so
        that they slip at τ = −w. With neither of them the contact sticks.
    gross_slip, lift_off
        Shape (n,): whether the whole contact slides, or is lost, somewhere in the cycle.
    """

    protocol: Protocol
    begin: FloatArray
    end: FloatArray
    number: NDArray[np.intp]
    memory: Memory
    forward: NDArray[np.bool_]
    backward: NDArray[np.bool_]
    gross_slip: NDArray[np.bool_]
    lift_off: NDArray[np.bool_]

    def take(self, index: NDArray[np.intp]) -> Cycle:
        """The cycles at ``index``, repetitions allowed."""
        every = np.arange(self.begin.shape[1])
        return self.take_intervals(index, np.broadcast_to(every, (len(index), every.size)))

    def select(self, index: NDArray[np.intp], keep: NDArray[np.bool_]) -> Cycle:
        """The cycles at ``index`` with the intervals to keep, shape (len(index), i), and empty ones."""
        (interval,) = packed(keep, np.broadcast_to(np.arange(keep.shape[1]), keep.shape))
        chosen = self.take_intervals(index, interval)
        empty = np.arange(interval.shape[1]) >= keep.sum(axis=1, keepdims=True)
        return replace(chosen, end=np.where(empty, chosen.begin, chosen.end))

    def numbered(self, which: NDArray[np.bool_], count: int) -> NDArray[np.bool_]:
        """Some of the intervals, shape (n, i), by their numbers in a division of ``count``, (n, count)."""
        row, interval = np.nonzero(which)
        result = np.zeros((len(which), count), dtype=bool)
        result[row, self.number[row, interval]] = True
        return result

    def states(self, interval: NDArray[np.intp], instant: FloatArray) -> SlipStates:
        """Contact states at instants φ in intervals of the cycle, each of shape (n, …)."""
        depth = np.maximum(self.protocol.depth(instant), 0.0)
        u = self.protocol.displacement(instant)
        senses = self.forward, self.backward
        front, sign, piece = slip_front(self.protocol, self.memory, *senses, interval, depth, u)
        return SlipStates(depth, u, front, sign, piece)

    def slips(self) -> NDArray[np.bool_]:
        """Whether any spring slips somewhere in the cycle, shape (n,)."""
        interval = np.arange(self.begin.shape[1])
        middle = self.states(interval, 0.5 * (self.begin + self.end))
        slips = middle.front < (1.0 - NO_SLIP) * middle.depth
        return np.asarray((slips & (self.end - self.begin > NO_SLIP)).any(axis=1))

    def first_half(self) -> Cycle:
        """The intervals that begin in the first half of the common period, and empty ones."""
        return self.select(np.arange(len(self.begin)), self.begin < np.pi)

    def take_intervals(self, index: NDArray[np.intp], interval: NDArray[np.intp]) -> Cycle:
        """The cycles at ``index``, of which only the intervals of shape (len(index), j) are kept."""
        at = index[:, None], interval
        return Cycle(
            self.protocol.take(index),
            self.begin[at],
            self.end[at],
            self.number[at],
            self.memory.take(at),
            self.forward[at],
            self.backward[at],
            self.gross_slip[index],
            self.lift_off[index],
        )


def solve_cycle(protocol: Protocol) -> Cycle:
    """March the memory diagram through the first period and record the second one, which is stationary.

    Parameters
    ----------
    protocol
        The n load protocols (eqs. 7, 8), started at t = 0 from δ(0) and u = 0.
    """
    n = len(protocol)
    first, last = np.zeros((n, 1)), np.full((n, 1), 2.0 * np.pi)
    edges = np.concatenate([first, turning_instants(protocol), last], axis=1)
    middle = 0.5 * (edges[:, 1:] + edges[:, :-1])
    displacement_rate, depth_rate = protocol.displacement_rate(middle), protocol.depth_rate(middle)
    forward = displacement_rate > depth_rate
    backward = displacement_rate < -depth_rate
    growth = ~forward & ~backward & (depth_rate > 0.0)
    branch = 2.0 * np.pi * np.round((protocol.q * middle + protocol.phase[:, None]) / (2.0 * np.pi))
    depth, displacement = np.maximum(protocol.depth(edges), 0.0), protocol.displacement(edges)

    intervals = middle.shape[1]
    shape = (n, 1, 2 * intervals + 3)
    stack = Memory(np.full(shape, np.inf), *(np.zeros(shape) for _ in range(4)))
    stack.start[depth[:, 0] > 0.0, 0, 0] = 0.0
    record = Memory(*(np.empty((n, intervals, shape[2])) for _ in range(5)))
    only = np.zeros((n, 1), dtype=np.intp)
    flat = np.zeros(n)
    for period in range(2):
        for i in range(intervals):
            before, now, u = depth[:, i], depth[:, i + 1], displacement[:, i + 1]
            # Turning instants may come in pairs that differ by rounding: nothing grows in between.
            sticks = growth[:, i] & (now - before > NO_GROWTH)
            grown = np.full(n, GROWTH)
            _push(stack, sticks, Memory(before, displacement[:, i], grown, branch[:, i], now))
            if period == 1:
                for name in record.__dataclass_fields__:
                    getattr(record, name)[:, i] = getattr(stack, name)[:, 0]
            stack.start[stack.start >= now[:, None, None]] = np.inf
            senses = forward[:, i : i + 1], backward[:, i : i + 1]
            fronts, signs, _ = slip_front(protocol, stack, *senses, only, now[:, None], u[:, None])
            front, sign = fronts[:, 0], signs[:, 0]
            slips = front < now
            _push(stack, slips, Memory(front, u + sign * (front - now), sign, flat, flat))
    deepest = max(int(np.isfinite(record.start).sum(axis=-1).max()), 1)
    memory = record.take((slice(None), slice(None), slice(deepest)))
    gross_slip = stick_depth(protocol) < 0.0
    lift_off = protocol.normal_amplitude > 1.0
    number = np.broadcast_to(np.arange(intervals), (n, intervals))
    return Cycle(
        protocol, edges[:, :-1], edges[:, 1:], number, memory, forward, backward, gross_slip, lift_off
    )


def _push(stack: Memory, where: NDArray[np.bool_], piece: Memory) -> None:
    """Pop what begins at or outside of the piece's start, then push the piece, in the rows ``where``."""
    row = np.flatnonzero(where)
    keep = stack.start[row, 0] < piece.start[row, None]
    stack.start[row, 0] = np.where(keep, stack.start[row, 0], np.inf)
    place = keep.sum(axis=1)
    for name in stack.__dataclass_fields__:
        getattr(stack, name)[row, 0, place] = getattr(piece, name)[row]


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
