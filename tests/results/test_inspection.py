"""One point explained: its numbers against the solver and the textbook method, and its figure."""

import numpy as np
import pytest

import swtstudy

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

SCENES = {
    "Table 1": {},
    "gross slip": {"phase": 1.4},
    "two periods": {"frequency_ratio": "3/2", "phase": 0.4},
    "no normal oscillation": {"normal_amplitude": 0},
    "lift-off": {"normal_amplitude": 1.5, "phase": 0.6},
    "rounded": {"profile": "rounded_punch", "flat_radius": 0.5, "phase": 0.5},
    "truncated": {"profile": "truncated_paraboloid", "flat_radius": 0.7},
    "wavy": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5, "phase": 2.6},
}


@pytest.mark.quick(3)
@pytest.mark.parametrize("parameters", SCENES.values(), ids=SCENES)
def test_the_stress_cycle_makes_s(parameters):
    point = swtstudy.inspect_point(**parameters)
    strain = point.normal_strain
    s = float(point.s)
    assert float(point.normal_stress.max() * (strain.max() - strain.min()) / 2) == pytest.approx(s, rel=1e-4)
    assert float(point.s_local.sel(x=point.shown_x)) == pytest.approx(s, rel=1e-4)
    assert float(point.s_local.max()) == pytest.approx(s, rel=1e-3)
    assert 2 <= point.sizes["instant"] <= 4
    assert (np.diff(point.instant_time) > 0).all()
    assert (abs(point.traction) <= 0.3 * point.pressure + 1e-6).all()
    assert (abs(point.force) <= point.compression + 1e-12).all()


def test_at_the_singular_edge_of_a_face_the_largest_sampled_value_is_shown():
    given = {"profile": "truncated_paraboloid", "flat_radius": 5, "friction": 0.99, "phase": 0.7}
    point = swtstudy.inspect_point(**given)
    assert abs(float(point.critical_x)) == 5.0
    assert float(point.s_local.sel(x=point.shown_x)) == float(point.s_local.max()) < float(point.s)
    assert np.isfinite(point.normal_stress).all()


def test_the_curve_of_a_sharp_tip_goes_up_to_the_tip():
    tip = {"profile": "power_law", "exponent": 1.3, "friction": 3.0, "tangential_amplitude": 2.0}
    point = swtstudy.inspect_point(**tip)
    assert float(point.shown_x) == 0.0
    assert float(point.s_local.max()) == pytest.approx(float(point.s), rel=1e-4)


@pytest.mark.quick(3)
@pytest.mark.parametrize("parameters", SCENES.values(), ids=SCENES)
def test_curves_are_those_of_the_stress_field(parameters):
    """Which comes from the springs by another way: the stress on the shown plane, the load on the surface."""
    point = swtstudy.inspect_point(**parameters)
    x, angle = float(point.shown_x), np.radians(float(point.shown_angle))
    some = point.isel(time=slice(None, None, 40))
    field = swtstudy.stress_field(x, 0.0, 0.0, time=some.time.values, **parameters)
    n, m = np.cos(angle), np.sin(angle)
    normal = n * n * field.sigma_xx + 2 * n * m * field.sigma_xz + m * m * field.sigma_zz
    trace = field.sigma_xx + field.sigma_yy + field.sigma_zz
    strain = (1.3 * normal - 0.3 * trace) / (1 - 0.3**2)  # Hooke's law with E = (1 − ν²) E*
    for name, expected in (
        ("normal_stress", normal),
        ("normal_strain", strain),
        ("sigma_xx", field.sigma_xx),
        ("sigma_xz", field.sigma_xz),
    ):
        np.testing.assert_allclose(some[name], expected, atol=1e-5)
    np.testing.assert_allclose(some.contact_radius, field.contact_radius, atol=1e-9)

    line = point.isel(x=slice(None, None, 40))
    load = swtstudy.stress_field(line.x.values, 0.0, 0.0, time=line.instant_time.values, **parameters)
    np.testing.assert_allclose(line.pressure, -load.sigma_zz, atol=1e-5)
    np.testing.assert_allclose(line.traction, -load.sigma_xz, atol=1e-5)


def test_traction_is_cattaneos():
    """Sliding in +x over an annulus: +μ p there, and Coulomb's bound with the μ of the scene."""
    point = swtstudy.inspect_point(normal_amplitude=0, tangential_amplitude=0.4, friction=0.5)
    for sense, turn in ((1.0, np.pi / 2), (-1.0, 3 * np.pi / 2)):
        at = point.isel(instant=int(np.abs(point.instant_time.values - turn).argmin()))
        assert float(at.instant_time) == pytest.approx(turn)
        c2, r2 = 0.6, at.x.values**2
        p, less = (2 / np.pi * np.sqrt(np.maximum(square - r2, 0.0)) for square in (1.0, c2))
        np.testing.assert_allclose(at.pressure, p, atol=1e-9)
        np.testing.assert_allclose(at.traction, sense * 0.5 * (p - less), atol=1e-9)


def test_what_always_sticks():
    # With δA = 0 the stick zone is Cattaneo's: (c/a)² = 1 − U.
    point = swtstudy.inspect_point(normal_amplitude=0, tangential_amplitude=0.4)
    assert float(point.permanent_stick_radius) == pytest.approx(np.sqrt(0.6))
    assert float(point.least_radius) == float(point.largest_radius) == pytest.approx(1.0)
    assert np.isnan(swtstudy.inspect_point(phase=1.4).permanent_stick_radius)


def test_without_friction_it_is_drawn_too():
    figure = swtstudy.inspect(friction=0, style={"font.size": 7})
    assert figure.axes[0].xaxis.label.get_fontsize() == 7
    assert "not finite" not in figure.get_suptitle()


def test_nothing_that_moves_is_drawn_as_nothing():
    axes = swtstudy.inspect(normal_amplitude=0, tangential_amplitude=0).axes
    load, swt = axes[0], axes[5]
    assert np.ptp(load.get_xlim()) == pytest.approx(0.1 * 1.28)
    (dot,) = (line for line in swt.lines if line.get_marker() == "o")
    assert dot.get_ydata() == [0.0]


@pytest.mark.quick(6)
@pytest.mark.parametrize("phase", [0.0, 0.1, 0.3, 2.9, 3.1, 6.2])
@pytest.mark.parametrize("ratio", ["1", "3/2"])
def test_instants_near_to_one_another_are_one_also_across_the_end_of_the_cycle(phase, ratio):
    """Next to 0 and 2π the extremes of σ_n and ε_n are on both sides of where the cycle begins."""
    point = swtstudy.inspect_point(normal_amplitude=0.6, phase=phase, frequency_ratio=ratio)
    period = float(point.time.max() - point.time.min())
    share = np.sort(point.instant_time.values) / period
    assert np.diff(np.append(share, share[0] + 1.0)).min() >= 0.079
    # The smallest normal stress and the largest strain do not make s.
    assert not {"σ_n smallest", "ε_n largest"} & {*point.reason.values.tolist()}
    largest = point.normal_stress.argmax("time")
    at = float(point.instant_time[point.reason.values.tolist().index("σ_n largest")])
    assert at == pytest.approx(float(point.time[largest]), abs=1e-9)


def test_where_nothing_moves_one_instant_is_shown():
    still = swtstudy.inspect_point(normal_amplitude=0, tangential_amplitude=0)
    assert still.reason.values.tolist() == ["σ_n largest"]
    assert swtstudy.inspect_point().sizes["instant"] == 4
