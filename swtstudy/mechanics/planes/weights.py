"""Weights with which the six components of a tensor make linear functionals of it; Hooke's law."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray, Floats


def strain_history(stress: FloatArray, poisson_ratio: Floats, young_modulus: Floats = 1.0) -> FloatArray:
    """Hooke's law, ε = ((1 + ν) σ − ν tr σ)/E, with tensor shear components (half the engineering ones).

    Parameters
    ----------
    stress
        Shape (..., 6).
    poisson_ratio, young_modulus
        ν, E; they may be arrays that can be broadcast to (..., 1).
    """
    strain = (1.0 + poisson_ratio) * stress
    strain[..., :3] -= poisson_ratio * stress[..., :3].sum(axis=-1, keepdims=True)
    return strain / young_modulus


def normal_weights(normal: FloatArray) -> FloatArray:
    """Weights of the components xx, yy, zz, yz, xz, xy in nᵀ σ n, shape (..., 6), for normals (..., 3)."""
    return bilinear_weights(normal, normal)


def bilinear_weights(left: FloatArray, right: FloatArray) -> FloatArray:
    """Weights of the six components in lᵀ σ r, shape (..., 6), for vectors of shape (..., 3)."""
    lx, ly, lz = left[..., 0], left[..., 1], left[..., 2]
    rx, ry, rz = right[..., 0], right[..., 1], right[..., 2]
    weights = np.empty((*np.broadcast_shapes(lx.shape, rx.shape), 6))
    weights[..., 0], weights[..., 1], weights[..., 2] = lx * rx, ly * ry, lz * rz
    weights[..., 3], weights[..., 4] = ly * rz + lz * ry, lx * rz + lz * rx
    weights[..., 5] = lx * ry + ly * rx
    return weights


def symmetric_tensor(components: FloatArray) -> FloatArray:
    """Matrices of shape (..., 3, 3) from the components xx, yy, zz, yz, xz, xy."""
    return components[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]


def squared(components: FloatArray) -> FloatArray:
    """The components of the squares of tensors, (..., 6)."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(components, -1, 0)
    parts = [xx * xx + xy * xy + xz * xz, xy * xy + yy * yy + yz * yz, xz * xz + yz * yz + zz * zz]
    parts += [xy * xz + yy * yz + yz * zz, xx * xz + xy * yz + xz * zz, xx * xy + xy * yy + xz * yz]
    return np.stack(parts, axis=-1)


def jet_weights(normal: FloatArray, tangent: FloatArray) -> FloatArray:
    """Weights of the six components in nᵀ σ n and its derivatives along great circles, shape (n, 6, 6).

    The columns: value; first derivatives along the two tangents; second derivatives 11, 22, 12.
    """
    first, second = tangent[:, 0], tangent[:, 1]
    value = normal_weights(normal)
    return np.stack(
        [
            value,
            2.0 * bilinear_weights(normal, first),
            2.0 * bilinear_weights(normal, second),
            2.0 * (normal_weights(first) - value),
            2.0 * (normal_weights(second) - value),
            2.0 * bilinear_weights(first, second),
        ],
        axis=-1,
    )


def apply_jets(jets: FloatArray, components: FloatArray) -> FloatArray:
    """Jets, (n, …, 6), of components (n, 6) or (n, k, 6) by `jet_weights` of n planes."""
    if components.ndim == 2:
        return (components[:, None, :] @ jets)[:, 0]
    return components @ jets


def tangent_basis(normal: FloatArray) -> FloatArray:
    """Two unit vectors normal to each normal and to one another, shape (n, 2, 3)."""
    least = np.argmin(np.abs(normal), axis=-1)
    first = _cross(normal, np.eye(3)[least])
    first /= np.linalg.norm(first, axis=-1, keepdims=True)
    return np.stack([first, _cross(normal, first)], axis=1)


def _cross(left: FloatArray, right: FloatArray) -> FloatArray:
    """``np.cross`` of vectors of shape (n, 3), several times as fast."""
    (a, b, c), (d, e, f) = left.T, right.T
    return np.stack([b * f - c * e, c * d - a * f, a * e - b * d], axis=-1)
