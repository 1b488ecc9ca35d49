"""The criterion of a plane (eq. 9), the one place that knows how swt is made.

Three curves over the cycle make it, σ_n, ε_n and −ε_n, each by its maximum alone: swt is the largest σ_n
times the amplitude of ε_n, and 0 where the plane never is in tension.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray


def curves(stress: FloatArray, strain: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The curves over the cycle whose maxima make swt: σ_n, ε_n and −ε_n."""
    return stress, strain, -strain


def of_maxima(tension: FloatArray, elongation: FloatArray, contraction: FloatArray) -> FloatArray:
    """swt of a plane from the maxima of its three `curves`."""
    return combined(tension, 0.5 * (elongation + contraction))


def combined(tension: FloatArray, amplitude: FloatArray) -> FloatArray:
    """swt of a plane from its largest σ_n and its amplitude of ε_n."""
    return np.asarray(np.maximum(tension, 0.0) * amplitude)


def derivatives(
    tension: tuple[FloatArray, FloatArray, FloatArray], amplitude: tuple[FloatArray, FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """First and second derivative of `combined` from value and two derivatives of both, σ_n > 0."""
    (f, df, ddf), (g, dg, ddg) = tension, amplitude
    return df * g + f * dg, ddf * g + 2.0 * df * dg + f * ddg


def log_derivatives(tension: FloatArray, amplitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Derivatives of ln `combined` in two directions, σ_n > 0.

    Parameters
    ----------
    tension, amplitude
        Shape (n, 6): value, first derivatives 1, 2, second derivatives 11, 22, 12.

    Returns
    -------
    slope, stiffness
        Shape (n, 2) and (n, 3): first derivatives, and second ones with the sign changed.
    """
    f, g = (jet[:, 1:] / jet[:, :1] for jet in (tension, amplitude))
    # Of ln f the second derivative is f″/f − (f′/f)².
    square = [a[:, [0, 1, 0]] * a[:, [0, 1, 1]] for a in (f, g)]
    return f[:, :2] + g[:, :2], square[0] + square[1] - f[:, 2:] - g[:, 2:]
