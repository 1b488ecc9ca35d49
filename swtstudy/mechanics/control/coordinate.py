"""The diagram's coordinate: what the contact solution calls the contact radius.

The memory diagram lives in the coordinate of what is prescribed tangentially. The coordinate is 1 where the
contact has the reference depth δ0, and grows with the radius; only the stress asks for the radius itself.

For a prescribed tangential displacement it is the depth. For a prescribed force it is the normal force: on
every piece of the memory diagram do/dG = dT/dN, with N the normal force at the depth G over that at δ0 and T
the tangential force over μ times that, and integrating τ over the springs by parts gives T = ∫ o′ dN. So the
diagram of (N, T) is that of (δ, u) in another coordinate of the contact radius.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.indenter.profile_table import AnyProfile
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray, Rows, Shape
from swtstudy.vocabulary.parameters import Control


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


class DepthCoordinate(Coordinate):
    """The indentation depth G = g(ξ)/δ0, where displacements are prescribed."""

    def of(self, radius: FloatArray) -> FloatArray:
        return self.profile.depth(radius)

    def radius(self, coordinate: FloatArray) -> FloatArray:
        return self.profile.radius(coordinate)


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


def largest_depth(control: Control, name: AnyProfile, shape: Shape, largest_normal: FloatArray) -> FloatArray:
    """Largest indentation depth over δ0 at the largest normal load, as it is prescribed; shape (n,)."""
    if not control.normal_force:
        return largest_normal
    return profile_up_to_force(name, shape, largest_normal)[0].largest_depth
