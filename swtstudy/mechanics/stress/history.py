"""The building blocks of the stress on the surface line, and the stress that is made of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

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
    bulk
        B, what a bulk stress adds to σ_xx; None without one.
    """

    pressure: FloatArray
    mean_pressure: FloatArray
    tangential_1: FloatArray
    tangential_3: FloatArray
    traction: FloatArray
    bulk: FloatArray | None = None

    def take(self, *index: NDArray[np.intp] | int) -> History:
        """The blocks at ``index`` of the leading axes."""
        bulk = None if self.bulk is None else self.bulk[index]
        return History(*(values[index] for values in self._blocks)).carrying(bulk)

    def with_tangential_sign(self, sign: float | FloatArray) -> History:
        """The same with the tangential load times ±1."""
        tangential = (sign * v for v in (self.tangential_1, self.tangential_3, self.traction))
        return History(self.pressure, self.mean_pressure, *tangential).carrying(self.bulk)

    def joined(self, other: History) -> History:
        """These instants, then the other ones."""
        both = zip(self._blocks, other._blocks, strict=True)
        bulk = None
        if self.bulk is not None and other.bulk is not None:
            bulk = np.concatenate([self.bulk, other.bulk], axis=-1)
        return History(*(np.concatenate(pair, axis=-1) for pair in both)).carrying(bulk)

    def carrying(self, bulk: FloatArray | None) -> History:
        """The same with a bulk stress, shape (n, X, T)."""
        return replace(self, bulk=bulk)

    @property
    def _blocks(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """What the contact makes."""
        of_traction = self.tangential_1, self.tangential_3, self.traction
        return self.pressure, self.mean_pressure, *of_traction


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
    if history.bulk is not None:
        sigma_xx = sigma_xx + history.bulk
    sigma_yy = -spread - 2.0 * nu * history.pressure + pull * nu * history.tangential_3
    return sigma_xx, sigma_yy, -history.pressure, mu * history.traction
