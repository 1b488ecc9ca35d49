"""The Smith–Watson–Topper parameter of a plane (eq. 9), and Walker's with its exponent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from swtstudy.mechanics.planes.criterion import Criterion, Jet
from swtstudy.mechanics.planes.swing import NORMAL_STRAIN, Swing
from swtstudy.mechanics.points import FloatArray

#: γ of the Smith–Watson–Topper parameter.
SWT_EXPONENT = 0.5
#: Amplitudes below this are none: what is divided by it has a finite square.
NO_AMPLITUDE = 1e-100


@dataclass(frozen=True)
class Swt(Criterion):
    """swt, the largest σ_n times the amplitude of ε_n, 0 where the plane never is in tension.

    With Walker's exponent γ it is σ_n^(2 − 2γ) (E ε_n)^(2γ)/E, whose γ = 1/2 is swt.

    Attributes
    ----------
    exponent
        γ in (0, 1); None where it is 1/2 everywhere.
    modulus
        E in the unit of stress over that of strain; None with the exponent.
    """

    exponent: FloatArray | None = None
    modulus: FloatArray | None = None

    name: ClassVar[str] = "swt"
    words: ClassVar[str] = "Smith–Watson–Topper parameter"
    symbol: ClassVar[str] = "swt"
    degree: ClassVar[int] = 2
    swing: ClassVar[Swing] = NORMAL_STRAIN
    needs_tension: ClassVar[bool] = True
    knows_sharp_edge: ClassVar[bool] = True

    @classmethod
    def of(cls, exponent: FloatArray, modulus: FloatArray) -> Swt:
        """With exponents γ and moduli E of one shape."""
        return cls() if np.all(exponent == SWT_EXPONENT) else cls(exponent, modulus)

    def value(self, tension: FloatArray, amplitude: FloatArray) -> FloatArray:
        tension = np.maximum(tension, 0.0)
        if self.exponent is None or self.modulus is None:
            return np.asarray(tension * amplitude)
        γ, E = self.exponent, self.modulus
        swing = np.maximum(E * amplitude, 0.0)
        return np.asarray(tension ** (2.0 - 2.0 * γ) * swing ** (2.0 * γ) / E)

    def partials(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, ...]:
        α, β = self.powers(tension, amplitude)
        T, a, f = tension, np.maximum(amplitude, NO_AMPLITUDE), self.value(tension, amplitude)
        return α * f / T, β * f / a, α * (α - 1.0) * f / T**2, α * β * f / (T * a), β * (β - 1.0) * f / a**2

    def derivatives(self, tension: Jet, amplitude: Jet) -> tuple[FloatArray, FloatArray]:
        (f, df, ddf), (g, dg, ddg) = tension, amplitude
        if self.exponent is None:
            return df * g + f * dg, ddf * g + 2.0 * df * dg + f * ddg
        # σ_n times a power κ of ε_n has its maxima there, too: f g^κ, over g^(κ − 1).
        κ = self.exponent / (1.0 - self.exponent)
        g = np.maximum(g, NO_AMPLITUDE)
        slope = df * g + κ * f * dg
        return slope, ddf * g + κ * (2.0 * df * dg + f * ((κ - 1.0) * dg * dg / g + ddg))

    def log_derivatives(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        f, g = (jet[:, 1:] / jet[:, :1] for jet in (tension, amplitude))
        # Of ln f the second derivative is f″/f − (f′/f)².
        square = [a[:, [0, 1, 0]] * a[:, [0, 1, 1]] for a in (f, g)]
        if self.exponent is None:
            return f[:, :2] + g[:, :2], square[0] + square[1] - f[:, 2:] - g[:, 2:]
        β = 2.0 * self.exponent[:, None]
        α = 2.0 - β
        slope = α * f[:, :2] + β * g[:, :2]
        return slope, α * (square[0] - f[:, 2:]) + β * (square[1] - g[:, 2:])

    def powers(self, tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
        β = np.asarray(2.0 * SWT_EXPONENT if self.exponent is None else 2.0 * self.exponent)
        return np.asarray(2.0 - β), β

    def far_field(
        self, largest: FloatArray, amplitude: FloatArray, poisson_ratio: FloatArray, plane: bool
    ) -> tuple[FloatArray, FloatArray]:
        """On the x-normal."""
        if not plane:
            amplitude = amplitude / (1.0 - poisson_ratio**2)
        return self.value(largest, amplitude), np.zeros_like(largest)


#: γ = 1/2.
SWT = Swt()
