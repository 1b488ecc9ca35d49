"""Base of all profiles: the MDR profile g, and the integrals of the surface stress over it.

Lengths are in a_H, which is √(R δ0) unless a family says otherwise, depths in δ0. A batch of n profiles of
one family is one object; its methods take arrays of shape (n, …). Integrals that have no closed form are
Chebyshev tables of their running integrals.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import SAME, TINY, align
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.points import BoolArray, FloatArray, Floats, IndexArray, IntArray, Rows, Shape


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
    number: IndexArray
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
    def resolved(cls, largest_depth: FloatArray, **shape: FloatArray) -> tuple[Shape, FloatArray]:
        """Shape parameters that can be resolved, and the relative error of s by what was left out, (n,)."""
        return shape, np.zeros(len(largest_depth))

    @classmethod
    def compact(cls, largest_depth: Floats, **shape: FloatArray) -> BoolArray:
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
    def singular_approach(self) -> FloatArray:
        """Shape (n, k): radii that lead up to a singularity of the stress, in ever smaller steps."""
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
        for _ in range(MOST_STEPS):
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
            inside = (new >= low) & (new <= high) | (np.abs(step) <= SAME * w)
            new = np.where(inside, new, middle)
            last, w = np.abs(new - w), new
            if np.all(last <= SAME * w):
                break
        return np.hypot(w, b)

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        """A first guess of w = √(ξ² − b²) at the half of a normal force."""
        return np.cbrt(2.0 * half_load)

    @abstractmethod
    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        """The full-slip integrals at r = ``position``, shape (n, X), to so many digits of the largest."""


class InnerTable:
    """T1 and T3 as series in α, ξ² = b² + (r² − b²) sin²α, up to the largest contact radius.

    Parameters
    ----------
    profile
        n profiles with b ≥ 0.
    position
        Shape (n, X), r = |x| > b; 0 results where r ≤ b.
    count
        Number of Chebyshev nodes.
    largest
        Shape (n,): largest contact radius.
    """

    def __init__(self, profile: Profile, position: FloatArray, count: int, largest: FloatArray) -> None:
        self.flat = profile.flat_radius[:, None]
        self.gap = np.maximum(position**2 - self.flat**2, 0.0)
        #: Largest α.
        self.span: Floats = 0.5 * np.pi
        outside = position > largest[:, None]
        if np.any(outside):
            share = (largest[:, None] ** 2 - self.flat**2) / np.maximum(self.gap, TINY)
            self.span = np.where(outside, np.arcsin(np.sqrt(np.minimum(share, 1.0))), self.span)[..., None]
        angle = 0.5 * self.span * (1.0 + chebyshev.nodes(count))
        radius2 = self.flat[..., None] ** 2 + self.gap[..., None] * np.sin(angle) ** 2
        weight = self.span * profile.weighted_slope(np.sqrt(radius2)) / position[..., None]
        weight = np.where(self.gap[..., None] > 0.0, weight, 0.0)
        self.integrals = chebyshev.RunningIntegrals(self.densities(weight, radius2, position))

    def densities(self, weight: FloatArray, radius2: FloatArray, position: FloatArray) -> FloatArray:
        """Integrand over α, from 2 m/r and the squares of the radii at the nodes."""
        return np.stack([weight, weight * radius2 / position[..., None] ** 2])

    def __call__(self, radius: FloatArray) -> FloatArray:
        gap, flat = align(self.gap, radius), align(self.flat, radius)
        share = np.maximum(radius * radius - flat * flat, 0.0) / np.maximum(gap, TINY)
        angle = np.arcsin(np.sqrt(np.minimum(share, 1.0)))
        if isinstance(self.span, float):
            y = angle * (4.0 / np.pi) - 1.0
        else:
            y = np.minimum(angle * (2.0 / align(self.span[..., 0], radius)), 2.0) - 1.0
        return self.integrals.up_to(y)


class OuterTable:
    """Π and W as series: in v = √(ξ² − r²), or, about a flat face, in ω with ε = √|r² − b²|.

    For r > b: v = ε sinh ω; for r < b: √(ξ² − b²) = ε sinh ω. Then dΠ = (m/ξ) dω, which takes the
    logarithmic singularity at r = b out of the integrand. Without a face W turns within v ~ r, so that it has
    fewer digits next to the axis, where swt is never largest.

    Parameters
    ----------
    profile
        n profiles.
    position
        Shape (n, X), r = |x|.
    count
        Number of Chebyshev nodes.
    largest
        Shape (n,): largest contact radius.
    """

    def __init__(self, profile: Profile, position: FloatArray, count: int, largest: FloatArray) -> None:
        flat = profile.flat_radius[:, None]
        self.has_face = bool(np.any(flat > 0.0))
        self.low2 = np.maximum(position, flat) ** 2
        self.position = position
        if self.has_face:
            distance = np.abs((position - flat) * (position + flat))
            self.scale = np.sqrt(np.maximum(distance, 1e-20 * largest[:, None] ** 2))
        else:
            self.scale = np.ones_like(position)
        self.span = np.maximum(self._abscissa(largest[:, None], self.low2, self.scale), TINY)
        node = self.span[..., None] * 0.5 * (1.0 + chebyshev.nodes(count))
        rise = self.scale[..., None] * np.sinh(node) if self.has_face else node
        radius = np.sqrt(self.low2[..., None] + rise * rise)
        r = position[..., None]
        v = np.sqrt(np.maximum((radius - r) * (radius + r), 0.0))
        m = profile.weighted_slope(radius) / radius
        if not self.has_face:
            m = m / radius
        values = 0.5 * self.span[..., None] * np.stack([m, m * v / (radius + v)])
        self.integrals = chebyshev.RunningIntegrals(values)
        self.of_pressure = self.integrals.component(0)

    def _abscissa(self, radius: FloatArray, low2: FloatArray, scale: FloatArray) -> FloatArray:
        rise = np.sqrt(np.maximum(radius * radius - low2, 0.0))
        return np.asarray(np.arcsinh(rise / scale)) if self.has_face else rise

    def __call__(self, radius: FloatArray) -> FloatArray:
        """Π and W up to the radii (n, X, …), shape (2, n, X, …)."""
        return self._up_to(radius, self.integrals)

    def pressure(self, radius: FloatArray) -> FloatArray:
        """Π alone."""
        return self._up_to(radius, self.of_pressure)[0]

    def _up_to(self, radius: FloatArray, integrals: chebyshev.RunningIntegrals) -> FloatArray:
        low2, scale, span = (align(v, radius) for v in (self.low2, self.scale, self.span))
        y = np.minimum(2.0 * self._abscissa(radius, low2, scale) / span, 2.0) - 1.0
        return integrals.up_to(y)


class TablePrimitives(Primitives):
    """Primitives of any profile from its m(ξ) alone; see `InnerTable` and `OuterTable`."""

    def __init__(
        self, profile: Profile, position: FloatArray, inner_nodes: int, outer_nodes: int, largest: FloatArray
    ) -> None:
        self._inner = InnerTable(profile, position, inner_nodes, largest)
        self._outer = OuterTable(profile, position, outer_nodes, largest)

    def inner(self, radius: FloatArray) -> FloatArray:
        return self._inner(radius)

    def outer(self, radius: FloatArray) -> FloatArray:
        return self._outer(radius)

    def pressure(self, radius: FloatArray) -> FloatArray:
        return self._outer.pressure(radius)
