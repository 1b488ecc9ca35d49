"""The power law in the plane, f ∝ |x|ⁿ: N/N_0 = ξⁿ in the half-width at the mean load."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlanePrimitives, PlaneProfile
from swtstudy.mechanics.indenter.power_law import PowerLaw, PowerPrimitives, evaluate_inner, inner_series
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray


class PowerLawCylinder(PlaneProfile, PowerLaw):
    """n profiles N/N_0 = ξⁿ: the disc's g, so that its tables serve both."""

    @classmethod
    def length_law(cls, **shape: float) -> tuple[float, float]:
        # f = |x|ⁿ/(n Rⁿ⁻¹), as the disc's: N = E* ξⁿ/Rⁿ⁻¹ ∫ sⁿ/√(1 − s²) ds, and N = (π/4) E* δ0 at a_H.
        from scipy.special import beta  # as long to import as all else, and few need it

        n = shape["exponent"]
        return 0.5 * float(beta(0.5 * (n + 1.0), 0.5)) / MEAN_LOAD, 1.0 / n

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * super().weighted_slope(radius)

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth = self.depth(radius)
        return depth, MEAN_LOAD * align(self.exponent, radius) * depth

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        return self.depth(radius) / align(self.exponent, radius)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return PowerStripPrimitives(self.exponent, position, digits)


class PowerStripPrimitives(PlanePrimitives):
    """The disc's integral over the outer springs, and over the inner ones that of the exponent n − 1."""

    def __init__(self, exponent: FloatArray, position: FloatArray, digits: float) -> None:
        self.exponent, self.position = exponent, position
        self._of_disc = PowerPrimitives(exponent, position, digits)
        self._inner = inner_series(exponent - 1.0, digits)

    def inner(self, radius: FloatArray) -> FloatArray:
        r, n, scale = (align(v, radius) for v in (self.position, self.exponent, self._of_disc.power))
        sine = np.minimum(radius / r, 1.0)
        return (2.0 * MEAN_LOAD * n * scale * sine**n * evaluate_inner(self._inner, sine))[None]

    def pressure(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * self._of_disc.pressure(radius)
