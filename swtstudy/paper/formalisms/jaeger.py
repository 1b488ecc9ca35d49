"""Jäger's algorithm: the traction is a sum of Hertzian pressures, q/μ = Σ c p(r; D).

A step either adds the difference of the new and the old pressure, where all sticks, or a Cattaneo–Mindlin
pair ±[p(δ) − p(D*)] to what is left of the old distributions inside of the stick zone D*. Depths in δ0,
displacements as G* u/(μ E* δ0), a paraboloid.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from swtstudy.vocabulary.arrays import FloatArray


@dataclass
class JaegerContact:
    """The present load and the terms (D, c) of the superposition, D descending."""

    depth: float
    displacement: float
    terms: list[tuple[float, float]] = field(default_factory=list)

    def step(self, depth: float, displacement: float) -> None:
        """Move on a straight line to the given load."""
        if self.depth < 0.0 < depth:  # what u does before the touch-down is not felt
            share = -self.depth / (depth - self.depth)
            self.displacement += share * (displacement - self.displacement)
            self.depth = 0.0
        du, rise = displacement - self.displacement, depth - self.depth
        if depth <= 0.0:
            self.terms = []
        elif rise > 0.0 and abs(du) <= rise:
            self._add((depth, du / rise), (self.depth, -du / rise))
        else:
            self._slip(depth, du)
        self.depth, self.displacement = depth, displacement

    def _slip(self, depth: float, du: float) -> None:
        edge = min(depth, self.depth)
        sense = np.sign(sum(c * max(d - edge, 0.0) for d, c in self.terms) + du)
        if sense == 0.0:
            self.terms = [(min(d, depth), c) for d, c in self.terms]
            return
        # On each piece between old depths: Σ_{D > D*} c (D − D*) + du = sense (δ − D*).
        stick = -1.0
        ends = sorted({0.0, edge, *(d for d, _ in self.terms if d < edge)}, reverse=True)
        for high, low in pairwise(ends):
            outer = [(d, c) for d, c in self.terms if d >= high]
            slope = sense - sum(c for _, c in outer)
            excess = sense * depth - du - sum(c * d for d, c in outer)
            found = excess / slope if slope != 0.0 else (high if excess == 0.0 else -1.0)
            if low <= found * (1.0 + 1e-15) and found <= high:
                stick = found
                break
            if sense * (excess - slope * high) > 0.0:  # rounding: the edge itself
                stick = high
                break
        if stick < 0.0:  # gross slip
            self.terms = [(depth, sense)]
            return
        self.terms = [(min(d, stick), c) for d, c in self.terms]
        self._add((depth, sense), (stick, -sense))

    def _add(self, *terms: tuple[float, float]) -> None:
        total: dict[float, float] = {}
        for d, c in (*self.terms, *terms):
            total[d] = total.get(d, 0.0) + c
        self.terms = sorted(((d, c) for d, c in total.items() if c != 0.0 and d > 0.0), reverse=True)

    def springs(self, g: FloatArray) -> FloatArray:
        """Tangential force over μ of the equivalent springs at depths ``g``: Σ c (D − g) where D > g."""
        return np.sum([np.zeros_like(g), *(c * np.maximum(d - g, 0.0) for d, c in self.terms)], axis=0)

    def traction(self, r: FloatArray) -> FloatArray:
        """q/μ in E* √(δ0/R) by Hertz's pressures."""
        hertz = (c * 2.0 / np.pi * np.sqrt(np.maximum(d - r * r, 0.0)) for d, c in self.terms)
        return np.sum([np.zeros_like(r), *hertz], axis=0)

    def force(self) -> float:
        """Tangential force over μ E* δ0 a_H by Hertz's forces."""
        return sum(c * 4.0 / 3.0 * d**1.5 for d, c in self.terms)
