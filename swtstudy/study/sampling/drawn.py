"""Random points of a grid, of a size that no run could compute."""

from __future__ import annotations

import numpy as np

from swtstudy.points.canonical import Table, group_rows
from swtstudy.points.grid import Grid

#: The largest index that NumPy's random numbers can be.
LARGEST_SAMPLED = 2**63 - 1


def drawn_rows(grid: Grid, points: int, seed: int) -> Table:
    """Canonical rows of random points of a grid, without repetition, shape (n, columns).

    Raises
    ------
    ValueError
        If it has more than `LARGEST_SAMPLED` points.
    """
    if grid.size > LARGEST_SAMPLED:
        raise ValueError(f"{grid.size} points are too many to sample, at most {LARGEST_SAMPLED}")
    rng = np.random.default_rng(seed)
    # More than asked for: two points of the grid can be physically the same.
    many = 2 * points
    if grid.size <= 2 * many:
        index = rng.permutation(grid.size)
    else:
        _, first = np.unique(index := rng.integers(grid.size, size=many), return_index=True)
        index = index[np.sort(first)]
    rows = np.concatenate([grid.canonical(i, i + 1)[0] for i in map(int, index)])
    first, _ = group_rows(rows)
    return rows[np.sort(first)[:points]]
