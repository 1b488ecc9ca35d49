"""The paraboloid (eq. 3): g = ξ², everything in closed form."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.numerics.arrays import align
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
