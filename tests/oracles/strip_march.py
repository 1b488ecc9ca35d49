"""A strip on an elastic half-plane by boundary elements, marched in time: no superposition, no memory.

Constant tractions on equal elements. At each instant the pressure is that of the contact without adhesion
that carries P, and the shear that of Coulomb's friction which carries Q: elements that stick move together
with the other body since the last instant, those that slip have |q| = μp against their motion. Lengths in
a_H, heights in δ0, tractions in E* δ0/a_H, loads in E* δ0; similar bodies, so that nothing couples them. A
bulk stress of one body strains its surface by half its value: u = σ x/(2 E*).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: Changes of the set of elements that touch or slip.
ROUNDS = 60


class StripMarch:
    """A profile f(x) with so many elements on |x| < ``reach``."""

    def __init__(self, f: Callable[[Array], Array], reach: float, elements: int, friction: float) -> None:
        ends = np.linspace(-reach, reach, elements + 1)
        self.x, self.width, self.friction = 0.5 * (ends[1:] + ends[:-1]), np.diff(ends), friction
        self.gap = f(np.abs(self.x))
        # u = −(2/π) ∫ ln|x − s| ds of unit tractions on the elements, but for a constant.
        right, left = self.x[:, None] - ends[:-1], self.x[:, None] - ends[1:]
        self.compliance = -2.0 / np.pi * (right * np.log(np.abs(right)) - left * np.log(np.abs(left)))
        self.pressure, self.shear = np.zeros((2, elements))
        self.bulk = 0.0

    def _solve(self, free: NDArray[np.bool_], right: Array, load: float, moved: float) -> tuple[Array, float]:
        """Tractions of the free elements that move together, and that motion."""
        index = np.flatnonzero(free)
        matrix = np.zeros((index.size + 1, index.size + 1))
        matrix[:-1, :-1] = self.compliance[np.ix_(index, index)]
        matrix[:-1, -1], matrix[-1, :-1] = -moved, self.width[index]
        found = np.linalg.solve(matrix, np.append(right[index], load))
        traction = np.zeros(free.size)
        traction[index] = found[:-1]
        return traction, float(found[-1])

    def step(self, normal: float, tangential: float, bulk: float = 0.0) -> None:
        """Move to line loads P and Q, and to a bulk stress."""
        touches = np.ones(self.x.size, dtype=bool)
        for _ in range(ROUNDS):
            pressure, approach = self._solve(touches, -self.gap, normal, 1.0)
            overlap = self.compliance @ pressure + self.gap - approach < -1e-12
            new = (touches & (pressure > 0.0)) | (~touches & overlap)
            if (new == touches).all():
                break
            touches = new
        old, limit = self.shear, self.friction * pressure
        slides = np.zeros(self.x.size)
        strain = 0.5 * (bulk - self.bulk) * self.x
        for _ in range(ROUNDS):
            sticks = touches & (slides == 0.0)
            fixed = slides * limit
            # Elements that stick keep u − (u of the other body).
            right = self.compliance @ (old - fixed) - strain
            shear, motion = self._solve(sticks, right, tangential - fixed @ self.width, 1.0)
            shear += fixed
            slip = self.compliance @ (shear - old) + strain - motion
            new = np.where(sticks & (np.abs(shear) > limit), np.sign(shear), slides)
            # What is dragged along is held back: the body follows the other one too little.
            new = np.where((slides != 0.0) & (slip * slides > 0.0), 0.0, new)
            if (new == slides).all():
                break
            slides = new
        self.pressure, self.shear, self.bulk = pressure, shear, bulk

    def stress_along(self, x: Array) -> Array:
        """σ_xx by the tractions at places of the surface that are no ends of elements."""
        left = self.x - 0.5 * self.width
        over = np.log(np.abs((x[:, None] - left) / (x[:, None] - left - self.width)))
        return -np.interp(x, self.x, self.pressure, 0.0, 0.0) - 2.0 / np.pi * over @ self.shear
