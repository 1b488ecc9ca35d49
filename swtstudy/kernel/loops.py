"""Loops of vertices and sums of harmonics, by NumPy alone: studies are checked without a compiler."""

from itertools import combinations

import numpy as np

#: Rounding of a corner's sine, in the sizes of its products: each has two differences and a product, 1.5 ε.
STRAIGHT = 4.0 * float(np.finfo(float).eps)
#: Instants to an oscillation between which the largest value of a sum of harmonics is looked for.
SAMPLES = 32


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
    count = int(SAMPLES * order.max())
    t = 2.0 * np.pi / count * np.arange(count)
    values = np.sin(np.outer(t, order) + phase) @ size
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
