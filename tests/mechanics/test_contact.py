"""The contact solution: memory diagram, Cattaneo–Mindlin's cycle, gross slip and lift-off."""

from __future__ import annotations

import numpy as np
import pytest
from memory import front_at, harmonic, tangential_force
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from oracles.springs import bimodal, spring_forces

from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.load.bimodal import BimodalLoad

Array = NDArray[np.float64]
FREQUENCIES = [(1, 1), (1, 2), (2, 1), (3, 2), (2, 3), (1, 4), (5, 2), (5, 4)]


def random_load(rng: np.random.Generator) -> tuple[float, float, float]:
    """δA/δ0 with and without lift-off, amplitude with and without gross slip, and phase."""
    return rng.uniform(0.0, 1.4), 10.0 ** rng.uniform(-2.0, 0.3), rng.uniform(0.0, 2.0 * np.pi)


@pytest.mark.quick(3)
@pytest.mark.parametrize(("p", "q"), FREQUENCIES)
def test_memory_diagram_is_the_clip_rule_in_its_second_and_any_later_period(p: int, q: int) -> None:
    rng = np.random.default_rng([p, q])
    for _ in range(5):
        load = random_load(rng)
        instants = np.sort(rng.uniform(0.0, 2.0 * np.pi, 40))
        depths = np.sort(rng.uniform(0.0, 1.0 + load[0], 200))
        found = tangential_force(solve_cycle(harmonic(*load, p, q)), depths, instants)
        path = bimodal(*load, p, q, periods=3)
        for period in (1, 2):
            expected = spring_forces(path, depths, instants + 2.0 * np.pi * period)
            # Rounding: the instants are shifted by periods.
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(("p", "q"), FREQUENCIES)
def test_no_spring_exceeds_coulombs_limit_and_the_edge_is_free(p: int, q: int) -> None:
    rng = np.random.default_rng([7, p, q])
    load = random_load(rng)
    instants = np.linspace(0.0, 2.0 * np.pi, 101)
    depths = np.linspace(0.0, 1.0 + load[0], 301)
    w = np.maximum(1.0 + load[0] * np.sin(q * instants + load[2])[:, None] - depths, 0.0)
    force = tangential_force(solve_cycle(harmonic(*load, p, q)), depths, instants)
    assert np.all(np.abs(force) <= w + 1e-14)


@pytest.mark.quick(2)
@pytest.mark.parametrize(("p", "q"), FREQUENCIES)
def test_something_slips_where_a_spring_in_contact_changes_its_offset(p: int, q: int) -> None:
    rng = np.random.default_rng([5, p, q])
    instants = np.linspace(2.0 * np.pi, 4.0 * np.pi, 2001)
    depths = np.linspace(0.0, 1.9, 100)
    sticks = []
    for phase in (0.0, np.pi, *rng.uniform(0.0, 2.0 * np.pi, 2)):
        d, u = rng.uniform(0.3, 0.9), rng.uniform(0.0, 0.3)
        path = bimodal(d, u, phase, p, q, periods=2)
        offset = u * np.sin(p * instants)[:, None] - spring_forces(path, depths, instants)
        touches = 1.0 + d * np.sin(q * instants + phase)[:, None] > depths
        change = np.abs(np.diff(offset, axis=0))[touches[1:] & touches[:-1]].max()
        slips = solve_cycle(harmonic(d, u, phase, p, q)).slips()[0]
        assert slips == (change > 1e-7)
        sticks.append(not slips)
    if p == q:
        assert any(sticks)


def test_the_whole_contact_slides_where_the_slip_lines_cross() -> None:
    rng = np.random.default_rng(1)
    fine = np.linspace(0.0, 2.0 * np.pi, 20001)
    seen = []
    for p, q in FREQUENCIES:
        d, u, psi = rng.uniform(0.0, 1.0, 40), rng.uniform(0.0, 2.0, 40), rng.uniform(0.0, 2.0 * np.pi, 40)
        depth = 1.0 + d[:, None] * np.sin(q * fine + psi[:, None])
        displacement = u[:, None] * np.sin(p * fine)
        overlap = (displacement - depth).max(axis=1) - (displacement + depth).min(axis=1)
        clear = np.abs(overlap) > 1e-5  # the sampling's error
        slides = solve_cycle(BimodalLoad(d, u, psi, p, q)).gross_slip
        np.testing.assert_array_equal(slides[clear], overlap[clear] > 0.0)
        seen.extend(slides[clear])
    assert 0.2 < np.mean(seen) < 0.8


def test_contact_is_lost_where_the_oscillation_exceeds_the_depth() -> None:
    amplitudes = np.array([0.0, 0.5, 1.0, np.nextafter(1.0, 2.0), 1.2])
    loads = BimodalLoad(amplitudes, np.full(5, 0.5), np.zeros(5), 1, 1)
    np.testing.assert_array_equal(solve_cycle(loads).lift_off, [False, False, False, True, True])


def test_nothing_is_remembered_through_lift_off() -> None:
    # Whatever the first period did, the springs' forces are set by what follows the touch-down.
    d, u, psi = 1.2, 0.6, 0.4
    touch_down = (2.0 * np.pi - np.arcsin(1.0 / d) - psi) % (2.0 * np.pi)
    instants = np.linspace(touch_down + 1e-3, 2.0 * np.pi, 50)
    depths = np.linspace(0.0, 2.2, 300)
    path = bimodal(d, u, psi, 1, 1)
    fresh = type(path)(
        path.depth, path.displacement, np.append(touch_down, path.turns[path.turns > touch_down])
    )
    found = tangential_force(solve_cycle(harmonic(d, u, psi)), depths, instants)
    np.testing.assert_allclose(found, spring_forces(fresh, depths, instants), rtol=0.0, atol=1e-13)


# Cattaneo and Mindlin: constant normal load, a = a_H, normal force P = 4/3 E* δ0 a_H.


def mindlin_force(u: Array) -> Array:
    """F/(μP) on first loading of a paraboloid: 1 − (1 − u)^(3/2)."""
    return 1.0 - (1.0 - u) ** 1.5


def tangential_load(cycle_amplitude: float, instants: Array) -> Array:
    """F/(μP) of the package's springs: ∫ 2τ dξ, exact by Gauss's rule between the breakpoints."""
    cycle = solve_cycle(harmonic(0.0, cycle_amplitude))
    node, weight = leggauss(4)
    load = np.empty(len(instants))
    for k, front in enumerate(front_at(cycle, instants)[0]):
        ends = np.sqrt(np.sort([0.0, 1.0 - cycle_amplitude, front, 1.0]))
        half = 0.5 * np.diff(ends)[:, None]
        radius = (ends[:-1, None] + half * (1.0 + node)).ravel()
        force = tangential_force(cycle, radius**2, instants[k : k + 1])[0]
        load[k] = 2.0 * np.sum(force * (half * weight).ravel()) / (4.0 / 3.0)
    return load


@pytest.mark.parametrize("amplitude", [0.05, 0.5, 5 / 6, 0.999])
def test_cattaneo_mindlin_stick_radius(amplitude: float) -> None:
    cycle = solve_cycle(harmonic(0.0, amplitude))
    instants = np.linspace(0.51 * np.pi, 1.49 * np.pi, 25)  # unloading from +U
    front = front_at(cycle, instants)[0]
    np.testing.assert_allclose(front, 1.0 - 0.5 * amplitude * (1.0 - np.sin(instants)), rtol=1e-13)
    # At full reversal the stick radius c: F = μP (1 − c³/a³).
    fully = front_at(cycle, np.array([1.5 * np.pi - 1e-9]))[0]
    assert 1.0 - fully**1.5 == pytest.approx(mindlin_force(np.array([amplitude])), rel=1e-9)


@pytest.mark.parametrize("amplitude", [0.05, 0.5, 5 / 6, 0.999])
def test_mindlins_force_displacement_loop(amplitude: float) -> None:
    instants = np.linspace(0.5 * np.pi, 1.5 * np.pi, 21)
    u = amplitude * np.sin(instants)
    unloading = mindlin_force(np.array(amplitude)) - 2.0 * mindlin_force(0.5 * (amplitude - u))
    np.testing.assert_allclose(tangential_load(amplitude, instants), unloading, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("amplitude", [0.05, 0.5, 5 / 6])
def test_dissipated_work_is_the_area_of_mindlins_loop(amplitude: float) -> None:
    node, weight = leggauss(24)
    half = 0.5 * np.pi
    work = 0.0
    for centre in (0.0, np.pi):
        instants = np.mod(centre + half * node, 2.0 * np.pi)
        rate = amplitude * np.cos(instants)
        order = np.argsort(instants)
        force = np.empty(len(node))
        force[order] = tangential_load(amplitude, instants[order])
        work += half * np.sum(weight * force * rate)
    stored = amplitude - 0.4 * (1.0 - (1.0 - amplitude) ** 2.5)  # ∫ F du on first loading
    expected = 8.0 * stored - 4.0 * amplitude * mindlin_force(np.array(amplitude))
    assert work == pytest.approx(expected, rel=1e-9)
