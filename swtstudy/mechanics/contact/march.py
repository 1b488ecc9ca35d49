"""The march of the memory diagram through two periods: the second one is stationary."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, Memory
from swtstudy.mechanics.contact.slip_front import slip_front
from swtstudy.mechanics.contact.stick_depth import stick_depth
from swtstudy.mechanics.load.bimodal import Protocol, turning_instants

#: Growth of the depth below which there is none, in δ0.
NO_GROWTH = 1e-12


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
