"""Stability where methods fail: the edges of the parameter box, and properties that hold all over it.

No warning (pytest turns them into errors), no NaN, no exception for valid input.
"""

from __future__ import annotations

from dataclasses import replace
from math import gcd
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray
from scenes import PROFILE_NAMES, points, take

from swtstudy.mechanics import REGIMES, Points, Solution, solve_points
from swtstudy.mechanics.profiles import make_profile

Array = NDArray[np.float64]
RTOL = 1e-4
TINY = 5e-324
SHAPES: dict[str, dict[str, float]] = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": 0.5},
    "truncated_paraboloid": {"flat_radius": 0.5},
    "wavy_paraboloid": {"waviness_amplitude": 0.01, "wavelength": 5.0},
}
every_profile = pytest.mark.parametrize("profile", PROFILE_NAMES)


def sound(batch: Points, rtol: float = RTOL) -> Solution:
    """Solve and check what must hold of every result."""
    found = solve_points(batch, rtol)
    largest_depth = 1.0 + batch.normal_amplitude
    largest = make_profile(batch.profile, batch.shape, largest_depth).radius(largest_depth[:, None])[:, 0]
    finite = found.regime != REGIMES.index("not_finite")
    may_be_infinite = batch.profile == "truncated_paraboloid"
    assert may_be_infinite or np.all(finite)
    assert np.all(np.isnan(found.s) == ~finite)
    assert np.all(np.isfinite(found.s[finite]) & (found.s[finite] >= 0.0))
    assert np.all(np.isfinite(found.s_error[finite]) & (found.s_error[finite] >= 0.0))
    assert np.all((np.abs(found.critical_x) <= largest * (1.0 + 1e-12))[finite])
    assert np.all(((found.critical_angle > -90.0) & (found.critical_angle <= 90.0))[finite])
    # The accuracy asked for, with a margin for the few points at which the estimate is a bit above it.
    assert np.all(found.s_error[finite] <= 3.0 * rtol * found.s[finite])
    return found


def regime_names(found: Solution) -> list[str]:
    return [REGIMES[k] for k in found.regime]


def close(first: ArrayLike, second: ArrayLike, rtol: float) -> None:
    np.testing.assert_allclose(first, second, rtol=rtol, atol=1e-300)


# One parameter at a time to its end, and to the limit beside it.


@every_profile
def test_normal_amplitude_to_lift_off_and_past_it(profile: str) -> None:
    amplitude = [0.0, 1e-12, 0.99, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5, 10.0]
    if profile == "truncated_paraboloid":
        amplitude = amplitude[:3]
    found = sound(points(profile, normal_amplitude=amplitude, phase=0.7, **SHAPES[profile]))
    assert np.all(np.isfinite(found.s))
    assert found.s[1] == pytest.approx(found.s[0], rel=1e-5)  # √δA = 1e-6
    if profile == "truncated_paraboloid":
        return
    # Lift-off starts where the contact is a point for an instant: nothing jumps.
    close(found.s[3:6], found.s[4], 3 * RTOL)
    assert regime_names(found)[5:] == ["lift_off"] * 3
    assert "lift_off" not in regime_names(found)[:5]


@every_profile
@pytest.mark.xfail(strict=True, reason="(δ − 1)/δA overflows")
def test_a_denormal_normal_amplitude_is_none(profile: str) -> None:
    found = sound(points(profile, normal_amplitude=[0.0, TINY, 1e-300], phase=0.7, **SHAPES[profile]))
    close(found.s, found.s[0], RTOL)


@every_profile
def test_tangential_amplitude_to_nothing_and_to_gross_slip(profile: str) -> None:
    amplitude = [0.0, TINY, 1e-300, 1e-12, 2.0, 10.0, 100.0]
    found = sound(points(profile, tangential_amplitude=amplitude, phase=0.7, **SHAPES[profile]))
    close(found.s[:4], found.s[0], 3 * RTOL)
    assert regime_names(found)[0] == "stick"
    assert regime_names(found)[4:] == ["gross_slip"] * 3


@every_profile
def test_constant_depth_from_no_motion_to_gross_slip(profile: str) -> None:
    amplitude = np.array([0.0, TINY, 1e-12, 1e-6, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 5.0])
    batch = points(profile, normal_amplitude=0.0, tangential_amplitude=amplitude, **SHAPES[profile])
    found = solve_points(batch)
    # Nothing oscillates, or hardly: Δε ~ u on a ring ever thinner at the edge.
    assert found.s[0] == 0.0
    assert np.all(np.diff(found.s[:5]) >= 0.0)
    assert found.s[2] < 1e-4 * found.s[4]
    # At u = δ everything has just slipped, and more does not change that.
    close(found.s[4:], found.s[5], 3 * RTOL)
    assert regime_names(found)[-2:] == ["gross_slip"] * 2


@every_profile
def test_friction_to_nothing_and_to_ten(profile: str) -> None:
    friction = [0.0, TINY, 1e-300, 1e-12, 1e-6, 5.0, 10.0]
    if profile == "truncated_paraboloid":
        friction = friction[:5]
    found = sound(points(profile, friction=friction, phase=0.7, **SHAPES[profile]))
    close(found.s[:4], found.s[0], 3 * RTOL)
    assert found.s[4] == pytest.approx(found.s[0], rel=1e-4)
    if len(friction) == 7:
        # The pressure's part fades against the traction's: s ~ μ².
        assert found.s[6] / found.s[5] == pytest.approx(4.0, rel=0.15)


@every_profile
def test_without_friction_the_tangential_motion_does_not_matter(profile: str) -> None:
    batch = points(profile, friction=0.0, tangential_amplitude=[0.0, 0.3, 5.0], phase=0.7, **SHAPES[profile])
    found = sound(batch)
    close(found.s, found.s[0], 3 * RTOL)


@every_profile
def test_poisson_ratio_at_its_ends(profile: str) -> None:
    nu = [0.0, 1e-12, 0.5 - 1e-9, 0.5]
    found = sound(points(profile, poisson_ratio=nu, phase=0.7, **SHAPES[profile]))
    close(found.s[0], found.s[1], 3 * RTOL)
    close(found.s[2], found.s[3], 3 * RTOL)


@every_profile
def test_phase_at_points_of_symmetry(profile: str) -> None:
    for p, q in ((1, 1), (1, 2), (2, 1)):
        # On the symmetry point and a rounding error beside it, u and δ turn together.
        phase = np.pi * np.array([0.0, 0.5, 1.0, 1.5, 2.0])
        batch = points(profile, phase=np.concatenate([phase, phase + 1e-13]), p=p, q=q, **SHAPES[profile])
        found = sound(batch)
        close(found.s[:5], found.s[5:], 3 * RTOL)
        close(found.s[0], found.s[4], 3 * RTOL)
    turns = sound(points(profile, phase=[0.3, 0.3 + 200.0 * np.pi], **SHAPES[profile]))
    close(turns.s[0], turns.s[1], 3 * RTOL)


@pytest.mark.parametrize("phase", [0.0, 0.5 * np.pi, np.pi])
def test_equal_amplitudes_in_phase_neither_grow_nor_slip(phase: float) -> None:
    # u ± δ do not move at all for half the cycle.
    found = sound(points(normal_amplitude=0.5, tangential_amplitude=[0.5, 0.5 + 1e-12], phase=phase))
    close(found.s[0], found.s[1], 3 * RTOL)


@pytest.mark.parametrize(("p", "q"), [(1, 16), (16, 15), (15, 16)])
def test_long_common_periods(p: int, q: int) -> None:
    sound(points(p=p, q=q, phase=0.7), 1e-3)


FEW_GROWTH_NODES = pytest.mark.xfail(strict=True, reason="nodes of the growths do not grow with p/q")


@pytest.mark.parametrize("p", [pytest.param(16, marks=FEW_GROWTH_NODES)])
def test_many_tangential_oscillations_within_one_touch_down(p: int) -> None:
    # So small that the ground grows in stick through all of them.
    sound(points(p=p, tangential_amplitude=0.5 / p, phase=0.7), 1e-3)


@pytest.mark.parametrize("profile", ["rounded_punch", "truncated_paraboloid"])
def test_face_to_nothing_and_to_a_thin_annulus(profile: str) -> None:
    flat_radius = [0.0, TINY, 1e-300, 1e-12, 1e-9, 2.0, 5.0, 20.0, 100.0]
    found = sound(points(profile, phase=0.7, flat_radius=flat_radius))
    paraboloid = solve_points(points(phase=0.7))
    close(found.s[:5], paraboloid.s[0], 3 * RTOL)
    falls = np.diff(found.s[5:])
    assert np.all(falls < 0.0) if profile == "rounded_punch" else np.all(falls > 0.0)


def test_waviness_to_nothing() -> None:
    # Shorter waves of the same steepness hold less: the slope goes like √h.
    amplitude = np.array([0.0, 1e-5, 1e-3])
    found = sound(points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=5.0))
    distance = np.abs(found.s / found.s[0] - 1.0)
    assert distance[1] < distance[2] < 0.3


@pytest.mark.parametrize("amplitude", [TINY, 1e-300, 1e-14])
@pytest.mark.xfail(strict=True, reason="the number of nodes overflows or takes hours", run=False)
def test_waviness_too_fine_to_matter(amplitude: float) -> None:
    found = sound(points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=5.0))
    assert found.s[0] == pytest.approx(solve_points(points(phase=0.7)).s[0], rel=1e-3)


@pytest.mark.parametrize("amplitude", [1e-3, 0.1, 10.0])
def test_waviness_at_the_limit_of_a_compact_contact_and_far_above(amplitude: float) -> None:
    # 3.54 is the limit for any number of waves within the contact.
    sound(points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=[3.55, 1000.0]))


# The truncated paraboloid at r = b⁺: p and q are A ln(1/ε) there, σ_n ~ −(1 − μ sin 2θ) A ln(1/ε).


@pytest.mark.parametrize("flat_radius", [0.5, 2.0])
@pytest.mark.parametrize("friction", [1.05, 1.2, 3.0])
def test_gross_slip_with_friction_above_one_tears_at_the_edge(flat_radius: float, friction: float) -> None:
    batch = points(
        "truncated_paraboloid",
        friction=friction,
        tangential_amplitude=2.0,
        phase=[0.7, 2.0],
        flat_radius=flat_radius,
    )
    assert regime_names(solve_points(batch)) == ["not_finite"] * 2


@pytest.mark.xfail(strict=True, reason="only gross slip is flagged")
@pytest.mark.parametrize("flat_radius", [0.5, 2.0])
def test_so_does_a_stick_zone_that_keeps_the_offset_of_a_slip_line(flat_radius: float) -> None:
    # Table 1: min(u + δ) < 0, so that even the spring at the edge was at its limit, and stays so.
    batch = points("truncated_paraboloid", friction=1.2, flat_radius=flat_radius)
    assert regime_names(solve_points(batch)) == ["not_finite"]


def test_sliding_through_lift_off_tears_at_the_edge_with_any_friction() -> None:
    # While the contact grows past r the springs inside pull with a finite stress, and Δε_n ~ ln(1/ε).
    batch = points(
        "truncated_paraboloid",
        0.0,
        [0.2, 0.5],
        [1.0, 1.1875],
        tangential_amplitude=1.0,
        phase=[1.0, 0.0],
        flat_radius=1.0,
    )
    assert regime_names(solve_points(batch)) == ["not_finite"] * 2


def test_without_slip_at_the_edge_a_truncated_paraboloid_stays_finite() -> None:
    # max(u − δ) < 0 < min(u + δ): the spring at the edge never slips, q is regular there.
    batch = points(
        "truncated_paraboloid",
        friction=[1.2, 3.0],
        normal_amplitude=0.5,
        tangential_amplitude=0.3,
        phase=0.7,
        flat_radius=2.0,
    )
    assert regime_names(sound(batch)) == ["partial_slip"] * 2


# Properties that hold all over the box, on a few hundred draws.

few = settings(
    max_examples=12,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
pairs = st.sampled_from([(p, q) for p in range(1, 6) for q in range(1, 6) if gcd(p, q) == 1 and p + q < 7])


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high)


@st.composite
def single_points(draw: st.DrawFn, names: tuple[str, ...] = PROFILE_NAMES) -> Points:
    """One point anywhere in the box where s is asked to be accurate, ends included."""
    profile = draw(st.sampled_from(names))
    shape: dict[str, Any] = {}
    if profile == "wavy_paraboloid":
        shape = {"waviness_amplitude": draw(between(1e-4, 0.2)), "wavelength": draw(between(3.6, 12.0))}
    elif profile != "paraboloid":
        shape = {"flat_radius": draw(between(0.0, 3.0))}
    p, q = draw(pairs)
    return points(
        profile,
        draw(between(0.0, 0.5)),
        # Above 0.9 the truncated paraboloid may not be finite.
        draw(between(0.0, 0.85 if profile == "truncated_paraboloid" else 1.0)),
        # … nor may it after lift-off.
        draw(between(0.0, 0.99 if profile == "truncated_paraboloid" else 1.2)),
        draw(between(0.0, 1.2)),
        draw(between(0.0, 6.3)),
        p,
        q,
        **shape,
    )


def several(point: Points, **columns: Array) -> Points:
    """The point repeated with some of its columns replaced."""
    size = len(next(iter(columns.values())))
    batch = take(point, np.zeros(size, dtype=int))
    shape = {name: columns.pop(name, values) for name, values in batch.shape.items()}
    return replace(batch, **columns, shape=shape)


@few
@given(single_points())
def test_every_result_is_sound(point: Points) -> None:
    sound(point)


@few
@given(single_points())
def test_s_has_its_period_in_the_phase(point: Points) -> None:
    period = (1.0 if point.q[0] % 2 else 2.0) * np.pi / point.p[0]
    found = solve_points(several(point, phase=point.phase[0] + period * np.array([0.0, 1.0, -2.0])), RTOL)
    close(found.s, found.s[0], 3 * RTOL)


@few
@given(single_points())
def test_s_rises_with_friction(point: Points) -> None:
    found = solve_points(several(point, friction=np.linspace(0.0, 0.85, 5)), RTOL)
    assert np.all(np.diff(found.s) >= -2 * RTOL * found.s[1:])


@few
@given(single_points(("paraboloid", "rounded_punch")), between(0.01, 1.0))
def test_s_rises_with_the_tangential_amplitude(point: Points, friction: float) -> None:
    # Up to gross slip; and not a theorem: steps of 0.3 are longer than any ripple found.
    batch = several(point, tangential_amplitude=np.array([0.0, 0.3, 0.6, 0.9]))
    found = solve_points(replace(batch, friction=np.full(4, friction)), RTOL)
    assert np.all(np.diff(found.s) >= -1e-3 * found.s[1:])


@few
@given(single_points())
def test_s_is_continuous_in_every_parameter(point: Points) -> None:
    # √1e-11 ~ 3e-6 is the most that a cusp in a parameter moves s, whose own error is below RTOL.
    names = ["poisson_ratio", "friction", "normal_amplitude", "tangential_amplitude", "phase"]
    batch = take(point, np.zeros(1 + len(names) + len(point.shape), dtype=int))
    columns = {name: getattr(batch, name).copy() for name in names}
    shape = {name: values.copy() for name, values in batch.shape.items()}
    for k, values in enumerate([*columns.values(), *shape.values()]):
        values[1 + k] *= 1.0 - 1e-11
    found = solve_points(replace(batch, **columns, shape=shape), RTOL)
    assert np.all(np.abs(found.s - found.s[0]) <= found.s_error + found.s_error[0] + RTOL * found.s[0])


@few
@given(st.lists(single_points(("paraboloid",)), min_size=3, max_size=8))
def test_chunks_do_not_matter(singles: list[Points]) -> None:
    names = ["poisson_ratio", "friction", "normal_amplitude", "tangential_amplitude", "phase", "p", "q"]
    batch = replace(
        singles[0],
        **{name: np.concatenate([getattr(single, name) for single in singles]) for name in names},
    )
    together = solve_points(batch, RTOL)
    half = len(batch) // 2
    parts = [solve_points(take(batch, part), RTOL) for part in (np.arange(half), np.arange(half, len(batch)))]
    np.testing.assert_allclose(np.concatenate([part.s for part in parts]), together.s, rtol=1e-12)


def test_many_copies_of_one_point_are_all_alike() -> None:
    batch = take(points(phase=0.7), np.zeros(300, dtype=int))
    found = solve_points(batch, 1e-3)
    assert np.ptp(found.s) == 0.0


def test_an_empty_batch_has_an_empty_solution() -> None:
    found = solve_points(take(points(), np.zeros(0, dtype=int)))
    assert found.s.shape == found.regime.shape == (0,)
