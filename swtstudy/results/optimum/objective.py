"""The objective that is minimised: a quantity of the solver's, over the unit cube."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.points.grid import SAMPLE
from swtstudy.results.optimum.box import Box
from swtstudy.units.variables import LIVES

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.points.grid import Grid

#: Values at n points of the unit cube, shape (n, d) to (n,); infinite where there is none.
Function = Callable[[FloatArray], FloatArray]


def worst(values: xr.DataArray) -> FloatArray:
    """Values of the points of a sample: of both bodies, and both directions, that which is worse."""
    others = [dim for dim in values.dims if dim != SAMPLE]
    return np.asarray((values.min(others) if values.name in LIVES else values.max(others)).values, float)


class Objective:
    """A quantity, or its negative, at points of a box; counts them, and keeps what it has found.

    Parameters
    ----------
    box
        The box.
    solve
        Results on a grid.
    quantity
        Name of the data variable.
    sign
        1 where its least value is wanted, -1 where the greatest is.
    """

    def __init__(self, box: Box, solve: Callable[[Grid], xr.Dataset], quantity: str, sign: int) -> None:
        self._box, self._solve, self._quantity, self.sign = box, solve, quantity, sign
        self.points = np.empty((0, len(box.names)))
        self.values = np.empty(0)

    def __call__(self, unit: FloatArray) -> FloatArray:
        """See `Function`."""
        found = worst(self._solve(self._box.sample(unit))[self._quantity])
        values = np.where(np.isfinite(found), self.sign * found, np.inf)
        self.points, self.values = np.concatenate([self.points, unit]), np.append(self.values, values)
        return values
