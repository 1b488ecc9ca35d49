"""The values of many canonical points, filled in as they are computed."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import REGIMES, IntArray, Solution


@dataclass(frozen=True)
class Values:
    """Arrays of a `Solution`, filled in place.

    Attributes
    ----------
    solution
        The arrays; NaN and "not_finite" where nothing has been computed.
    """

    solution: Solution

    @classmethod
    def empty(cls, size: int) -> Values:
        """Room for `size` points."""
        regime = np.full(size, REGIMES.index("not_finite"), np.int8)
        s, s_error, critical_x, critical_angle = np.full((4, size), np.nan)
        return cls(Solution(s, s_error, critical_x, critical_angle, regime))

    def put(self, where: NDArray, part: Solution) -> None:
        """Fill in the points `where` (indices)."""
        for item in fields(Solution):
            getattr(self.solution, item.name)[where] = getattr(part, item.name)

    def at(self, index: IntArray) -> Solution:
        """The solution at the points `index`, as copies."""
        return Solution(**{item.name: getattr(self.solution, item.name)[index] for item in fields(Solution)})
