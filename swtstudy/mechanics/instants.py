"""Event-aligned instants: where the stress at x has a kink or a square-root cusp in time.

At a fixed x that happens when the contact edge passes (δ = g(x)) and when the slip front does (the spring at
x goes from stick to slip). Together with the turning instants of the protocol they cut the cycle into
stretches in which the stress is smooth but for square roots at the ends; cosine-spaced nodes resolve those.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import GROWTH, Cycle
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.protocol import filled_rows


def stretches(cycle: Cycle, depth: FloatArray) -> FloatArray:
    """Ends of the smooth stretches of every interval, for the springs at ``depth``.

    Parameters
    ----------
    cycle
        n cycles of i intervals.
    depth
        Shape (n, X): G = g(|x|)/δ0.

    Returns
    -------
    Shape (n, X, i, 4), ascending: begin of the interval, passage of the slip front and of the contact edge,
    end. What does not happen in an interval coincides with its begin or end.
    """
    begin, end = cycle.edges[:, None, :-1], cycle.edges[:, None, 1:]
    edge = _edge_passes(cycle, depth)
    front = _front_passes(cycle, depth)
    first, second = np.minimum(front, edge), np.maximum(front, edge)
    shape = edge.shape
    return np.stack([np.broadcast_to(begin, shape), first, second, np.broadcast_to(end, shape)], axis=-1)


def cosine_nodes(ends: FloatArray, count: int) -> tuple[NDArray[np.intp], FloatArray]:
    """Cosine-spaced nodes on each stretch.

    Parameters
    ----------
    ends
        Shape (n, X, i, 4), see `stretches`.
    count
        Number of steps of each stretch.

    Returns
    -------
    interval, instant
        Shape (1, 1, T) and (n, X, T), T = 3 i (count + 1).
    """
    share = 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count)
    low, high = ends[..., :-1, None], ends[..., 1:, None]
    instant = low + (high - low) * share
    intervals = ends.shape[2]
    interval = np.repeat(np.arange(intervals), 3 * (count + 1))
    return interval[None, None], instant.reshape(*ends.shape[:2], -1)


def _edge_passes(cycle: Cycle, depth: FloatArray) -> FloatArray:
    """Instant with δ = G in each interval, or its nearer end, shape (n, X, i)."""
    protocol = cycle.protocol
    low, high = cycle.edges[:, None, :-1], cycle.edges[:, None, 1:]
    middle = 0.5 * (low + high)
    rising = protocol.depth_rate(middle) > 0.0
    instant = protocol.touch_down(np.broadcast_to(depth[:, :, None], (*depth.shape, 1)), np.zeros(1))
    angle = protocol.q * instant + protocol.phase[:, None, None]
    angle = np.where(rising, angle, np.pi - angle)
    centre = protocol.q * middle + protocol.phase[:, None, None]
    angle = angle + 2.0 * np.pi * np.round((centre - angle) / (2.0 * np.pi))
    found = np.clip((angle - protocol.phase[:, None, None]) / protocol.q, low, high)
    # A spring that never touches or never lifts off has no such instant.
    beyond = np.abs(depth - 1.0) > protocol.normal_amplitude[:, None]
    return np.where(beyond[:, :, None], high, found)


def _front_passes(cycle: Cycle, depth: FloatArray) -> FloatArray:
    """Instant at which the spring at G starts to slip in each interval, else the end, shape (n, X, i)."""
    protocol, memory = cycle.protocol, cycle.memory
    n, columns = depth.shape
    low, high = cycle.edges[:, None, :-1], cycle.edges[:, None, 1:]
    at = depth[:, :, None]
    piece = np.maximum((memory.start[:, None] < at[..., None]).sum(axis=-1) - 1, 0)
    row = np.arange(n)[:, None, None]
    where = row, np.arange(piece.shape[2]), piece
    start, slope = memory.start[where], memory.slope[where]
    held = memory.offset[where] + np.where(slope == GROWTH, 0.0, slope) * (at - start)
    grown = slope == GROWTH
    if np.any(grown):
        deep = np.broadcast_to(at, grown.shape)
        held = np.where(grown, protocol.displacement(protocol.touch_down(deep, memory.branch[where])), held)
    in_contact = at < np.maximum(protocol.depth(cycle.edges), 0.0)[:, None, :-1]

    first = np.broadcast_to(high, held.shape).copy()
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        goal = sense * held - at
        hit, instant = _slip_line_passes(cycle, sense, goal, active[:, None] & in_contact)
        first[hit] = np.minimum(first[hit], instant)
    return first


def split_at_breakpoints(cycle: Cycle) -> Cycle:
    """The same cycle with its intervals cut where a slip front passes a breakpoint of the memory.

    The front changes its speed there, and with it the stress at every x outside of it.
    """
    memory = cycle.memory
    n, _, depth = memory.start.shape
    rows, instants = [], []
    for sense, active in ((1.0, cycle.forward), (-1.0, cycle.backward)):
        goal = np.moveaxis(sense * memory.offset - memory.start, -1, 1)
        hit, instant = _slip_line_passes(cycle, sense, goal, np.broadcast_to(active[:, None], goal.shape))
        rows.append(hit[0])
        instants.append(instant)
    row, instant = np.concatenate(rows), np.concatenate(instants)
    columns = filled_rows(row, instant, n, 2.0 * np.pi)
    edges = np.sort(np.concatenate([cycle.edges, columns], axis=1), axis=1)
    middle = 0.5 * (edges[:, 1:] + edges[:, :-1])
    parent = np.minimum((middle[:, :, None] >= cycle.edges[:, None, 1:]).sum(axis=-1), memory.start.shape[1] - 1)
    return cycle.with_edges(edges, parent)


def _slip_line_passes(
    cycle: Cycle, sense: float, goal: FloatArray, allowed: NDArray[np.bool_]
) -> tuple[tuple[NDArray[np.intp], ...], FloatArray]:
    """Where in (n, X, i), and when, the slip line sense·u − δ rises through ``goal``."""
    protocol = cycle.protocol
    line = sense * protocol.displacement(cycle.edges) - protocol.depth(cycle.edges)
    hit = np.nonzero(allowed & (line[:, None, :-1] < goal) & (goal < line[:, None, 1:]))
    row, _, interval = hit
    low, high = cycle.edges[row, interval], cycle.edges[row, interval + 1]
    return hit, protocol.take(row).slip_line_instant(sense, goal[hit], low, high)
