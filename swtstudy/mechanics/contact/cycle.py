"""The stationary cycle of the contact: its intervals, the springs at any instant, and how it is found.

The memory diagram marches through two periods, of which the second one is stationary. Prescribed forces must
besides be in equilibrium: where that is lost, the body slides away or falls apart.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.contact.memory import GROWTH, GrowthTimes, Memory
from swtstudy.mechanics.contact.slip_front import Senses, SlipStates, slip_states, stick_coordinate
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.numerics.arrays import ROUNDING, packed
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray, Rows
from swtstudy.vocabulary.parameters import Control


@dataclass(frozen=True)
class Cycle(Rows):
    """The stationary cycle of n loads, cut into i intervals between turning instants.

    Within an interval the normal load and both slip lines are monotone, the front moves inwards only, and the
    memory inside of the front does not change.

    Attributes
    ----------
    load
        The n loads.
    begin, end
        Shape (n, i): first and last instants φ of the intervals, ascending from 0 to `PERIOD`.
    memory
        Pieces inside of the front, shape (n, i, d); during growth, with the growing piece.
    times
        When the memory's growths were.
    forward, backward
        Shape (n, i): whether T − N rises, so that springs slip at τ = +w, and whether T + N falls, so
        that they slip at τ = −w. With neither of them the contact sticks.
    gross_slip, lift_off
        Shape (n,): whether the whole contact slides, or is lost, somewhere in the cycle.
    """

    load: Load
    begin: FloatArray
    end: FloatArray
    memory: Memory
    times: GrowthTimes
    forward: BoolArray
    backward: BoolArray
    gross_slip: BoolArray
    lift_off: BoolArray

    def states(self, interval: IndexArray, instant: FloatArray) -> SlipStates:
        """Contact states at instants φ in intervals of the cycle, each of shape (n, …)."""
        return slip_states(self.load, self.memory, self.senses, self.times, interval, instant)

    @property
    def senses(self) -> Senses:
        """In which intervals springs may slip forward and backward."""
        return self.forward, self.backward

    def slips(self) -> BoolArray:
        """True where any spring slips somewhere in the cycle, shape (n,)."""
        interval = np.arange(self.begin.shape[1])
        middle = self.states(interval, 0.5 * (self.begin + self.end))
        slips = middle.front < (1.0 - ROUNDING) * middle.edge
        return np.asarray((slips & (self.end - self.begin > ROUNDING)).any(axis=1))

    def first_half(self) -> Cycle:
        """The intervals that begin in the first half of the common period, and empty ones."""
        return self.only(self.begin < 0.5 * PERIOD)

    def only(self, kept: BoolArray) -> Cycle:
        """The intervals that are ``kept``, (n, i), and empty ones."""
        (interval,) = packed(kept, np.broadcast_to(np.arange(kept.shape[1]), kept.shape))
        chosen = self.take_intervals(np.arange(len(kept)), interval)
        empty = np.arange(interval.shape[1]) >= kept.sum(axis=1, keepdims=True)
        return replace(chosen, end=np.where(empty, chosen.begin, chosen.end))

    def take_intervals(self, index: IndexArray, interval: IndexArray) -> Cycle:
        """The cycles at ``index``, of which only the intervals of shape (len(index), j) are kept."""
        at = index[:, None], interval
        return Cycle(
            self.load.take(index),
            self.begin[at],
            self.end[at],
            self.memory.take(at),
            self.times.take(index),
            self.forward[at],
            self.backward[at],
            self.gross_slip[index],
            self.lift_off[index],
        )


#: Room for pieces with which a march begins. Few stacks need more, however many intervals there are.
DEPTH = 32


@dataclass(frozen=True)
class _Course:
    """The load between its turning instants.

    Attributes
    ----------
    instant, edge, tangential
        Shape (n, i + 1): the ends of the intervals, and there the edge's coordinate and the tangential load.
    forward, backward, grows
        Shape (n, i): whether springs may slip forward or backward, and whether ground is gained in stick.
    branch
        Shape (n, i): the load's branch in which the interval lies.
    growth
        Shape (n, i): slope of what grows in stick: `GROWTH`, or that of a line.
    times
        When that is.
    """

    instant: FloatArray
    edge: FloatArray
    tangential: FloatArray
    forward: BoolArray
    backward: BoolArray
    grows: BoolArray
    branch: IntArray
    growth: FloatArray
    times: GrowthTimes


def solve_cycle(load: Load) -> Cycle:
    """March the memory diagram through the first period and record the second one.

    Parameters
    ----------
    load
        n loads, each started at φ = 0 from its normal load there and no tangential load.
    """
    course = _course(load)
    n, intervals = course.grows.shape
    most = 2 * intervals + 3
    depth = min(most, DEPTH)
    stack, record = Memory.empty(n, 1, depth), Memory.empty(n, intervals, depth)
    stack.start[course.edge[:, 0] > 0.0, 0, 0] = 0.0
    slips = np.any(course.forward | course.backward, axis=0)
    # Elsewhere what slips later wipes out how the tangential load came to be.
    at_rest = load.has_tangential & ~load.moves_tangentially & (load.largest_normal == load.least_normal)
    if at_rest.any():
        first = course.tangential[:, :1]
        senses = at_rest[:, None] & (first > 0.0), at_rest[:, None] & (first < 0.0)
        _slip(load, stack, senses, course.times, course.instant[:, :1])
    for period in range(2):
        for i in range(intervals):
            # An interval pushes two pieces at most.
            if depth < most and np.isfinite(stack.start[:, 0, depth - 2]).any():
                depth *= 2
                stack, record = stack.deeper(depth), record.deeper(depth)
            _grow(stack, course, i)
            if period == 1:
                record.write((slice(None), i), stack.take((slice(None), 0)))
            _lose_contact(stack, course, i)
            if slips[i]:
                senses = course.forward[:, i : i + 1], course.backward[:, i : i + 1]
                _slip(load, stack, senses, course.times, course.instant[:, i + 1 : i + 2])
    deepest = max(int(np.isfinite(record.start).sum(axis=-1).max()), 1)
    memory = record.take((slice(None), slice(None), slice(deepest)))
    return Cycle(
        load,
        course.instant[:, :-1],
        course.instant[:, 1:],
        memory,
        course.times,
        course.forward,
        course.backward,
        gross_slip=stick_coordinate(load) < 0.0,
        lift_off=load.least_normal < 0.0,
    )


def _course(load: Load) -> _Course:
    first, last = np.zeros((len(load), 1)), np.full((len(load), 1), PERIOD)
    instant = np.concatenate([first, load.turning_instants(), last], axis=1)
    middle = 0.5 * (instant[:, 1:] + instant[:, :-1])
    tangential_rate, normal_rate = load.tangential_rate(middle), load.normal_rate(middle)
    forward, backward = tangential_rate > normal_rate, tangential_rate < -normal_rate
    edge = _or_none(load.normal(instant))
    grows = ~forward & ~backward & (normal_rate > 0.0) & (np.diff(edge, axis=1) > ROUNDING)
    growth = np.full(grows.shape, GROWTH)
    if load.grows_in_lines:
        np.divide(tangential_rate, normal_rate, out=growth, where=grows)
    tangential, branch = load.tangential(instant), load.branch(middle)
    times = GrowthTimes.of(load, edge, branch, grows & (growth == GROWTH))
    return _Course(instant, edge, tangential, forward, backward, grows, branch, growth, times)


def _or_none(coordinate: FloatArray) -> FloatArray:
    # Next to a tip the ground within what rounding leaves of it would count.
    return np.where(coordinate > ROUNDING, coordinate, 0.0)


def _grow(stack: Memory, course: _Course, i: int) -> None:
    """Push a piece that remembers the tangential load at touch-down, where springs are gained in stick."""
    before, now, number = course.edge[:, i], course.edge[:, i + 1], np.full(len(course.grows), i)
    piece = Memory(before, course.tangential[:, i], course.growth[:, i], now, course.branch[:, i], number)
    _push(stack, course.grows[:, i], piece)


def _lose_contact(stack: Memory, course: _Course, i: int) -> None:
    stack.start[stack.start >= course.edge[:, i + 1, None, None]] = np.inf


def _slip(
    load: Load, stack: Memory, senses: tuple[BoolArray, BoolArray], times: GrowthTimes, instant: FloatArray
) -> None:
    """Push a piece along a slip line where springs slip up to an instant, (n, 1), in one of both senses."""
    row = np.zeros((len(load), 1), dtype=np.intp)
    states = slip_states(load, stack, senses, times, row, instant)
    edge, tangential, front, sign = (
        values[:, 0] for values in (states.edge, states.tangential, states.front, states.sign)
    )
    none = np.zeros(len(load)), row[:, 0], row[:, 0]
    front = _or_none(front)
    _push(stack, front < edge, Memory(front, tangential + sign * (front - edge), sign, *none))


def _push(stack: Memory, where: BoolArray, piece: Memory) -> None:
    """Pop what begins at or outside of the piece's start, then push the piece, in the rows ``where``."""
    row = np.flatnonzero(where)
    keep = stack.start[row, 0] < piece.start[row, None]
    stack.start[row, 0] = np.where(keep, stack.start[row, 0], np.inf)
    stack.write((row, 0, keep.sum(axis=1)), piece.take((row,)))


def out_of_equilibrium(load: Load, control: Control) -> BoolArray:
    """True where there is no equilibrium at some instant, so that there is no stationary cycle.

    A tangential force needs |T| ≤ N, and a normal force N ≥ 0, both beyond rounding. Bodies that never touch
    have none either.

    Parameters
    ----------
    load
        n loads in the coordinate of the memory diagram.
    control
        What of them is prescribed as a force.

    Returns
    -------
    Shape (n,).
    """
    least = -ROUNDING * load.largest_normal
    lost = load.largest_normal <= 0.0
    if control.normal_force:
        lost = lost | (load.least_normal < least)
    if control.tangential_force:
        instants = load.turning_instants()
        # The normal force has none where the bodies are apart.
        normal, tangential = np.maximum(load.normal(instants), 0.0), np.abs(load.tangential(instants))
        lost = lost | ((normal - tangential).min(axis=1) < least)
    return np.asarray(lost)
