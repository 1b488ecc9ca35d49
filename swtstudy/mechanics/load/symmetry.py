"""What two harmonic loads may differ in and have the same s."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray, IntArray


def without_what_stands_still(
    constant: NDArray[np.bool_], phase: FloatArray, p: IntArray, q: IntArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Phase and ω2/ω1 = p/q, each (n,): 0 and 1 for a constant normal load, which has neither."""
    return np.where(constant, 0.0, phase), np.where(constant, 1, p), np.where(constant, 1, q)


def fold_phase(phase: FloatArray, p: IntArray, q: IntArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Fold ψ into one symmetry period of s(ψ): 2π/p for even q, π/p for odd q.

    Shifting time by π/ω2 flips u and mirrors x.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    p, q
        Shape (n,), ω2/ω1 = p/q in lowest terms.

    Returns
    -------
    folded, mirrored
        The equivalent phase in [0, period), and whether x and the plane's angle change sign with it.
    """
    period = np.where(q % 2 == 0, 2.0, 1.0) * np.pi / p
    turns = np.floor(phase / period + 1e-12)
    folded = np.maximum(phase - turns * period, 0.0)
    mirrored = (q % 2 == 1) & (turns % 2 == 1)
    return folded, mirrored
