"""STUB: the symmetry of s in the phase (theory: t → t + π/ω2 flips u and mirrors x)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray, IntArray


def fold_phase(phase: FloatArray, p: IntArray, q: IntArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The phase folded into [0, 2π/p) for even q or [0, π/p) for odd q, and whether x is mirrored."""
    phase, p, q = np.broadcast_arrays(np.asarray(phase, float), np.asarray(p), np.asarray(q))
    period = np.where(q % 2 == 0, 2 * np.pi, np.pi) / p
    count = np.floor(phase / period)
    return phase - count * period, (q % 2 == 1) & (count % 2 == 1)
