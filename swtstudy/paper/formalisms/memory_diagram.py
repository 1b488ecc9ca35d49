"""The method of memory diagrams: a memory function D(η), |D| ≤ 1, over the contact's history of depths η.

It weighs the increments of normal contact: u = ∫ D dη and q = μ ∫ D ∂p/∂η dη, where ∂p/∂η is the pressure of
a flat punch with the radius of the contact at depth η. Fresh ground gets D = du/dδ; where that is not
allowed, D = ±1 from the stick depth s outwards such that the displacement is right.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq

from swtstudy.vocabulary.arrays import FloatArray


@dataclass
class MemoryDiagram:
    """The present load and D, piecewise constant: ``value[i]`` from ``edge[i]`` to ``edge[i + 1]``."""

    depth: float
    displacement: float
    edge: FloatArray = field(default_factory=lambda: np.zeros(1))
    value: FloatArray = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        if self.depth > 0.0:
            self.edge, self.value = np.array([0.0, self.depth]), np.zeros(1)

    def area(self, depth: float) -> float:
        """∫ D dη from 0 to ``depth``."""
        return float(self.value @ np.diff(np.minimum(self.edge, depth)))

    def step(self, depth: float, displacement: float) -> None:
        """Move on a straight line to the given load."""
        if self.depth < 0.0 < depth:
            self.displacement += (displacement - self.displacement) * self.depth / (self.depth - depth)
            self.depth = 0.0
        du, rise = displacement - self.displacement, depth - self.depth
        if depth <= 0.0:
            self.edge, self.value = np.zeros(1), np.zeros(0)
        elif rise > 0.0 and abs(du) <= rise:
            self.edge, self.value = np.append(self.edge, depth), np.append(self.value, du / rise)
        else:
            self._slip(depth, self.area(self.depth) + du)
        self.depth, self.displacement = depth, displacement

    def _slip(self, depth: float, displacement: float) -> None:
        """D = ±1 outside of s, where ∫_0^s D dη ± (δ − s) is the displacement."""
        inner = min(depth, self.depth)
        sense = np.sign(displacement - self.area(inner))

        def lack(stick: float) -> float:
            return sense * (displacement - self.area(stick)) - (depth - stick)

        if sense == 0.0:
            stick = inner
        elif lack(0.0) >= 0.0:
            stick = 0.0  # gross slip wipes the memory
        else:
            stick = brentq(lack, 0.0, inner, xtol=1e-15, rtol=1e-14)
        keep = self.edge[:-1] < stick
        edge = np.append(self.edge[:-1][keep], [stick, depth] if stick < depth else [depth])
        self.edge = edge if keep.any() else np.array([0.0, depth])
        self.value = np.append(self.value[keep], [sense] if stick < depth else [])

    def springs(self, g: FloatArray) -> FloatArray:
        """Tangential force over μ of the equivalent springs at depths ``g``: ∫ D dη from g outwards."""
        outer = np.maximum(self.edge[:, None] - g, 0.0)
        return np.asarray(self.value @ np.diff(outer, axis=0))

    def traction(self, r: FloatArray) -> FloatArray:
        """q/μ in E* √(δ0/R): flat punches with ∂p/∂η = 1/(π √(η − r²)), as a paraboloid has η = a²."""
        root = np.sqrt(np.maximum(self.edge[:, None] - r * r, 0.0))
        return 2.0 / np.pi * (self.value @ np.diff(root, axis=0))

    def force(self) -> float:
        """Tangential force over μ E* δ0 a_H: ∫ D dN with N = 4/3 η^(3/2)."""
        return float(self.value @ np.diff(4.0 / 3.0 * np.maximum(self.edge, 0.0) ** 1.5))
