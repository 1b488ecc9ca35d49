"""When slip fronts pass springs and breakpoints of the memory, and the cycle cut at the latter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import count_below, filled_rows
from swtstudy.mechanics.points import FloatArray


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
    cycle: Cycle, sense: float, row: NDArray[np.intp], interval: NDArray[np.intp], goal: FloatArray
) -> tuple[NDArray[np.intp], FloatArray]:
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
