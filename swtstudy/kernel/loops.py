"""Loops of vertices, by NumPy alone: studies are checked without a compiler."""

from itertools import combinations

import numpy as np

#: Rounding of a corner's sine, in the sizes of its products: each has two differences and a product, 1.5 ε.
STRAIGHT = 4.0 * float(np.finfo(float).eps)


def without_collinear(loop):
    """A closed polygon (k, d) without repeated vertices and those on the straight line between neighbours."""
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
