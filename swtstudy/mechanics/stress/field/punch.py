"""The stress field of one rigid flat punch of radius ξ, pressed or dragged, in closed form.

The punch carries the traction 1/√(ξ² − r²) on r < ξ, as a pressure or as a shear in +x (eqs. 13, 14). Shift
the depth into the complex plane, ζ = z + iξ, and the potential of a point load becomes that of the punch:
every stress component is the imaginary part of an algebraic function of R = √(r² + ζ²) and L = 1/(R + ζ).

All components are sums of ten functions of r, z and ζ only, with factors in x, y, z and ν that do not know ξ.
Hence the same sums serve the field of one punch and, with the ten functions integrated over ξ, of many.
"""

# ruff: noqa: N815 – the names are the symbols of the theory.

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.points import FloatArray

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
