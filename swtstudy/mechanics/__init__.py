"""The physics on plain arrays: NumPy and SciPy only, batch axes leading, no labels and no files."""

# STUB: a smooth stand-in for the solver until the mechanics are merged.

from __future__ import annotations

import time

import numpy as np

from swtstudy.mechanics.points import Points, Solution


def solve_points(points: Points, rtol: float) -> Solution:
    """Stand-in: smooth values with the right symmetry in the phase, about 1 ms a point."""
    time.sleep(1e-3 * len(points))
    s = 0.155 + 0.02 * points.normal_amplitude * np.cos(2 * points.p * points.phase)
    for shape in points.shape.values():
        s = s / (1 + shape)
    return Solution(
        s,
        rtol * s,
        np.sqrt(1 + points.normal_amplitude),
        5 + np.cos(points.phase),
        np.ones(len(points), np.int8),
    )
