"""The truncated paraboloid at r = b⁺, where p and q are A ln(1/ε): where s is finite, and where it lies."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scenes import points
from solved import Points, solve_points
from soundness import regime_names, sound


def truncated(
    friction: ArrayLike, normal: ArrayLike, tangential: float, phase: float, flat_radius: ArrayLike
) -> Points:
    return points("truncated_paraboloid", 0.3, friction, normal, tangential, phase, flat_radius=flat_radius)


FINITE = {
    "the innermost spring never slips": (3.0, 0.5, 0.3, 0.7, 2.0),
    "μ = 1 without gross slip": (1.0, 0.75, 5 / 6, 0.0, 0.5),
    "lift-off without sliding": (3.0, 1.5, 0.0, 0.0, 1.0),
    "lift-off without friction": (0.0, 1.5, 1.0, 0.7, 1.0),
    "no face": (3.0, 1.5, 2.0, 0.7, 0.0),
    "at rest": (3.0, 0.0, 0.0, 0.0, 0.5),
}


@pytest.mark.parametrize("values", FINITE.values(), ids=FINITE)
def test_finite(values: tuple[float, ...]) -> None:
    assert regime_names(sound(truncated(*values))) != ["not_finite"]


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "values",
    [
        # The maximum is at r = b, or elsewhere.
        (0.08435340, 0.94105030, 0.79864548, 1.0938743, 2.9931, 5, 4, 1.8927726),
        (0.29732402, 0.91095776, 0.89587082, 0.74832412, 4.493057, 5, 3, 1.1397951),
    ],
)
def test_the_front_passes_r_before_it_arrives_at_the_innermost_spring(values: tuple[float, ...]) -> None:
    # From then on the point itself slips: interpolation over that kink would make s 12 to 27 % too large.
    *load, flat_radius = values
    batch = points("truncated_paraboloid", *load, flat_radius=flat_radius)
    coarse, fine = solve_points(batch, 1e-6), solve_points(batch, 1e-7)
    assert coarse.s_error[0] <= 3e-6 * coarse.s[0]
    assert fine.s_error[0] <= 2e-6 * fine.s[0]
    assert coarse.s[0] == pytest.approx(fine.s[0], rel=3e-7)
    assert solve_points(batch).s[0] == pytest.approx(fine.s[0], rel=3e-5)


def test_gross_slip_below_friction_one_has_its_maximum_next_to_the_edge() -> None:
    # At L ~ 1/(1 − μ), and as high: numbers near b end at L = 36.
    friction = np.array([0.97, 0.98, 0.985, 0.989])
    found = sound(truncated(friction, 0.75, 2.0, 0.7, 1.0))
    np.testing.assert_array_equal(np.abs(found.critical_x), 1.0)
    np.testing.assert_allclose(np.abs(found.critical_angle), 45.0, atol=3.0)
    limit = found.s * (1.0 - friction)
    np.testing.assert_allclose(limit, limit[-1], rtol=0.03)
    # Nearer still there is no continuum.
    assert regime_names(solve_points(truncated(0.996, 0.75, 2.0, 0.7, 1.0))) == ["not_finite"]


def test_s_grows_like_a_logarithm_towards_lift_off() -> None:
    normal = 1.0 - 10.0 ** -np.array([1.0, 1.5, 2.0, 2.5, 3.0, 6.0])
    found = solve_points(truncated(0.5, normal, 0.5, 0.0, 2.0), 1e-3)
    assert regime_names(found) == ["stick"] * 5 + ["not_finite"]
    rise = np.diff(found.s[2:5])
    assert rise[1] == pytest.approx(rise[0], rel=0.02)


def test_s_grows_like_a_logarithm_towards_slip_of_the_innermost_spring() -> None:
    # |u| = δ is reached at u_A = √(1 − δA²) here.
    tangential = np.sqrt(0.75) * (1.0 - 10.0 ** -np.array([1.0, 2.0, 3.0, 4.0, 6.0, 12.0]))
    batch = points("truncated_paraboloid", 0.3, 1.2, 0.5, tangential, -0.5 * np.pi, flat_radius=1.0)
    found = solve_points(batch)
    assert regime_names(found) == ["partial_slip"] * 4 + ["not_finite"] * 2
    assert found.s[3] - found.s[2] > found.s[2] - found.s[1] > 0.0


@pytest.mark.slow
def test_s_is_continuous_where_the_search_changes_hands() -> None:
    for friction in (0.8, 0.9, 0.94, 0.95):
        found = sound(truncated(friction + np.array([-1e-9, 0.0, 1e-9]), 0.75, 2.0, 0.7, 1.0))
        np.testing.assert_allclose(found.s, found.s[1], rtol=1e-4)
    found = sound(truncated(np.linspace(0.9, 0.99, 19), 0.75, 2.0, 0.7, 2.0))
    # Convex: the rise per step never falls.
    assert np.all(np.diff(found.s, 2) > -1e-4 * found.s[1:-1])
    assert np.all(solve_points(truncated(0.9, 0.75, 2.0, 0.7, [0.0, 1e-9, 1e-3])).s > 0.0)


def pulled(mean: float, amplitude: float = 0.0, phase: float = 0.0, **other: float) -> Points:
    own = {"friction": 0.0, "normal": 1.2, "tangential": 1.0, "phase": 1.0, "flat_radius": 1.0} | other
    bulk = {"bulk_stress_mean": mean, "bulk_stress_amplitude": amplitude, "bulk_stress_phase": phase}
    return replace(truncated(**own), **{name: np.array([value]) for name, value in bulk.items()})


def test_at_half_no_strain_swings_with_the_pressure_alone() -> None:
    found = solve_points(replace(pulled(0.05), poisson_ratio=np.array([0.5])))
    assert regime_names(found) == ["lift_off"]
    assert found.s[0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("flat_radius", "normal", "tangential", "expected"),
    # s at the place of the maximum by `oracles.line.Line.stress`; of the last one at the rtol 1e-6.
    [
        (10.0, 0.99, 1e-4, 1.7586978),
        (3.0, 0.99, 1e-5, 0.0530112),
        (2.0, 0.999, 1e-5, 0.0933180),
        (100.0, 0.99, 1e-4, 176.35208),
    ],
)
@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_small_motions_of_a_nearly_unloaded_face(
    flat_radius: float, normal: float, tangential: float, expected: float, rtol: float
) -> None:
    """The pressure beside the edge is much higher than the tension: what grew has to be known to less."""
    given = points(
        "truncated_paraboloid", 0.3, 0.3, normal, tangential, 1.0, p=1, q=2, flat_radius=flat_radius
    )
    found = solve_points(given, rtol)
    assert found.s[0] == pytest.approx(expected, abs=found.s_error[0] + 2e-6 * expected)


def test_the_error_covers_small_motions_of_nearly_unloaded_faces() -> None:
    rng = np.random.default_rng(3)
    for q in (2, 3, 4, 5) * 4:
        given = points(
            "truncated_paraboloid",
            rng.uniform(0.1, 0.45),
            10.0 ** rng.uniform(-1.7, -0.2),
            1.0 - 10.0 ** rng.uniform(-3.0, -0.5),
            10.0 ** rng.uniform(-6.0, -2.0),
            rng.uniform(0.0, 6.28),
            p=1,
            q=q,
            flat_radius=10.0 ** rng.uniform(-0.3, 1.3),
        )
        rough, fine = solve_points(given, 1e-4), solve_points(given, 1e-6)
        assert abs(rough.s[0] - fine.s[0]) <= rough.s_error[0] + fine.s_error[0]
