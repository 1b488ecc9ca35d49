"""Walker's mean-stress exponent: closed forms, brute force, and the way back to swt at γ = 1/2."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from oracles.hertz import at_the_edge
from scenes import PROFILE_NAMES, points, random_points, take
from solved import Points, solve_points
from test_values import ALIGNED

import swtstudy
from studies.accuracy_speed.textbook import textbook_s

SEVERAL = np.array([0.1, 0.3, 0.5, 0.7, 0.85])


def with_exponent(batch: Points, exponent: Any) -> Points:
    return replace(batch, walker_exponent=np.broadcast_to(exponent, (len(batch),)).astype(float))


def test_swt_is_what_it_was_to_the_last_bit() -> None:
    batch = random_points(4, 4)
    plain, given = solve_points(batch), solve_points(with_exponent(batch, 0.5))
    for name, values in vars(plain).items():
        np.testing.assert_array_equal(getattr(given, name), values)


def test_points_with_other_exponents_leave_swt_alone() -> None:
    batch = random_points(4, 6, largest_term=1)
    mixed = solve_points(with_exponent(batch, [0.5, 0.3, 0.5, 0.8, 0.5, 0.7]))
    alone = solve_points(take(batch, [0, 2, 4]))
    np.testing.assert_array_equal(mixed.s[::2], alone.s)
    np.testing.assert_array_equal(mixed.critical_x[::2], alone.critical_x)


@pytest.mark.parametrize(("nu", "mu", "amplitude"), [(0.3, 0.3, 5 / 6), (0.0, 0.8, 0.5), (0.45, 0.5, 0.2)])
def test_constant_depth_has_a_closed_form(nu: float, mu: float, amplitude: float) -> None:
    batch = with_exponent(points("paraboloid", nu, mu, 0.0, amplitude * np.ones(5)), SEVERAL)
    found = solve_points(batch, 1e-7)
    spread, pull, across = at_the_edge(nu, mu, amplitude)
    tension, swing = 2.0 / np.pi * (spread + pull), 2.0 / np.pi * (pull - nu * across)
    expected = tension ** (2.0 - 2.0 * SEVERAL) * swing ** (2.0 * SEVERAL) / (1.0 - nu**2)
    np.testing.assert_allclose(found.s, expected, rtol=1e-6)
    np.testing.assert_allclose(np.abs(found.critical_x), 1.0, rtol=1e-9)


def test_s_is_continuous_in_the_exponent() -> None:
    batch = points(phase=[0.0, 1.0, 2.3])
    at, near = (solve_points(with_exponent(batch, γ), 1e-7).s for γ in (0.5, 0.5 + 1e-9))
    np.testing.assert_allclose(near, at, rtol=1e-7)


def test_where_the_critical_point_jumps_s_does_not() -> None:
    """ψ = 1 at Table 1: from the edge on the x-normal to oblique planes well inside the contact."""
    γ = np.linspace(0.6, 0.7, 11)
    found = solve_points(with_exponent(points(phase=np.ones(11)), γ), 1e-6)
    jump = np.abs(np.diff(np.abs(found.critical_x)))
    assert jump.max() > 0.3
    assert np.sort(jump)[-2] < 0.05
    assert np.abs(np.diff(np.log(found.s), n=2)).max() < 0.06


@pytest.mark.parametrize(
    ("profile", "exponent"),
    [
        ("paraboloid", 0.3),
        ("rounded_punch", 0.8),
        *(pytest.param(p, 0.8, marks=pytest.mark.slow) for p in PROFILE_NAMES if p != "rounded_punch"),
    ],
)
def test_the_aligned_textbook_method_agrees(profile: str, exponent: float) -> None:
    point = with_exponent(random_points(3, 1, profile, largest_term=3), exponent)
    ratio = textbook_s(point, **{**ALIGNED, "positions": 200}).s / solve_points(point).s[0]
    # As at γ = 1/2, but a small γ doubles the weight of the tension, whose cusps in x are missed.
    assert 1.0 - 4e-2 < ratio < 1.0 + 7e-4


@pytest.mark.slow
def test_fields_and_means_have_the_exponent() -> None:
    parameters: dict[str, Any] = {"phase": 1.0, "walker_exponent": 0.3}
    solved = swtstudy.solve(**parameters)
    x = float(solved.critical_x)
    field = swtstudy.swt_field(x, 0.0, 0.0, **parameters)
    assert float(field.s_local) == pytest.approx(float(solved.s), rel=3e-3)
    means = swtstudy.solve(critical_distance=1e-6, **parameters)
    assert float(means.s_line.sel(direction="depth").squeeze()) == pytest.approx(float(solved.s), rel=0.01)
    stress = swtstudy.stress_field(x, 0.0, 0.0, **parameters)
    history = np.stack([stress[name].values for name in stress if name.startswith("sigma")], axis=-1)
    own = swtstudy.swt_of_history(history, 0.3, 1.0 - 0.3**2, walker_exponent=0.3)
    assert float(own.swt) == pytest.approx(float(solved.s), rel=2e-5)
    shown = swtstudy.inspect_point(**parameters)
    assert float(shown.s_local.max()) == pytest.approx(float(solved.s), rel=1e-2)
