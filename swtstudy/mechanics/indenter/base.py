"""Base of all profiles: the MDR profile g, and the integrals of the surface stress over it.

Lengths are in a_H, which is √(R δ0) unless a family says otherwise, depths in δ0. A batch of n profiles of
one family is one object; its methods take arrays of shape (n, …).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray, IntArray
from swtstudy.mechanics.rows import Rows

#: Steps that invert the normal force fall back to bisection, so this many always suffice (10 do at 144
#: points); the last one, relative: its square is the error. 1e-4: 1e-4 at 42 of 144; 1e-11: 5e-11.
LARGEST_STEP_COUNT, LAST_STEP = 60, 1e-8


class Primitives(ABC):
    """Full-slip integrals at fixed positions r = |x|, shape (n, X), as functions of the radius.

    With m(ξ) = g′ √(ξ² − b²), ξ² = b² + (r² − b²) sin²α and v² = ξ² − r² both ends are regular.
    """

    @abstractmethod
    def inner(self, radius: FloatArray) -> FloatArray:
        """Integrals over the springs inside r up to ``radius``, shape (2, n, X, …).

        T1 = ∫ 2 (ξ/r) g′ dξ/√(r²−ξ²) and T3 = ∫ 2 (ξ/r)³ g′ dξ/√(r²−ξ²), ξ from b to min(radius, r):
        the in-plane stress by tangential load is made of them (theory of the surface stress).
        """

    @abstractmethod
    def outer(self, radius: FloatArray) -> FloatArray:
        """Integrals over the springs outside r up to ``radius``, shape (2, n, X, …).

        Π = ∫ g′ dξ/v (pressure, traction) and W = ∫ g′ dξ/(ξ+v) (the springs' part in the load inside r,
        over 2 r²), v = √(ξ²−r²), ξ from max(r, b) to radius; 0 where the radius is smaller.
        """

    def pressure(self, radius: FloatArray) -> FloatArray:
        """Π alone, the first of `outer`, shape (n, X, …)."""
        return np.asarray(self.outer(radius)[0])


@dataclass(frozen=True)
class Tables:
    """Layout of the tables of depths and forces of n profiles.

    Attributes
    ----------
    profile
        Those that differ.
    number
        Shape (n,): which of them each of the profiles is.
    cells
        Number of even cells up to the largest depth and force.
    """

    profile: Profile
    number: NDArray[np.intp]
    cells: int


class Profile(Rows, ABC):
    """n profiles of one family, in contact up to a depth.

    Parameters
    ----------
    largest_depth
        Shape (n,): largest indentation depth in δ0, up to which tables are made.
    """

    __match_args__ = ("largest_depth",)

    #: Whether the contact is a strip in plane strain, not a disc: what that changes is in
    #: `swtstudy.mechanics.indenter.plane`.
    plane: ClassVar[bool] = False
    #: Whether the stress has no bound at the edge r = b⁺ of a flat face.
    has_singular_edge: ClassVar[bool] = False
    #: Whether equal cells of ξ resolve g′ as well as others.
    evenly_smooth: ClassVar[bool] = True

    def __init__(self, largest_depth: FloatArray) -> None:
        self.largest_depth = largest_depth

    @classmethod
    def roughness(cls, largest_depth: FloatArray, **shape: FloatArray) -> IntArray:
        """Resolution that g′ needs, in whole steps: points that differ are not batched together."""
        return np.zeros(len(largest_depth), dtype=np.int64)

    @classmethod
    def resolved(
        cls, largest_depth: FloatArray, **shape: FloatArray
    ) -> tuple[dict[str, FloatArray], FloatArray]:
        """Shape parameters that can be resolved, and the relative error of s by what was left out, (n,)."""
        return shape, np.zeros(len(largest_depth))

    @classmethod
    def compact(cls, largest_depth: FloatArray | float, **shape: FloatArray) -> NDArray[np.bool_]:
        """True where the contact is a full disc up to ``largest_depth``, (n,) or one, for shapes (n,)."""
        return np.ones(np.broadcast_shapes(*map(np.shape, shape.values())), bool)

    @classmethod
    def too_small(cls, largest_depth: float, **shape: float) -> tuple[str, float] | None:
        """The shape parameter that is too small for a full disc up to a depth, and its least value."""
        return None

    @classmethod
    def check(cls, largest_depth: float, **shape: float) -> str | None:
        """Why the contact is not a full disc up to ``largest_depth``, or None."""
        limit = cls.too_small(largest_depth, **shape)
        if limit is None:
            return None
        name, least = limit
        others = ", ".join(f"{other} {value:g}" for other, value in shape.items() if other != name)
        return (
            f"{name} {shape[name]:g} is below {least:.4g}, the smallest for which the contact stays compact"
            f"{' at ' * bool(others)}{others} up to the {'load' if cls.plane else 'depth'} {largest_depth:g} "
            f"{'P0' if cls.plane else 'δ0'}"
        )

    @classmethod
    def length_law(cls, **shape: float) -> tuple[float, float]:
        """Coefficient c and power p in a_H = R (δ0/(c R))ᵖ, the contact radius at δ0 were there no shape."""
        return 1.0, 0.5

    @property
    def flat_radius(self) -> FloatArray:
        """Shape (n,): radius b inside of which g = 0."""
        return np.zeros(len(self.largest_depth))

    @property
    def tip(self) -> NDArray[np.bool_]:
        """Shape (n,): which have a tip, where g′ does not fall to 0, or slowly."""
        return np.zeros(len(self.largest_depth), dtype=bool)

    @property
    def singular_approach(self) -> FloatArray:
        """Shape (n, k): radii that lead up to a singularity of the stress or a tip, in ever smaller steps."""
        return np.zeros((len(self.largest_depth), 0))

    @property
    def landmarks(self) -> FloatArray:
        """Shape (n, k): radii near which g′ turns within a small part of the contact."""
        return np.zeros((len(self.largest_depth), 0))

    def tables(self) -> Tables | None:
        """Layout of the tables of depths against forces, None where formulas are as fast."""
        return None

    def extra_nodes(self, digits: float) -> int:
        """Chebyshev nodes that running integrals of g′ need beyond those of a smooth profile."""
        return 0

    @property
    def feature_length(self) -> FloatArray:
        """Shape (n,): length in a_H on which the profile repeats itself, inf for none."""
        return np.full(len(self.largest_depth), np.inf)

    @abstractmethod
    def depth(self, radius: FloatArray) -> FloatArray:
        """MDR profile g(ξ)/δ0 (eq. 11)."""

    @abstractmethod
    def radius(self, depth: FloatArray) -> FloatArray:
        """Contact radius ξ/a_H at the indentation depth: the inverse of `depth`, b at depth 0."""

    @abstractmethod
    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        """m(ξ) = g′(ξ) √(ξ² − b²), regular also where g′ is not."""

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`depth` and `weighted_slope` in one."""
        return self.depth(radius), self.weighted_slope(radius)

    def slope_integral(self, radius: FloatArray) -> FloatArray:
        """∫ g′ dξ from b to ``radius``, of the slope that `weighted_slope` has."""
        return self.depth(radius)

    @abstractmethod
    def half_load(self, radius: FloatArray) -> FloatArray:
        """∫ ξ g′ dξ from b to ``radius``: half of the normal force over E* δ0 a_H."""

    def half_load_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`half_load` and `weighted_slope` in one."""
        return self.half_load(radius), self.weighted_slope(radius)

    def radius_of_half_load(self, half_load: FloatArray) -> FloatArray:
        """Contact radius ξ/a_H at the half of a normal force: the inverse of `half_load`, b at no force."""
        b, goal = align(self.flat_radius, half_load), np.maximum(half_load, 0.0)
        # dH/dw = m in w = √(ξ² − b²), in which H is nearly a cubic power.
        w = self._rise_at_half_load(goal)
        low, high = np.zeros_like(w), np.full_like(w, np.inf)
        for _ in range(LARGEST_STEP_COUNT):
            radius = np.hypot(w, b)
            found, slope = self.half_load_and_weighted_slope(radius)
            low, high = np.where(found < goal, w, low), np.where(found < goal, high, w)
            ratio = np.cbrt(np.divide(goal, found, out=np.ones_like(w), where=found > 0.0))
            step = np.divide(
                3.0 * found * (ratio - 1.0), slope, out=np.full_like(w, np.inf), where=slope > 0.0
            )
            step = np.where(found == goal, 0.0, step)
            new = w + step
            middle = np.where(np.isfinite(high), 0.5 * (low + high), 2.0 * w)
            # A last step may lead out of the bracket by its rounding.
            inside = (new >= low) & (new <= high) | (np.abs(step) <= LAST_STEP * w)
            new = np.where(inside, new, middle)
            last, w = np.abs(new - w), new
            if np.all(last <= LAST_STEP * w):
                break
        return np.hypot(w, b)

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        """A first guess of w = √(ξ² − b²) at the half of a normal force."""
        return np.cbrt(2.0 * half_load)

    @abstractmethod
    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        """The full-slip integrals at r = ``position``, shape (n, X), to so many digits of the largest."""
