"""The normal load in the diagram's coordinate, where it is prescribed in the other one.

The diagram's coordinate is that of the tangential control. A prescribed depth becomes the force N(δ), a
prescribed force the depth G(N): monotone functions of the indenter. Where the bodies are apart, at negative
values, any monotone continuation will do: the value itself.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.control.force import ForceCoordinate
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: Least contact radius for which derivatives are computed: they have no bound at the tip. 1e-11: no change at
#: 144 points; 1e-4: 2e-13.
LEAST_RADIUS = 1e-8


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
        return self._derivatives(np.maximum(self._radius(load), LEAST_RADIUS))

    def _slope_of_depth(self, radius: FloatArray, weighted_slope: FloatArray) -> FloatArray:
        """g′ at radii, nowhere 0, from the profile's `weighted_slope`."""
        b = align(self.force.profile.flat_radius, radius)
        rise = np.sqrt(np.maximum((radius - b) * (radius + b), LEAST_RADIUS**2))
        return np.maximum(weighted_slope / rise, LEAST_RADIUS)

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
        return self.force.of(radius), self._unit(radius) / np.maximum(radius, LEAST_RADIUS)

    def _radius(self, load: FloatArray) -> FloatArray:
        return self.force.radius(load)

    def _derivatives(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        value, weighted_slope = self.force.profile.depth_and_weighted_slope(radius)
        slope = self._unit(radius) / radius
        bend = -(slope**2) / (radius * self._slope_of_depth(radius, weighted_slope))
        return value, slope, bend
