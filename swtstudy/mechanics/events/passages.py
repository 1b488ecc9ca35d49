"""When slip fronts pass springs and breakpoints of the memory, and the cycle cut at the latter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import held_offset
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import filled_rows
from swtstudy.mechanics.points import FloatArray


def front_passes(cycle: Cycle, coordinate: FloatArray) -> FloatArray:
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
    rows, instants = [], []
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        goal = np.moveaxis(sense * memory.offset - memory.start, -1, 1)
        hit, instant = _slip_line_passes(cycle, sense, goal, np.broadcast_to(active[:, None], goal.shape))
        rows.append(hit[0])
        instants.append(instant)
    row, instant = np.concatenate(rows), np.concatenate(instants)
    return split_at(cycle, filled_rows(row, instant, len(memory.start), PERIOD))


def split_at(cycle: Cycle, cuts: FloatArray) -> tuple[Cycle, NDArray[np.intp]]:
    """The same cycle with its intervals cut at more instants, (n, k), and as `split_at_breakpoints`."""
    n = len(cuts)
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
