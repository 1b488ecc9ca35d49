"""Labelled fields of one parameter point against s and against one another."""

import tracemalloc
from fractions import Fraction
from functools import partial

import numpy as np
import pytest
import xarray as xr
from scenes import PROFILE_NAMES, each_profile, random_points
from told import refused

import swtstudy


def test_stress_field_has_the_dimensions_of_its_positions():
    grid = swtstudy.stress_field(x=[-1.0, 0.0, 1.0], y=0.0, z=[0.0, 0.5], time=[0.0, 1.0])
    assert grid.sigma_xx.dims == ("time", "x", "z")
    assert grid.sigma_xx.shape == (2, 3, 2)
    assert grid.y.ndim == 0
    line = xr.DataArray(np.linspace(0, 1, 5), dims="point")
    points = swtstudy.stress_field(line, 0.1, line, time=[4.0], frequency_ratio="3/2")
    assert points.sigma_xz.dims == ("time", "point")
    assert swtstudy.stress_field(0, 0, 1, time=0.3).sigma_zz.ndim == 0


def test_each_position_has_its_own_instants():
    place = xr.DataArray([0.9, -0.3], dims="point", coords={"point": [7, 8]})
    own = swtstudy.stress_field(place, 0.0, [0.0, 0.2], frequency_ratio="3/2")
    for values in (own.sigma_xz, own.time, own.contact_radius):
        assert values.dims == ("instant", "point", "z")
    assert (own.time.diff("instant") >= 0.0).all()
    assert float(own.time.max()) == pytest.approx(4 * np.pi)
    for point, z in ((7, 0.2), (8, 0.0)):
        one = own.sel(point=point, z=z)
        same = swtstudy.stress_field(float(one.x), 0.0, z, time=one.time.values, frequency_ratio="3/2")
        for name in own:
            np.testing.assert_allclose(one[name], same[name], atol=1e-8)


def swt_of(field, poisson_ratio=0.3):
    """swt of the histories of a stress field."""
    names = [f"sigma_{name}" for name in ("xx", "yy", "zz", "yz", "xz", "xy")]
    stress = np.stack([np.moveaxis(field[name].values, 0, -1) for name in names], axis=-1)
    return swtstudy.swt_of_history(stress, poisson_ratio, 1.0 - poisson_ratio**2).swt


@pytest.mark.parametrize("profile", each_profile())
def test_the_instants_of_a_position_make_its_swt(profile):
    batch = random_points(11, 2, profile, 3)
    for k in range(2):
        ratio = Fraction(int(batch.p[k]), int(batch.q[k]))
        names = ("poisson_ratio", "friction", "normal_amplitude", "tangential_amplitude", "phase")
        numbers = {name: float(getattr(batch, name)[k]) for name in names}
        shape = {name: float(values[k]) for name, values in batch.shape.items()}
        parameters = {"profile": profile, "frequency_ratio": ratio, **numbers, **shape}
        solved = swtstudy.solve(rtol=1e-5, **parameters)
        field = swtstudy.stress_field(float(solved.critical_x), 0.0, 0.0, **parameters)
        assert float(swt_of(field, numbers["poisson_ratio"])) == pytest.approx(float(solved.s), rel=1e-5)


@pytest.mark.parametrize(
    ("parameters", "low"),
    [
        ({"frequency_ratio": "1/2", "phase": 0.3}, {64: 0.206, 512: 0.066}),
        ({"normal_amplitude": 8 / 9, "phase": 2.6}, {64: 0.232, 512: 0.102}),
    ],
)
def test_what_evenly_spread_instants_cost(parameters, low):
    """What the docstring of stress_field says."""
    solved = swtstudy.solve(**parameters, rtol=1e-7)  # x is known to the root of that
    x, s = float(solved.critical_x), float(solved.s)
    own = swtstudy.stress_field(x, 0.0, 0.0, **parameters)
    assert float(swt_of(own)) == pytest.approx(s, rel=1e-5)
    period = 4 * np.pi if "frequency_ratio" in parameters else 2 * np.pi
    for count, share in low.items():
        even = swtstudy.stress_field(x, 0.0, 0.0, time=period * np.arange(count) / count, **parameters)
        assert 1.0 - float(swt_of(even)) / s == pytest.approx(share, abs=2e-3)


def largest_memory(call):
    """Bytes that a call takes at most."""
    tracemalloc.start()
    call()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


@pytest.mark.slow
def test_memory_does_not_grow_with_the_square_of_the_instants():
    """4,000 once took 2 GB at one point, the field at 7/8 half a GB."""
    swtstudy.stress_field(0.4, 0.0, 0.1, time=0.0)  # what is made once only
    few, many = (
        largest_memory(partial(swtstudy.stress_field, 0.4, 0.0, 0.1, time=np.linspace(0.0, 6.0, count)))
        for count in (1000, 4000)
    )
    assert few < 10e6
    assert many - few < 3000 * 500
    line = np.linspace(0.1, 1.2, 6)
    assert largest_memory(lambda: swtstudy.swt_field(line, 0.0, 0.1, frequency_ratio="7/8")) < 60e6


@pytest.mark.parametrize(
    "parameters",
    [
        {},
        {"phase": 1.0, "frequency_ratio": "3/2"},
        {"profile": "rounded_punch", "flat_radius": 0.5, "phase": 2.0},
        {"profile": "wavy_paraboloid", "waviness_amplitude": 0.05, "wavelength": 5, "phase": 2.0},
    ],
)
def test_swt_field_at_the_critical_point_is_s(parameters):
    solved = swtstudy.solve(**parameters)
    # The solver may mirror x by symmetry of the cycle, the field has the point as it stands.
    field = swtstudy.swt_field(solved.critical_x.item(), 0.0, 0.0, **parameters)
    assert float(field.s_local) == pytest.approx(float(solved.s), rel=3e-3)
    tilt = np.degrees(np.arctan(float(field.normal_z / field.normal_x)))
    assert tilt == pytest.approx(float(solved.critical_angle), abs=1.5)


def test_slip_map():
    radius = np.linspace(0.0, 1.5, 40)
    states = swtstudy.slip_map(radius, time=np.linspace(0.0, 6.0, 30), phase=0.5)
    assert ((states.state == 0) == (states.r > states.contact_radius)).all()
    assert ((states.state == 1) == (states.r < states.slip_radius)).all()
    # In slip the traction is μ p, against the sense of the drag.
    field = swtstudy.stress_field(radius[1:], 0.0, 0.0, time=states.time, phase=0.5)
    for flag, sign in ((2, 1.0), (3, -1.0)):
        slips = (states.state.values == flag)[:, 1:]
        np.testing.assert_allclose(
            field.sigma_xz.values[slips], 0.3 * sign * field.sigma_zz.values[slips], atol=1e-6
        )


NO_NUMBERS = {
    "complex": 1j,
    "text": "1/2",
    "truth value": True,
    "nothing": None,
    "ragged": [[1.0], [1.0, 2.0]],
    "time": np.timedelta64(1, "s"),
    "times": np.array([1, 2], dtype="timedelta64[s]"),
    "a time among numbers": [Fraction(1, 2), np.timedelta64(1, "s")],
}
PUBLIC = {
    "x": lambda value: swtstudy.stress_field(value, 0.0, 0.0, time=0.0),
    "y": lambda value: swtstudy.swt_field(0.0, value, 0.0),
    "time": lambda value: swtstudy.stress_field(0.0, 0.0, 0.0, time=[value]),
    "r": swtstudy.slip_map,
    "stress": lambda value: swtstudy.swt_of_history(value, 0.3),
    "phase": lambda value: swtstudy.inspect_point(phase=f"{value}!" if isinstance(value, str) else value),
}


@pytest.mark.parametrize("value", NO_NUMBERS.values(), ids=NO_NUMBERS)
@pytest.mark.parametrize("key", PUBLIC)
def test_what_is_no_number_is_one_mistake(key, value):
    refused(rf"^{key}: found .*; allowed: [^\n]*$", PUBLIC[key], value)


def test_fractions_and_objects_are_numbers():
    third = Fraction(1, 3)
    exact = swtstudy.stress_field(third, [third, 1], np.array([third], dtype=object), time=third)
    xr.testing.assert_identical(exact, swtstudy.stress_field(1 / 3, [1 / 3, 1.0], [1 / 3], time=1 / 3))


@pytest.mark.parametrize("field", [swtstudy.stress_field, swtstudy.swt_field])
def test_positions_agree_in_their_coordinates(field):
    def positions(places):
        return xr.DataArray([0.1, 0.2], dims="point", coords={"point": places})

    for other in (positions([1, 2]), positions([1, 0]), xr.DataArray([0.1] * 3, dims="point")):
        refused("x, y, z: found DataArrays that do not fit together", field, positions([0, 1]), other, 0.1)
    across = xr.DataArray([0.3, 0.4, 0.5], dims="other")
    spanned = field(positions([0, 1]), across, 0.1)
    assert spanned.sizes["point"] == 2
    assert spanned.sizes["other"] == 3


@pytest.mark.slow
def test_nonlocal_values_are_nan_where_s_is_not_finite():
    edge = {"profile": "truncated_paraboloid", "flat_radius": 0.5, "friction": 1.5}
    dataset = swtstudy.solve(
        critical_distance=0.1, tangential_amplitude=[0.0, 3.0], normal_amplitude=0.2, **edge
    )
    assert np.isfinite(dataset.s_volume.values).tolist() == [True, False]
    assert np.isnan(dataset.s_point.sel(tangential_amplitude=3.0)).all()


@pytest.mark.slow
def test_nonlocal_values_of_several_profiles_at_once():
    at = {"critical_distance": 0.05, "rtol": 1e-2}
    both = swtstudy.solve(profile=["paraboloid", "rounded_punch"], flat_radius=0.5, **at)
    punch = swtstudy.solve(profile=["rounded_punch"], flat_radius=0.5, **at)
    assert both.s_volume.sel(profile="rounded_punch").item() == pytest.approx(punch.s_volume.item())
    with pytest.raises(ValueError, match=r"flat_radius: found .*, which no profile here has"):
        swtstudy.slip_map(0.5, flat_radius=0.5)


def test_waves_too_short_to_follow_are_left_out_of_fields_too():
    wave = {"waviness_amplitude": 1e-20, "wavelength": 5.0}
    smooth, wavy = (
        swtstudy.stress_field(0.4, 0.0, 0.2, time=[0.5, 1.5], profile=profile, **shape)
        for profile, shape in (("paraboloid", {}), ("wavy_paraboloid", wave))
    )
    np.testing.assert_allclose(wavy.sigma_xx, smooth.sigma_xx, rtol=1e-9)


def test_nonlocal_values_of_one_point():
    """All parameters single values: the same numbers as along an axis, without its dimension."""
    one = swtstudy.solve(critical_distance=0.05)
    assert one.s_volume.dims == ()
    assert one.s_line.dims == ("direction",)
    along = swtstudy.solve(critical_distance=[0.05], friction=[0.3])
    for name, values in along.squeeze(["friction", "critical_distance"]).items():
        np.testing.assert_array_equal(one[name], values)


def test_nonlocal_values_tend_to_s():
    dataset = swtstudy.solve(critical_distance=[1e-8, 0.05], friction=[0.4])
    assert dataset.s_volume.dims == ("friction", "critical_distance")
    assert dataset.s_line.dims == ("friction", "critical_distance", "direction")
    for name in ("s_volume", "s_point", "s_line"):
        values = dataset[name]
        near = values.isel(critical_distance=0)
        np.testing.assert_allclose(near, dataset.s.broadcast_like(near), rtol=1e-3)
        assert (values.diff("critical_distance") < 0).all()
    for wrong in (0.0, np.ma.masked_equal([0.1, 0.2], 0.2)):
        with pytest.raises(ValueError, match="critical_distance"):
            swtstudy.solve(critical_distance=wrong)


@pytest.mark.parametrize(("instant", "sense"), {0.7: 1, 2.5: -1, 4.0: -1, 5.5: 1}.items())
def test_slip_of_an_oscillating_sphere_is_mindlins(instant, sense):
    """On the way to +x and back: ω1 t, and the sense of the motion (Mindlin and Deresiewicz)."""
    own = {"normal_amplitude": 0.0, "tangential_amplitude": 0.6, "friction": 0.4}
    stick = np.sqrt(1.0 - 0.5 * (0.6 + sense * 0.6 * np.sin(instant)))
    states = swtstudy.slip_map([0.0, stick - 1e-6, stick + 1e-6, 1 - 1e-6, 1 + 1e-6], time=instant, **own)
    assert float(states.slip_radius) == pytest.approx(stick, abs=1e-9)
    assert float(states.contact_radius) == pytest.approx(1.0)
    slip = 2 if sense > 0 else 3
    assert states.state.values.tolist() == [1, 1, slip, slip, 0]


@pytest.mark.parametrize("field", [swtstudy.stress_field, swtstudy.swt_field, swtstudy.slip_map])
def test_there_is_no_field_without_equilibrium(field):
    """Friction carries up to the normal force: what is left of a larger one is no solution."""
    places = ([0.5],) if field is swtstudy.slip_map else ([0.5], 0.0, 0.0)
    forces = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 1.2}
    refused(r"^tangential_force_amplitude: found 1.2, at which the body slides", field, *places, **forces)
    assert field(*places, **(forces | {"tangential_force_amplitude": 0.9})).sizes


@pytest.mark.parametrize("amplitude", [0.1, 0.4, 0.7])
def test_at_a_turn_of_the_load_the_slip_that_ends_there_is_shown(amplitude):
    """Mindlin's slip zone under a constant normal load: largest where the displacement turns."""
    turns = np.pi * np.array([0.5, 1.5])
    slip = swtstudy.slip_map([0.0, 0.99], time=turns, normal_amplitude=0, tangential_amplitude=amplitude)
    np.testing.assert_allclose(slip.slip_radius, np.sqrt(1.0 - amplitude), rtol=1e-9)
    assert slip.state.values.tolist() == [[1, 2], [1, 3]]


@pytest.mark.parametrize("beside", [3e-8, 6.477761838041829e-8, 1e-7])
def test_both_loads_turn_at_nearly_one_instant(beside: float) -> None:
    """Growth within a rounding of its place is none."""
    given = {"friction": 0.5, "normal_amplitude": 0.0549375816778321, "frequency_ratio": "4"}
    given |= {"tangential_amplitude": 0.0001600303623207556, "phase": 0.375 * np.pi + beside}
    for rtol in (1e-4, 1e-6):
        assert float(swtstudy.solve(**given, rtol=rtol).s) == pytest.approx(0.0047156791, rel=1e-7)
    field = swtstudy.stress_field(np.linspace(0.05, 1.5, 30), 0.0, 0.1, time=[0.0, 1.0, 2.0], **given)
    assert np.isfinite(field.sigma_xx).all()
    x = np.linspace(0.9, 1.1, 81)
    found, at_once = (
        swtstudy.swt_field(x, 0.0, 0.0, **given | {"phase": phase}).s_local.values
        for phase in (given["phase"], 0.375 * np.pi)
    )
    np.testing.assert_allclose(found, at_once, rtol=1e-3, atol=1e-8)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:the search over planes ended early")
def test_fields_of_swt_are_as_near_as_said():
    """At places in and beneath the surface, near edges of the contact and far from it."""
    rng, names = np.random.default_rng(5), ("poisson_ratio", "friction", "phase")
    missing, sizes = [], []
    for profile in PROFILE_NAMES:
        for point in range(80):
            batch = random_points(100 + point, 1, profile, 3)
            given = {name: float(getattr(batch, name)[0]) for name in (*names, "tangential_amplitude")}
            given |= {"frequency_ratio": Fraction(int(batch.p[0]), int(batch.q[0])), "profile": profile}
            given |= {name: float(values[0]) for name, values in batch.shape.items()}
            given |= {"normal_amplitude": float(batch.normal_amplitude[0])}
            near = rng.choice([-1.0, 1.0], (3, 6)) * 10.0 ** rng.uniform(-4.0, 1.0, (3, 6))
            x, y, z = np.where(rng.random((3, 6)) < 0.5, rng.normal(size=(3, 6)), near)
            places = [xr.DataArray(each, dims="place") for each in (x, y * (rng.random(6) < 0.5), abs(z))]
            stress = swtstudy.stress_field(*places, **given).transpose("instant", "place")
            known = swt_of(stress, given["poisson_ratio"])
            found = swtstudy.swt_field(*places, **given).s_local.values
            largest = max(float(abs(stress[name]).max()) for name in stress if name != "contact_radius")
            sizes.append(known / largest**2)
            missing.append(1.0 - found / np.maximum(known, 1e-300))
    missing, sizes = np.ravel(missing), np.ravel(sizes)
    counted = sizes > 1e-9
    assert counted.sum() > 1000
    assert (missing[counted] < 1e-3).mean() > 0.99
    assert missing[sizes > 1e-3].max() < 0.01
