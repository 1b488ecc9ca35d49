"""The stress beneath a contact as a sum of point loads."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def sum_of_point_loads(
    weighted_slope: Callable[[Array], Array], a: float, b: float, place: tuple[float, float, float], ν: float
) -> Array:
    """Boussinesq's and Cerruti's solutions integrated over p(r) = (1/π) ∫ g′ dξ/√(ξ² − r²), shape (2, 6).

    For m = g′ √(ξ² − b²) and the contact radius a; with the pressure itself as the traction in +x.
    """
    u, w = np.polynomial.legendre.leggauss(40)
    angle = np.linspace(0, 2 * np.pi, 160, endpoint=False)
    x, y, z = place

    def pressure(r: Array) -> Array:
        # v runs over the part of (b, a) outside r, in ξ² = max(b, r)² + v².
        low = np.maximum(r, b)
        top = np.sqrt(a**2 - low**2)
        # t² = v: the lower end is a square root in v.
        t = np.sqrt(top)[:, None] * (u + 1) / 2
        ξ = np.sqrt(low[:, None] ** 2 + t**4)
        kernel = (
            weighted_slope(ξ) / np.sqrt(ξ**2 - b**2) * t**2 / (ξ * np.sqrt((low**2 - r**2)[:, None] + t**4))
        )
        return (kernel * 2 * t * w * np.sqrt(top)[:, None] / 2).sum(axis=1) / np.pi

    total = np.zeros((2, 6))
    for inner, outer in ((0.0, b), (b, a)):
        # s² grading towards both ends, where the pressure has roots.
        s = np.sin(np.pi / 4 * (u + 1)) ** 2
        r = inner + (outer - inner) * s
        if outer == inner:
            continue
        weight = w * np.pi / 4 * np.sin(np.pi / 2 * (u + 1)) * (outer - inner) * r * pressure(r)
        X = x - r[:, None] * np.cos(angle)
        Y = y - r[:, None] * np.sin(angle)
        for load, kernel in enumerate((boussinesq, cerruti)):
            total[load] += (weight[:, None] * kernel(X, Y, z, ν)).sum(axis=(1, 2)) * (2 * np.pi / len(angle))
    return total


def boussinesq(X: Array, Y: Array, z: float, ν: float) -> Array:
    """Unit point load into the body (Johnson, Contact Mechanics, eq. 3.19)."""
    r2 = X**2 + Y**2
    ρ = np.sqrt(r2 + z**2)
    k = (1 - 2 * ν) / r2
    difference = (1 - z / ρ) * (X**2 - Y**2) / r2
    sxx = k * (difference + z * Y**2 / ρ**3) - 3 * z * X**2 / ρ**5
    syy = k * (-difference + z * X**2 / ρ**3) - 3 * z * Y**2 / ρ**5
    sxy = k * ((1 - z / ρ) * X * Y / r2 * 2 - X * Y * z / ρ**3) - 3 * X * Y * z / ρ**5
    return np.array([sxx, syy, -3 * z**3 / ρ**5, -3 * Y * z**2 / ρ**5, -3 * X * z**2 / ρ**5, sxy]) / (
        2 * np.pi
    )


def cerruti(X: Array, Y: Array, z: float, ν: float) -> Array:
    """Unit tangential point load in +x (Johnson, Contact Mechanics, eq. 3.76)."""
    ρ = np.sqrt(X**2 + Y**2 + z**2)
    a, b, c = 1 / (ρ * (ρ + z) ** 2), 1 / (ρ**3 * (ρ + z) ** 2), 2 / (ρ**2 * (ρ + z) ** 3)
    k = 1 - 2 * ν
    sxx = -3 * X**3 / ρ**5 + k * (X / ρ**3 - 3 * X * a + X**3 * (b + c))
    syy = -3 * X * Y**2 / ρ**5 + k * (X / ρ**3 - X * a + X * Y**2 * (b + c))
    sxy = -3 * X**2 * Y / ρ**5 + k * (-Y * a + X**2 * Y * (b + c))
    szz, syz, sxz = -3 * X * z**2 / ρ**5, -3 * X * Y * z / ρ**5, -3 * X**2 * z / ρ**5
    return np.array([sxx, syy, szz, syz, sxz, sxy]) / (2 * np.pi)
