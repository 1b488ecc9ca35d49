"""Plane contacts: what all strips have in common, the cylinder, and the flat with rounded edges.

Depth has no meaning in the plane. In its place stands the line load N(ξ) at the half-width ξ over N_0 = π/4,
the mean one in E* δ0: that is how δ0 is defined. With N′ in the place of g′ all that is written for discs
holds for strips, but for the kernels: there is one integral over the springs inside |x| and one over those
outside, and no load inside.

The rounded flat is f = (|x| − b)²/2 beyond the half-width b. With w = √(ξ² − b²) and N in E* δ0, N = ½ [ξ²
arctan(w/b) − b w] and N′ = ξ arctan(w/b).
"""

from __future__ import annotations

from abc import abstractmethod
from functools import lru_cache

import numpy as np

from swtstudy.mechanics.indenter.base import InnerTable, OuterTable, Primitives, Profile
from swtstudy.mechanics.indenter.paraboloid import FlatFaced, rise_abscissa, rise_angles
from swtstudy.mechanics.numerics.arrays import TINY, align
from swtstudy.mechanics.numerics.roots import NEWTON_STEPS
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


#: w/b below which N is taken from so many terms of its series: there its two parts cancel.
SMALL, TERMS = 0.05, 6


class RoundedFlat(PlaneProfile, FlatFaced):
    """n flats with rounded edges.

    Parameters
    ----------
    largest_depth
        Shape (n,): largest line load over the mean one.
    flat_half_width
        Shape (n,): b/a_H.
    """

    def __init__(self, largest_depth: FloatArray, flat_half_width: FloatArray) -> None:
        super().__init__(largest_depth, flat_half_width)

    def depth(self, radius: FloatArray) -> FloatArray:
        b, w = self._face(radius), self._rise(radius)
        return _load(w, b, np.arctan2(w, b)) / MEAN_LOAD

    def radius(self, depth: FloatArray) -> FloatArray:
        b, goal = self._face(depth), MEAN_LOAD * np.maximum(depth, 0.0)
        # Exact for small and for large b²/N; the table knows what is in between.
        scale = np.sqrt(goal) + np.cbrt(b * goal)
        w = scale * np.interp(rise_abscissa(b, goal), *_rise_table())
        for _ in range(NEWTON_STEPS):
            angle = np.arctan2(w, b)
            slope = w * angle
            error = _load(w, b, angle) - goal
            w = w - np.divide(error, slope, out=np.zeros_like(w), where=slope > 0.0)
        return np.hypot(w, b)

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        b, w = self._face(radius), self._rise(radius)
        return np.maximum(radius, b) * w * np.arctan2(w, b)

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        b, w = self._face(radius), self._rise(radius)
        angle = np.arctan2(w, b)
        return _load(w, b, angle) / MEAN_LOAD, np.maximum(radius, b) * w * angle

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        b, w = self._face(radius), self._rise(radius)
        angle = np.arctan2(w, b)
        return 0.5 * (_load(w, b, angle) - b * (w - b * angle)) / MEAN_LOAD

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return RoundedFlatPrimitives(position, self.flat_radius[:, None])


class RoundedFlatPrimitives(PlanePrimitives):
    """Closed forms, both by parts.

    Parameters
    ----------
    position, flat
        Shapes (n, X) and (n, 1): |x| and b.
    """

    def __init__(self, position: FloatArray, flat: FloatArray) -> None:
        self.position, self.flat = position, flat
        #: ln √|x² − b²|, which cancels at x = b.
        gap = np.abs((position - flat) * (position + flat))
        self.logarithm = 0.5 * np.log(np.where(gap > 0.0, gap, 1.0))

    def inner(self, radius: FloatArray) -> FloatArray:
        x, b = align(self.position, radius), align(self.flat, radius)
        gap = np.maximum((x - b) * (x + b), 0.0)
        w2 = np.minimum(np.maximum((radius - b) * (radius + b), 0.0), gap)
        w, v = np.sqrt(w2), np.sqrt(gap - w2)
        # √(x² − b²) sin α = w and √(x² − b²) cos α = v.
        return (2.0 * (x * np.arctan2(x * w, b * v) - b * np.arctan2(w, v) - v * np.arctan2(w, b)))[None]

    def pressure(self, radius: FloatArray) -> FloatArray:
        x, b = align(self.position, radius), align(self.flat, radius)
        radius = np.maximum(radius, np.maximum(x, b))
        v, w = np.sqrt((radius - x) * (radius + x)), np.sqrt((radius - b) * (radius + b))
        touches = (v > 0.0) & (w > 0.0)
        outer, inner = (np.log(np.where(touches, one, 1.0)) for one in ((x * w + b * v) / radius, v + w))
        # At the edge of the contact and at x = b differences of equal logarithms.
        turn = (x - b) * (outer - align(self.logarithm, radius)) + b * (outer - inner)
        return np.where(touches, v * np.arctan2(w, b) + turn, 0.0)


def _load(w: FloatArray, b: FloatArray, angle: FloatArray) -> FloatArray:
    """N, with arctan(w/b)."""
    t = np.minimum(w / np.maximum(b, TINY), 1.0)
    square = t * t
    series = np.zeros(())
    for k in range(TERMS, 0, -1):
        series = 2.0 / (4 * k * k - 1.0) - square * series
    return 0.5 * np.where(t < SMALL, b * b * t * square * series, (w * w + b * b) * angle - b * w)


@lru_cache(maxsize=1)
def _rise_table() -> tuple[FloatArray, FloatArray]:
    """w/(√N + (b N)^⅓) over 1/(1 + (b²/N)^⅙), for `RoundedFlat.radius`."""
    rest = rise_angles()
    angle = 0.5 * np.pi - rest
    # With b = 1: w = tan.
    w = 1.0 / np.tan(rest)
    load = _load(w, np.ones_like(w), angle)
    ratio = w / (np.sqrt(load) + np.cbrt(load))
    abscissa = 1.0 / (1.0 + load ** (-1.0 / 6.0))
    ends = np.cbrt(3.0), 1.0 / np.sqrt(MEAN_LOAD)
    return np.concatenate([[0.0], abscissa, [1.0]]), np.concatenate([ends[:1], ratio, ends[1:]])
