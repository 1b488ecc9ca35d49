"""Loops of vertices, sums of harmonics and their phases, by NumPy: studies are checked without a compiler."""

from itertools import combinations

import numpy as np

#: Rounding of a corner's sine, in the sizes of its products: each has two differences and a product, 1.5 ε.
STRAIGHT = 4.0 * float(np.finfo(float).eps)
#: Instants to an oscillation between which the largest value of a sum of harmonics is looked for.
SAMPLES = 32
#: Share of its amplitude by which a bulk stress may be off a multiple of the tangential load, to follow it
#: exactly, or nearly: s is then off by as large a share of what the moved stick zone adds to it.
EXACTLY, NEARLY = 1e-9, 0.05
#: Turns that a phase is off a multiple of its period by rounding.
WHOLE_TURNS = 1e-12


def without_collinear(loop):
    """A closed polygon (k, d) without repeated vertices or vertices on the line between neighbours."""
    moves = (loop != np.roll(loop, 1, axis=0)).any(axis=1)
    if not moves.any():
        return loop[:1]
    loop = loop[moves]
    before, after = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    straight = np.ones(len(loop), dtype=bool)
    for i, j in combinations(range(loop.shape[1]), 2):
        products = before[:, i] * after[:, j], before[:, j] * after[:, i]
        size = np.abs(products[0]) + np.abs(products[1])
        straight &= np.abs(products[0] - products[1]) <= STRAIGHT * size
    # A vertex at which the loop turns back stays.
    straight &= (before * after).sum(axis=1) > 0.0
    return loop[~straight]


def ends_of_sum(rows):
    """Smallest and largest value of Σ amplitude · sin(order · t + phase), of rows of these three."""
    rest = sum(size * np.sin(phase) for order, size, phase in rows if order == 0)
    moving = [row for row in rows if row[0] > 0 and row[1] != 0.0]
    if len(moving) < 2:
        swing = sum(abs(size) for _, size, _ in moving)
        return float(rest - swing), float(rest + swing)
    order, size, phase = np.array(moving, dtype=float).T
    t = even_instants(order.max())
    values = sum_at(moving, t)
    ends = []
    for best, least in ((values.argmin(), min), (values.argmax(), max)):
        at = t[best]
        for _ in range(6):  # Newton's method
            rate, bend = (
                order * size @ np.cos(order * at + phase),
                order**2 * size @ np.sin(order * at + phase),
            )
            at += rate / bend if bend else 0.0
        ends.append(float(rest + least(values[best], size @ np.sin(order * at + phase))))
    return ends[0], ends[1]


def even_instants(fastest):
    """Instants of a cycle, `SAMPLES` for each oscillation of its fastest harmonic."""
    count = int(SAMPLES * fastest)
    return 2.0 * np.pi / count * np.arange(count)


def sum_at(rows, t):
    """Σ amplitude · sin(order · t + phase), of rows of these three, at instants (k,)."""
    order, size, phase = np.array([*rows], dtype=float).reshape(-1, 3).T
    return np.sin(np.outer(t, order) + phase) @ size


def slope_of(tangential, bulk, nearly=NEARLY):
    """Factor with which a bulk stress follows the tangential load.

    Parameters
    ----------
    tangential, bulk
        Values over a cycle, shape (…, k).
    nearly
        Share of its amplitude by which the bulk stress may be off.

    Returns
    -------
    slope, exactly
        Shape (…): dB/dv, 0 where the bulk stress does not follow or does not move; and whether it follows
        exactly, not nearly.
    """
    across, along = (each - each.mean(axis=-1, keepdims=True) for each in (tangential, bulk))
    square = (across * across).sum(axis=-1)
    slope = np.divide((across * along).sum(axis=-1), square, out=np.zeros_like(square), where=square > 0.0)
    off, size = np.abs(along - slope[..., None] * across).max(axis=-1), np.abs(along).max(axis=-1)
    return np.where(off <= nearly * size, slope, 0.0), off <= EXACTLY * size


def fold_phase(phase, p, q):
    """Fold ψ into one symmetry period of s(ψ): 2π/p for even q, π/p for odd q.

    Shifting time by π/ω2 flips u and mirrors x.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    p, q
        Shape (n,), ω2/ω1 = p/q in lowest terms.

    Returns
    -------
    folded, mirrored
        The equivalent phase in [0, period), and whether x and the plane's angle change sign with it.
    """
    folded, is_odd = _folded(phase, np.where(q % 2 == 0, 2.0, 1.0) * np.pi / p)
    return folded, (q % 2 == 1) & is_odd


def fold_bulk_phase(phase, moves, mirrored, both_ways):
    """Fold ψ_B of bulk stresses that oscillate with the tangential load, once ψ is folded.

    Mirroring x leaves a bulk stress as it is, but the shift of time by π/ω2 that flips u flips its
    oscillation, too.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    moves
        Shape (n,): whether the bulk stress oscillates; elsewhere it has no phase.
    mirrored
        Shape (n,): where `fold_phase` mirrors x.
    both_ways
        Shape (n,): whether that shift of time leaves ψ as it is, so that ψ_B + π mirrors x.

    Returns
    -------
    folded, mirrored
        The equivalent ψ_B in [0, π) or [0, 2π), and whether x is mirrored by both folds together.
    """
    phase = phase + np.where(mirrored, np.pi, 0.0)
    folded, is_odd = _folded(phase, np.where(both_ways, 1.0, 2.0) * np.pi)
    return np.where(moves, folded, 0.0), mirrored ^ (moves & both_ways & is_odd)


def _folded(phase, period):
    """Phases in [0, period), and whether they were an odd number of periods away."""
    turns = np.floor(phase / period + WHOLE_TURNS)
    return np.maximum(phase - turns * period, 0.0), turns % 2 == 1
