"""Criteria of shear: those of Fatemi and Socie, and of Findley."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.swing import SHEAR_STRESS, Swing
from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class ShearCriterion(Criterion):
    """An amplitude of the shear stress, raised by the largest σ_n.

    Attributes
    ----------
    sensitivity
        How much by.
    """

    sensitivity: FloatArray

    degree: ClassVar[int] = 1
    swing: ClassVar[Swing] = SHEAR_STRESS
    needs_tension: ClassVar[bool] = False
    knows_sharp_edge: ClassVar[bool] = False


@dataclass(frozen=True)
class FatemiSocie(ShearCriterion):
    """γ_a G (1 + κ σ_n⁺), γ_a G being the amplitude of τ; κ over the unit of the stress."""

    name: ClassVar[str] = "fatemi_socie"
    words: ClassVar[str] = "Fatemi–Socie parameter"
    symbol: ClassVar[str] = r"\mathrm{FS}"

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        return np.asarray(amplitude * (1.0 + self.sensitivity * np.maximum(tension, 0.0)))

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        slope = self.sensitivity * (tension > 0.0)
        zero = np.zeros_like(tension)
        return amplitude * slope, 1.0 + slope * tension, zero, slope + zero, zero

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        # sin 2θ (1 + m + m cos 2θ) is largest where its derivative, a quadratic form of the cosine, vanishes.
        m = 0.5 * self.sensitivity * np.maximum(largest, 0.0)
        cosine = 2.0 * m / (1.0 + m + np.sqrt((1.0 + m) ** 2 + 8.0 * m**2))
        tension, swing = 0.5 * largest * (1.0 + cosine), 0.5 * amplitude * np.sqrt(1.0 - cosine**2)
        return self.value(tension, swing), np.arccos(cosine)


@dataclass(frozen=True)
class Findley(ShearCriterion):
    """τ_a + k max σ_n, and 0 where that is negative."""

    name: ClassVar[str] = "findley"
    words: ClassVar[str] = "Findley stress"
    symbol: ClassVar[str] = "f"

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        return np.maximum(amplitude + self.sensitivity * tension, 0.0)

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        zero = np.zeros_like(tension)
        return self.sensitivity + zero, 1.0 + zero, zero, zero, zero

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        pull = self.sensitivity * largest
        return 0.5 * (pull + np.hypot(amplitude, pull)), np.arctan2(amplitude, pull)
