"""Hooke's law for histories of stress tensors."""

from __future__ import annotations

from swtstudy.mechanics.points import FloatArray


def strain_history(
    stress: FloatArray, poisson_ratio: float | FloatArray, young_modulus: float = 1.0
) -> FloatArray:
    """Hooke's law, ε = ((1 + ν) σ − ν tr σ)/E, with tensor shear components (half the engineering ones).

    Parameters
    ----------
    stress
        Shape (..., 6).
    poisson_ratio, young_modulus
        ν, E; ν may be an array that can be broadcast to (..., 1).
    """
    strain = (1.0 + poisson_ratio) * stress
    strain[..., :3] -= poisson_ratio * stress[..., :3].sum(axis=-1, keepdims=True)
    return strain / young_modulus
