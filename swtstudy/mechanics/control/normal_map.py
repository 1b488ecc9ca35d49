"""The normal load in the diagram's coordinate, where it is prescribed in the other one.

The diagram's coordinate is that of the tangential control. A prescribed depth becomes the force N(δ), a
prescribed force the depth G(N): monotone functions of the indenter, from tables where its contact radius is
no formula. Where the bodies are apart, at negative values, any monotone continuation will do: the value
itself.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.control.coordinate import ForceCoordinate
from swtstudy.mechanics.indenter.base import Tables
from swtstudy.mechanics.numerics.arrays import SAME, align
from swtstudy.mechanics.numerics.chebyshev import EvenTable
from swtstudy.mechanics.numerics.roots import NEWTON_STEPS
from swtstudy.mechanics.points import FloatArray, IndexArray, Rows


class NormalMap(Rows, ABC):
    """Monotone functions of n indenters from the prescribed normal load to that of the diagram."""

    def value(self, load: FloatArray) -> FloatArray:
        """The diagram's normal load, shape (n, …)."""
        return np.where(load > 0.0, self._value(np.maximum(load, 0.0)), load)

    def inverse(self, value: FloatArray) -> FloatArray:
        """The prescribed normal load at which the diagram has the value, shape (n, …)."""
        return np.where(value > 0.0, self._inverse(np.maximum(value, 0.0)), value)

    def inverse_and_slope(self, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`inverse`, and the derivative of `value` there; where there is contact, to the digits of tables."""
        return self._inverse_and_slope(np.maximum(value, 0.0))

    def with_derivatives(self, load: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """`value` and two derivatives."""
        value, slope, bend = self._with_derivatives(np.maximum(load, 0.0))
        touches = load > 0.0
        return np.where(touches, value, load), np.where(touches, slope, 1.0), np.where(touches, bend, 0.0)

    def slope(self, load: FloatArray) -> FloatArray:
        """Derivative of `value`."""
        return self.with_derivatives(load)[1]

    @abstractmethod
    def _value(self, load: FloatArray) -> FloatArray:
        """`value` where there is contact."""

    @abstractmethod
    def _inverse(self, value: FloatArray) -> FloatArray:
        """`inverse` where there is contact."""

    @abstractmethod
    def _inverse_and_slope(self, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`inverse_and_slope` where there is contact."""

    @abstractmethod
    def _with_derivatives(self, load: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """`with_derivatives` where there is contact."""


@dataclass(frozen=True)
class ByRadius(NormalMap):
    """Both loads as functions of the contact radius.

    Attributes
    ----------
    force
        The n indenters, and their normal force over that at δ0.
    """

    force: ForceCoordinate

    def _with_derivatives(self, load: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        return self._derivatives(np.maximum(self._radius(load), SAME))

    def _slope_of_depth(self, radius: FloatArray, weighted_slope: FloatArray) -> FloatArray:
        """g′ at radii, nowhere 0, from the profile's `weighted_slope`."""
        b = align(self.force.profile.flat_radius, radius)
        rise = np.sqrt(np.maximum((radius - b) * (radius + b), SAME**2))
        return np.maximum(weighted_slope / rise, SAME)

    def _unit(self, like: FloatArray) -> FloatArray:
        return align(self.force.unit, like)

    @abstractmethod
    def _radius(self, load: FloatArray) -> FloatArray:
        """Contact radius at the prescribed load."""

    @abstractmethod
    def _derivatives(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The diagram's normal load at contact radii, and its derivatives by the prescribed one."""


class ForceOfDepth(ByRadius):
    """N(δ), for a tangential force with the depth prescribed: dN = ξ g′ dξ/unit, dδ = g′ dξ."""

    def _value(self, load: FloatArray) -> FloatArray:
        return self.force.of(self.force.profile.radius(load))

    def _inverse(self, value: FloatArray) -> FloatArray:
        return self.force.profile.depth(self.force.radius(value))

    def _inverse_and_slope(self, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        radius = self.force.radius(value)
        return self.force.profile.depth(radius), radius / self._unit(radius)

    def _radius(self, load: FloatArray) -> FloatArray:
        return self.force.profile.radius(load)

    def _derivatives(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        unit = self._unit(radius)
        value, weighted_slope = self.force.with_weighted_slope(radius)
        return value, radius / unit, 1.0 / (unit * self._slope_of_depth(radius, weighted_slope))


class DepthOfForce(ByRadius):
    """G(N), for a tangential displacement with the normal force prescribed."""

    def _value(self, load: FloatArray) -> FloatArray:
        return self.force.profile.depth(self.force.radius(load))

    def _inverse(self, value: FloatArray) -> FloatArray:
        return self.force.of(self.force.profile.radius(value))

    def _inverse_and_slope(self, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        radius = self.force.profile.radius(value)
        return self.force.of(radius), self._unit(radius) / np.maximum(radius, SAME)

    def _radius(self, load: FloatArray) -> FloatArray:
        return self.force.radius(load)

    def _derivatives(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        value, weighted_slope = self.force.profile.depth_and_weighted_slope(radius)
        slope = self._unit(radius) / radius
        bend = -(slope**2) / (radius * self._slope_of_depth(radius, weighted_slope))
        return value, slope, bend


#: Share of a cell next to no load at which derivatives are taken that have no bound there. 1e-5 or 0.1: no
#: change at 61 points of mixed control.
NEXT_TO_NONE = 1e-3

#: Values and two derivatives at abscissae (n, …).
Derivatives = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]


class RootTable:
    """Monotone functions y(x) over the root t of x = tᵖ, in which they are smooth also where contact is made.

    Parameters
    ----------
    of
        n functions.
    end
        Shape (n,): largest x.
    power
        p: 2 for a depth x, so that y is a force and begins like t³, 3 the other way round.
    cells
        Number of cells.
    """

    def __init__(self, of: Derivatives, end: FloatArray, power: int, cells: int) -> None:
        self._power = power
        last = _root(end, power)
        root = last[:, None] * np.linspace(0.0, 1.0, cells + 1)
        root[:, 0] = NEXT_TO_NONE * root[:, 1]
        x, first, second = self._load(root)
        value, slope, bend = of(x)
        slope, bend = slope * first, bend * first**2 + slope * second
        value[:, 0] = slope[:, 0] = 0.0
        if power == 2:
            bend[:, 0] = 0.0
        self._table = EvenTable(last, value, slope, bend)

    def value(self, row: IndexArray, x: FloatArray) -> FloatArray:
        """y of the functions number ``row``, shape (n, …)."""
        return self._table(row, _root(x, self._power))

    def with_slope(self, row: IndexArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """y and its derivative by x."""
        root = np.maximum(_root(x, self._power), SAME)
        value, slope = self._table.with_slope(row, root)
        return value, slope / (self._power * root ** (self._power - 1))

    def with_derivatives(self, row: IndexArray, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """y and two derivatives by x."""
        root = np.maximum(_root(x, self._power), SAME)
        value, slope, bend = self._table.with_derivatives(row, root)
        _, first, second = self._load(root)
        slope = slope / first
        return value, slope, (bend - slope * second) / (first * first)

    def _load(self, root: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """x at the root t, and two derivatives by t."""
        p = self._power
        return root**p, p * root ** (p - 1), p * (p - 1) * root ** (p - 2)


def _root(x: FloatArray, power: int) -> FloatArray:
    return np.sqrt(x) if power == 2 else np.cbrt(x)


@dataclass(frozen=True)
class TabledMap(NormalMap):
    """Functions of n indenters, of which some share a table.

    Attributes
    ----------
    row
        Shape (n,): the row of each one in the tables.
    forward, backward
        The functions and their inverses.
    """

    row: IndexArray
    forward: RootTable
    backward: RootTable

    @classmethod
    def of(cls, exact: ByRadius, tables: Tables) -> TabledMap:
        """Tables of exact maps, of indenters without a flat face."""
        profile, number = tables.profile, tables.number
        unit = exact.force.unit[np.unique(number, return_index=True)[1]]
        force = ForceCoordinate(profile, unit)
        largest_depth = profile.largest_depth[:, None]
        largest_force = force.of(profile.radius(largest_depth))
        depth, force_ = (largest_depth[:, 0], 2), (largest_force[:, 0], 3)
        one = type(exact)(force)
        given, found = (depth, force_) if isinstance(exact, ForceOfDepth) else (force_, depth)
        forward = RootTable(one.with_derivatives, *given, tables.cells)

        def inverse(value: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            row, load = np.arange(len(value))[:, None], one.inverse(value)
            for _ in range(NEWTON_STEPS):
                near, slope, bend = forward.with_derivatives(row, load)
                load = np.maximum(load - (near - value) / slope, 0.0)
            return load, 1.0 / slope, -bend / slope**3

        return cls(number, forward, RootTable(inverse, *found, tables.cells))

    def _value(self, load: FloatArray) -> FloatArray:
        return self.forward.value(align(self.row, load), load)

    def _inverse(self, value: FloatArray) -> FloatArray:
        row = align(self.row, value)
        load = self.backward.value(row, value)
        # To the last digit the inverse of the table, not of what it stands for.
        found, slope = self.forward.with_slope(row, load)
        step = np.divide(found - value, slope, out=np.zeros_like(load), where=slope > 0.0)
        return np.asarray(np.maximum(load - step, 0.0))

    def _inverse_and_slope(self, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        load, slope = self.backward.with_slope(align(self.row, value), value)
        return load, np.divide(1.0, slope, out=np.zeros_like(load), where=slope > 0.0)

    def _with_derivatives(self, load: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        return self.forward.with_derivatives(align(self.row, load), load)
