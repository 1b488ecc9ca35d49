"""The objective that is minimised, a quantity of the solver's, and the box of parameters searched for it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import read_grid
from swtstudy.points.values import NUMERIC
from swtstudy.units.results import LIVES
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, nearest


@dataclass(frozen=True)
class Box:
    """Ranges of d parameters; the others are fixed. A point of it is a point of the unit cube.

    Attributes
    ----------
    corners
        The grid of the ends of all ranges; of real contacts of both bodies, too.
    names
        The parameters that are searched over.
    low, high
        Shape (d,): the ends of the ranges, in the order of the names.
    """

    corners: Grid
    names: tuple[str, ...]
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(cls, corners: Grid, over: Mapping[str, object]) -> Box:
        """That of a grid of the ends of ranges; a StudyError if one of them is the wrong way round."""
        low, high = np.array([corners.axes[name] for name in over], float).T
        names = [name for name, wrong in zip(over, low > high, strict=True) if wrong]
        if names:
            raise StudyError([Mistake(f"over.{n}", literal(over[n]), "the lower end first") for n in names])
        return cls(corners, tuple(over), low, high)

    def values(self, unit: FloatArray) -> FloatArray:
        """Values of the parameters at points of the unit cube, shape (n, d)."""
        # Not low + unit (high - low): rounding must not leave the range.
        return self.low * (1.0 - unit) + self.high * unit

    def sample(self, unit: FloatArray) -> Grid:
        """The grid whose sample is n points of the unit cube, shape (n, d)."""
        columns = zip(self.names, self.values(unit).T, strict=True)
        axes = {name: values for name, values in self.corners.axes.items() if name not in self.names}
        samples = {name: tuple(column.tolist()) for name, column in columns}
        return replace(self.corners, axes=axes, samples=samples)


def read_ranges(over: object, names: Collection[str]) -> tuple[dict[str, list[object] | None], Report]:
    """The ranges by name, ``(low, high)`` each, of parameters of some names, None for one that is none."""
    if not isinstance(over, Mapping) or not over:
        raise StudyError([Mistake("over", literal(over), 'ranges by name, such as {"phase": (0, "2*pi")}')])
    report = Report()
    axes: dict[str, list[object] | None] = {}
    for name, ends in over.items():
        key = f"over.{name}"
        if name not in names:
            report(key, "not a parameter that is a number", nearest(str(name), names))
            continue
        axes[name] = None
        if not isinstance(ends, list | tuple | np.ndarray) or np.shape(ends) != (2,):
            report(key, literal(ends), "both ends of a range, (low, high)")
        else:
            axes[name] = list(ends)
    return axes, report


def read_box(over: object, fixed: Mapping[str, object]) -> Box:
    """The box of ranges by name, ``(low, high)`` each, and of fixed values.

    Raises
    ------
    StudyError
        With every mistake.
    """
    axes, report = read_ranges(over, NUMERIC)
    corners, found = read_grid(fixed, axes, lambda name: f"over.{name}" if name in axes else name)
    if corners is None or report:
        raise StudyError([*report, *found])
    return Box.of(corners, over)  # type: ignore[arg-type]


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
