"""The building blocks of the stress on the surface line, and the stress that is made of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class History:
    """The building blocks of the stress at n × X positions and T instants, each (n, X, T).

    Attributes
    ----------
    pressure
        p in E* √(δ0/R).
    mean_pressure
        Load inside r over π r², same unit.
    tangential_1, tangential_3
        T1 and T3 with the springs' τ′: (1/π) ∫ 2 sin φ τ′ dφ and (1/π) ∫ 2 sin³φ τ′ dφ.
    traction
        (1/π) ∫ τ′ dξ/√(ξ²−r²) over the springs outside r: −q/μ.
    """

    pressure: FloatArray
    mean_pressure: FloatArray
    tangential_1: FloatArray
    tangential_3: FloatArray
    traction: FloatArray

    def take(self, *index: NDArray[np.intp] | int) -> History:
        """The blocks at ``index`` of the leading axes."""
        return History(*(values[index] for values in vars(self).values()))

    def with_tangential_sign(self, sign: float | FloatArray) -> History:
        """The same with the tangential load times ±1."""
        tangential = (sign * v for v in (self.tangential_1, self.tangential_3, self.traction))
        return History(self.pressure, self.mean_pressure, *tangential)

    def joined(self, other: History) -> History:
        """These instants, then the other ones."""
        both = zip(vars(self).values(), vars(other).values(), strict=True)
        return History(*(np.concatenate(pair, axis=-1) for pair in both))


def stresses(
    history: History, poisson_ratio: FloatArray, friction: FloatArray, side: float | FloatArray
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
    spread = 0.5 * (1.0 - 2.0 * nu) * history.mean_pressure
    pull = side * mu
    sigma_xx = (
        spread - history.pressure + pull * ((1.0 + nu) * history.tangential_1 - nu * history.tangential_3)
    )
    sigma_yy = -spread - 2.0 * nu * history.pressure + pull * nu * history.tangential_3
    return sigma_xx, sigma_yy, -history.pressure, mu * history.traction
