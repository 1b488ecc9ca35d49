"""The harmonic load: common period, turning instants, symmetry in the phase."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import points

from swtstudy.mechanics import solve_points
from swtstudy.mechanics.load.bimodal import BimodalLoad, fold_phase

FREQUENCIES = [(1, 1), (1, 2), (2, 1), (3, 2), (2, 3), (1, 4), (5, 2), (4, 5)]
every_frequency = pytest.mark.parametrize(("p", "q"), FREQUENCIES)


def random_loads(count: int, p: int, q: int) -> BimodalLoad:
    rng = np.random.default_rng([p, q])
    return BimodalLoad(
        rng.uniform(0.0, 1.3, count), rng.uniform(0.0, 2.0, count), rng.uniform(-10.0, 10.0, count), p, q
    )


@every_frequency
def test_the_load_is_equations_7_and_8_over_the_common_period(p: int, q: int) -> None:
    load = random_loads(4, p, q)
    omega_1, omega_2 = 3.0, 3.0 * p / q
    period = 2.0 * np.pi * q / omega_1
    time = np.linspace(0.0, period, 50)
    instants = np.broadcast_to(omega_1 * time / q, (4, 50))
    d, u, psi = (v[:, None] for v in (load.normal_amplitude, load.tangential_amplitude, load.phase))
    depth, displacement = 1.0 + d * np.sin(omega_1 * time + psi), u * np.sin(omega_2 * time)
    np.testing.assert_allclose(load.normal(instants), depth, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(load.tangential(instants), displacement, rtol=0.0, atol=1e-13)
    # It ends where it began, and not earlier.
    for motion in (load.normal, load.tangential):
        np.testing.assert_allclose(motion(instants)[:, 0], motion(instants)[:, -1], rtol=0.0, atol=1e-13)
    fraction = np.linspace(0.0, 2.0 * np.pi, 721)[None]
    for divisor in range(2, max(p, q) + 1):
        shift = 2.0 * np.pi / divisor
        same = [
            np.allclose(motion(fraction + shift), motion(fraction), atol=1e-6)
            for motion in (load.take(np.array([0])).normal, load.take(np.array([0])).tangential)
        ]
        assert not all(same)


@every_frequency
def test_rates_are_the_derivatives(p: int, q: int) -> None:
    load, step = random_loads(4, p, q), 1e-6
    instants = np.broadcast_to(np.linspace(0.0, 2.0 * np.pi, 40), (4, 40))
    pairs = ((load.normal, load.normal_rate), (load.tangential, load.tangential_rate))
    for motion, rate in pairs:
        difference = (motion(instants + step) - motion(instants - step)) / (2.0 * step)
        # Rounding of the quotient: 1e-16 · 3/1e-6.
        np.testing.assert_allclose(rate(instants), difference, rtol=0.0, atol=5e-9)


@every_frequency
def test_every_turn_of_the_depth_and_of_the_slip_lines_is_found(p: int, q: int) -> None:
    count = 30
    load = random_loads(count, p, q)
    found = load.turning_instants()
    assert np.all(np.diff(found, axis=1) >= 0.0)
    assert np.all((found >= 0.0) & (found <= 2.0 * np.pi))
    samples = np.linspace(0.0, 2.0 * np.pi, 20001)
    grid = np.broadcast_to(samples, (count, samples.size))
    depth_rate, displacement_rate = load.normal_rate(grid), load.tangential_rate(grid)
    contact = load.normal(grid)
    for values in (depth_rate, displacement_rate - depth_rate, displacement_rate + depth_rate, contact):
        row, cell = np.nonzero(values[:, 1:] * values[:, :-1] < 0.0)
        inside = (found[row] >= samples[cell, None] - 1e-9) & (found[row] <= samples[cell + 1, None] + 1e-9)
        assert np.all(inside.any(axis=1))


@every_frequency
def test_touch_down_is_the_rising_passage_of_a_depth(p: int, q: int) -> None:
    load = random_loads(6, p, q)
    share = np.linspace(-0.99, 0.99, 9)
    depth = 1.0 + load.normal_amplitude[:, None] * share
    for turn in range(q):
        instant = load.touch_down(depth, np.full(1, turn))
        np.testing.assert_allclose(load.normal(instant), depth, rtol=0.0, atol=1e-13)
        assert np.all(load.normal_rate(instant) >= 0.0)
        angle = q * instant + load.phase[:, None] - 2.0 * np.pi * turn
        assert np.all(np.abs(angle) <= 0.5 * np.pi + 1e-12)


def folded(phases: np.ndarray, p: int, q: int) -> tuple[np.ndarray, np.ndarray]:
    many = np.full(phases.shape, p), np.full(phases.shape, q)
    return fold_phase(phases, *many)


@pytest.mark.parametrize(
    ("p", "q", "period"), [(1, 1, 1.0), (3, 1, 1 / 3), (2, 3, 0.5), (1, 2, 2.0), (3, 4, 2 / 3)]
)
def test_phases_are_folded_into_one_period_of_s(p: int, q: int, period: float) -> None:
    phases = np.linspace(-15.0, 15.0, 301)
    base, mirrored = folded(phases, p, q)
    assert np.all((base >= 0.0) & (base < period * np.pi * (1.0 + 1e-12)))
    turns = (phases - base) / (period * np.pi)
    np.testing.assert_allclose(turns, np.round(turns), rtol=0.0, atol=1e-9)
    np.testing.assert_array_equal(
        mirrored, (np.round(turns) % 2 == 1) if q % 2 else np.zeros(301, dtype=bool)
    )


@pytest.mark.quick(2)
@pytest.mark.parametrize(("p", "q"), FREQUENCIES)
def test_s_has_the_period_of_the_folded_phase_and_x_its_mirror(p: int, q: int) -> None:
    phases = np.array([0.4, 2.1, 3.6, 5.5, -1.2])
    base, mirrored = folded(phases, p, q)
    as_given, as_folded = (
        solve_points(points(normal_amplitude=0.6, tangential_amplitude=0.7, phase=psi, p=p, q=q), 1e-6)
        for psi in (phases, base)
    )
    np.testing.assert_allclose(as_given.s, as_folded.s, rtol=2e-6)
    np.testing.assert_array_equal(as_given.regime, as_folded.regime)
    # Near a smooth maximum s knows x and the angle to the root of its own accuracy only.
    sign = np.where(mirrored, -1.0, 1.0)
    if q % 2 == 0:
        # Half a common period flips u and leaves δ: x and −x are always alike.
        sign = np.sign(as_given.critical_x * as_folded.critical_x)
    np.testing.assert_allclose(as_given.critical_x, sign * as_folded.critical_x, rtol=3e-3)
    np.testing.assert_allclose(as_given.critical_angle, sign * as_folded.critical_angle, atol=0.2)
    assert mirrored.any() == (q % 2 == 1)


@every_frequency
def test_what_a_load_says_of_itself(p: int, q: int) -> None:
    load = random_loads(5, p, q)
    instants = np.broadcast_to(np.linspace(0.0, 2.0 * np.pi, 40001), (5, 40001))
    normal, tangential = load.normal(instants), load.tangential(instants)
    np.testing.assert_allclose(load.least_normal, normal.min(axis=1), atol=1e-6)
    np.testing.assert_allclose(load.largest_normal, normal.max(axis=1), atol=1e-6)
    size = np.ptp(normal, axis=1) / 2.0 + np.ptp(tangential, axis=1) / 2.0
    np.testing.assert_allclose(load.motion, size, atol=1e-6)
    # How often each rises through its mean.
    for values, times in zip((normal[0] - 1.0, tangential[0]), load.oscillations, strict=True):
        assert np.count_nonzero((values[:-1] < -1e-9) & (values[1:] >= -1e-9)) == times
    half = instants + np.pi
    mirrored = np.allclose(load.normal(half), normal) and np.allclose(load.tangential(half), -tangential)
    assert load.mirrored_half == mirrored
    still = BimodalLoad(np.ones(2), np.array([0.0, 1e-12]), np.zeros(2), p, q)
    assert still.moves_tangentially.tolist() == [False, True]


@every_frequency
def test_growth_slope_is_the_slope_of_the_path_within_the_bounds_of_stick(p: int, q: int) -> None:
    """−du/dδ along the path, by differences; ±1 where the tangential load is faster: there the edge slips."""
    load = random_loads(6, p, q)
    load.tangential_amplitude[0] = 20.0
    depth = 1.0 + load.normal_amplitude[:, None] * np.linspace(-0.95, 0.95, 11)
    clipped = 0
    for turn in range(q):
        branch = np.full(1, turn)
        instant, step = load.touch_down(depth, branch), 1e-6
        du, dd = (f(instant + step) - f(instant - step) for f in (load.tangential, load.normal))
        found = load.growth_slope(depth, branch)
        np.testing.assert_allclose(found, -np.clip(du / dd, -1.0, 1.0), rtol=0.0, atol=1e-6)
        clipped += np.count_nonzero(np.abs(found) == 1.0)
    assert clipped > 0


def test_growth_slope_at_a_turn_and_without_motion() -> None:
    """At a common turning point 0/0 is 0; without motion of the depth no ground grows."""
    load = BimodalLoad(np.array([0.5, 0.0]), np.array([0.8, 0.8]), np.zeros(2), 1, 1)
    slope = load.growth_slope(np.array([[1.5, 0.5], [1.0, 1.0]]), np.zeros(1, dtype=int))
    assert np.all(np.abs(slope) <= 1.0)
    np.testing.assert_array_equal(slope[1], 0.0)


@every_frequency
def test_passages_of_the_depth(p: int, q: int) -> None:
    load = random_loads(4, p, q)
    # From each turn of the depth to the next, rising or falling.
    quarter = np.pi * (np.arange(-2, 2 * q + 2) + 0.5)
    turns = (quarter - np.mod(load.phase, 2.0 * np.pi)[:, None]) / q
    begin, end = turns[:, :-1], turns[:, 1:]
    depth = 1.0 + load.normal_amplitude[:, None] * np.array([-0.9, -0.2, 0.0, 0.5, 0.99])
    found = load.passage(depth, begin, end)
    assert np.all((found >= begin[:, None]) & (found <= end[:, None]))
    np.testing.assert_allclose(
        load.normal(found), np.broadcast_to(depth[:, :, None], found.shape), rtol=0.0, atol=1e-12
    )
    # Part of a stretch: the nearer end; a depth that is never reached: the end.
    third = begin + (end - begin) / 3.0
    early = load.passage(depth, begin, third)
    np.testing.assert_allclose(early, np.minimum(found, third[:, None]), rtol=0.0, atol=1e-12)
    late = load.passage(depth, third, end)
    np.testing.assert_allclose(late, np.maximum(found, third[:, None]), rtol=0.0, atol=1e-12)
    for side in (-1.001, 1.001):
        never = load.passage(1.0 + side * load.normal_amplitude[:, None], begin, third)
        np.testing.assert_array_equal(never[:, 0], third)


@every_frequency
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_instants_of_the_slip_lines(p: int, q: int, sense: float) -> None:
    """Between two turns of sense·T − N every value is met once; beyond them the nearer end is given."""
    load = random_loads(20, p, q)
    samples = np.broadcast_to(np.linspace(0.0, 2.0 * np.pi, 4001), (20, 4001))
    line = sense * load.tangential(samples) - load.normal(samples)
    rising = np.diff(line, axis=1) > 0.0
    begin = np.array([np.flatnonzero(np.diff(row))[0] + 1 for row in rising])
    end = np.array([np.flatnonzero(np.diff(row))[1] for row in rising])
    row = np.arange(20)
    low, high = samples[row, begin], samples[row, end]
    brackets = load.slip_line_brackets(sense, low, high)
    for share in (0.1, 0.5, 0.8):
        goal = (1.0 - share) * line[row, begin] + share * line[row, end]
        found = load.slip_line_instant(sense, goal, brackets)
        assert np.all((found >= low) & (found <= high))
        at = sense * load.tangential(found[:, None]) - load.normal(found[:, None])
        np.testing.assert_allclose(at[:, 0], goal, rtol=0.0, atol=1e-10)
    for beyond, expected in ((-0.1, low), (1.1, high)):
        goal = (1.0 - beyond) * line[row, begin] + beyond * line[row, end]
        found = load.slip_line_instant(sense, goal, brackets)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-2)
        at = sense * load.tangential(found[:, None]) - load.normal(found[:, None])
        assert np.all(
            np.abs(at[:, 0] - goal) <= np.abs(line[row, begin if beyond < 0 else end] - goal) + 1e-12
        )


@every_frequency
def test_branches_are_numbered_from_the_turn_before(p: int, q: int) -> None:
    load = random_loads(4, p, q)
    depth = 1.0 + load.normal_amplitude[:, None] * np.linspace(-0.9, 0.9, 7)
    for turn in range(q):
        np.testing.assert_array_equal(load.branch(load.touch_down(depth, np.full(1, turn))), turn)
