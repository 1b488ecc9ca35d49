"""The criterion of a plane (eq. 9), the one place that knows how swt is made.

Three curves over the cycle make it, σ_n, ε_n and −ε_n, each by its maximum alone: swt is the largest σ_n
times the amplitude of ε_n, and 0 where the plane never is in tension. With Walker's exponent γ it is
σ_n^(2 − 2γ) (E ε_n)^(2γ)/E, whose γ = 1/2 is swt.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray

#: γ of the Smith–Watson–Topper parameter.
SWT_EXPONENT = 0.5
#: Amplitudes below this are none: what is divided by it has a finite square.
NO_AMPLITUDE = 1e-100


@dataclass(frozen=True)
class Walker:
    """Walker's criterion at places of shape (…); None in its stead is swt, γ = 1/2.

    Attributes
    ----------
    exponent
        γ in (0, 1).
    modulus
        E in the unit of stress over that of strain.
    """

    exponent: FloatArray
    modulus: FloatArray

    @classmethod
    def of(cls, exponent: float, modulus: float, count: int = 1) -> Walker | None:
        """One criterion at ``count`` places; None for γ = 1/2."""
        return None if exponent == SWT_EXPONENT else cls(np.full(count, exponent), np.full(count, modulus))

    def take(self, *index: NDArray[np.intp] | slice | int) -> Walker:
        """The criterion at the places at ``index``."""
        return Walker(self.exponent[index], self.modulus[index])

    def reshape(self, *shape: int) -> Walker:
        """The same for places of another shape."""
        return Walker(self.exponent.reshape(shape), self.modulus.reshape(shape))


def curves(stress: FloatArray, strain: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The curves over the cycle whose maxima make swt: σ_n, ε_n and −ε_n."""
    return stress, strain, -strain


def of_maxima(
    tension: FloatArray, elongation: FloatArray, contraction: FloatArray, *, walker: Walker | None = None
) -> FloatArray:
    """swt of a plane from the maxima of its three `curves`."""
    return combined(tension, 0.5 * (elongation + contraction), walker)


def combined(tension: FloatArray, amplitude: FloatArray, walker: Walker | None = None) -> FloatArray:
    """swt of a plane from its largest σ_n and its amplitude of ε_n."""
    tension = np.maximum(tension, 0.0)
    if walker is None:
        return np.asarray(tension * amplitude)
    γ, E = walker.exponent, walker.modulus
    swing = np.maximum(E * amplitude, 0.0)
    return np.asarray(tension ** (2.0 - 2.0 * γ) * swing ** (2.0 * γ) / E)


def derivatives(
    tension: tuple[FloatArray, FloatArray, FloatArray],
    amplitude: tuple[FloatArray, FloatArray, FloatArray],
    walker: Walker | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Where swt rises and how it bends, from value and two derivatives of both.

    These are the first and second derivative of σ_n times a power of ε_n that has its maxima where `combined`
    has them, over a common positive factor; for swt, of `combined` itself.
    """
    (f, df, ddf), (g, dg, ddg) = tension, amplitude
    if walker is None:
        return df * g + f * dg, ddf * g + 2.0 * df * dg + f * ddg
    # f g^κ, over g^(κ − 1).
    κ = walker.exponent / (1.0 - walker.exponent)
    g = np.maximum(g, NO_AMPLITUDE)
    slope = df * g + κ * f * dg
    return slope, ddf * g + κ * (2.0 * df * dg + f * ((κ - 1.0) * dg * dg / g + ddg))


def log_derivatives(
    tension: FloatArray, amplitude: FloatArray, walker: Walker | None = None
) -> tuple[FloatArray, FloatArray]:
    """Derivatives of ln `combined` in two directions, σ_n > 0.

    Parameters
    ----------
    tension, amplitude
        Shape (n, 6): value, first derivatives 1, 2, second derivatives 11, 22, 12.
    walker
        Shape (n,).

    Returns
    -------
    slope, stiffness
        Shape (n, 2) and (n, 3): first derivatives, and second ones with the sign changed.
    """
    f, g = (jet[:, 1:] / jet[:, :1] for jet in (tension, amplitude))
    # Of ln f the second derivative is f″/f − (f′/f)².
    square = [a[:, [0, 1, 0]] * a[:, [0, 1, 1]] for a in (f, g)]
    if walker is None:
        return f[:, :2] + g[:, :2], square[0] + square[1] - f[:, 2:] - g[:, 2:]
    β = 2.0 * walker.exponent[:, None]
    α = 2.0 - β
    slope = α * f[:, :2] + β * g[:, :2]
    return slope, α * (square[0] - f[:, 2:]) + β * (square[1] - g[:, 2:])
