"""The diagram's coordinate: what the contact solution calls the contact radius.

The memory diagram lives in the coordinate of what is prescribed tangentially. The coordinate is 1 where the
contact has the reference depth δ0, and grows with the radius; only the stress asks for the radius itself.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows


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
