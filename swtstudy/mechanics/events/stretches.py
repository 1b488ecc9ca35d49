"""The smooth stretches of the cycle at each position: what parts them, which of them meet, instants on them.

They are parted by passages: slip fronts pass springs, and breakpoints of the memory, at which the whole cycle
is cut. Instants on a stretch are spaced like cosines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import (
    ROUNDING,
    SAME,
    T,
    between,
    count_below,
    filled_rows,
    gather,
    layer_share,
    packed,
)
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows


def front_passes(cycle: Cycle, coordinate: FloatArray) -> FloatArray:
    """Instant at which the spring at G starts to slip in each interval, else the end, shape (n, X, i)."""
    load, memory, end = cycle.load, cycle.memory, cycle.end
    first = np.repeat(end[:, None], coordinate.shape[1], axis=1)
    may_slip = coordinate[:, :, None] < np.maximum(load.normal(cycle.begin), 0.0)[:, None]
    may_slip &= (cycle.forward | cycle.backward)[:, None]
    where = np.flatnonzero(may_slip)
    spring, interval = np.divmod(where, end.shape[1])
    row, at = spring // coordinate.shape[1], coordinate.ravel()[spring]
    piece = np.maximum(count_below(memory.start, row * end.shape[1] + interval, at) - 1, 0)
    held = held_offset(load.take(row), memory.take((row, interval, piece)), at)
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        some = np.flatnonzero(active[row, interval])
        goal = sense * held[some] - at[some]
        hit, instant = _slip_line_passes(cycle, sense, row[some], interval[some], goal)
        there = where[some[hit]]
        first.ravel()[there] = np.minimum(first.ravel()[there], instant)
    return first


def split_at_breakpoints(cycle: Cycle) -> Cycle:
    """The same cycle with its intervals cut where a slip front passes a breakpoint of the memory.

    The front changes its speed there, and with it the stress at every x outside of it.
    """
    memory = cycle.memory
    rows, instants = [], []
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        row, interval, piece = np.nonzero(active[:, :, None] & np.isfinite(memory.start))
        at = row, interval, piece
        goal = sense * memory.offset[at] - memory.start[at]
        hit, instant = _slip_line_passes(cycle, sense, row, interval, goal)
        rows.append(row[hit])
        instants.append(instant)
    row, instant = np.concatenate(rows), np.concatenate(instants)
    return split_at(cycle, filled_rows(row, instant, len(memory.start), PERIOD))


def split_at(cycle: Cycle, cuts: FloatArray) -> Cycle:
    """The same cycle with its intervals cut at more instants, (n, k)."""
    n = len(cuts)
    edges = np.sort(np.concatenate([np.zeros((n, 1)), cycle.end, cuts], axis=1), axis=1)
    middle = 0.5 * (edges[:, 1:] + edges[:, :-1])
    below = count_below(
        cycle.end, np.repeat(np.arange(n), middle.shape[1]), np.nextafter(middle.ravel(), np.inf)
    )
    parent = below.reshape(middle.shape)
    parent = np.minimum(parent, cycle.end.shape[1] - 1)
    finer = cycle.take_intervals(np.arange(n), parent)
    return replace(finer, begin=edges[:, :-1], end=edges[:, 1:])


def _slip_line_passes(
    cycle: Cycle, sense: float, row: IndexArray, interval: IndexArray, goal: FloatArray
) -> tuple[IndexArray, FloatArray]:
    """Which goals, shape (m,), the slip line sense·T − N rises through in their intervals, and when."""
    load = cycle.load
    first, last = (
        sense * load.tangential(instant) - load.normal(instant) for instant in (cycle.begin, cycle.end)
    )
    hit = np.flatnonzero((first[row, interval] < goal) & (goal < last[row, interval]))
    row, interval = row[hit], interval[hit]
    slipping = load.take(row)
    brackets = slipping.slip_line_brackets(sense, cycle.begin[row, interval], cycle.end[row, interval])
    return hit, slipping.slip_line_instant(sense, goal[hit], brackets)


#: Stretches of each interval: two events cut it.
PER_INTERVAL = 3


@dataclass(frozen=True)
class Stretches(Rows):
    """m stretches of the cycle at n × X positions, `PER_INTERVAL` of each interval, in the order of time.

    Attributes
    ----------
    low, high
        Shape (n, X, m): first and last instant φ; both are the same where an event does not happen.
    """

    low: FloatArray
    high: FloatArray

    @cached_property
    def real(self) -> BoolArray:
        """Shape (n, X, m): which have a length."""
        return np.asarray(self.high - self.low > ROUNDING)

    @cached_property
    def last_real(self) -> IndexArray:
        """Shape (n, X, m): the last one with a length up to each, −1 for none."""
        number = np.arange(self.low.shape[-1])
        return np.maximum.accumulate(np.where(self.real, number, -1), axis=-1)

    @cached_property
    def next_real(self) -> IndexArray:
        """Shape (n, X, m): the first one with a length from each on, m for none."""
        total = self.low.shape[-1]
        behind = np.where(self.real, np.arange(total), total)[..., ::-1]
        return np.minimum.accumulate(behind, axis=-1)[..., ::-1]


def stretches(cycle: Cycle, at: FloatArray) -> Stretches:
    """Each interval cut where the contact edge and the slip front pass a spring.

    Parameters
    ----------
    cycle
        n cycles of i intervals.
    at
        Shape (n, X): G of the springs, those at r = |x|.
    """
    edge = cycle.load.passage(at, cycle.begin, cycle.end)
    front = front_passes(cycle, at)
    begin, end = (np.broadcast_to(instant[:, None], edge.shape) for instant in (cycle.begin, cycle.end))
    ends = np.stack([begin, np.minimum(front, edge), np.maximum(front, edge), end], axis=-1)
    low, high = (ends[..., side].reshape(*at.shape, -1) for side in (slice(3), slice(1, 4)))
    return Stretches(low, high)


def split_at_layers(cycle: Cycle, at: FloatArray, thin: float) -> Cycle:
    """The same cycle with its intervals cut where thin layers of the `stretches` at one spring end.

    What happens in a short stretch makes a layer in a long one beside it, too.

    Parameters
    ----------
    cycle
        n cycles.
    at
        Shape (n,): G of the springs.
    thin
        Share of the angle of a stretch up to which a layer counts.
    """
    parts = stretches(cycle, at[:, None])
    row, number = np.nonzero(parts.real[:, 0])
    low, high = parts.low[row, 0, number], parts.high[row, 0, number]
    length = high - low
    first = np.append(True, np.diff(row) > 0)
    last = np.append(first[1:], True)
    before, after = np.roll(length, 1), np.roll(length, -1)
    # The cycle is closed.
    before[first], after[last] = length[last], length[first]
    begins, ends = (layer_share(near, length) < thin for near in (before, after))
    owner = np.append(row[begins], row[ends])
    if not owner.size:
        return cycle
    cuts = np.append((low + before)[begins], (high - after)[ends])
    return split_at(cycle, filled_rows(owner, cuts, len(at), PERIOD))


def meet(end: FloatArray, begin: FloatArray) -> BoolArray:
    """Return whether one stretch ends where another begins, in the periodic cycle."""
    gap = np.abs(begin - end)
    return np.asarray((gap <= SAME) | (PERIOD - gap <= SAME))


@dataclass(frozen=True)
class Nodes(Rows):
    """Instants at n × X positions, T each.

    Where no event cuts an interval, all positions have the same instants: they are listed once.

    Attributes
    ----------
    interval, instant
        Shape (n, k): the distinct instants φ, and their intervals of the cycle.
    index
        Shape (n, X, T): which of the k.
    """

    interval: IndexArray
    instant: FloatArray
    index: IndexArray

    def spread(self, values: NDArray[T]) -> NDArray[T]:
        """Values at the distinct instants, shape (n, k), at the instants of each position, (n, X, T)."""
        return values.ravel().take(self._flat)

    @cached_property
    def _flat(self) -> IndexArray:
        n, distinct = self.instant.shape
        return np.arange(n)[:, None, None] * distinct + self.index


@dataclass(frozen=True)
class Placed(Rows):
    """Where nodes lie, each of shape (n, X, T).

    Attributes
    ----------
    stretch
        Number of the stretch.
    place
        Number of the node in it, from 0 to the number of its steps.
    """

    stretch: IndexArray
    place: IndexArray

    @property
    def interval(self) -> IndexArray:
        """Number of the interval of the cycle."""
        return self.stretch // PER_INTERVAL


def cosine_nodes(cycle: Cycle, parts: Stretches, count: int) -> tuple[Nodes, Placed]:
    """Cosine-spaced nodes on each stretch with a length, without repetitions where stretches meet.

    Parameters
    ----------
    cycle
        n cycles.
    parts
        At n × X positions.
    count
        Number of steps of each stretch.
    """
    placed = _places(parts, count)
    angle = np.pi * np.arange(count + 1) / count
    common = between(cycle.begin[..., None], cycle.end[..., None], angle).reshape(len(cycle.begin), -1)
    n, shape = len(common), placed.stretch.shape
    low, high = (gather(side, placed.stretch).reshape(n, -1) for side in (parts.low, parts.high))
    interval, place = placed.interval.reshape(n, -1), placed.place.reshape(n, -1)
    own = (low != gather(cycle.begin, interval)) | (high != gather(cycle.end, interval))
    # The common instants of all intervals come first, then those of the positions.
    index = np.where(own, common.shape[1] + np.cumsum(own, axis=1) - 1, interval * (count + 1) + place)
    # A row without instants of its own keeps one for the others' sake.
    own[:, 0] |= ~own.any(axis=1)
    (own_interval,), (own_instant,) = packed(own, interval), packed(own, between(low, high, angle[place]))
    of_common = np.broadcast_to(np.repeat(np.arange(cycle.begin.shape[1]), count + 1), common.shape)
    nodes = Nodes(
        np.concatenate([of_common, own_interval], axis=1),
        np.concatenate([common, own_instant], axis=1),
        index.reshape(shape),
    )
    return nodes, placed


def _places(parts: Stretches, count: int) -> Placed:
    """All nodes of the stretches with a length, but for the last one of each that meets the next."""
    total = parts.low.shape[-1]
    after = np.append(parts.next_real[..., 1:], np.full((*parts.low.shape[:-1], 1), total), axis=-1)
    gap = gather(parts.low, np.minimum(after, total - 1)) - parts.high
    keep = np.repeat(parts.real[..., None], count + 1, axis=-1)
    keep[..., -1] &= ~((after < total) & (gap <= SAME))
    keep = keep.reshape(*parts.low.shape[:-1], -1)
    (number,) = packed(keep, np.broadcast_to(np.arange(keep.shape[-1]), keep.shape))
    return Placed(number // (count + 1), number % (count + 1))
