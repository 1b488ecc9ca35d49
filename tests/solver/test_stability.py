"""Stability where methods fail: each parameter to the ends of its range, and to the limits beside them.

No warning (pytest turns them into errors), no NaN, no exception for valid input.
"""

import numpy as np
import pytest
from oracles.hertz import s_at_the_edge
from scenes import each_profile, points, take
from solved import solve_points
from soundness import RTOL, SHAPES, close, regime_names, sound

TINY = 5e-324
every_profile = pytest.mark.parametrize("profile", each_profile())


# One parameter at a time to its end, and to the limit beside it.


@every_profile
def test_normal_amplitude_to_lift_off_and_past_it(profile: str) -> None:
    amplitude = [0.0, 1e-12, 0.99, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5, 10.0]
    found = sound(points(profile, normal_amplitude=amplitude, phase=0.7, **SHAPES[profile]))
    assert found.s[1] == pytest.approx(found.s[0], rel=1e-5)  # √δA = 1e-6
    if profile == "truncated_paraboloid":
        # The springs that touch next to r = b pull before the infinite pressure comes (test_face_edge.py).
        assert regime_names(found)[4:] == ["not_finite"] * 4
        return
    # Lift-off starts where the contact is a point for an instant: nothing jumps.
    close(found.s[3:6], found.s[4], 3 * RTOL)
    assert regime_names(found)[5:] == ["lift_off"] * 3
    assert "lift_off" not in regime_names(found)[:5]


@every_profile
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


@pytest.mark.quick(1)
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


def test_a_slip_zone_thinner_than_any_grid_at_constant_depth() -> None:
    amplitude = 10.0 ** -np.arange(1.0, 13.0)
    # A position off by roundings moves s by the root of them over the slip zone's width: 5 times that of 8
    # is claimed.
    rounding = 5.0 * np.sqrt(8.0 * np.finfo(float).eps / amplitude)
    found = sound(points(normal_amplitude=0.0, tangential_amplitude=amplitude), rounding=rounding)
    exact = s_at_the_edge(0.3, 0.3, amplitude)
    assert np.all(np.abs(found.s - exact) <= found.s_error)


@every_profile
def test_friction_to_nothing_and_to_ten(profile: str) -> None:
    friction = [0.0, TINY, 1e-300, 1e-12, 1e-6, 5.0, 10.0]
    found = sound(points(profile, friction=friction, phase=0.7, **SHAPES[profile]))
    close(found.s[:4], found.s[0], 3 * RTOL)
    assert found.s[4] == pytest.approx(found.s[0], rel=1e-4)
    if profile == "truncated_paraboloid":
        assert regime_names(found)[5:] == ["not_finite"] * 2
    else:
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
    for p, q in ((1, 2), (2, 1)):
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


@pytest.mark.parametrize("p", [4, 16])
def test_many_tangential_oscillations_within_one_touch_down(p: int) -> None:
    # So small that the ground grows in stick through all of them.
    batch = points(p=p, tangential_amplitude=0.5 / p, phase=0.7)
    found = sound(batch, 1e-3)
    close(found.s, sound(batch, 1e-5).s, 1e-3)


@pytest.mark.slow
def test_the_longest_common_periods() -> None:
    # Up to some seconds a value.
    for p, q in ((1, 64), (63, 64)):
        sound(points(p=p, q=q, phase=0.7), 1e-3)


@pytest.mark.parametrize("profile", ["rounded_punch", "truncated_paraboloid"])
def test_face_to_nothing_and_to_a_thin_annulus(profile: str) -> None:
    flat_radius = [0.0, TINY, 1e-300, 1e-12, 1e-9, 2.0, 5.0, 20.0]
    found = sound(points(profile, phase=0.7, flat_radius=flat_radius))
    paraboloid = solve_points(points(phase=0.7))
    close(found.s[:5], paraboloid.s[0], 3 * RTOL)
    falls = np.diff(found.s[5:])
    assert np.all(falls < 0.0) if profile == "rounded_punch" else np.all(falls > 0.0)


def test_waviness_to_nothing() -> None:
    # Shorter waves of the same steepness hold less: the slope goes like √h.
    amplitude = np.array([0.0, 1e-4, 1e-3])
    found = sound(points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=5.0))
    distance = np.abs(found.s / found.s[0] - 1.0)
    assert distance[1] < distance[2] < 0.3


def test_waviness_too_fine_to_follow_is_left_out_and_in_the_error() -> None:
    amplitude = np.array([TINY, 1e-300, 1e-14, 1e-7, 1e-5])
    batch = points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=5.0)
    found = solve_points(batch)
    close(found.s, solve_points(points(phase=0.7)).s[0], RTOL)
    assert np.all(np.diff(found.s_error[2:]) > 0.0)
    assert found.s_error[0] <= RTOL * found.s[0] < found.s_error[-1] < 0.05 * found.s[-1]


@pytest.mark.parametrize("amplitude", [1e-3, 0.1, 10.0])
def test_waviness_at_the_limit_of_a_compact_contact_and_far_above(amplitude: float) -> None:
    # 3.54 is the limit for any number of waves within the contact.
    sound(points("wavy_paraboloid", phase=0.7, waviness_amplitude=amplitude, wavelength=[3.55, 1000.0]))


def test_many_copies_of_one_point_are_all_alike() -> None:
    batch = take(points(phase=0.7), np.zeros(300, dtype=int))
    found = solve_points(batch, 1e-3)
    assert np.ptp(found.s) == 0.0
