"""Jäger's algorithm, the method of memory diagrams and the springs of the MDR: one solution, three routes.

They follow random two-dimensional oblique load paths, with loss of contact and gross slip. The package's own
memory diagram, made for the harmonic protocol, is compared with all of them on that.
"""

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.springs import polygon, spring_forces
from scipy.integrate import trapezoid

from swtstudy.paper.formalisms import JaegerContact, MemoryDiagram, random_path

Array = NDArray[np.float64]


def traction_of_hertz(jaeger: JaegerContact, r: Array) -> Array:
    """q/μ in E* √(δ0/R) by Hertz's pressures."""
    hertz = (c * 2.0 / np.pi * np.sqrt(np.maximum(d - r * r, 0.0)) for d, c in jaeger.terms)
    return np.sum([np.zeros_like(r), *hertz], axis=0)


def traction_of_punches(diagram: MemoryDiagram, r: Array) -> Array:
    """q/μ in E* √(δ0/R): flat punches with ∂p/∂η = 1/(π √(η − r²)), as a paraboloid has η = a²."""
    root = np.sqrt(np.maximum(diagram.edge[:, None] - r * r, 0.0))
    return 2.0 / np.pi * (diagram.value @ np.diff(root, axis=0))


def traction_of_springs(radius: Array, force: Array, r: Array) -> Array:
    """q/μ = −(1/π) ∫ τ′ dξ/√(ξ² − r²), τ linear between the springs."""
    kernel = np.arccosh(np.maximum(radius / r[:, None], 1.0))
    return -np.diff(kernel, axis=1) @ (np.diff(force) / np.diff(radius)) / np.pi


POSITIONS = np.linspace(0.03, 1.27, 80)


@pytest.mark.quick(2)
@pytest.mark.parametrize("seed", range(12))
def test_three_routes_lead_to_the_same_tractions(seed: int) -> None:
    depth, displacement = random_path(seed, 40)
    radius = np.linspace(0.0, 1.3, 3001)
    instants = np.arange(len(depth), dtype=float)
    forces = spring_forces(polygon(depth, displacement), radius**2, instants)
    jaeger, diagram = (kind(depth[0], displacement[0]) for kind in (JaegerContact, MemoryDiagram))
    most = 0
    for k in range(1, len(depth)):
        jaeger.step(depth[k], displacement[k])
        diagram.step(depth[k], displacement[k])
        most = max(most, len(jaeger.terms))
        for each in (jaeger, diagram):
            np.testing.assert_allclose(each.springs(radius**2), forces[k], rtol=0.0, atol=1e-11)
        expected = traction_of_hertz(jaeger, POSITIONS)
        # The same breakpoints, to rounding accumulated over the path …
        np.testing.assert_allclose(traction_of_punches(diagram, POSITIONS), expected, rtol=0.0, atol=1e-10)
        # Hertz's forces, and ∫ D dN with N = 4/3 η^(3/2).
        force = sum(c * 4.0 / 3.0 * d**1.5 for d, c in jaeger.terms)
        of_diagram = diagram.value @ np.diff(4.0 / 3.0 * np.maximum(diagram.edge, 0.0) ** 1.5)
        assert of_diagram == pytest.approx(force, abs=1e-10)
        # … while springs a cell h apart find a kink of τ within h only, which q sees to √h next to it.
        error = np.abs(traction_of_springs(radius, forces[k], POSITIONS) - expected)
        assert error.max() < np.sqrt(radius[1])
        assert error.mean() < radius[1]
        total = trapezoid(2.0 * forces[k], radius)
        assert total == pytest.approx(force, abs=radius[1] ** 1.5)
    assert most >= 3  # partial slip with a memory
