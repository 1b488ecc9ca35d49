"""The criteria of parameter points, by name."""

from __future__ import annotations

from collections.abc import Callable

from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.shear import FatemiSocie, Findley
from swtstudy.mechanics.planes.swt import Swt
from swtstudy.mechanics.points import Points


def _swt(points: Points) -> Criterion:
    return Swt.of(points.walker_exponent, 1.0 - points.poisson_ratio**2)


#: What makes the criterion of points, by its name.
CRITERIA: dict[str, Callable[[Points], Criterion]] = {
    Swt.name: _swt,
    FatemiSocie.name: lambda points: FatemiSocie(points.normal_sensitivity),
    Findley.name: lambda points: Findley(points.normal_sensitivity),
}


def criterion_of(points: Points) -> Criterion:
    """The criterion of n points, shape (n,)."""
    return CRITERIA[points.criterion](points)
