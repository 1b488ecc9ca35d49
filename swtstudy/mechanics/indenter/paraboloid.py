"""The paraboloid (eq. 3), and with a flat face the rounded punch (eq. 4) and the truncated one (eq. 5).

The paraboloid has g = ξ², and everything in closed form. With a face of radius b the formulas are simplest in
w = √(ξ² − b²), with arccos(b/ξ) = arctan(w/b).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from swtstudy.mechanics.indenter.base import OuterTable, Primitives, Profile
from swtstudy.mechanics.numerics.arrays import TINY, TINY_ROOT, align
from swtstudy.mechanics.points import FloatArray


class ParaboloidPrimitives(Primitives):
    """Hamilton's full-slip solution on the surface, split into its two integrals."""

    def __init__(self, position: FloatArray) -> None:
        self.position = position

    def inner(self, radius: FloatArray) -> FloatArray:
        r = align(self.position, radius)
        sine = np.minimum(radius / r, 1.0)
        cosine = np.sqrt(1.0 - sine * sine)
        product = sine * cosine
        lens = r * (np.arcsin(sine) - product)
        return np.stack([2.0 * lens, 1.5 * lens - r * sine * sine * product])

    def outer(self, radius: FloatArray) -> FloatArray:
        r = align(self.position, radius)
        radius = np.maximum(radius, r)
        v = np.sqrt(radius * radius - r * r)
        # ∫ (ξ − v) g′ dξ/r² without the difference of large numbers.
        inside = (2.0 / 3.0) * (radius + v * v / (radius + v) - r)
        return np.stack([2.0 * v, inside])

    def pressure(self, radius: FloatArray) -> FloatArray:
        r = align(self.position, radius)
        radius = np.maximum(radius, r)
        return np.asarray(2.0 * np.sqrt(radius * radius - r * r))


class Paraboloid(Profile):
    """n paraboloids; they are all the same in a_H and δ0."""

    def depth(self, radius: FloatArray) -> FloatArray:
        return radius * radius

    def radius(self, depth: FloatArray) -> FloatArray:
        return np.sqrt(np.maximum(depth, 0.0))

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return 2.0 * radius * radius

    def half_load(self, radius: FloatArray) -> FloatArray:
        return (2.0 / 3.0) * radius**3

    def radius_of_half_load(self, half_load: FloatArray) -> FloatArray:
        return np.cbrt(1.5 * np.maximum(half_load, 0.0))

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return ParaboloidPrimitives(position)


#: Chebyshev nodes of the tables for each digit, for any width of the face (test_profiles.py). Half:
#: 3e-10 at 128 points at rtol 1e-5, no faster; twice: 5e-14.
NODES_PER_DIGIT = 4.5
#: Distance from the singular r = b up to which positions are looked at, over the face or the ring beside it.
#: 1e-11 or 1e-7: no change at 128 points, nor at 32 that slide at the edge.
NEAREST = 1e-9
#: A face smaller than this share of the contact is not looked at closely: its singularity has no weight. Half
#: or twice: no change at 160 points.
SMALLEST_FACE = 1e-3
#: Positions on the way to r = b. The nearest alone: s is 2e-2 low in tests/mechanics/test_face_edge.py.
APPROACH_COUNT = 9


class FlatFaced(Profile):
    """n profiles with g = 0 up to the radius b/a_H = ``flat_radius``, shape (n,)."""

    __match_args__ = ("largest_depth", "_flat_radius")

    def __init__(self, largest_depth: FloatArray, flat_radius: FloatArray) -> None:
        super().__init__(largest_depth)
        self._flat_radius = np.asarray(flat_radius, dtype=float)

    @property
    def flat_radius(self) -> FloatArray:
        return self._flat_radius

    def _face(self, like: FloatArray) -> FloatArray:
        return align(self._flat_radius, like)

    def _rise(self, radius: FloatArray) -> FloatArray:
        """w = √(ξ² − b²), 0 on the face."""
        b = self._face(radius)
        return np.sqrt(np.maximum((radius - b) * (radius + b), 0.0))


class RoundedPunch(FlatFaced):
    """g = ξ (w − b arctan(w/b))."""

    def depth(self, radius: FloatArray) -> FloatArray:
        return self._depth(radius, *self._shape_at(radius))

    def radius(self, depth: FloatArray) -> FloatArray:
        b, depth = self._face(depth), np.maximum(depth, 0.0)
        # Exact for small and for large b²/G; the table knows what is in between.
        scale = np.sqrt(depth) + np.cbrt(3.0 * b * depth)
        w = scale * np.interp(rise_abscissa(b, depth), *_rise_table())
        radius = np.sqrt(b * b + w * w)
        # One Newton step in w squares the table's error.
        error = radius * (w - b * np.arctan2(w, b)) - depth
        slope = (2.0 * w - b * np.arctan2(w, b)) * w / np.maximum(radius, TINY)
        w = w - np.divide(error, slope, out=np.zeros_like(w), where=slope > 0.0)
        return np.sqrt(b * b + w * w)

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return self._weighted_slope(*self._shape_at(radius))

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        at = self._shape_at(radius)
        return self._depth(radius, *at), self._weighted_slope(*at)

    def half_load(self, radius: FloatArray) -> FloatArray:
        return self._half_load(*self._shape_at(radius))

    def half_load_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        at = self._shape_at(radius)
        return self._half_load(*at), self._weighted_slope(*at)

    def _shape_at(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """b, w and arctan(w/b), which takes longest."""
        b, w = self._face(radius), self._rise(radius)
        return b, w, np.arctan2(w, b)

    @staticmethod
    def _depth(radius: FloatArray, b: FloatArray, w: FloatArray, angle: FloatArray) -> FloatArray:
        return np.maximum(radius, b) * (w - b * angle)

    @staticmethod
    def _weighted_slope(b: FloatArray, w: FloatArray, angle: FloatArray) -> FloatArray:
        return w * (2.0 * w - b * angle)

    @staticmethod
    def _half_load(b: FloatArray, w: FloatArray, angle: FloatArray) -> FloatArray:
        return (2.0 / 3.0) * w**3 - 0.5 * b * ((w * w + b * b) * angle - b * w)

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        root = np.cbrt(half_load)
        ratio = self._face(half_load) / np.maximum(root, TINY_ROOT)
        return root * np.interp(1.0 / (1.0 + ratio), *_rise_by_load_table())

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return RoundedPrimitives(self, position, self.radius(self.largest_depth), digits)


class FacePrimitives(Primitives):
    """Elementary inner integrals in α, w = √(r² − b²) sin α, and tabulated outer ones."""

    def __init__(self, profile: FlatFaced, position: FloatArray, largest: FloatArray, digits: float) -> None:
        self.position, self.flat = position, profile.flat_radius[:, None]
        self._outer = OuterTable(profile, position, int(NODES_PER_DIGIT * digits), largest)

    def outer(self, radius: FloatArray) -> FloatArray:
        return self._outer(radius)

    def pressure(self, radius: FloatArray) -> FloatArray:
        return self._outer.pressure(radius)

    def _angle(self, radius: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """r, b, (r² − b²), sin α and cos α, which broadcast against the radius."""
        r, b = align(self.position, radius), align(self.flat, radius)
        gap = np.maximum((r - b) * (r + b), 0.0)
        share = np.maximum((radius - b) * (radius + b), 0.0) / np.maximum(gap, TINY)
        share = np.where(gap > 0.0, np.minimum(share, 1.0), 0.0)
        return r, b, gap, np.sqrt(share), np.sqrt(1.0 - share)


class RoundedPrimitives(FacePrimitives):
    """m = 2w² − b w arctan(w/b); the integrals of the second term follow by parts."""

    def inner(self, radius: FloatArray) -> FloatArray:
        r, b, gap, sine, cosine = self._angle(radius)
        root = np.sqrt(gap)
        angle = np.arcsin(sine)
        product = sine * cosine
        lens = angle - product
        bend = np.arctan2(root * sine, b)
        # ∫ cos²α dα/(b² + (r² − b²) sin²α) times b (r² − b²).
        turn = r * np.arctan2(r * sine, b * cosine) - b * angle
        first = turn - root * cosine * bend
        cubic = (2.0 * gap - b * b) * turn + 0.5 * b * gap * (angle + product)
        cubic = cubic / 3.0 - root * gap * (cosine - cosine**3 / 3.0) * bend
        quartic = 0.75 * lens - 0.5 * sine * sine * product
        b2 = b * b
        one = gap * lens - b * first
        three = b2 * one + gap * gap * quartic - b * cubic
        return np.stack([(2.0 / r) * one, (2.0 / r**3) * three])


def rise_abscissa(b: FloatArray, depth: FloatArray) -> FloatArray:
    """1/(1 + (b²/G)^⅙), over which w is tabulated."""
    ratio = np.cbrt(b) / np.maximum(np.sqrt(np.cbrt(depth)), TINY_ROOT)
    return np.asarray(1.0 / (1.0 + ratio))


def rise_angles() -> FloatArray:
    """π/2 − arctan(w/b) for the tables of w, falling; closer towards small faces.

    Beside the edge the stress shows the square root of a radius's error.
    """
    rest = 0.5 * np.pi - np.linspace(0.0, 0.5 * np.pi, 20001)[1:-1]
    return np.concatenate([rest[rest > 0.02], np.geomspace(0.02, 1e-12, 8001)])


@lru_cache(maxsize=1)
def _rise_table() -> tuple[FloatArray, FloatArray]:
    """w/(√G + (3 b G)^⅓) over 1/(1 + (b²/G)^⅙), for `RoundedPunch.radius`."""
    rest = rise_angles()
    angle = 0.5 * np.pi - rest
    # With b = 1: w = tan, G = (tan − angle)/cos; the series keeps the difference exact for small angles.
    tangent = 1.0 / np.tan(rest)
    difference = np.where(angle < 0.02, angle**3 / 3.0 + angle**5 * (2.0 / 15.0), tangent - angle)
    depth = difference / np.sin(rest)
    ratio = tangent / (np.sqrt(depth) + np.cbrt(3.0 * depth))
    abscissa = 1.0 / (1.0 + depth ** (-1.0 / 6.0))
    return np.concatenate([[0.0], abscissa, [1.0]]), np.concatenate([[1.0], ratio, [1.0]])


@lru_cache(maxsize=1)
def _rise_by_load_table() -> tuple[FloatArray, FloatArray]:
    """w/H^⅓ over 1/(1 + b/H^⅓), for `RoundedPunch.radius_of_half_load`."""
    angle = np.linspace(0.0, 0.5 * np.pi, 20001)[1:-1]
    # With b = 1: w = tan; the series keeps the difference exact for small angles.
    w = np.tan(angle)
    series = w**3 / 3.0 + w**5 / 15.0 - w**7 / 35.0
    half_load = np.where(angle < 0.02, series, (2.0 / 3.0) * w**3 - 0.5 * ((w * w + 1.0) * angle - w))
    root = np.cbrt(half_load)
    ends = np.cbrt(3.0), np.cbrt(1.5)
    abscissa = root / (1.0 + root)
    return np.concatenate([[0.0], abscissa, [1.0]]), np.concatenate([ends[:1], w / root, ends[1:]])


class TruncatedParaboloid(FlatFaced):
    """g = ξ w; the pressure is logarithmically infinite at r = b."""

    has_singular_edge = True

    def depth(self, radius: FloatArray) -> FloatArray:
        return radius * self._rise(radius)

    def radius(self, depth: FloatArray) -> FloatArray:
        b2, depth = self._face(depth) ** 2, np.maximum(depth, 0.0)
        square = 2.0 * depth * depth / np.maximum(b2 + np.sqrt(b2 * b2 + 4.0 * depth * depth), TINY)
        return np.sqrt(b2 + square)

    @property
    def singular_approach(self) -> FloatArray:
        b = self._flat_radius[:, None]
        largest = self.radius(self.largest_depth)[:, None]
        width = 0.1 * (largest - b)
        nearest = NEAREST * np.minimum(largest - b, np.maximum(b, SMALLEST_FACE * largest))
        share = np.linspace(0.0, 1.0, APPROACH_COUNT)
        distance = width * (nearest / width) ** share
        return np.asarray(np.where(b >= SMALLEST_FACE * largest, b + distance, b))

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        b = self._face(radius)
        return 2.0 * np.maximum(radius, b) ** 2 - b * b

    def half_load(self, radius: FloatArray) -> FloatArray:
        b, w = self._face(radius), self._rise(radius)
        return w * ((2.0 / 3.0) * w * w + b * b)

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        # The real root of the cubic w³ + (3/2) b² w = (3/2) H.
        b = np.maximum(self._face(half_load), TINY_ROOT)
        return np.sqrt(2.0) * b * np.sinh(np.arcsinh(1.5 * np.sqrt(2.0) * half_load / b**3) / 3.0)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return TruncatedPrimitives(self, position, self.radius(self.largest_depth), digits)


class TruncatedPrimitives(FacePrimitives):
    """m = 2w² + b²."""

    def inner(self, radius: FloatArray) -> FloatArray:
        r, b, gap, sine, cosine = self._angle(radius)
        b2, sine2, product = b * b, sine * sine, sine * cosine
        angle = np.arcsin(sine)
        lens = angle - product
        first = (2.0 / r) * (b2 * angle + gap * lens)
        quartic = 0.75 * lens - 0.5 * sine2 * product
        third = (2.0 / r**3) * (b2 * b2 * angle + 1.5 * b2 * gap * lens + gap * gap * quartic)
        return np.stack([first, third])
