"""What stands beside the numbers of fields, averages and one point, in words that are not the package's."""

import numpy as np
import pytest
from solved import REGIMES

import swtstudy
from swtstudy.paper.audit import VERDICTS
from swtstudy.vocabulary.variables import ATTRIBUTES

STRESS = {f"sigma_{name}": (rf"\sigma_{{{name}}}", "1") for name in ("xx", "yy", "zz", "yz", "xz", "xy")}
PLACES = {name: (f"{name}/a_H", "1") for name in "xyz"}
TIME = {"time": (r"\omega_1 t", "rad")}


def told(dataset, names):
    """Symbol and unit of variables."""
    return {name: (dataset[name].attrs.get("symbol"), dataset[name].attrs.get("units")) for name in names}


def test_stress_field():
    field = swtstudy.stress_field([0.1, 0.2], 0.0, [0.1], time=[0.0, 1.0])
    expected = STRESS | PLACES | TIME
    assert told(field, expected) == expected
    for name in STRESS:
        words = f"stress {name[-2:]} over E* sqrt(delta0/R), tension positive"
        assert field[name].attrs["long_name"] == words
    assert field.contact_radius.attrs["long_name"] == "contact radius, in units of a_H = sqrt(R delta0)"
    assert field.contact_radius.attrs["units"] == "1"
    assert field.time.attrs["long_name"] == "omega1 t, in the stationary cycle"
    assert [field[name].attrs["long_name"] for name in "xyz"] == [
        "position in the direction of sliding, in units of a_H = sqrt(R delta0)",
        "position across the direction of sliding, in units of a_H = sqrt(R delta0)",
        "depth, in units of a_H = sqrt(R delta0)",
    ]


def test_swt_field_and_slip_map():
    field = swtstudy.swt_field([0.1, 0.9], 0.0, 0.1)
    expected = {"s_local": ("swt", "1"), **{f"normal_{n}": (f"n_{n}", "1") for n in "xyz"}, **PLACES}
    assert told(field, expected) == expected
    assert field.s_local.attrs["long_name"] == "Smith-Watson-Topper parameter over E* delta0/R"
    assert field.normal_x.attrs["long_name"] == "unit normal of the critical plane"
    states = swtstudy.slip_map([0.1, 0.9], time=[0.0, 1.0])
    expected = {"r": ("r/a_H", "1"), **TIME}
    assert told(states, expected) == expected
    assert states.state.attrs["flag_values"].tolist() == [0, 1, 2, 3]
    assert states.state.attrs["flag_meanings"] == "open stick forward_slip backward_slip"
    assert states.state.attrs["long_name"] == "state of the contact"
    for name in ("contact_radius", "slip_radius"):
        words = f"{name.replace('_', ' ')}, in units of a_H"
        assert (states[name].attrs["long_name"], states[name].attrs["units"]) == (words, "1")


def test_nonlocal_values():
    found = swtstudy.solve(critical_distance=[0.05], rtol=1e-2)
    words = {name: found[name].attrs["comment"] for name in ("s_volume", "s_point", "s_line")}
    assert words == {
        "s_volume": "largest mean of swt/SWT0 over the half spheres of the critical distance, in the "
        "section of plane contacts half discs, about places of the surface line, which is that about "
        "volume_x",
        "s_point": "largest swt/SWT0 at half the critical distance from places of the surface line, which is "
        "that from point_x (point method)",
        "s_line": "largest mean of swt/SWT0 over twice the critical distance from places of the surface "
        "line, which is that from line_x",
    }
    assert found.volume_x.attrs["symbol"] == r"x_\mathrm{volume}/a_H"
    assert not any("units" in found[name].attrs for name in (*words, "critical_distance"))
    assert found.critical_distance.attrs["symbol"] == r"\ell/a_H"
    assert found.direction.values.tolist() == ["depth", "critical_plane"]


@pytest.mark.parametrize(
    ("criterion", "value"),
    [
        ("findley", "Findley stress"),
        pytest.param("fatemi_socie", "Fatemi-Socie parameter", marks=pytest.mark.slow),
        pytest.param(["findley", "swt"], "criterion", marks=pytest.mark.slow),
    ],
)
def test_nonlocal_values_are_of_the_criterion(criterion, value):
    found = swtstudy.solve(
        criterion=criterion,
        normal_sensitivity=0.3,
        critical_distance=0.1,
        tangential_amplitude=0.5,
        rtol=1e-2,
    )
    told = {name: values.attrs for name, values in found.data_vars.items() if name not in ATTRIBUTES}
    assert told["s_volume"]["long_name"] == f"mean of {value} over a volume"
    assert told["s_point"]["long_name"] == f"{value} at a distance"
    assert told["s_line"]["comment"] == (
        f"largest mean of {value} in the unit of s over twice the critical distance from places of the "
        "surface line, which is that from line_x"
    )
    assert not [each for each in told.values() if "swt" in " ".join(map(str, each.values())).lower()]


def test_counted_cycles_are_of_the_criterion():
    own = {
        "young_modulus": 210e3,
        "poisson_ratio": 0.3,
        "radius": 50.0,
        "friction": 0.5,
        "normal_force": 200.0,
    }
    contacts = swtstudy.physical(
        **own,
        tangential_force_amplitude=[30.0, 60.0],
        criterion="fatemi_socie",
        normal_sensitivity=0.3,
        yield_strength=400.0,
    )
    found = contacts.solve(constants=swtstudy.FatigueConstants(210e3, 900.0, -0.1, 0.5, -0.6), rtol=1e-2)
    assert found.counted.attrs["symbol"] == "s_i/s"
    assert not [each for each in found.counted.attrs.values() if "swt" in str(each).lower()]


def test_one_point():
    point = swtstudy.inspect_point()
    expected = {
        "depth": r"\delta/\delta_0",
        "displacement": r"G^* u/(\mu E^* \delta_0)",
        "normal_stress": r"\sigma_n",
        "normal_strain": r"\varepsilon_n",
        "sigma_xx": r"\sigma_{xx}",
        "sigma_xz": r"\sigma_{xz}",
        "pressure": "p",
        "traction": "q",
        "compression": r"w/\delta_0",
        "force": r"G^* u_{MDR}/(\mu E^* \delta_0)",
        "s_local": "swt",
        "shown_x": "x/a_H",
        "permanent_stick_radius": "c/a_H",
        "least_radius": "a/a_H",
        "largest_radius": "a/a_H",
        "x": "x/a_H",
    }
    assert told(point, expected) == {name: (symbol, "1") for name, symbol in expected.items()}
    assert all(point[name].attrs["long_name"] for name in expected)
    assert point.shown_angle.attrs["units"] == "degree"
    assert point.attrs == swtstudy.inspect_point(friction=0.2).attrs


def test_flags_are_those_of_the_words():
    assert REGIMES == ("stick", "partial_slip", "gross_slip", "lift_off", "not_finite", "no_equilibrium")
    assert VERDICTS == ("none", "line_search", "plane_through_y", "symmetry_line", "surface", "not_finite")


@pytest.mark.parametrize(
    ("parameters", "regime"),
    [
        ({"normal_amplitude": 0.5, "tangential_amplitude": 0.0}, "stick"),
        ({"normal_amplitude": 0.0, "tangential_amplitude": 0.99}, "partial_slip"),
        ({"normal_amplitude": 0.0, "tangential_amplitude": 1.01}, "gross_slip"),
        ({"normal_amplitude": 1.01, "tangential_amplitude": 0.1}, "lift_off"),
    ],
)
def test_regimes_of_known_motions(parameters, regime):
    """With δA = 0 all slides from u_A = 1 (in δ0 of the springs) on; δA > δ0 loses the contact."""
    found = swtstudy.solve(rtol=1e-2, **parameters)
    names = found.regime.attrs["flag_meanings"].split()
    assert names[int(found.regime)] == regime
    assert np.isfinite(found.s)


def test_xarray_labels_its_own_plots():
    """Short, in one line each, and with units where there are some: no [1]."""
    pytest.importorskip("matplotlib.pyplot")
    from matplotlib.figure import Figure

    found = swtstudy.solve(phase=[0.0, 1.0, 2.0], flat_radius=[0.1, 0.5], profile="rounded_punch", rtol=1e-2)
    axes = Figure().subplots()
    found.s.plot.line(x="phase", ax=axes, add_legend=False)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("phase [rad]", "SWT parameter SWT/SWT0")
    axes = Figure().subplots()
    found.critical_angle.isel(phase=0).plot(ax=axes)
    assert axes.get_ylabel() == "critical plane angle [degree]"
    assert "\n" not in axes.get_xlabel()
    assert "[" not in axes.get_xlabel()


def test_every_variable_of_results_has_a_comment():
    words = {
        "s": "one elastic half-space with E*, G* against a rigid indenter",
        "s_error": "estimated",
        "s_surface": "over all planes",
        "stick_zone": "whether s and all beside it have the stick zone moved by the bulk stress",
        "bulk_shift": "by the strain of the bulk stress, in a_H",
        "bulk_shift_ratio": "where stick_zone is in_place, s leaves it out and is too low",
        "prescribed_force_ratio": "above 1 there is no equilibrium",
        "radius_ratio": "half the width in plane contacts, over the radius R",
        "slide_ratio": "exceeds the limit of partial slip, over the largest contact radius of a cycle",
        "critical_x": "in units of a_H = sqrt(R delta0)",
        "critical_angle": "angle of the normal of the critical plane against the x axis, in (-90, 90]",
        "regime": "over the stationary cycle",
        "status": "whether the point has been computed",
        "run": "an index into the attribute runs; -1 if missing",
        "message": "there if points failed",
    }
    assert words.keys() == ATTRIBUTES.keys()
    for name, attributes in ATTRIBUTES.items():
        assert words[name] in attributes.get("comment", ""), name
        assert name == "message" or ("units" in attributes) != ("flag_meanings" in attributes), name
