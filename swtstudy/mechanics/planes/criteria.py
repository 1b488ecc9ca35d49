"""The criterion of parameter points."""

from __future__ import annotations

from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.swt import Swt
from swtstudy.mechanics.points import Points


def criterion_of(points: Points) -> Criterion:
    """The criterion of n points, shape (n,)."""
    return Swt.of(points.walker_exponent, 1.0 - points.poisson_ratio**2)
