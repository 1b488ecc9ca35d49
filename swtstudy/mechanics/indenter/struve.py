"""The Struve functions H₀ and H₁ from a table."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from swtstudy.mechanics.numerics.arrays import polynomial_in
from swtstudy.mechanics.points import FloatArray

#: Spacing of the table; the error between is h⁴/384 times the fourth derivative, about 3e-11.
#: Twice: s changes by 1e-10.
STEP = 0.01
SMALLEST_RANGE = 64.0
#: Beyond, as far from the contact, no table: one takes 6 kB per rad.
LARGEST_RANGE = 1024.0
#: Gauss nodes of the integrals, and so many more per rad: errors of 2e-13 up to 66. Half of the second: 2e-9.
NODES, NODES_PER_RADIAN = 24, 0.5
#: Terms of the expansions for large z, which are good to 1e-15 from 64 on. Integrals would take as
#: long as z², and far from the contact z goes into the thousands.
TERMS = 10


def struve_functions(z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """H₀(z) and H₁(z) for z ≥ 0."""
    reach = 2.0 ** np.ceil(np.log2(np.max(z, initial=SMALLEST_RANGE)))
    near = np.minimum(z, LARGEST_RANGE)
    cell = (near * (1.0 / STEP)).astype(np.intp)
    rest = near - cell * STEP
    zeroth, first = (polynomial_in(c, cell, rest) for c in _table(min(reach, LARGEST_RANGE)))
    if reach > LARGEST_RANGE:
        far = z > LARGEST_RANGE
        zeroth[far], first[far] = struve_expansions(z[far])
    return zeroth, first


@lru_cache(maxsize=8)
def _table(reach: float) -> FloatArray:
    """Coefficients of cubics for H₀ and H₁, shape (2, 4, cells)."""
    z = np.arange(0.0, reach + 2.0 * STEP, STEP)
    near, far = np.split(z, [np.searchsorted(z, SMALLEST_RANGE)])
    zeroth, first = np.concatenate([struve_integrals(near), struve_expansions(far)], axis=1)
    # H₀′ = 2/π − H₁ and H₁′ = H₀ − H₁/z make them Hermite polynomials.
    slopes = 2.0 / np.pi - first, zeroth - np.divide(first, z, out=np.zeros_like(z), where=z > 0.0)
    return np.stack([_hermite(value, slope) for value, slope in ((zeroth, slopes[0]), (first, slopes[1]))])


def _hermite(value: FloatArray, slope: FloatArray) -> FloatArray:
    """Coefficients of t⁰ to t³ from the values and slopes at both ends of each cell, shape (4, cells)."""
    chord = np.diff(value) / STEP
    left, right = slope[:-1], slope[1:]
    cubic, square = (left + right - 2.0 * chord) / STEP**2, (3.0 * chord - 2.0 * left - right) / STEP
    return np.stack([value[:-1], left, square, cubic])


def struve_integrals(z: FloatArray) -> FloatArray:
    """H₀(z) and H₁(z) for z ≥ 0 of shape (m,), by their integrals, shape (2, m).

    Those of scipy are NaN next to zeros of H₀, and take longer to import than all else here.
    """
    count = NODES + int(NODES_PER_RADIAN * z.max(initial=0.0))
    node, weight = np.polynomial.legendre.leggauss(count)
    θ, half = 0.25 * np.pi * (1.0 + node), 0.5 * weight
    # H₀ = (2/π) ∫ sin(z cos θ) dθ and H₁ = (2z/π) ∫ sin(z cos θ) sin²θ dθ from 0 to π/2.
    weights = np.stack([half, half * np.sin(θ) ** 2])
    wave = np.sin(z[:, None] * np.cos(θ))
    zeroth, first = np.einsum("mk,ck->cm", wave, weights)
    return np.stack([zeroth, z * first])


def struve_expansions(z: FloatArray) -> FloatArray:
    """H₀(z) and H₁(z) for large z of shape (m,), shape (2, m): Y, and H − Y (DLMF 10.17.4 and 11.6.1)."""
    k = np.arange(1, TERMS)
    found = []
    for order in (0, 1):
        # a₀ + a₁ (i/z) + a₂ (i/z)² + …
        hankel = np.cumprod(np.append(1.0, (4.0 * order**2 - (2.0 * k - 1.0) ** 2) / (8.0 * k)))
        wave = np.exp(1j * (z - 0.5 * np.pi * order - 0.25 * np.pi)) * np.polyval(hankel[::-1], 1j / z)
        rest = np.cumprod(np.append(1.0, (2.0 * k - 1.0) * (1.0 - 2.0 * k + 2.0 * order)))
        found.append(
            np.sqrt(2.0 / (np.pi * z)) * wave.imag
            + (2.0 / np.pi) * z ** (order - 1.0) * np.polyval(rest[::-1], 1.0 / z**2)
        )
    return np.stack(found)
