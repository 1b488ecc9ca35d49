"""The cylinder with superimposed waviness: N/N_0 = ξ² + 2 h z J₁(z), z = kξ, k = 2π/λ."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlaneProfile, StripTablePrimitives
from swtstudy.mechanics.indenter.wavy_paraboloid import NODES_PER_DIGIT, WavyParaboloid, largest_phase
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray


class WavyCylinder(PlaneProfile, WavyParaboloid):
    """n cylinders with waviness; parameters and tables of first guesses as of the paraboloid."""

    def _with_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        """N/N_0 and its slope 2ξ + 2 h k z J₀."""
        from scipy.special import j0, j1  # as long to import as all else, and few need it

        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        z = k * radius
        return radius * radius + 2.0 * h * z * j1(z), 2.0 * radius + 2.0 * h * k * z * j0(z)

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * radius * self._with_slope(radius)[1]

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth, slope = self._with_slope(radius)
        return depth, MEAN_LOAD * radius * slope

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        from scipy.special import j0

        h, k = align(self.waviness_amplitude, radius), align(self.wave_number, radius)
        return 0.5 * radius * radius + 2.0 * h * (1.0 - j0(k * radius))

    @classmethod
    def smallest_wavelength(
        cls, largest_depth: FloatArray | float, h: FloatArray, wavelength: FloatArray
    ) -> FloatArray:
        phase = largest_phase(largest_depth, h, wavelength)
        # N′ ∝ 1 + (4π² hR/λ²) J₀(z).
        return 2.0 * np.pi * np.sqrt(np.maximum(np.interp(phase, *_deepest_troughs()), 0.0))

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        nodes = int(NODES_PER_DIGIT * digits) + self.extra_nodes(digits)
        return StripTablePrimitives(self, position, nodes, self.radius(self.largest_depth))


@lru_cache
def _deepest_troughs() -> tuple[FloatArray, FloatArray]:
    """Phases kξ, and the greatest −J₀ up to each, that at its first minimum near 3.8."""
    from scipy.special import j0

    z = np.linspace(1e-3, 8.0, 2001)
    return z, np.maximum.accumulate(-j0(z))
