"""The normal force as the diagram's coordinate: for a prescribed tangential force.

On every piece of the memory diagram do/dG = dT/dN, with N the normal force at the depth G over that at δ0
and T the tangential force over μ times that: integrating τ over the springs by parts gives T = ∫ o′ dN. So
the diagram of (N, T) is that of (δ, u) in another coordinate of the contact radius.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.indenter import TabulatedProfile, make_profile
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray


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


def unit_half_load(name: str | TabulatedProfile, shape: dict[str, FloatArray], count: int) -> FloatArray:
    """`Profile.half_load` of ``count`` profiles of a family at the depth δ0, shape (count,)."""
    profile = make_profile(name, shape, np.ones(count))
    return profile.half_load(profile.radius(np.ones(count)))


def profile_up_to_force(
    name: str | TabulatedProfile, shape: dict[str, FloatArray], largest_force: FloatArray
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
