"""From parameter points to s."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from swtstudy.kernel.batch import solve_batch
from swtstudy.solver.points import Points, Solution


def solve_points(points: Points, rtol: float = 1e-4) -> Solution:
    """s of every point (eqs. 7–20).

    Parameters
    ----------
    points
        n points of one profile family and control.
    rtol
        Relative accuracy asked for.

    Returns
    -------
    Solution
        Arrays of shape (n,), NaN where the body slides away. The value of a point does not depend on the
        others.

    Raises
    ------
    ArithmeticError
        If a load cycle has more pieces than the solver has room for.
    """
    found = solve_batch(**arguments_of(points), rtol=rtol)
    names = "s", "s_error", "critical_x", "critical_angle", "s_surface"
    s, error, x, angle, surface = (found[name].copy() for name in names)
    return Solution(s, error, x, angle, found["regime"].astype(np.int8), surface)


def arguments_of(points: Points) -> dict[str, Any]:
    """Points as arguments of `swtstudy.kernel.batch.chunks`."""
    return {
        "profile": points.profile,
        "poisson_ratio": points.poisson_ratio,
        "friction": points.friction,
        "normal_amplitude": points.normal_amplitude,
        "tangential_amplitude": points.tangential_amplitude,
        "frequency_ratio": [Fraction(int(p), int(q)) for p, q in zip(points.p, points.q, strict=True)],
        "phase": points.phase,
        "loops": None if points.path is None else [points.path] * len(points),
        "shape": points.shape,
        "control": (points.control.normal_force, points.control.tangential_force),
        "bulk_amplitude": points.bulk_stress_amplitude,
        "bulk_mean": points.bulk_stress_mean,
        "bulk_phase": points.bulk_stress_phase,
        "pulled": points.bulk_strain_share,
        "criterion": points.criterion,
        "walker_exponent": points.walker_exponent,
        "normal_sensitivity": points.normal_sensitivity,
    }
