"""The stress on the surface line: Hertz, Hamilton, Cattaneo–Mindlin, and quadrature over the springs."""

from __future__ import annotations

from typing import Any

import memory
import numpy as np
import pytest
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.hamilton import hamilton
from scenes import points

from swtstudy.mechanics.contact.cycle import Cycle, solve_cycle
from swtstudy.mechanics.contact.memory import Growths
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.indenter import Profile, make_profile
from swtstudy.mechanics.stress.growth import GrowthIntegrals
from swtstudy.mechanics.stress.history import History, stresses
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import scene_of

Array = NDArray[np.float64]
DIGITS = 12.0
SHAPES: dict[str, oracle.Indenter] = {
    "paraboloid": oracle.paraboloid(),
    "rounded_punch": oracle.rounded_punch(1.0),
    "truncated_paraboloid": oracle.truncated_paraboloid(1.0),
    "wavy_paraboloid": oracle.wavy_paraboloid(0.02, 4.5),
}


def history_at(cycle: Cycle, profile: Profile, position: Array, instants: Array) -> History:
    """Building blocks of the stress of the first cycle at all positions and instants, each (1, X, T)."""
    interval = np.searchsorted(cycle.end[0], instants)[None]
    index = np.broadcast_to(np.arange(instants.size), (1, position.size, instants.size))
    return SurfaceLine(cycle, DepthCoordinate(profile), position[None], DIGITS).history(
        Nodes(interval, instants[None], index)
    )


def stress_at(
    load: dict[str, Any], x: Array, instants: Array, nu: float, mu: float
) -> tuple[Array, Array, Array, Array]:
    """σ_xx, σ_yy, σ_zz, σ_xz of a paraboloid, each (X, T)."""
    cycle = solve_cycle(memory.harmonic(**load))
    paraboloid = make_profile("paraboloid", {}, cycle.load.largest_normal)
    history = history_at(cycle, paraboloid, np.abs(x), instants)
    side = np.sign(x)[None, :, None]
    xx, yy, zz, xz = stresses(history, np.array([nu]), np.array([mu]), side)
    return xx[0], yy[0], zz[0], xz[0]


X = np.array([-1.4, -1.05, -0.97, -0.6, -0.2, 0.15, 0.5, 0.9, 1.02, 1.3])


def test_hertz_pressure_and_load() -> None:
    instants = np.linspace(0.0, 2.0 * np.pi, 13)
    cycle = solve_cycle(memory.harmonic(0.5, 0.3, 0.4))
    position = np.array([0.05, 0.4, 0.8, 1.1, 1.5])
    history = history_at(cycle, make_profile("paraboloid", {}, np.array([1.5])), position, instants)
    depth = 1.0 + 0.5 * np.sin(instants + 0.4)
    r = position[:, None]
    inside = np.maximum(1.0 - r**2 / depth, 0.0)
    np.testing.assert_allclose(history.pressure[0], 2.0 / np.pi * np.sqrt(depth * inside), atol=1e-14)
    # P(r)/P = 1 − (1 − r²/a²)^(3/2), P = 4/3 E* √R δ^(3/2).
    load = 4.0 / 3.0 * depth**1.5 * (1.0 - inside**1.5)
    np.testing.assert_allclose(history.mean_pressure[0] * np.pi * r**2, load, rtol=1e-12)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("mu", [0.0, 0.3, 1.0])
def test_full_sliding_is_hamiltons_solution(nu: float, mu: float) -> None:
    # The amplitude is so large that all slides at φ = 0 (forward) and π (backward), at any depth.
    load = {"normal_amplitude": 0.6, "tangential_amplitude": 20.0, "phase": 0.3}
    instants = np.array([0.0, np.pi])
    found = stress_at(load, X, instants, nu, mu)
    for k, sense in enumerate((1.0, -1.0)):
        depth = 1.0 + 0.6 * np.sin(instants[k] + 0.3)
        expected = hamilton(X, depth, nu, 1.0, sense * mu)
        for component, value in zip(found, expected, strict=True):
            np.testing.assert_allclose(component[:, k], value, rtol=0.0, atol=2e-14)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("u", [0.8, 0.1, -0.55])
def test_cattaneo_mindlin_is_a_superposition_of_hamiltons_solutions(nu: float, u: float) -> None:
    # Unloading from u = U: τ = −w(1) + 2 w(f) − w(1 − U), where w(D) = D − G within the depth D.
    amplitude, mu = 5 / 6, 0.4
    load = {"normal_amplitude": 0.0, "tangential_amplitude": amplitude}
    instant = np.array([np.pi - np.arcsin(u / amplitude)])
    found = stress_at(load, X, instant, nu, mu)
    front = 1.0 - 0.5 * (amplitude - u)
    parts = [
        hamilton(X, 1.0, nu, 1.0, -mu),
        hamilton(X, front, nu, 0.0, 2.0 * mu),
        hamilton(X, 1.0 - amplitude, nu, 0.0, -mu),
    ]
    for component, *values in zip(found, *parts, strict=True):
        np.testing.assert_allclose(component[:, 0], sum(values), rtol=0.0, atol=2e-14)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("mu", [0.1, 0.6])
def test_trailing_edge_under_full_sliding(nu: float, mu: float) -> None:
    load = {"normal_amplitude": 0.0, "tangential_amplitude": 5.0}
    sigma_xx = stress_at(load, np.array([-1.0]), np.zeros(1), nu, mu)[0][0, 0]
    expected = (1.0 - 2.0 * nu) / 3.0 + np.pi * mu * (4.0 + nu) / 8.0
    assert sigma_xx / (2.0 / np.pi) == pytest.approx(expected, rel=1e-13)


def test_half_a_tangential_cycle_later_the_other_side_has_the_same_stress() -> None:
    # ψ → ψ + π and t → t + π/ω2 flip u: the contact is its own mirror image.
    load = {"normal_amplitude": 0.7, "tangential_amplitude": 0.9, "phase": 0.8}
    instants = np.linspace(0.1, 3.0, 12)
    here = stress_at(load, X, instants, 0.3, 0.5)
    there = stress_at({**load, "phase": 0.8 + np.pi}, -X, instants + np.pi, 0.3, 0.5)
    for one, other, parity in zip(here, there, (1.0, 1.0, 1.0, -1.0), strict=True):
        np.testing.assert_allclose(one, parity * other, rtol=0.0, atol=1e-13)


def random_cycle(seed: int, p: int, q: int) -> Cycle:
    rng = np.random.default_rng([seed, p, q])
    amplitudes = rng.uniform(0.05, 0.95), rng.uniform(0.05, 1.2)
    return solve_cycle(memory.harmonic(*amplitudes, rng.uniform(0.0, 2.0 * np.pi), p, q))


def profile_of(indenter: oracle.Indenter, cycle: Cycle) -> Profile:
    shape = {name: np.array([value]) for name, value in indenter.shape.items()}
    return make_profile(indenter.profile, shape, cycle.load.largest_normal)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize(("p", "q"), [(1, 1), (3, 2), (1, 4), (5, 2)])
def test_traction_obeys_coulombs_law(name: str, p: int, q: int) -> None:
    cycle = random_cycle(0, p, q)
    profile = profile_of(SHAPES[name], cycle)
    largest = profile.radius(cycle.load.largest_normal[:, None])[0, 0]
    position = largest * np.linspace(0.013, 1.01, 60)
    history = history_at(cycle, profile, position, np.linspace(0.0, 2.0 * np.pi, 97)[:-1])
    # The tables of the profiles are exact to 1e-9 of the largest stress.
    assert np.all(np.abs(history.traction) <= history.pressure + 2e-8)
    slips = np.isclose(np.abs(history.traction), history.pressure, atol=1e-7) & (history.pressure > 1e-3)
    assert slips.any()


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize(("p", "q"), [(1, 1), (1, 2), (5, 2)])
def test_stress_by_growth_in_stick_against_quadrature(name: str, p: int, q: int) -> None:
    # A cycle whose normal motion is faster than the tangential one: ground grows in stick.
    cycle = solve_cycle(memory.harmonic(0.7, 0.4 * q / p, 0.5, p, q))
    indenter, profile = SHAPES[name], profile_of(SHAPES[name], cycle)
    position = profile.radius(np.array([[0.2, 0.9, 1.45]]))[0]
    instants = np.linspace(0.03, 2.0 * np.pi, 3, endpoint=False)
    found = history_at(cycle, profile, position, instants)
    grown = 0
    for t, instant in enumerate(instants):
        pieces = memory.slopes(cycle, float(instant))
        grown += sum(1 for *_, slope in pieces if slope(0.5) not in (-1.0, 0.0, 1.0))
        for k, r in enumerate(position):
            total = np.zeros(3)
            for low, high, slope in pieces:
                low, high = profile.radius(np.array([[low, high]]))[0]

                def weight(xi: float, slope=slope) -> float:  # type: ignore[no-untyped-def]
                    return slope(profile.depth(np.array([[xi]]))[0, 0])

                inner = indenter.inner(r, high, weight, low)
                total += [*inner, indenter.outer(r, high, weight, low)[0]]
            blocks = [getattr(found, name)[0, k, t] for name in ("tangential_1", "tangential_3", "traction")]
            np.testing.assert_allclose(blocks, total / np.pi, rtol=0.0, atol=1e-8)
    assert grown > 0


@pytest.mark.quick(5)
@pytest.mark.parametrize(
    "phase", [1e-6, 0.01, np.pi - 1e-3, *(pytest.param(each, marks=pytest.mark.slow) for each in (1e-4, 1.0))]
)
@pytest.mark.parametrize(("share", "p"), [(0.02, 1), (0.3, 1), (0.9, 1), (0.3, 2), (0.3, 20)])
def test_growth_that_turns_fast(share: float, p: int, phase: float) -> None:
    """At its ends, where the loads are nearly in phase, and all over it; against a sum over small steps."""
    d = 0.3
    scene = scene_of(points(normal_amplitude=d, tangential_amplitude=share * d / p, phase=phase, p=p))
    growths = Growths.of(scene.cycle.memory)
    for number, (begin, end) in enumerate(zip(growths.begin[0], growths.end[0], strict=True)):
        # Of the angle θ = φ + ψ, ever smaller steps towards both ends.
        first, last = np.arcsin((np.array([begin, end]) - 1.0) / d)
        steps = (last - first) * 0.5 * np.linspace(0.0, 1.0, 400_000) ** 4
        θ = np.concatenate([first + steps, (last - steps[:-1])[::-1]])
        middle = 0.5 * (θ[1:] + θ[:-1])
        slope = -share * np.cos(p * (middle - phase)) / np.cos(middle)
        r, ξ = np.sqrt([[begin], [0.5 * (begin + end)], [end]]), np.sqrt(1.0 + d * np.sin(θ))
        # Of the springs inside r over α, ξ = r sin α, and of those outside over v = √(ξ² − r²).
        α, v = np.arcsin(np.minimum(ξ / r, 1.0)), np.sqrt(np.maximum(ξ * ξ - r * r, 0.0))
        inner = 4.0 / r * (1.0 + d * np.sin(middle)) * slope * np.diff(α)
        expected = np.stack([inner.sum(axis=1), (2.0 * slope * np.diff(v)).sum(axis=1)])
        at = np.zeros(3, dtype=np.intp), np.arange(3), np.full(3, number), np.full(3, np.sqrt(end))
        for digits in (5.0, 7.0):
            found = GrowthIntegrals(scene.cycle, scene.coordinate, r.T, digits).up_to(*at)[[0, 2]]
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=5e-8)
