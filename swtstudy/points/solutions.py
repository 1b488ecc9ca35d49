"""Solutions of many points: without values, at selected points, concatenated."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import REGIMES, Solution


def blank(size: int) -> Solution:
    """A solution without values."""
    s, s_error, critical_x, critical_angle, s_surface = np.full((5, size), np.nan)
    regime = np.full(size, REGIMES.index("not_finite"), np.int8)
    return Solution(s, s_error, critical_x, critical_angle, regime, s_surface)


def solution_at(solution: Solution, rows: NDArray | slice) -> Solution:
    """The solution at the given rows."""
    return Solution(**{item.name: getattr(solution, item.name)[rows] for item in fields(Solution)})


def joined(solutions: list[Solution]) -> Solution:
    """Solutions concatenated to one."""
    names = [item.name for item in fields(Solution)]
    return Solution(**{name: np.concatenate([getattr(part, name) for part in solutions]) for name in names})
