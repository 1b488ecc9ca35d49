"""The building blocks of the stress on the surface line, and the stress of them, there and on circles.

By pressure the stress at (r cos θ, r sin θ) is axisymmetric; by shear it is, over μ, with c = cos θ, s = sin
θ, j = T1 − T3 and k = (3/2) T1 − 2 T3,

    σ_xx = (1 + ν) T1 c + σ,   σ_yy = −σ,   σ_xy = T1 s/2 + ν s (2 c² k − j),   σ = ν c (2 c² k − 3 j),

since ζ = iξ at the surface makes the functions of `swtstudy.mechanics.stress.punch` depend on one another: r²
L³/R = 2 L² − L/R.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.points import FloatArray, Floats, Rows


@dataclass(frozen=True)
class History(Rows):
    """The building blocks of the stress at n × X positions and T instants, each (n, X, T).

    Attributes
    ----------
    pressure
        p in E* √(δ0/R).
    mean_pressure
        Load inside r over π r², same unit; None in the plane.
    tangential_1, tangential_3
        T1 and T3 with the springs' τ′: (1/π) ∫ 2 sin φ τ′ dφ and (1/π) ∫ 2 sin³φ τ′ dφ. In the plane A in
        the place of the first, (1/π) ∫ 2 τ′ dξ/√(x²−ξ²), and None.
    traction
        (1/π) ∫ τ′ dξ/√(ξ²−r²) over the springs outside r: −q/μ.
    bulk
        B, what a bulk stress adds to σ_xx; None without one.
    """

    pressure: FloatArray
    mean_pressure: FloatArray | None
    tangential_1: FloatArray
    tangential_3: FloatArray | None
    traction: FloatArray
    bulk: FloatArray | None = None

    def with_tangential_sign(self, sign: Floats) -> History:
        """The same with the tangential load times ±1."""
        third = None if self.tangential_3 is None else sign * self.tangential_3
        return replace(
            self, tangential_1=sign * self.tangential_1, tangential_3=third, traction=sign * self.traction
        )

    def followed_by(self, other: History) -> History:
        """These instants, then the other ones."""
        both = zip(vars(self).values(), vars(other).values(), strict=True)
        return self._made(None if one is None else np.concatenate((one, more), axis=-1) for one, more in both)

    def weighted(self, weights: FloatArray) -> History:
        """Weighted means over samples, of e · k instants and weights (n, X, e, k), at e instants."""
        shape = weights.shape

        def mean(values: FloatArray | None) -> FloatArray | None:
            return None if values is None else (values.reshape(shape) * weights).sum(axis=-1)

        return self._made(map(mean, vars(self).values()))


def stresses(
    history: History, poisson_ratio: FloatArray, friction: FloatArray, side: Floats
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """σ_xx, σ_yy, σ_zz, σ_xz in E* √(δ0/R), tension positive.

    Parameters
    ----------
    history
        Building blocks at r = |x|.
    poisson_ratio, friction
        Shape (n,).
    side
        Sign of x.
    """
    nu, mu = (v.reshape(v.shape + (1,) * (history.pressure.ndim - 1)) for v in (poisson_ratio, friction))
    if history.mean_pressure is None or history.tangential_3 is None:
        return _plane_stresses(history, nu, mu, side)
    spread = 0.5 * (1.0 - 2.0 * nu) * history.mean_pressure
    pull = side * mu
    sigma_xx = (
        spread - history.pressure + pull * ((1.0 + nu) * history.tangential_1 - nu * history.tangential_3)
    )
    if history.bulk is not None:
        sigma_xx = sigma_xx + history.bulk
    sigma_yy = -spread - 2.0 * nu * history.pressure + pull * nu * history.tangential_3
    return sigma_xx, sigma_yy, -history.pressure, mu * history.traction


def _plane_stresses(
    history: History, nu: FloatArray, mu: FloatArray, side: Floats
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """`stresses` of a plane contact: plane strain, of the bulk stress, too."""
    sigma_xx = side * mu * history.tangential_1 - history.pressure
    if history.bulk is not None:
        sigma_xx = sigma_xx + history.bulk
    sigma_yy = nu * (sigma_xx - history.pressure)
    return sigma_xx, sigma_yy, -history.pressure, mu * history.traction


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
