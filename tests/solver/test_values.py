"""Values of s: known ones, closed forms, convergence, and the textbook method as an independent route."""

from typing import Any

import numpy as np
import pytest
from oracles.hertz import s_at_the_edge
from scenes import each_profile, points, random_points, take
from solved import solve_points

from studies.accuracy_speed.textbook import textbook_s

#: Parameters off Table 1, the known s, and how well it is known, absolutely: to its last digit unless said.
KNOWN: dict[str, tuple[dict[str, Any], float, float]] = {
    "table_1": ({}, 0.155137, 5e-7),
    "small_normal_amplitude": ({"normal_amplitude": 0.1}, 0.142923, 5e-7),
    "phase": ({"phase": 2.3}, 0.132589, 2e-6),
    "large_normal_amplitude": ({"normal_amplitude": 8 / 9, "phase": 2.6}, 0.099618, 2e-6),
    "two_frequencies": ({"p": 3, "q": 2, "phase": 1.0}, 0.192034, 5e-7),
    "no_normal_oscillation": ({"normal_amplitude": 0.0}, 0.126444, 5e-7),
    "rounded_punch": ({"profile": "rounded_punch", "flat_radius": 0.5}, 0.122635, 5e-7),
    "truncated_paraboloid": ({"profile": "truncated_paraboloid", "flat_radius": 0.5}, 0.159997, 5e-7),
    "wavy_paraboloid": (
        {"profile": "wavy_paraboloid", "waviness_amplitude": 0.01, "wavelength": 5.0},
        0.140864,
        5e-7,
    ),
}


@pytest.mark.parametrize("name", KNOWN)
@pytest.mark.parametrize("rtol", [1e-4, 1e-7])
def test_known_values(name: str, rtol: float) -> None:
    parameters, known, uncertainty = KNOWN[name]
    s = solve_points(points(**parameters), rtol).s[0]
    assert abs(s - known) <= uncertainty + rtol * known


def test_table_1_is_critical_at_the_largest_contact_radius_on_the_x_normal() -> None:
    solution = solve_points(points())
    assert abs(solution.critical_x[0]) == pytest.approx(np.sqrt(1.75), rel=1e-12)
    assert abs(solution.critical_angle[0]) < 1e-6


def test_constant_depth_has_a_closed_form() -> None:
    # Weak friction is left to the stability tests: the edge is critical wherever the trailing edge is.
    grid = np.meshgrid([0.0, 0.25, 0.5], [0.2, 0.5, 1.0], [0.1, 0.5, 0.9, 0.999], indexing="ij")
    nu, mu, amplitude = (v.ravel() for v in grid)
    solution = solve_points(points("paraboloid", nu, mu, 0.0, amplitude), 1e-6)
    np.testing.assert_allclose(solution.s, s_at_the_edge(nu, mu, amplitude), rtol=1e-6)
    np.testing.assert_allclose(np.abs(solution.critical_x), 1.0, rtol=1e-9)


def test_s_leaves_constant_depth_with_a_square_root_cusp() -> None:
    normal_amplitude = np.array([1e-4, 1e-6, 1e-8])
    at_rest = solve_points(points(normal_amplitude=0.0), 1e-8).s
    growth = solve_points(points(normal_amplitude=normal_amplitude), 1e-8).s - at_rest
    exponent = np.diff(np.log(growth)) / np.diff(np.log(normal_amplitude))
    # The next term is of the order δA: a relative √δA of the first one, here 1e-2 and 1e-3.
    assert abs(exponent[0] - 0.5) < 1e-2
    assert abs(exponent[1] - 0.5) < 1e-3


@pytest.mark.parametrize("profile", each_profile("paraboloid"))
def test_s_converges_to_the_asked_accuracy(profile: str) -> None:
    batch = random_points(1, 6, profile)
    coarse, fine = (solve_points(batch, rtol).s for rtol in (1e-4, 1e-7))
    np.testing.assert_allclose(coarse, fine, rtol=1e-4)


@pytest.mark.parametrize("profile", each_profile())
def test_a_point_does_not_depend_on_its_batch(profile: str) -> None:
    batch = random_points(2, 6, profile, largest_term=2)
    together, backwards = solve_points(batch), solve_points(take(batch, np.arange(6)[::-1]))
    for k in (0, 5):
        alone = solve_points(take(batch, k))
        for name in ("s", "critical_x", "critical_angle", "regime"):
            value = getattr(alone, name)[0]
            assert getattr(together, name)[k] == pytest.approx(value, rel=1e-12, abs=1e-12)
            assert getattr(backwards, name)[5 - k] == pytest.approx(value, rel=1e-12, abs=1e-12)


#: Aligned, 1000 springs see the stress to (1/1000)^1.5 of a cusp's height, a few 1e-5; 360 steps leave
#: chords of growth in stick of (1/360)^1.5 ~ 1.5e-4; 100 positions and 180 planes miss a smooth peak by
#: (1/100)² ~ 1e-4 and (1°)² ~ 3e-4. A mistake in the physics costs per cents.
ALIGNED: dict[str, Any] = {"springs": 1000, "steps": 360, "positions": 100, "planes": 180, "aligned": True}


@pytest.mark.quick(5)
@pytest.mark.parametrize("name", KNOWN)
def test_the_aligned_textbook_method_agrees(name: str) -> None:
    point = points(**KNOWN[name][0])
    assert textbook_s(point, **ALIGNED).s == pytest.approx(solve_points(point).s[0], rel=7e-4)


@pytest.mark.quick(1)
@pytest.mark.parametrize("profile", each_profile())
def test_the_aligned_textbook_method_agrees_at_random_points(profile: str) -> None:
    point = random_points(3, 1, profile, largest_term=3)
    ratio = textbook_s(point, **{**ALIGNED, "positions": 200}).s / solve_points(point).s[0]
    # From below, cusps in x where slip fronts turn are missed by up to (1/200)^½ of their height, ~ 10 %.
    assert 1.0 - 7e-3 < ratio < 1.0 + 7e-4


def test_under_a_constant_normal_load_the_turns_of_the_tangential_one_are_enough() -> None:
    few, many = (textbook_s(points(normal_amplitude=0.0), 100, steps, 20, 18).s for steps in (4, 40))
    assert few == pytest.approx(many, rel=1e-9)


def test_fixed_grids_stay_below_and_come_closer() -> None:
    # The cusp at a(δ0 − δA) falls between positions: a grid only sees it to the root of the spacing.
    point = points(normal_amplitude=0.1)
    s = solve_points(point).s[0]
    coarse, fine = (textbook_s(point, 4 * n, n, n, 90).s for n in (100, 400))
    assert coarse < fine < s
    assert (s - fine) < 0.6 * (s - coarse)
