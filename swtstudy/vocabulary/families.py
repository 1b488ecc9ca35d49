"""The families of profiles: a profile is one function of s and one row of a table.

The function is dG/ds at s = √(ξ² − b²), with G = g/δ0 the depth of the spring at ξ (eq. 11), or in the plane
G = N/N_0, the line load at the half-width ξ over N_0 = π/4, the mean one in E* δ0. In s it is smooth, also
beside a flat face of radius b. Lengths are in a_H. Depths, forces, radii and pressures follow from it, in
`swtstudy.solver.at_rest` and in `swtstudy.kernel.profiles`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from typing import Any, NamedTuple

import numpy as np

from swtstudy.vocabulary.arrays import FloatArray

#: N_0: the mean line load over E* δ0.
MEAN_LOAD = 0.25 * np.pi
#: Coefficients of the series of a wave, which die out to rounding.
WAVE_ORDER = 26


def power_law(s: FloatArray, exponent: Any) -> FloatArray:
    """dG/ds of G = ξⁿ: the paraboloid (3) and the cylinder for n = 2."""
    return exponent * s ** (exponent - 1.0)


def rounded_punch(s: FloatArray, b: Any) -> FloatArray:
    """dG/ds of (4): g′ = 2√(ξ² − b²) − b arccos(b/ξ)."""
    return (2.0 * s - b * np.arctan2(s, b)) * s / np.hypot(s, b)


def truncated_paraboloid(s: FloatArray, b: Any) -> FloatArray:
    """dG/ds of (5): g′ = (2ξ² − b²)/√(ξ² − b²)."""
    return (2.0 * s * s + b * b) / np.hypot(s, b)


def wavy_paraboloid(s: FloatArray, amplitude: Any, wavelength: Any) -> FloatArray:
    """dG/ds of (6): g = ξ² + (π/2) h k ξ H₀(kξ)."""
    k = wave_number(amplitude, wavelength)
    return 2.0 * s + 0.5 * np.pi * amplitude * k * wave(k * s)


def rounded_flat(s: FloatArray, b: Any) -> FloatArray:
    """dG/ds of the flat with rounded edges: N = ½ [ξ² arctan(s/b) − b s]."""
    return s * np.arctan2(s, b) / MEAN_LOAD


def wavy_cylinder(s: FloatArray, amplitude: Any, wavelength: Any) -> FloatArray:
    """dG/ds of the wavy cylinder: N = πξ²/4 + (π/2) h k ξ J₁(kξ)."""
    from scipy.special import j0  # as long to import as all else, and few need it

    k = wave_number(amplitude, wavelength)
    return 2.0 * s * (1.0 + amplitude * k * k * j0(k * s))


def wave_number(amplitude: Any, wavelength: Any) -> Any:
    """k = 2π/λ in 1/a_H of h/δ0 and λ/√(hR); 0 without waves."""
    length = np.asarray(wavelength * np.sqrt(amplitude))
    return np.divide(2.0 * np.pi, length, out=np.zeros_like(length), where=length > 0.0)


class Form(NamedTuple):
    """The form of the profiles of a family.

    Attributes
    ----------
    density
        dG/ds of an array of s and of the shape parameters, in the order of the family's row in
        `swtstudy.vocabulary.choices.FAMILIES`.
    rises
        Power of s as which G rises at s = 0.
    faced, singular
        Whether the first parameter is the radius of a flat face, and whether the pressure has no bound at
        the edge of that.
    """

    density: Callable[..., FloatArray]
    rises: int = 2
    faced: bool = False
    singular: bool = False


FORMS: dict[str, Form] = {
    "paraboloid": Form(power_law),
    "rounded_punch": Form(rounded_punch, rises=3, faced=True),
    "truncated_paraboloid": Form(truncated_paraboloid, rises=1, faced=True, singular=True),
    "wavy_paraboloid": Form(wavy_paraboloid),
    "power_law": Form(power_law),
    "cylinder": Form(power_law),
    "rounded_flat": Form(rounded_flat, rises=3, faced=True),
    "wavy_cylinder": Form(wavy_cylinder),
    "power_law_cylinder": Form(power_law),
}


def length_law(profile: str, shape: Mapping[str, float]) -> tuple[float, float]:
    """Coefficient c and power p in a_H = R (δ0/(c R))ᵖ, the contact radius at δ0 were there no shape."""
    if "exponent" not in shape:
        return 1.0, 0.5
    from scipy.special import beta

    # f = rⁿ/(n Rⁿ⁻¹), whose slope at R is 1: a_H = √(R δ0) at n = 2. g = ξ/2 B(n/2, 1/2) (ξ/R)ⁿ⁻¹, and in the
    # plane N = E* ξⁿ/Rⁿ⁻¹ ∫ sⁿ/√(1 − s²) ds, which is N_0 at a_H.
    n = shape["exponent"]
    if profile == "power_law":
        return 0.5 * float(beta(0.5 * n, 0.5)), 1.0 / n
    return 0.5 * float(beta(0.5 * (n + 1.0), 0.5)) / MEAN_LOAD, 1.0 / n


def smallest_wavelength(
    profile: str, largest_depth: Any, h: FloatArray, wavelength: FloatArray
) -> FloatArray:
    """Smallest λ/√(hR) with a compact contact up to a depth, over the phases that waves λ have there.

    dG/ds ∝ 2z + (π/2) (4π² hR/λ²) A(z), A the function `wave`, or 1 + (4π² hR/λ²) J₀(z), with z = kξ.
    """
    with np.errstate(divide="ignore", over="ignore"):  # too short for a float: all phases are reached
        phase = 2.0 * np.pi * np.sqrt(largest_depth) / (wavelength * np.sqrt(h)) + np.pi
    deepest = np.maximum(np.interp(phase, *_deepest_troughs(profile)), 0.0)
    factor = np.pi**3 if profile == "wavy_paraboloid" else 4.0 * np.pi**2
    return np.asarray(np.sqrt(factor * deepest))


@lru_cache
def _deepest_troughs(profile: str) -> tuple[FloatArray, FloatArray]:
    """Phases kξ, and the greatest −A/z or −J₀ up to each: the first minimum, below 8, is the deepest."""
    z = np.linspace(1e-3, 8.0, 2001)
    if profile == "wavy_paraboloid":
        return z, np.maximum.accumulate(-wave(z) / z)
    from scipy.special import j0

    return z, np.maximum.accumulate(-j0(z))


def wave(x: FloatArray) -> FloatArray:
    """H₀(x) + x (2/π − H₁(x)), the derivative of x H₀(x), from series over one wave each."""
    number = (x * (0.5 / np.pi)).astype(np.intp)
    series = _waves(8 * (int(number.max(initial=0)) // 8 + 1))
    y = x / np.pi - 2.0 * number - 1.0
    later, latest = np.zeros_like(y), np.zeros_like(y)
    for k in range(WAVE_ORDER - 1, 0, -1):  # Clenshaw's recurrence
        latest, later = series[k].take(number) + 2.0 * y * latest - later, latest
    return np.asarray(series[0].take(number) + y * latest - later)


@lru_cache(maxsize=16)
def _waves(count: int) -> FloatArray:
    """The series of the first waves, shape (WAVE_ORDER, count)."""
    return np.ascontiguousarray(np.stack([_series_of_wave(j) for j in range(count)], axis=1))


@cache
def _series_of_wave(j: int) -> FloatArray:
    """Coefficients of `wave` over [2πj, 2π(j + 1)]; SciPy's Struve functions take 50 µs a value."""
    from scipy.special import struve

    y = np.cos(np.pi * (np.arange(WAVE_ORDER) + 0.5) / WAVE_ORDER)
    x = np.pi * (2.0 * j + 1.0 + y)
    value = struve(0, x) + x * (2.0 / np.pi - struve(1, x))
    return np.polynomial.chebyshev.chebfit(y, value, WAVE_ORDER - 1)
