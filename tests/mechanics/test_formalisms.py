"""Jäger's algorithm, the method of memory diagrams and the springs of the MDR: one solution, three routes.

They follow random two-dimensional oblique load paths, with loss of contact and gross slip. The package's own
memory diagram, made for the harmonic protocol, is compared with all of them on that.
"""

from __future__ import annotations

import numpy as np
import pytest
from memory import harmonic, tangential_force
from numpy.typing import NDArray
from oracles.springs import bimodal, polygon, spring_forces
from scipy.integrate import trapezoid

from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.paper.formalisms.jaeger import JaegerContact
from swtstudy.paper.formalisms.memory_diagram import MemoryDiagram

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


@pytest.mark.quick(3)
@pytest.mark.parametrize(("p", "q"), [(1, 1), (1, 2), (5, 2)])
@pytest.mark.parametrize("amplitudes", [(0.6, 0.5), (0.3, 1.1), (1.2, 0.7)])
def test_the_package_goes_the_same_way_on_harmonic_paths(
    p: int, q: int, amplitudes: tuple[float, float]
) -> None:
    load = (*amplitudes, 0.9)
    cycle = solve_cycle(harmonic(*load, p, q))
    profile = make_profile("paraboloid", {}, cycle.load.largest_normal)
    instants = np.array([0.4, 1.7, 3.1, 4.4, 5.9])
    interval = np.searchsorted(cycle.end[0], instants)[None]
    position = np.linspace(0.05, 1.4, 40)
    index = np.broadcast_to(np.arange(instants.size), (1, position.size, instants.size))
    found = SurfaceLine(cycle, DepthCoordinate(profile), position[None], 9.0).history(
        Nodes(interval, instants[None], index)
    )

    # Through all turns; a chord of growth in stick leaves a kink that q sees to (2π/300)^1.5 ~ 3e-3 of it.
    steps = 2.0 * np.pi / (300 * max(p, q))
    path = bimodal(*load, p, q, periods=2)
    times = np.union1d(np.arange(0.0, 4.0 * np.pi, steps), np.append(path.turns, instants + 2.0 * np.pi))
    depth, displacement = path.depth(times), path.displacement(times)
    jaeger, diagram = (kind(depth[0], displacement[0]) for kind in (JaegerContact, MemoryDiagram))
    for time, d, u in zip(times[1:], depth[1:], displacement[1:], strict=True):
        jaeger.step(d, u)
        diagram.step(d, u)
        for k in np.flatnonzero(instants + 2.0 * np.pi == time):
            for route in (jaeger, diagram):
                error = np.abs(found.traction[0, :, k] + route.traction(position))
                assert error.max() < 1e-3
                assert error.mean() < 2e-4


def test_the_adapter_reads_the_same_forces_as_jaegers_terms() -> None:
    # δA = 0: no growth, so that Jäger's steps are exact whatever their size.
    instants = np.array([0.8, 2.0, 3.5, 5.0])
    g = np.linspace(0.0, 1.0, 101)
    found = tangential_force(solve_cycle(harmonic(0.0, 0.7)), g, instants)
    jaeger = JaegerContact(1.0, 0.0)
    turns = np.array([0.5 * np.pi, 1.5 * np.pi, 2.0 * np.pi, 2.5 * np.pi, 3.5 * np.pi])
    for time in np.sort(np.append(turns, instants + 2.0 * np.pi)):
        jaeger.step(1.0, 0.7 * np.sin(time))
        for k in np.flatnonzero(instants + 2.0 * np.pi == time):
            expected = np.sum([c * np.maximum(d - g, 0.0) for d, c in jaeger.terms], axis=0)
            np.testing.assert_allclose(found[k], expected, rtol=0.0, atol=1e-13)
