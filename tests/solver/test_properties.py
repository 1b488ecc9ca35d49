"""Properties of s that hold all over the parameter box, on a few draws each."""

from dataclasses import replace
from math import gcd

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scenes import PLANE_NAMES, PROFILE_NAMES, plane_points, points, shape_of, take
from solved import Points, solve_points
from soundness import RTOL, close, sound

Array = NDArray[np.float64]

few = settings(
    max_examples=6,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
pairs = st.sampled_from([(p, q) for p in range(1, 6) for q in range(1, 6) if gcd(p, q) == 1 and p + q < 7])


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high)


@st.composite
def single_points(draw: st.DrawFn, names: tuple[str, ...] = (*PROFILE_NAMES, *PLANE_NAMES)) -> Points:
    """One point anywhere in the box where s is asked to be accurate, ends included."""
    profile = draw(st.sampled_from(names))
    least = 4.0 if profile == "wavy_cylinder" else 3.6
    ranges = {
        "waviness_amplitude": between(1e-4, 0.2),
        "wavelength": between(least, 12.0),
        "exponent": between(1.1, 20.0),
        "flat_radius": between(0.0, 3.0),
        "flat_half_width": between(0.0, 3.0),
    }
    shape = {name: draw(ranges[name]) for name in shape_of(profile)}
    p, q = draw(pairs)
    if profile in PLANE_NAMES:
        normal = draw(between(0.0, 0.95))
        # Whatever the phase, friction bears so much. Strips that nothing pulls at, or that have next to no
        # friction, have no tension but for rounding.
        pull = (1.0 - normal) * draw(between(0.02, 0.999))
        of_plane = draw(between(0.0, 0.5)), draw(between(0.05, 1.0)), normal, pull, draw(between(0.0, 6.3))
        return plane_points(profile, *of_plane, p, q, **shape)
    return points(
        profile,
        draw(between(0.0, 0.5)),
        # From 1 on the truncated paraboloid may not be finite.
        draw(between(0.0, 0.99 if profile == "truncated_paraboloid" else 1.0)),
        # … nor is it after lift-off, and just before it the maximum is at the singular edge.
        draw(between(0.0, 0.95 if profile == "truncated_paraboloid" else 1.2)),
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
    # Where nothing is in tension, s is the rounding of stresses of the order 1, squared.
    s = np.where(found.s < 1e-24, 0.0, found.s)
    close(s, s[0], 3 * RTOL)


@pytest.mark.slow
@few
@given(single_points())
def test_s_rises_with_friction(point: Points) -> None:
    found = solve_points(several(point, friction=np.linspace(0.0, 0.95, 5)), RTOL)
    assert np.all(np.diff(found.s) >= -2 * RTOL * found.s[1:])


@pytest.mark.slow
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


@pytest.mark.slow
@few
@given(st.lists(single_points(("paraboloid",)), min_size=2, max_size=3))
def test_chunks_do_not_matter(singles: list[Points]) -> None:
    names = [name for name, values in vars(singles[0]).items() if isinstance(values, np.ndarray)]
    batch = replace(
        singles[0], **{name: np.concatenate([getattr(single, name) for single in singles]) for name in names}
    )
    together = solve_points(batch, RTOL)
    half = len(batch) // 2
    parts = [solve_points(take(batch, part), RTOL) for part in (np.arange(half), np.arange(half, len(batch)))]
    for name, values in vars(together).items():
        np.testing.assert_array_equal(np.concatenate([getattr(part, name) for part in parts]), values)
