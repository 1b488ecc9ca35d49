"""The box of parameters that is searched, read from what a user wrote."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from swtstudy.grid.grid import Grid
from swtstudy.grid.reading import read_grid
from swtstudy.grid.values import NUMERIC
from swtstudy.mechanics.points import FloatArray
from swtstudy.mistakes import Mistake, StudyError, literal, nearest


@dataclass(frozen=True)
class Box:
    """Ranges of d parameters; the others are fixed. A point of it is a point of the unit cube.

    Attributes
    ----------
    corners
        The grid of the ends of all ranges.
    low, high
        Shape (d,): the ends of the ranges, in the order of the corners' axes.
    """

    corners: Grid
    low: FloatArray
    high: FloatArray

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that are searched over."""
        return tuple(self.corners.axes)

    def values(self, unit: FloatArray) -> FloatArray:
        """Values of the parameters at points of the unit cube, shape (n, d)."""
        # Not low + unit (high - low): rounding must not leave the range.
        return self.low * (1.0 - unit) + self.high * unit

    def sample(self, unit: FloatArray) -> Grid:
        """The grid whose sample is n points of the unit cube, shape (n, d)."""
        columns = zip(self.names, self.values(unit).T, strict=True)
        return Grid(self.corners.fixed, {}, {name: tuple(column.tolist()) for name, column in columns})


def read_box(over: object, fixed: Mapping[str, object]) -> Box:
    """The box of ranges by name, ``(low, high)`` each, and of fixed values.

    Raises
    ------
    StudyError
        With every mistake.
    """
    if not isinstance(over, Mapping) or not over:
        raise StudyError([Mistake("over", literal(over), 'ranges by name, such as {"phase": (0, "2*pi")}')])
    mistakes: list[Mistake] = []
    axes: dict[str, list[object] | None] = {}
    for name, ends in over.items():
        key = f"over.{name}"
        axes[name] = None
        if name not in NUMERIC:
            allowed = nearest(str(name), NUMERIC)
            mistakes.append(Mistake(key, "not a parameter that is a number", allowed))
        elif not isinstance(ends, list | tuple | np.ndarray) or np.shape(ends) != (2,):
            mistakes.append(Mistake(key, literal(ends), "both ends of a range, (low, high)"))
        else:
            axes[name] = list(ends)
    known = {name: ends for name, ends in axes.items() if name in NUMERIC}
    places = {name: f"over.{name}" for name in known}
    corners, found = read_grid(fixed, known, lambda name: places.get(name, name))
    if corners is None or mistakes:
        raise StudyError([*mistakes, *found])
    low, high = np.array(list(corners.axes.values()), float).T
    reversed_ = np.flatnonzero(low > high)
    if reversed_.size:
        names = [tuple(corners.axes)[i] for i in reversed_]
        raise StudyError([Mistake(places[n], literal(over[n]), "the lower end first") for n in names])
    return Box(corners, low, high)
