"""Event-aligned instants: where the stress at x has a kink or a square-root cusp in time.

At a fixed x that happens when the contact edge passes (δ = g(x)) and when the slip front does (the spring at
x goes from stick to slip). Together with the turning instants of the load they cut the cycle into
stretches in which the stress is smooth but for square roots at the ends; cosine-spaced nodes resolve those.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import filled_rows, gather, packed
from swtstudy.mechanics.points import FloatArray

T = TypeVar("T", bound=np.generic)

#: Stretches shorter than this, in rad of the cycle, count as none; nearer than this, two of them meet.
NO_STRETCH, GAP = 1e-12, 1e-10


def stretches(cycle: Cycle, coordinate: FloatArray) -> FloatArray:
    """Ends of the smooth stretches of every interval, for some springs.

    Parameters
    ----------
    cycle
        n cycles of i intervals.
    coordinate
        Shape (n, X): G of the springs, those at r = |x|.

    Returns
    -------
    Shape (n, X, i, 4), ascending: begin of the interval, passage of the slip front and of the contact edge,
    end. What does not happen in an interval coincides with its begin or end.
    """
    begin, end = cycle.begin[:, None], cycle.end[:, None]
    edge = cycle.load.passage(coordinate, cycle.begin, cycle.end)
    front = _front_passes(cycle, coordinate)
    first, second = np.minimum(front, edge), np.maximum(front, edge)
    shape = edge.shape
    return np.stack([np.broadcast_to(begin, shape), first, second, np.broadcast_to(end, shape)], axis=-1)


@dataclass(frozen=True)
class Nodes:
    """Instants at n × X positions, T each.

    Where no event cuts an interval, all positions have the same instants: they are listed once.

    Attributes
    ----------
    interval, instant
        Shape (n, k): the distinct instants φ, and their intervals of the cycle.
    index
        Shape (n, X, T): which of the k.
    """

    interval: NDArray[np.intp]
    instant: FloatArray
    index: NDArray[np.intp]

    def spread(self, values: NDArray[T]) -> NDArray[T]:
        """Values at the distinct instants, shape (n, k), at the instants of each position, (n, X, T)."""
        return values.ravel().take(np.arange(len(values))[:, None, None] * values.shape[1] + self.index)


def cosine_nodes(cycle: Cycle, ends: FloatArray, count: int) -> tuple[Nodes, NDArray[np.intp]]:
    """Cosine-spaced nodes on each stretch that is one, without repetitions where stretches meet.

    Parameters
    ----------
    cycle
        n cycles.
    ends
        Shape (n, X, i, 4), see `stretches`.
    count
        Number of steps of each stretch.

    Returns
    -------
    nodes, number
        The nodes; stretch · (count + 1) + place in the stretch, shape (n, X, T).
    """
    n, columns, intervals, _ = ends.shape
    low, high = (ends[..., side].reshape(n, columns, -1) for side in (slice(3), slice(1, 4)))
    real = high - low > NO_STRETCH
    keep = np.repeat(real[..., None], count + 1, axis=-1)
    keep[..., -1] &= ~_meets_next(low, high, real)
    keep = keep.reshape(n, columns, -1)
    (number,) = packed(keep, np.broadcast_to(np.arange(keep.shape[-1]), keep.shape))
    stretch, place = number // (count + 1), number % (count + 1)
    share = 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count)

    interval = np.repeat(np.arange(intervals), count + 1)
    begin, end = np.repeat(cycle.begin, count + 1, axis=1), np.repeat(cycle.end, count + 1, axis=1)
    common = begin + (end - begin) * np.tile(share, intervals)

    own_low, own_high = (gather(v, stretch).reshape(n, -1) for v in (low, high))
    place, of_interval = place.reshape(n, -1), stretch.reshape(n, -1) // 3
    index = of_interval * (count + 1) + place
    own = (own_low != gather(cycle.begin, of_interval)) | (own_high != gather(cycle.end, of_interval))
    index = np.where(own, common.shape[1] + np.cumsum(own, axis=1) - 1, index)
    # A row without instants of its own keeps one for the others' sake.
    own[:, 0] |= ~own.any(axis=1)
    own_interval, own_instant = (
        packed(own, of_interval),
        packed(own, own_low + (own_high - own_low) * share[place]),
    )
    nodes = Nodes(
        np.concatenate([np.broadcast_to(interval, common.shape), *own_interval], axis=1),
        np.concatenate([common, *own_instant], axis=1),
        index.reshape(number.shape),
    )
    return nodes, number


def _meets_next(low: FloatArray, high: FloatArray, real: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether the end of each stretch is the begin of the next one that has a length."""
    total = low.shape[-1]
    number = np.arange(total)
    following = np.minimum.accumulate(np.where(real, number, total)[..., ::-1], axis=-1)[..., ::-1]
    after = np.append(following[..., 1:], np.full((*low.shape[:-1], 1), total), axis=-1)
    return (after < total) & (gather(low, np.minimum(after, total - 1)) - high <= GAP)


def _front_passes(cycle: Cycle, coordinate: FloatArray) -> FloatArray:
    """Instant at which the spring at G starts to slip in each interval, else the end, shape (n, X, i)."""
    load, memory = cycle.load, cycle.memory
    high, at = cycle.end[:, None], coordinate[:, :, None]
    piece = np.maximum((memory.start[:, None] < at[..., None]).sum(axis=-1) - 1, 0)
    row = np.arange(len(coordinate))[:, None, None]
    pieces = memory.take((row, np.arange(piece.shape[2]), piece))
    held = held_offset(load, pieces, np.broadcast_to(at, piece.shape))
    in_contact = at < np.maximum(load.normal(cycle.begin), 0.0)[:, None]

    first = np.broadcast_to(high, held.shape).copy()
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        goal = sense * held - at
        hit, instant = _slip_line_passes(cycle, sense, goal, active[:, None] & in_contact)
        first[hit] = np.minimum(first[hit], instant)
    return first


def split_at_breakpoints(cycle: Cycle) -> tuple[Cycle, NDArray[np.intp]]:
    """The same cycle with its intervals cut where a slip front passes a breakpoint of the memory.

    The front changes its speed there, and with it the stress at every x outside of it.

    Returns
    -------
    The finer division, numbered anew, and the interval of the cycle that each of its intervals is a part of,
    shape (n, i).
    """
    memory = cycle.memory
    n = len(memory.start)
    rows, instants = [], []
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        goal = np.moveaxis(sense * memory.offset - memory.start, -1, 1)
        hit, instant = _slip_line_passes(cycle, sense, goal, np.broadcast_to(active[:, None], goal.shape))
        rows.append(hit[0])
        instants.append(instant)
    row, instant = np.concatenate(rows), np.concatenate(instants)
    cuts = filled_rows(row, instant, n, PERIOD)
    edges = np.sort(np.concatenate([np.zeros((n, 1)), cycle.end, cuts], axis=1), axis=1)
    middle = 0.5 * (edges[:, 1:] + edges[:, :-1])
    parent = (middle[:, :, None] >= cycle.end[:, None]).sum(axis=-1)
    parent = np.minimum(parent, cycle.end.shape[1] - 1)
    finer = cycle.take_intervals(np.arange(n), parent)
    number = np.broadcast_to(np.arange(parent.shape[1]), parent.shape)
    return replace(finer, begin=edges[:, :-1], end=edges[:, 1:], number=number), parent


def _slip_line_passes(
    cycle: Cycle, sense: float, goal: FloatArray, allowed: NDArray[np.bool_]
) -> tuple[tuple[NDArray[np.intp], ...], FloatArray]:
    """Where in (n, X, i), and when, the slip line sense·T − N rises through ``goal``."""
    load = cycle.load
    first, last = (
        sense * load.tangential(instant) - load.normal(instant) for instant in (cycle.begin, cycle.end)
    )
    hit = np.nonzero(allowed & (first[:, None] < goal) & (goal < last[:, None]))
    row, _, interval = hit
    low, high = cycle.begin[row, interval], cycle.end[row, interval]
    slipping = load.take(row)
    brackets = slipping.slip_line_brackets(sense, low, high)
    return hit, slipping.slip_line_instant(sense, goal[hit], brackets)
