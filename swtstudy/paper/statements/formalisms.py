"""Section 3.1: Jäger's algorithm, memory diagrams and springs solve the same contact problem.

For a paraboloid; depths in δ0, displacements as G* u/(μ E* δ0).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from swtstudy.paper.reference import march_springs
from swtstudy.paper.statements.statement import Finding, statement
from swtstudy.vocabulary.arrays import FloatArray


class Formalism:
    """A contact's present load, which moves on straight lines from one to the next.

    Parameters
    ----------
    depth, displacement
        The first load.
    """

    def __init__(self, depth: float, displacement: float) -> None:
        self.depth, self.displacement = depth, displacement

    def step(self, depth: float, displacement: float) -> None:
        """Move on a straight line to the given load."""
        if self.depth < 0.0 < depth:  # what u does before the touch-down is not felt
            self.displacement += (displacement - self.displacement) * self.depth / (self.depth - depth)
            self.depth = 0.0
        self.move(depth, displacement - self.displacement)
        self.depth, self.displacement = depth, displacement

    def move(self, depth: float, du: float) -> None:
        """Change the memory by a step to a depth, with a displacement by du."""
        raise NotImplementedError


class JaegerContact(Formalism):
    """Jäger's algorithm: the traction is a sum of Hertzian pressures, q/μ = Σ c p(r; D).

    A step either adds the difference of the new and the old pressure, where all sticks, or a Cattaneo–Mindlin
    pair ±[p(δ) − p(D*)] to what is left of the old distributions inside of the stick zone D*.
    """

    def __init__(self, depth: float, displacement: float) -> None:
        super().__init__(depth, displacement)
        #: The terms (D, c) of the superposition, D descending.
        self.terms: list[tuple[float, float]] = []

    def move(self, depth: float, du: float) -> None:
        rise = depth - self.depth
        if depth <= 0.0:
            self.terms = []
            return
        if rise > 0.0 and abs(du) <= rise:
            self._add((depth, du / rise), (self.depth, -du / rise))
            return
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


class MemoryDiagram(Formalism):
    """The method of memory diagrams: a memory function D(η), |D| ≤ 1, over the contact's history of depths η.

    It weighs the increments of normal contact: u = ∫ D dη and q = μ ∫ D ∂p/∂η dη, where ∂p/∂η is the pressure
    of a flat punch with the radius of the contact at depth η. Fresh ground gets D = du/dδ; where that is not
    allowed, D = ±1 from the stick depth s outwards such that the displacement is right.
    """

    def __init__(self, depth: float, displacement: float) -> None:
        super().__init__(depth, displacement)
        #: D, piecewise constant: ``value[i]`` from ``edge[i]`` to ``edge[i + 1]``.
        self.edge: FloatArray = np.array([0.0, depth] if depth > 0.0 else [0.0])
        self.value: FloatArray = np.zeros(self.edge.size - 1)

    def area(self, depth: float) -> float:
        """∫ D dη from 0 to ``depth``."""
        return float(self.value @ np.diff(np.minimum(self.edge, depth)))

    def move(self, depth: float, du: float) -> None:
        rise = depth - self.depth
        if depth <= 0.0:
            self.edge, self.value = np.zeros(1), np.zeros(0)
            return
        if rise > 0.0 and abs(du) <= rise:
            self.edge, self.value = np.append(self.edge, depth), np.append(self.value, du / rise)
            return
        displacement = self.area(self.depth) + du
        inner = min(depth, self.depth)
        sense = np.sign(displacement - self.area(inner))

        def lack(stick: float) -> float:
            """The displacement's integral ∫ D dη ± (δ − s), D up to s."""
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


#: Random load paths, their corners, and springs across the largest contact.
_PATHS, _CORNERS, _SPRINGS = 20, 40, 401
#: Differences up to here, in units of the largest spring force, are rounding summed along a path.
_ROUNDING = 1e-9


def random_path(seed: int) -> tuple[FloatArray, FloatArray]:
    """Depth and tangential displacement at the corners of a random path; every fourth path lifts off.

    Returns
    -------
    depth, displacement
        Shape (corners,), in δ0 and μE*δ0/G*.
    """
    rng = np.random.default_rng(seed)
    depth = rng.uniform(-0.3 if seed % 4 == 0 else 0.05, 1.6, _CORNERS)
    # From nearly normal to nearly tangential motion.
    displacement = np.cumsum(rng.normal(size=_CORNERS)) * 10.0 ** rng.uniform(-1.0, 0.2)
    depth[0], displacement[0] = 1.0, 0.0
    return depth, displacement


@statement("Section 3.1")
def formalisms_agree() -> Finding:
    """Jäger's algorithm, the method of memory diagrams and the MDR are equivalent.

    Holds if: their solutions differ by no more than rounding, 1e-9, on random load paths
    """
    worst = 0.0
    for depth, displacement in map(random_path, range(_PATHS)):
        g = np.linspace(0.0, depth.max(), _SPRINGS)
        _, springs = march_springs(g, depth, displacement, periods=1)
        contacts = JaegerContact(depth[0], displacement[0]), MemoryDiagram(depth[0], displacement[0])
        apart = 0.0
        for corner in range(1, len(depth)):
            found = [springs[corner]]
            for contact in contacts:
                contact.step(depth[corner], displacement[corner])
                found.append(contact.springs(g))
            apart = max(apart, float(np.ptp(found, axis=0).max()))
        worst = max(worst, apart / float(np.abs(springs).max()))
    measured = (
        f"on {_PATHS} random paths of {_CORNERS} corners, with gross slip and lift-off, tangential forces of "
        f"{_SPRINGS} springs differ by up to {worst:.0e} of the largest"
    )
    return Finding(measured, worst <= _ROUNDING)
