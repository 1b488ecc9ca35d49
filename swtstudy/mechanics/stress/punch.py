"""The stress field of a rigid flat punch of radius ξ, pressed or dragged, and its integrals over ξ.

The punch carries the traction 1/√(ξ² − r²) on r < ξ, as a pressure or as a shear in +x (eqs. 13, 14). Shift
the depth into the complex plane, ζ = z + iξ, and the potential of a point load becomes that of the punch:
every stress component is the imaginary part of an algebraic function of R = √(r² + ζ²) and L = 1/(R + ζ).

All components are sums of ten functions of r, z and ζ only, with factors in x, y, z and ν that do not know ξ.
Hence the same sums serve the field of one punch and, with the ten functions integrated over ξ, of many.

The integrals over ξ have the weights 1 and ξ. With U = R + ζ one has dζ/R = dU/U: every function times a
power of η = iξ = ζ − z integrates to powers of L = 1/U and one logarithm. Write I[n, m] = ∫ ηⁿ Lᵐ/R dζ and
J[n, m] = ∫ ηⁿ Lᵐ dζ; integration by parts gives

    I[0, 0] = ln U,   I[0, m] = −Lᵐ/m,   I[1, 0] = R − z ln U,
    I[n, m] = (−ηⁿ Lᵐ + n (I[n−1, m−1] − z I[n−1, m])) / (m + n),
    J[n, m] = (ηⁿ⁺¹ Lᵐ + m (I[n, m−1] − z I[n, m])) / (m + n + 1),

and the functions with 1/R³ are derivatives: 1/R³ = −(L/R)′, ζ/R³ = −(1/R)′, D = −(L²/R)′, B = −(L³/R)′.
Nothing here divides by r or z, so that the axis and the surface are ordinary places.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.numerics.arrays import TINY_ROOT
from swtstudy.mechanics.points import FloatArray

# ruff: noqa: N815 – the names are the symbols of the theory.


ComplexArray = NDArray[np.complex128]

#: Order of the stress components along the last axis (Voigt).
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")


class PunchFunctions(NamedTuple):
    """The ten functions of which a punch's field is made (or their integrals over ξ).

    Those with a factor z are kept with it: their product is finite at the surface, they alone are not.
    """

    one_over_R: NDArray  # 1/R
    L_over_R: NDArray  # L/R
    L2_over_R: NDArray  # L²/R
    L3_over_R: NDArray  # L³/R
    L: NDArray
    L2: NDArray  # L²
    z_over_R3: NDArray  # z/R³
    zζ_over_R3: NDArray  # zζ/R³
    zD: NDArray  # z (L²/R² + L/R³)
    zB: NDArray  # z (2L³/R² + L²/R³)


def complex_distance(r: FloatArray, z: FloatArray, radius: FloatArray) -> ComplexArray:
    """R = √(r² + (z + iξ)²) with Im R ≥ 0.

    Parameters
    ----------
    r, z, radius
        Distance from the axis, depth and punch radius ξ ≥ 0, broadcastable, in one unit of length.
    """
    # (r − ξ)(r + ξ) keeps the digits of r² − ξ² next to the punch's edge; the imaginary part is never −0.
    square = np.empty(np.broadcast_shapes(r.shape, z.shape, radius.shape), dtype=complex)
    square.real = (r - radius) * (r + radius) + z * z
    square.imag = 2.0 * z * radius
    return np.sqrt(square)


def normal_components(
    f: PunchFunctions, x: FloatArray, y: FloatArray, z: FloatArray, poisson_ratio: ArrayLike
) -> FloatArray:
    """Six stress components, last axis as `COMPONENTS`, under pressure on the punch.

    Parameters
    ----------
    f
        Imaginary parts of the ten functions, or those of their integrals over ξ.
    x, y, z
        Position, broadcastable with the functions.
    poisson_ratio
        ν.
    """
    ν = np.asarray(poisson_ratio)
    axial = 2.0 * ν * f.one_over_R - z * f.L_over_R + (1.0 - 2.0 * ν) * f.L
    radial = f.zD - (1.0 - 2.0 * ν) * f.L2_over_R
    return stacked(
        axial + x * x * radial,
        axial + y * y * radial,
        f.one_over_R + f.zζ_over_R3,
        y * f.z_over_R3,
        x * f.z_over_R3,
        x * y * radial,
    )


def tangential_components(
    f: PunchFunctions, x: FloatArray, y: FloatArray, z: FloatArray, poisson_ratio: ArrayLike
) -> FloatArray:
    """Six stress components, last axis as `COMPONENTS`, under shear in +x on the punch.

    Parameters
    ----------
    f, x, y, z, poisson_ratio
        As for `normal_components`.
    """
    ν = np.asarray(poisson_ratio)
    z_L2_over_R = z * f.L2_over_R
    twist = 2.0 * ν * x * (x * x * f.L3_over_R - 1.5 * f.L2)
    return stacked(
        x * (2.0 * (1.0 + ν) * f.L_over_R - 3.0 * z_L2_over_R + x * x * f.zB) + twist,
        x * (y * y * f.zB - z_L2_over_R) - twist,
        x * f.z_over_R3,
        x * y * f.zD,
        f.one_over_R - z * f.L_over_R + x * x * f.zD,
        y * (2.0 * ν * (x * x * f.L3_over_R - 0.5 * f.L2) + f.L_over_R - z_L2_over_R + x * x * f.zB),
    )


def stacked(*components: FloatArray) -> FloatArray:
    """Components along the last axis."""
    return np.stack(np.broadcast_arrays(*components), axis=-1)


def primitives(r: FloatArray, z: FloatArray, radius: FloatArray) -> tuple[PunchFunctions, PunchFunctions]:
    """Indefinite integrals over ξ of the ten functions' imaginary parts, weighted with 1 and with ξ.

    Parameters
    ----------
    r, z, radius
        Distance from the axis, depth z ≥ 0 and punch radius ξ ≥ 0, broadcastable, in one unit of length.

    Returns
    -------
    plain, weighted
        Real: ∫ Im f dξ and ∫ ξ Im f dξ.
    """
    R = complex_distance(r, z, radius)
    η = 1j * radius
    U = R + (z + η)
    # The origin, seen from the punch of radius 0: a slope that starts with g′(0) = 0 gives it no weight.
    origin = np.abs(U) < TINY_ROOT
    U[origin] = TINY_ROOT
    L = 1.0 / U
    L[origin] = 0.0
    # At the edge of the punch in the surface z/R is 0/0, with the limit 0.
    z_over_R = np.divide(z, R, out=np.zeros_like(R), where=R != 0.0)

    logU = np.log(U)
    L2 = L * L
    L3 = L2 * L
    I0 = (logU, -L, L2 * -0.5, L3 * (-1.0 / 3.0))
    # What both recursions need: I[n, m−1] − z I[n, m] for n = 0.
    K0 = (I0[0] - z * I0[1], I0[1] - z * I0[2], I0[2] - z * I0[3])
    ηL, ηL2, ηL3 = η * L, η * L2, η * L3
    I1 = (R - z * logU, (K0[0] - ηL) * 0.5, (K0[1] - ηL2) * (1.0 / 3.0), (K0[2] - ηL3) * 0.25)
    J0 = ((ηL + K0[0]) * 0.5, (ηL2 + 2.0 * K0[1]) * (1.0 / 3.0))
    J1 = ((η * ηL + I1[0] - z * I1[1]) * (1.0 / 3.0), (η * ηL2 + 2.0 * (I1[1] - z * I1[2])) * 0.25)
    boundary = (-z_over_R * L, -z_over_R, -z_over_R * L2, -z_over_R * L3)

    # ∫ f dξ = −i ∫ f dζ, and ξ = −iη: the imaginary parts are −Re and −Im.
    plain = PunchFunctions(*(-f.real for f in (*I0, *J0, *boundary)))
    inner = (I0[1], I0[0], I0[2], I0[3])
    weighted = PunchFunctions(
        *(-f.imag for f in (*I1, *J1)),
        *(-(radius * f.real + z * g.imag) for f, g in zip(boundary, inner, strict=True)),
    )
    return plain, weighted
