"""What is drawn and asked of a point whose stick zone a bulk stress moves: fields, cycle, means, lives."""

import numpy as np
import pytest
from body import von_mises
from numpy.typing import NDArray
from scipy.integrate import trapezoid

import swtstudy

Array = NDArray[np.float64]
FRICTION, NU, LOAD = 0.5, 0.3, 0.6
GIVEN = {"friction": FRICTION, "poisson_ratio": NU, "normal_force_amplitude": 0.0}
MOVED = {**GIVEN, "tangential_force_amplitude": LOAD, "bulk_stress_amplitude": 0.12}
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
PROFILES = pytest.mark.parametrize("profile", ["cylinder", "paraboloid"])


def field_at(places: Array, time: Array, **given: object) -> Array:
    """Stress at places (n, 3) and instants, shape (n, m, 6)."""
    import xarray as xr

    x, y, z = (xr.DataArray(each, dims="place") for each in places.T)
    field = swtstudy.stress_field(x, y, z, time=time, **given)
    return np.stack([field[f"sigma_{name}"].transpose("place", "time") for name in COMPONENTS], axis=-1)


def sliding(profile: str, places: Array) -> tuple[Array, Array]:
    """Stress by Hertz's pressure, and by the shear μ times that, of the half-width 1, each (n, 6)."""
    time = np.array([0.5, 1.5]) * np.pi
    both = field_at(places, time, profile=profile, **GIVEN, tangential_force_amplitude=1.0)
    return 0.5 * (both[:, 0] + both[:, 1]), 0.5 * (both[:, 0] - both[:, 1])


@PROFILES
@pytest.mark.parametrize("depth", [0.0, 0.07])
def test_the_field_is_that_of_two_shears_with_centres_of_their_own(profile: str, depth: float) -> None:
    draw = np.random.default_rng(5)
    places = np.column_stack([draw.uniform(-1.4, 1.4, (40, 2)), np.full(40, depth)])
    if depth:
        places[:, 2] *= draw.uniform(0.2, 10.0, 40)
    if profile == "cylinder":
        places[:, 1] = 0.0
    shift = float(swtstudy.solve(profile=profile, **MOVED, rtol=1e-2).bulk_shift)
    c = (1.0 - LOAD) ** (1.0 / (2.0 if profile == "cylinder" else 3.0))
    pressure, shear = sliding(profile, places)
    inner = c * sliding(profile, (places - [shift, 0.0, 0.0]) / c)[1]
    bulk = MOVED["bulk_stress_amplitude"] * np.array([1.0, NU * (profile == "cylinder"), 0, 0, 0, 0])
    time = np.array([0.5, 1.5]) * np.pi
    found = field_at(places, time, profile=profile, **MOVED)
    for instant, sign in ((0, 1.0), (1, -1.0)):
        expected = pressure + sign * (shear - inner + bulk)
        np.testing.assert_allclose(found[:, instant], expected, atol=2e-8)


@PROFILES
def test_s_is_the_largest_value_of_its_field(profile: str) -> None:
    found = swtstudy.solve(profile=profile, **MOVED, rtol=1e-6)
    x = float(found.critical_x)
    field = swtstudy.swt_field(x, 0.0, 0.0, profile=profile, **MOVED)
    assert float(field.s_local) == pytest.approx(float(found.s), rel=1e-3)
    around = x + np.array([-0.1, -0.02, 0.02, 0.1])
    near = swtstudy.swt_field(around, [0.0, 0.3], [0.0, 0.05], profile=profile, **MOVED)
    assert float(near.s_local.max()) < float(found.s)


@PROFILES
def test_tractions_and_states_of_the_cycle(profile: str) -> None:
    point = swtstudy.inspect_point(profile=profile, **MOVED)
    assert float(point.permanent_stick_radius) == pytest.approx(
        0.5 * float(point.stick_right - point.stick_left), rel=1e-9
    )
    assert float(point.stick_left + point.stick_right) == pytest.approx(
        2.0 * float(point.bulk_shift), rel=1e-9
    )
    assert (np.abs(point.traction) <= FRICTION * point.pressure * (1.0 + 1e-9) + 1e-9).all()
    # Slip at x is where the traction is that of friction.
    for number in point.instant.values:
        here = point.sel(instant=number)
        now = point.state.sel(time=float(here.instant_time), method="nearest")
        state = now.interp(r=here.x.values, method="nearest").values
        inside = np.abs(here.x.values) < 0.99 * float(point.largest_radius)
        full = np.isclose(np.abs(here.traction), FRICTION * here.pressure, rtol=1e-6)
        agree = (state >= 2) == full
        assert np.mean(agree[inside]) > 0.98
    if profile == "cylinder":
        force = trapezoid(point.traction, point.x, axis=-1) / (FRICTION * 0.25 * np.pi)
        expected = point.tangential_force.interp(time=point.instant_time)
        np.testing.assert_allclose(force, expected, atol=3e-3)


def test_a_slip_map_has_both_sides() -> None:
    given = {"profile": "cylinder", **MOVED}
    ends = swtstudy.solve(**given, quantities=["stick_left"], rtol=1e-2)
    left, right = float(ends.stick_left), float(ends.stick_right)
    assert right - left == pytest.approx(2.0 * np.sqrt(1.0 - LOAD))
    r = [left - 0.01, left + 0.01, right - 0.01, right + 0.01]
    always = (swtstudy.slip_map(r, **given).state == 1).all("time").values.tolist()
    assert always == [False, True, True, False]
    assert "stick_centre" not in swtstudy.slip_map(r, **given, stick_zone_shift="none")


@pytest.mark.quick(1)
@PROFILES
def test_means_and_stresses_rise_with_s(profile: str) -> None:
    given = {"profile": profile, **MOVED, "critical_distance": 0.02, "quantities": ["von_mises"]}
    moved, none = (swtstudy.solve(**given, stick_zone_shift=each) for each in ("moved", "none"))
    rise = float(moved.s / none.s)
    assert rise > 1.05
    for name in ("s_volume", "s_point", "s_line"):
        own = (moved[name] / none[name]).values
        assert (own > 1.0 + 0.5 * (rise - 1.0)).all()
        assert (moved[name] < moved.s).all()
    # At the edge xx is all that is there: of plane strain in the plane.
    time = np.linspace(0.0, 2.0 * np.pi, 721)
    at_edge = von_mises(swtstudy.stress_field(-1.0, 0.0, 0.0, time=time, profile=profile, **MOVED))
    assert float(moved.von_mises) >= 0.99 * at_edge.max()


def test_a_round_with_one_strain_cycle_has_the_life_of_s() -> None:
    steel = swtstudy.FatigueConstants(205e3, 1000.0, -0.09, 0.6, -0.6)
    contact = swtstudy.physical(
        profile="cylinder", young_modulus=205e3, poisson_ratio=0.3, radius=40.0, normal_force=400.0,
        friction=0.8, tangential_force_amplitude=150.0, bulk_stress_amplitude=60.0, bulk_stress_ratio=0.1,
    )  # fmt: skip
    found = contact.solve(constants=steel)
    one = found.sel(body=1)
    assert int(one.stick_zone) == 1
    assert float(one.counted_number.sum()) == 1.0
    assert float(one.cycles) == pytest.approx(float(steel.cycles(float(one.SWT))), rel=1e-6)


def test_a_maximum_off_the_line_is_seen() -> None:
    """At ν = 1/2 and little friction; the field of the body knows no line."""
    given = {"profile": "paraboloid", "poisson_ratio": 0.5, "friction": 0.1, "normal_force_amplitude": 0.0}
    given |= {"tangential_force_amplitude": 0.3, "bulk_stress_amplitude": 0.01, "bulk_stress_mean": -0.05}
    found = swtstudy.solve(**given)
    assert int(found.stick_zone) == 2
    angle = np.linspace(0.0, np.pi, 37)
    x, y = np.cos(angle), np.where(angle < np.pi, np.sin(angle), 0.0)
    import xarray as xr

    field = swtstudy.swt_field(xr.DataArray(x, dims="a"), xr.DataArray(y, dims="a"), 0.0, **given)
    assert float(found.s_surface) >= 0.999 * float(field.s_local.max())
    assert float(found.s_surface) <= 1.02 * max(float(field.s_local.max()), float(found.s))


@pytest.mark.slow
@pytest.mark.usefixtures("unwrapped")
def test_a_figure_says_where_the_stick_zone_is() -> None:
    words = {}
    for shift in ("moved", "none"):
        figure = swtstudy.inspect(profile="cylinder", **MOVED, stick_zone_shift=shift)
        words[shift] = " ".join(each.get_text() for each in figure.texts)
        words[shift] += figure.get_suptitle()
    assert "stick zone moved" in words["moved"]
    assert "stick zone in place" in words["none"]
