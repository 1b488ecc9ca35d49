"""Section 3.1: Jäger's algorithm, memory diagrams and springs solve the same contact problem.

For a paraboloid; depths in δ0, displacements as G* u/(μ E* δ0). No code is shared with the solver.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from scipy.optimize import brentq

from swtstudy.paper.statements import Measured
from swtstudy.vocabulary.arrays import FloatArray


def march_springs(
    g: FloatArray, depth: FloatArray, displacement: FloatArray, periods: int = 2
) -> tuple[FloatArray, FloatArray]:
    """Compression w = δ − g and tangential force τ of springs by the clip rule |τ| ≤ w, shape (T, k).

    ``depth`` and ``displacement``, shape (T,), are one period from rest; the last of ``periods`` is returned.
    """
    w = np.maximum(depth[:, None] - g, 0.0)
    tau = np.zeros_like(w)
    rise, du = np.diff(depth), np.diff(displacement)
    for _ in range(periods):
        tau[0] = tau[-1]
        for i in range(1, len(depth)):
            # A spring that touches down within the step feels only what u does after that.
            part = w[i] / rise[i - 1] if rise[i - 1] > 0.0 else 0.0
            felt = np.where(w[i - 1] > 0.0, 1.0, part)
            tau[i] = np.clip(tau[i - 1] + felt * du[i - 1], -w[i], w[i])
    return w, tau


class Formalism:
    """A memory of the load, which moves on straight lines from one load to the next.

    Parameters
    ----------
    depth, displacement
        The first load.
    """

    def __init__(self, depth: float, displacement: float) -> None:
        self.depth, self.displacement = depth, displacement
        self.renew(0.0, 0.0, depth)

    def springs(self, g: FloatArray | float) -> FloatArray:
        """Tangential force over μ of the equivalent springs at depths ``g``."""
        raise NotImplementedError

    def renew(self, stick: float, inclination: float, depth: float) -> None:
        """Keep the memory up to the stick depth, and give it one inclination from there to a depth."""
        raise NotImplementedError

    def step(self, depth: float, displacement: float) -> None:
        """Move on a straight line to the given load.

        Where all sticks, the memory grows with the inclination du/dδ of the line. Otherwise it ends at the
        stick depth s, where the springs, with du, are at the limit of friction, ± (δ − s).
        """
        if self.depth < 0.0 < depth:  # what u does before the touch-down is not felt
            self.displacement += (displacement - self.displacement) * self.depth / (self.depth - depth)
            self.depth = 0.0
        rise, du, edge = depth - self.depth, displacement - self.displacement, min(depth, self.depth)
        self.depth, self.displacement = depth, displacement
        if depth <= 0.0:
            self.renew(0.0, 0.0, 0.0)
            return
        if rise > 0.0 and abs(du) <= rise:
            self.renew(edge, du / rise, depth)
            return
        sense = np.sign(self.springs(edge) + du)

        def excess(stick: float) -> float:
            return float(sense * (self.springs(stick) + du) - (depth - stick))

        # Gross slip wipes the memory.
        stick = 0.0 if excess(0.0) >= 0.0 else brentq(excess, 0.0, edge, xtol=1e-15, rtol=1e-14)
        self.renew(stick, float(sense), depth)


class JaegerContact(Formalism):
    """Jäger's algorithm: the traction is a sum of Hertzian pressures, q/μ = Σ c p(r; D).

    A step adds the difference of a new and an old pressure: where all sticks, with the inclination of the
    line; else a Cattaneo–Mindlin pair ±[p(δ) − p(s)] to what is left of the sum inside of the stick zone.
    """

    #: The terms (D, c) of the sum.
    terms: tuple[tuple[float, float], ...] = ()

    def renew(self, stick: float, inclination: float, depth: float) -> None:
        total = defaultdict(float, {depth: inclination})
        for d, c in (*self.terms, (stick, -inclination)):
            total[min(d, stick)] += c
        self.terms = tuple((d, c) for d, c in total.items() if c != 0.0 and d > 0.0)

    def springs(self, g: FloatArray | float) -> FloatArray:
        return sum((c * np.maximum(d - g, 0.0) for d, c in self.terms), np.zeros_like(g))


class MemoryDiagram(Formalism):
    """The method of memory diagrams: a memory function D(η), |D| ≤ 1, over the contact's history of depths η.

    It weighs the increments of normal contact: u = ∫ D dη and q = μ ∫ D ∂p/∂η dη, where ∂p/∂η is the pressure
    of a flat punch with the radius of the contact at depth η. Fresh ground gets D = du/dδ; where that is not
    allowed, D = ±1 from the stick depth s outwards such that the displacement is right.
    """

    #: D, piecewise constant: ``value[i]`` from ``edge[i]`` to ``edge[i + 1]``.
    edge: FloatArray = np.zeros(1)
    value: FloatArray = np.zeros(0)

    def renew(self, stick: float, inclination: float, depth: float) -> None:
        kept = self.edge[:-1] < stick
        self.edge = np.array([*self.edge[:-1][kept], stick, depth])
        self.value = np.array([*self.value[kept], inclination])

    def springs(self, g: FloatArray | float) -> FloatArray:
        outer = np.maximum(np.subtract.outer(self.edge, g), 0.0)
        return np.asarray(self.value @ np.diff(outer, axis=0))


def random_path(seed: int, corners: int) -> tuple[FloatArray, FloatArray]:
    """Depth and tangential displacement at the corners of a random path; every fourth path lifts off.

    Returns
    -------
    depth, displacement
        Shape (corners,), in δ0 and μE*δ0/G*.
    """
    rng = np.random.default_rng(seed)
    depth = rng.uniform(-0.3 if seed % 4 == 0 else 0.05, 1.6, corners)
    # From nearly normal to nearly tangential motion.
    displacement = np.cumsum(rng.normal(size=corners)) * 10.0 ** rng.uniform(-1.0, 0.2)
    depth[0], displacement[0] = 1.0, 0.0
    return depth, displacement


def differ(paths: int, corners: int, springs: int, at_most: float) -> Measured:
    """Largest difference of the springs' forces by all routes on random paths, over the largest force."""
    worst = 0.0
    for seed in range(paths):
        depth, displacement = random_path(seed, corners)
        g = np.linspace(0.0, depth.max(), springs)
        _, marched = march_springs(g, depth, displacement, periods=1)
        contacts = JaegerContact(depth[0], displacement[0]), MemoryDiagram(depth[0], displacement[0])
        for load, force in zip(zip(depth[1:], displacement[1:], strict=True), marched[1:], strict=True):
            for contact in contacts:
                contact.step(*load)
            apart = np.ptp([force, *(contact.springs(g) for contact in contacts)], axis=0)
            worst = max(worst, apart.max() / np.abs(marched).max())
    return worst <= at_most, {"worst": worst}
