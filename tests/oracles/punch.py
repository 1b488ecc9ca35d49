"""The functions of one rigid flat punch, written out: the package has their integrals over the radius."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
# ruff: noqa: N815 – the names are the symbols of the theory.


class PunchFunctions(NamedTuple):
    """The ten functions; D = L²/R² + L/R³ and B = 2L³/R² + L²/R³."""

    one_over_R: ComplexArray
    L_over_R: ComplexArray
    L2_over_R: ComplexArray
    L3_over_R: ComplexArray
    L: ComplexArray
    L2: ComplexArray
    z_over_R3: ComplexArray
    zζ_over_R3: ComplexArray
    zD: ComplexArray
    zB: ComplexArray


def punch_functions(r: Array, z: Array, radius: Array) -> PunchFunctions:
    """The ten functions for one punch radius; the stresses need their imaginary parts.

    Parameters
    ----------
    r, z, radius
        Distance from the axis, depth and punch radius in one unit of length; not at r = ξ, z = 0.
    """
    ζ = z + 1j * radius
    R = np.sqrt(r * r + ζ * ζ + 0j)
    R = np.where(R.imag < 0.0, -R, R)
    L = 1.0 / (R + ζ)
    return PunchFunctions(
        one_over_R=1.0 / R,
        L_over_R=L / R,
        L2_over_R=L**2 / R,
        L3_over_R=L**3 / R,
        L=L,
        L2=L**2,
        z_over_R3=z / R**3,
        zζ_over_R3=z * ζ / R**3,
        zD=z * (L**2 / R**2 + L / R**3),
        zB=z * (2.0 * L**3 / R**2 + L**2 / R**3),
    )
