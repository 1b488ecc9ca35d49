"""The plane stress field of one rigid flat strip of half-width ξ, pressed or dragged, in closed form.

The strip carries the traction 1/√(ξ² − x²) on |x| < ξ, as a pressure or as a shear in +x. With w = x + iz and
I = 1/√(w² − ξ²), ~ 1/w far away, all components in the section are made of I and z I′; what is across it is
of plane strain. Both are superposed over ξ as they are: ∫ I dξ = arcsin(ξ/w), ∫ ξ I dξ = −√(w² − ξ²).

The functions are those at |x|: mirroring x changes the sign of Re I and of Im I′.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.numerics.arrays import TINY_ROOT
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.punch import stacked


class StripFunctions(NamedTuple):
    """The four functions of which a strip's field is made (or their integrals over ξ)."""

    real: NDArray  # Re I
    imaginary: NDArray  # Im I
    z_real: NDArray  # z Re I′
    z_imaginary: NDArray  # z Im I′


def strip_primitives(
    x: FloatArray, z: FloatArray, radius: FloatArray
) -> tuple[StripFunctions, StripFunctions]:
    """Indefinite integrals of the functions over ξ, weighted with 1 and with ξ."""
    w = _place(x, z)
    root = _root(w, radius)
    # At the edge of the strip in the surface z/√ is 0/0, with the limit 0.
    over = np.divide(z, root, out=np.zeros_like(root), where=root != 0.0)
    # arcsin(ξ/w), on the side of the real axis from which w comes.
    turn = -1j * np.log((root + 1j * radius) / w)
    parts = (turn, -radius / w * over), (-root, -w * over)
    plain, weighted = (StripFunctions(f.real, f.imag, g.real, g.imag) for f, g in parts)
    return plain, weighted


def _place(x: FloatArray, z: FloatArray) -> NDArray[np.complex128]:
    w = np.abs(x) + 1j * z
    return np.where(np.abs(w) < TINY_ROOT, TINY_ROOT, w)


def _root(w: NDArray[np.complex128], radius: FloatArray) -> NDArray[np.complex128]:
    """√(w² − ξ²), ~ w far away; each factor is in the upper half of the plane."""
    return np.asarray(np.sqrt(w - radius) * np.sqrt(w + radius))


def normal_components(
    f: StripFunctions, x: FloatArray, y: FloatArray, z: FloatArray, poisson_ratio: ArrayLike
) -> FloatArray:
    """Six stress components, last axis as `punch.COMPONENTS`, under pressure on the strip.

    Parameters
    ----------
    f
        The functions, or their integrals over ξ.
    x, y, z
        Position, broadcastable with the functions; nothing depends on y.
    poisson_ratio
        ν.
    """
    along, down = f.imaginary + f.z_real, f.imaginary - f.z_real
    return _in_plane_strain(along, down, -np.sign(x) * f.z_imaginary, poisson_ratio)


def tangential_components(
    f: StripFunctions, x: FloatArray, y: FloatArray, z: FloatArray, poisson_ratio: ArrayLike
) -> FloatArray:
    """Six stress components, last axis as `punch.COMPONENTS`, under shear in +x; as `normal_components`."""
    side = np.sign(x)
    along, down = side * (f.z_imaginary - 2.0 * f.real), -side * f.z_imaginary
    return _in_plane_strain(along, down, f.imaginary + f.z_real, poisson_ratio)


def _in_plane_strain(
    along: FloatArray, down: FloatArray, shear: FloatArray, poisson_ratio: ArrayLike
) -> FloatArray:
    none = np.zeros_like(along)
    return stacked(along, np.asarray(poisson_ratio) * (along + down), down, none, shear, none)
