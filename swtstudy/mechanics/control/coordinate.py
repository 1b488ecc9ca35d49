"""The diagram's coordinate: what the contact solution calls the contact radius.

The memory diagram lives in the coordinate of what is prescribed tangentially. The coordinate is 1 where the
contact has the reference depth δ0, and grows with the radius; only the stress asks for the radius itself.

For a prescribed tangential displacement it is the depth. For a prescribed force it is the normal force: on
every piece of the memory diagram do/dG = dT/dN, with N the normal force at the depth G over that at δ0 and T
the tangential force over μ times that, and integrating τ over the springs by parts gives T = ∫ o′ dN. So the
diagram of (N, T) is that of (δ, u) in another coordinate of the contact radius.

The displacement that goes with a line load is known but for a constant share of it. A strip of half-width ξ
moves by −(2/π) ln ξ for each unit of load per E*: over μ δ0 and μ P_0, P_0 being (π/4) E* δ0, that is −½ ln
ξ. Far away the body moves with the load, too, which adds nothing to the work along a loop.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.indenter.plane import PlaneProfile
from swtstudy.mechanics.indenter.profile_table import AnyProfile
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray, Rows, Shape


@dataclass(frozen=True)
class Coordinate(Rows, ABC):
    """The coordinate over n profiles.

    Attributes
    ----------
    profile
        n profiles of one family.
    """

    profile: Profile

    @abstractmethod
    def of(self, radius: FloatArray) -> FloatArray:
        """Coordinate of the contact radius ξ/a_H, shape (n, …)."""

    @abstractmethod
    def radius(self, coordinate: FloatArray) -> FloatArray:
        """Contact radius ξ/a_H: the inverse of `of`, shape (n, …)."""

    @abstractmethod
    def with_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`of` and the profile's `weighted_slope` in one."""


class DepthCoordinate(Coordinate):
    """The indentation depth G = g(ξ)/δ0, where displacements are prescribed."""

    def of(self, radius: FloatArray) -> FloatArray:
        return self.profile.depth(radius)

    def radius(self, coordinate: FloatArray) -> FloatArray:
        return self.profile.radius(coordinate)

    def with_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        return self.profile.depth_and_weighted_slope(radius)


@dataclass(frozen=True)
class ForceCoordinate(Coordinate):
    """The normal force N(ξ) over that at the depth δ0.

    Attributes
    ----------
    unit
        Shape (n,): half of the normal force at δ0 over E* δ0 a_H, see `unit_half_load`.
    """

    unit: FloatArray

    def of(self, radius: FloatArray) -> FloatArray:
        return self.profile.half_load(radius) / align(self.unit, radius)

    def radius(self, coordinate: FloatArray) -> FloatArray:
        return self.profile.radius_of_half_load(coordinate * align(self.unit, coordinate))

    def with_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        half_load, slope = self.profile.half_load_and_weighted_slope(radius)
        return half_load / align(self.unit, radius), slope


def unit_half_load(name: AnyProfile, shape: Shape, count: int) -> FloatArray:
    """`Profile.half_load` of ``count`` profiles of a family at the depth δ0, shape (count,)."""
    profile = make_profile(name, shape, np.ones(count))
    return profile.half_load(profile.radius(np.ones(count)))


def profile_up_to_force(
    name: AnyProfile, shape: Shape, largest_force: FloatArray
) -> tuple[Profile, FloatArray]:
    """n profiles of a family in contact up to a normal force over that at δ0, (n,), and its half at δ0."""
    unit = unit_half_load(name, shape, len(largest_force))
    profile = make_profile(name, shape, np.ones_like(unit))
    if profile.plane:
        # There the load itself stands in the place of the depth.
        return make_profile(name, shape, np.maximum(largest_force, 0.0)), unit
    # dN/dG grows with the contact radius, so that the force at δ0 grows at least like this.
    steepest = unit / profile.radius(np.ones_like(unit))
    wide = make_profile(name, shape, 1.0 + np.maximum(largest_force - 1.0, 0.0) * steepest)
    depth = wide.depth(wide.radius_of_half_load(np.maximum(largest_force, 0.0) * unit))
    return make_profile(name, shape, depth), unit


@dataclass(frozen=True)
class StripDisplacement(Rows):
    """∫ −½ ln ξ d(N/N_0) over n profiles: what in the plane stands beside the force as the other coordinate.

    Attributes
    ----------
    profile
        n profiles of one family.
    """

    profile: PlaneProfile

    def of(self, radius: FloatArray) -> FloatArray:
        """At half-widths ξ/a_H, shape (n, …)."""
        load = self.profile.depth(radius)
        logarithm = np.log(np.where(radius > 0.0, radius, 1.0))
        return 0.5 * (self.profile.depth_over_radius(radius) - load * logarithm)

    @staticmethod
    def compliance(radius: FloatArray) -> FloatArray:
        """Its derivative by N/N_0."""
        return -0.5 * np.log(radius)
