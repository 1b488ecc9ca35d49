"""The Struve functions H₀ and H₁ from a table: fast, and safe where the library's are NaN."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import struve

from swtstudy.mechanics.points import FloatArray

#: Spacing of the table; the spline's error is h⁴/384 times the fourth derivative, about 3e-11.
STEP = 0.01
SMALLEST_RANGE = 64.0
#: Distances of the neighbours that stand in where the library is NaN.
STEPS = (1e-3, 2e-3)


def struve_functions(z: FloatArray) -> FloatArray:
    """H₀(z) and H₁(z) for z ≥ 0, shape (2, …)."""
    largest = float(np.max(z, initial=SMALLEST_RANGE))
    return np.moveaxis(_table(2.0 ** np.ceil(np.log2(largest)))(z), -1, 0)


@lru_cache(maxsize=8)
def _table(reach: float) -> CubicSpline:
    z = np.arange(0.0, reach + 2.0 * STEP, STEP)
    values = np.stack([safe_struve(0, z), safe_struve(1, z)], axis=-1)
    return CubicSpline(z, values)


def safe_struve(order: int, z: FloatArray) -> FloatArray:
    """`scipy.special.struve`, mended where it is NaN: next to its zeros."""
    value = struve(order, z)
    broken = np.isnan(value)
    if np.any(broken):
        near = np.asarray(z)[broken]
        # The neighbours lie outside of the broken zone; the cubic through them is good to 1e-12.
        inner, outer = (0.5 * (struve(order, near - step) + struve(order, near + step)) for step in STEPS)
        value = np.array(value)
        value[broken] = (4.0 * inner - outer) / 3.0
    return value
