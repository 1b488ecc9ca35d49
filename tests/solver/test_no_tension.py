"""Where nothing is in tension, or nothing moves, s is 0 and no point critical; where there is hardly any."""

import numpy as np
import pytest
from made_up import STATEMENTS
from scenes import plane_points, points
from solved import REGIMES, solve_points
from soundness import SHAPES

import swtstudy

IDLE = [
    {"poisson_ratio": 0.5, "friction": 0.0},
    {"poisson_ratio": 0.5, "tangential_amplitude": 0.0},
    {"normal_amplitude": 0.0, "friction": 0.0},
    {"normal_amplitude": 0.0, "tangential_amplitude": 0.0},
]


@pytest.mark.parametrize("profile", SHAPES)
@pytest.mark.parametrize("values", IDLE)
def test_no_critical_point_where_s_is_zero(profile: str, values: dict[str, float]) -> None:
    found = solve_points(points(profile, **values, **SHAPES[profile]))  # type: ignore[arg-type]
    assert found.s[0] == found.s_error[0] == found.s_surface[0] == 0.0
    assert np.isnan(found.critical_x[0])
    assert np.isnan(found.critical_angle[0])
    assert REGIMES[found.regime[0]] != "not_finite"


def test_without_tangential_motion_friction_does_not_matter() -> None:
    found = solve_points(points(poisson_ratio=0.4999, tangential_amplitude=0.0, friction=[0.0, 10.0]), 1e-8)
    assert found.s[0] == found.s[1] > 0.0
    assert found.critical_x[0] == found.critical_x[1]


def test_what_needs_a_critical_point_lives_without_one() -> None:
    none = {"poisson_ratio": 0.5, "friction": 0.0}
    solved = swtstudy.solve(**none, phase=[0.0, 4.0])
    assert np.isnan(solved.critical_x).all()
    assert swtstudy.solve(critical_distance=0.1, **none).s_volume == 0.0
    inspected = swtstudy.inspect_point(**none)
    assert np.isfinite(inspected.shown_x)


def test_statements_on_critical_points_leave_out_where_there_is_none() -> None:
    some = swtstudy.solve(poisson_ratio=[0.3, 0.5], friction=0.0)
    alone = swtstudy.solve(poisson_ratio=[0.3], friction=0.0)
    for statement in (STATEMENTS["outside_of_stick"], STATEMENTS["normal_along_x"]):
        assert statement(some).holds == statement(alone).holds
        assert "nan" not in statement(some).measured


@pytest.mark.quick(1)
@pytest.mark.parametrize("profile", ["paraboloid", "rounded_punch", "wavy_paraboloid"])
@pytest.mark.parametrize("rest", [1e-4, pytest.param(1e-6, marks=pytest.mark.slow)])
def test_hardly_any_tension_is_not_drowned_in_rounding(profile: str, rest: float) -> None:
    # Without friction σ_xx = (1/2 − ν) P/(π r²) − p: at the edge only the first term is left, of which the
    # swing of strain, too, is made but for orders above: s goes with the square of 1/2 − ν.
    phase = np.linspace(0.0, 3.0, 3)
    shape = {name: np.full(3, value) for name, value in SHAPES[profile].items()}
    near, nearer = (
        solve_points(points(profile, 0.5 - small, 0.0, 0.8, phase=phase, **shape), 1e-6).s / small**2
        for small in (rest, 0.5 * rest)
    )
    np.testing.assert_allclose(near, nearer, rtol=20.0 * rest)
    coarse = solve_points(points(profile, 0.5 - rest, 0.0, 0.8, phase=phase, **shape), 1e-4).s / rest**2
    np.testing.assert_allclose(coarse, near, rtol=1e-4)


@pytest.mark.slow
def test_tension_within_rounding_is_within_s_error() -> None:
    # The cylinder's friction pulls by 2 μ p0 √N at most, p0 = 1/2: less than the bulk stress presses. Where
    # the edge leaves a place nothing acts across z, and rounding of that to the power of 0.2 is not small.
    found = solve_points(
        plane_points(
            poisson_ratio=[0.06305401, 0.30600425905670725],
            friction=[0.14134227, 0.03137036440145063],
            normal_force_amplitude=[0.5, 0.9998227575774346],
            tangential_force_amplitude=[0.1221914, 4.997078711851938e-08],
            phase=[1.57079633, 5.275668413336011],
            p=[4, 1],
            q=[3, 1],
            bulk_stress_mean=[-1.11167663, -0.17125916809521124],
            walker_exponent=0.9,
        )
    )
    assert np.all(found.s <= found.s_error)
