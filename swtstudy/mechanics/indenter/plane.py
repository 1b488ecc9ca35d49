"""Plane contacts: what all strips have in common, and the cylinder.

Depth has no meaning in the plane. In its place stands the line load N(ξ) at the half-width ξ over N_0 = π/4,
the mean one in E* δ0: that is how δ0 is defined. With N′ in the place of g′ all that is written for discs
holds for strips, but for the kernels: there is one integral over the springs inside |x| and one over those
outside, and no load inside.
"""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.indenter.tables import InnerTable, OuterTable
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray

#: N_0: the mean line load over E* δ0.
MEAN_LOAD = 0.25 * np.pi


class PlanePrimitives(Primitives):
    """Full-slip integrals of strips at fixed positions |x|, shape (n, X), as functions of the half-width."""

    @abstractmethod
    def inner(self, radius: FloatArray) -> FloatArray:
        """A = ∫ 2 N′ dξ/√(x²−ξ²) over the springs inside |x| up to ``radius``, shape (1, n, X, …)."""

    def outer(self, radius: FloatArray) -> FloatArray:
        """`pressure`, shape (1, n, X, …)."""
        return self.pressure(radius)[None]

    @abstractmethod
    def pressure(self, radius: FloatArray) -> FloatArray:
        """B = ∫ N′ dξ/√(ξ²−x²) over the springs outside |x| up to ``radius``, shape (n, X, …)."""


class PlaneProfile(Profile):
    """n profiles of a plane contact: radii are half-widths, and the depth is N(ξ)/N_0."""

    plane = True

    def slope_integral(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * self.depth(radius)

    def half_load(self, radius: FloatArray) -> FloatArray:
        """Half of the line load N over E* δ0."""
        return 0.5 * MEAN_LOAD * self.depth(radius)

    def half_load_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth, slope = self.depth_and_weighted_slope(radius)
        return 0.5 * MEAN_LOAD * depth, slope

    def radius_of_half_load(self, half_load: FloatArray) -> FloatArray:
        return self.radius(half_load / (0.5 * MEAN_LOAD))

    @abstractmethod
    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        """∫ N/(N_0 ξ) dξ from b to ``radius``: what the approach of a strip is made of beside a logarithm."""


class CylinderPrimitives(PlanePrimitives):
    """Closed forms for N′ = πξ/2."""

    def __init__(self, position: FloatArray) -> None:
        self.position = position

    def inner(self, radius: FloatArray) -> FloatArray:
        x = align(self.position, radius)
        radius = np.minimum(radius, x)
        # x − √(x² − ξ²) without the difference of large numbers.
        return (np.pi * radius * radius / (x + np.sqrt((x - radius) * (x + radius))))[None]

    def pressure(self, radius: FloatArray) -> FloatArray:
        x = align(self.position, radius)
        radius = np.maximum(radius, x)
        return np.asarray(0.5 * np.pi * np.sqrt((radius - x) * (radius + x)))


class Cylinder(PlaneProfile):
    """n cylinders; they are all the same in a_H and δ0."""

    def depth(self, radius: FloatArray) -> FloatArray:
        return radius * radius

    def radius(self, depth: FloatArray) -> FloatArray:
        return np.sqrt(np.maximum(depth, 0.0))

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return 2.0 * MEAN_LOAD * radius * radius

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        return 0.5 * radius * radius

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return CylinderPrimitives(position)


class StripTablePrimitives(PlanePrimitives):
    """Primitives of a plane profile without a face from its N′ √ξ² alone; see `TablePrimitives`."""

    def __init__(self, profile: Profile, position: FloatArray, nodes: int, largest: FloatArray) -> None:
        self._inner = _StripTable(profile, position, nodes, largest)
        self._outer = OuterTable(profile, position, nodes, largest)

    def inner(self, radius: FloatArray) -> FloatArray:
        return self._inner(radius)

    def pressure(self, radius: FloatArray) -> FloatArray:
        return self._outer.pressure(radius)


class _StripTable(InnerTable):
    """A as a series, see `InnerTable`."""

    def densities(self, weight: FloatArray, radius2: FloatArray, position: FloatArray) -> FloatArray:
        return (weight * position[..., None] / np.sqrt(radius2))[None]
