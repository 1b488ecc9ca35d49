"""The springs of the MDR marched step by step along a path of displacements or forces.

Where a force is prescribed, the displacement is solved for at every step so that the springs carry it. Depths
are over δ0, tangential displacements over μ E* δ0/G*, forces over the springs' own at δ0, times μ the
tangential one.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


@dataclass
class ForceMarch:
    """Springs in the middle of cells of the radius: their g(ξ)/δ0 and the widths of the cells."""

    g: Array
    width: Array

    def __post_init__(self) -> None:
        self.unit = self.total(np.maximum(1.0 - self.g, 0.0))
        self.tau, self.depth, self.displacement = np.zeros_like(self.g), 0.0, 0.0

    def total(self, force: Array) -> float:
        """Sum over the springs."""
        return float(force @ self.width)

    def depth_at(self, normal: float, is_force: bool) -> float:
        """The indentation depth at a prescribed normal load."""
        if not is_force:
            return normal
        # The force of springs is piecewise linear between the depths at which one of them touches.
        order = np.argsort(self.g)
        g, width = self.g[order], np.cumsum(self.width[order])
        force = np.append(0.0, np.cumsum(width[:-1] * np.diff(g)))
        return float(np.interp(normal * self.unit, force, g))

    def step(self, depth: float, tangential: float, is_force: bool) -> None:
        """Move to a depth and a tangential displacement or force; springs that touch take part from then."""
        w = np.maximum(depth - self.g, 0.0)
        rise = max(depth - self.depth, 1e-300)
        share = np.where(self.depth > self.g, 1.0, np.clip((depth - self.g) / rise, 0.0, 1.0))
        old = self.tau

        def moved(du: float) -> Array:
            return np.clip(old + share * du, -w, w)

        du = tangential - self.displacement
        if is_force:
            du = self._solve(moved, tangential * self.unit, w, share)
        self.tau = moved(du)
        self.displacement += du
        self.depth = depth

    def _solve(self, moved, goal: float, w: Array, share: Array) -> float:  # type: ignore[no-untyped-def]
        """The piecewise linear equation for the displacement: Newton's method."""
        du = 0.0
        for _ in range(100):
            tau = moved(du)
            lack = goal - self.total(tau)
            stiffness = self.total(np.where(np.abs(tau) < w, share, 0.0))
            if abs(lack) < 1e-14 * self.unit or stiffness == 0.0:
                break
            du += lack / stiffness
        else:
            low = high = 0.0
            while self.total(moved(high)) < goal:
                high = 2.0 * high + 0.1
            while self.total(moved(low)) > goal:
                low = 2.0 * low - 0.1
            du = brentq(lambda d: self.total(moved(d)) - goal, low, high, xtol=1e-15)
        return du


def second_round(
    springs: ForceMarch,
    normal: Array,
    tangential: Array,
    normal_force: bool,
    tangential_force: bool,
    moved: Array | None = None,
) -> Array:
    """Forces τ of the springs at each point of a closed path in its second round, (points, springs).

    The path starts from its first normal load without a tangential one. ``moved`` takes the displacements.
    """
    depths = [springs.depth_at(value, normal_force) for value in normal]
    springs.step(depths[0], 0.0, is_force=False)
    springs.tau[:] = 0.0
    found = np.empty((len(depths), len(springs.g)))
    for _ in range(2):
        for k, (depth, value) in enumerate(zip(depths, tangential, strict=True)):
            springs.step(depth, value, tangential_force)
            found[k] = springs.tau
            if moved is not None:
                moved[k] = springs.displacement
    return found
