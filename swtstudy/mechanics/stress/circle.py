"""Stress on circles of the surface about the axis, from the building blocks of the surface line.

By pressure the stress at (r cos θ, r sin θ) is axisymmetric; by shear it is, over μ, with c = cos θ,
s = sin θ, j = T1 − T3 and k = (3/2) T1 − 2 T3,

    σ_xx = (1 + ν) T1 c + σ,   σ_yy = −σ,   σ_xy = T1 s/2 + ν s (2 c² k − j),   σ = ν c (2 c² k − 3 j),

since ζ = iξ at the surface makes the functions of `swtstudy.mechanics.stress.field.punch` depend on one
another: r² L³/R = 2 L² − L/R.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.history import History


def circle_stress(
    history: History, poisson_ratio: FloatArray, friction: FloatArray, angle: FloatArray
) -> FloatArray:
    """Stress on circles of the surface, shape (n, k, T, 6), components xx, yy, zz, yz, xz, xy.

    Parameters
    ----------
    history
        Building blocks in E* √(δ0/R) at one r for each of n points, shape (n, T).
    poisson_ratio, friction
        Shape (n,): ν, μ.
    angle
        Shape (n, k): θ from the x axis.
    """
    assert history.mean_pressure is not None  # in the plane there are no circles
    assert history.tangential_3 is not None
    ν, μ = poisson_ratio[:, None], friction[:, None]
    c, s = np.cos(angle)[..., None], np.sin(angle)[..., None]
    spread = 0.5 * (1.0 - 2.0 * ν) * history.mean_pressure
    radial, hoop = spread - history.pressure, -spread - 2.0 * ν * history.pressure
    blocks = radial, hoop, μ * history.tangential_1, μ * history.tangential_3
    radial, hoop, t1, t3 = (block[:, None] for block in blocks)
    ν = ν[..., None]
    j, k = t1 - t3, 1.5 * t1 - 2.0 * t3
    across = ν * c * (2.0 * c * c * k - 3.0 * j)
    stress = np.zeros((*np.broadcast_shapes(c.shape, t1.shape), 6))
    stress[..., 0] = radial * c * c + hoop * s * s + (1.0 + ν) * t1 * c + across
    if history.bulk is not None:
        stress[..., 0] += history.bulk[:, None]
    stress[..., 1] = radial * s * s + hoop * c * c - across
    stress[..., 2] = -history.pressure[:, None]
    stress[..., 4] = (μ * history.traction)[:, None]
    stress[..., 5] = (radial - hoop) * c * s + 0.5 * t1 * s + ν * s * (2.0 * c * c * k - j)
    return stress
