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
    own = {name: found[name].copy() for name in Solution._fields}
    return Solution(**own | {"regime": own["regime"].astype(np.int8)})


#: Arguments of the kernel that have the names of columns of points, and those that have others.
_SAME = (
    *("profile", "poisson_ratio", "friction", "normal_amplitude", "tangential_amplitude", "phase", "shape"),
    *("criterion", "walker_exponent", "normal_sensitivity"),
)
_RENAMED = {
    **{f"bulk_{word}": f"bulk_stress_{word}" for word in ("amplitude", "mean", "phase")},
    "pulled": "bulk_strain_share",
}


def arguments_of(points: Points) -> dict[str, Any]:
    """Points as arguments of `swtstudy.kernel.batch.chunks`."""
    names = {name: name for name in _SAME} | _RENAMED
    return {key: getattr(points, name) for key, name in names.items()} | {
        "frequency_ratio": [*map(Fraction, points.p.tolist(), points.q.tolist())],
        "loops": None if points.path is None else [points.path] * len(points),
        "control": (points.control.normal_force, points.control.tangential_force),
    }
