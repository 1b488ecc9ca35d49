"""The Struve functions H₀ and H₁ from a table: fast, and safe where the library's are NaN."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray

#: Spacing of the table; the error between is h⁴/384 times the fourth derivative, about 3e-11.
#: Twice: s changes by 1e-10.
STEP = 0.01
SMALLEST_RANGE = 64.0
#: Distances of the neighbours that stand in where the library is NaN.
STEPS = (1e-3, 2e-3)


def struve_functions(z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """H₀(z) and H₁(z) for z ≥ 0."""
    largest = float(np.max(z, initial=SMALLEST_RANGE))
    cell = (z * (1.0 / STEP)).astype(np.intp)
    rest = z - cell * STEP
    zeroth, first = (_cubic(c, cell, rest) for c in _table(2.0 ** np.ceil(np.log2(largest))))
    return zeroth, first


def _cubic(coefficients: FloatArray, cell: NDArray[np.intp], rest: FloatArray) -> FloatArray:
    """Value of a piecewise cubic polynomial; its evenly spaced cells need no search."""
    value = coefficients[0].take(cell)
    for c in coefficients[1:]:
        value *= rest
        value += c.take(cell)
    return value


@lru_cache(maxsize=8)
def _table(reach: float) -> FloatArray:
    """Coefficients of cubics for H₀ and H₁, shape (2, 4, cells)."""
    z = np.arange(0.0, reach + 2.0 * STEP, STEP)
    zeroth, first = safe_struve(0, z), safe_struve(1, z)
    # H₀′ = 2/π − H₁ and H₁′ = H₀ − H₁/z make them Hermite polynomials.
    slopes = 2.0 / np.pi - first, zeroth - np.divide(first, z, out=np.zeros_like(z), where=z > 0.0)
    return np.stack([_hermite(value, slope) for value, slope in ((zeroth, slopes[0]), (first, slopes[1]))])


def _hermite(value: FloatArray, slope: FloatArray) -> FloatArray:
    """Coefficients of the cubics with the values and slopes at both ends of each cell, shape (4, cells)."""
    chord = np.diff(value) / STEP
    left, right = slope[:-1], slope[1:]
    cubic, square = (left + right - 2.0 * chord) / STEP**2, (3.0 * chord - 2.0 * left - right) / STEP
    return np.stack([cubic, square, left, value[:-1]])


def safe_struve(order: int, z: FloatArray) -> FloatArray:
    """`scipy.special.struve`, mended where it is NaN: next to its zeros."""
    from scipy.special import struve  # takes as long to import as all else, and few need it

    value = struve(order, z)
    broken = np.isnan(value)
    if np.any(broken):
        near = np.asarray(z)[broken]
        # The neighbours lie outside of the broken zone; the cubic through them is good to 1e-12.
        inner, outer = (0.5 * (struve(order, near - step) + struve(order, near + step)) for step in STEPS)
        value = np.array(value)
        value[broken] = (4.0 * inner - outer) / 3.0
    return value
