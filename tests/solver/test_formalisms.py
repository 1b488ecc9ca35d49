"""Jäger's algorithm, the method of memory diagrams and the springs of the MDR: one solution, three routes.

They follow random two-dimensional oblique load paths, with loss of contact and gross slip. The package's own
memory diagram, made for the harmonic protocol, is compared with all of them on that.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.springs import polygon, spring_forces
from scipy.integrate import trapezoid

from swtstudy.paper.statements.formalisms import JaegerContact, MemoryDiagram

Array = NDArray[np.float64]


def random_path(seed: int, corners: int = 40) -> tuple[Array, Array]:
    """δ and u of a random polygon; every fourth one loses contact now and then."""
    rng = np.random.default_rng(seed)
    depth = rng.uniform(-0.3 if seed % 4 == 0 else 0.05, 1.6, corners)
    # From nearly normal to nearly tangential motion.
    displacement = np.cumsum(rng.normal(size=corners)) * 10.0 ** rng.uniform(-1.0, 0.2)
    displacement[0] = 0.0
    depth[0] = 1.0
    return depth, displacement


def traction_of_springs(radius: Array, force: Array, r: Array) -> Array:
    """q/μ = −(1/π) ∫ τ′ dξ/√(ξ² − r²), τ linear between the springs."""
    kernel = np.arccosh(np.maximum(radius / r[:, None], 1.0))
    return -np.diff(kernel, axis=1) @ (np.diff(force) / np.diff(radius)) / np.pi


POSITIONS = np.linspace(0.03, 1.27, 80)


@pytest.mark.quick(4)
@pytest.mark.parametrize("seed", range(12))
def test_three_routes_lead_to_the_same_tractions(seed: int) -> None:
    depth, displacement = random_path(seed)
    radius = np.linspace(0.0, 1.3, 3001)
    instants = np.arange(len(depth), dtype=float)
    forces = spring_forces(polygon(depth, displacement), radius**2, instants)
    jaeger, diagram = (kind(depth[0], displacement[0]) for kind in (JaegerContact, MemoryDiagram))
    for k in range(1, len(depth)):
        jaeger.step(depth[k], displacement[k])
        diagram.step(depth[k], displacement[k])
        expected = jaeger.traction(POSITIONS)
        # The same breakpoints, to rounding accumulated over the path …
        np.testing.assert_allclose(diagram.traction(POSITIONS), expected, rtol=0.0, atol=1e-10)
        assert diagram.force() == pytest.approx(jaeger.force(), abs=1e-10)
        # … while springs a cell h apart find a kink of τ within h only, which q sees to √h next to it.
        error = np.abs(traction_of_springs(radius, forces[k], POSITIONS) - expected)
        assert error.max() < np.sqrt(radius[1])
        assert error.mean() < radius[1]
        total = trapezoid(2.0 * forces[k], radius)
        assert total == pytest.approx(jaeger.force(), abs=radius[1] ** 1.5)


@pytest.mark.parametrize("seed", range(12))
def test_force_of_every_spring_is_the_sum_of_jaegers_terms(seed: int) -> None:
    depth, displacement = random_path(seed)
    g = np.linspace(0.0, 1.6, 401)
    instants = np.arange(len(depth), dtype=float)
    forces = spring_forces(polygon(depth, displacement), g, instants)
    jaeger = JaegerContact(depth[0], displacement[0])
    regimes = set()
    for k in range(1, len(depth)):
        jaeger.step(depth[k], displacement[k])
        expected = np.sum([np.zeros_like(g), *(c * np.maximum(d - g, 0.0) for d, c in jaeger.terms)], axis=0)
        np.testing.assert_allclose(forces[k], expected, rtol=0.0, atol=1e-11)
        regimes.add(min(len(jaeger.terms), 3))
    assert 3 in regimes  # partial slip with a memory
