"""What stands beside the numbers of fields, averages and one point, in words that are not the package's."""

from functools import partial

import numpy as np
import pytest
import stand_in
from made_up import made_up_audit
from solved import REGIMES
from told import RIG

import swtstudy

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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("criterion", "value"),
    [
        ("findley", "Findley stress"),
        ("fatemi_socie", "Fatemi-Socie parameter"),
        (["findley", "swt"], "criterion"),
    ],
)
def test_nonlocal_values_are_of_the_criterion(criterion, value):
    given = {"normal_sensitivity": 0.3, "critical_distance": 0.1, "tangential_amplitude": 0.5}
    found = swtstudy.solve(criterion=criterion, **given, rtol=1e-2)
    others = {*found} - {*swtstudy.solve(rtol=1e-2)}
    told = {name: found[name].attrs for name in others}
    assert told["s_volume"]["long_name"] == f"mean of {value} over a volume"
    assert told["s_point"]["long_name"] == f"{value} at a distance"
    assert told["s_line"]["comment"] == (
        f"largest mean of {value} in the unit of s over twice the critical distance from places of the "
        "surface line, which is that from line_x"
    )
    assert not [each for each in told.values() if "swt" in " ".join(map(str, each.values())).lower()]


def test_counted_cycles_are_of_the_criterion():
    own = RIG | {"normal_force": 200.0, "tangential_force_amplitude": [30.0, 60.0]}
    own |= {"criterion": "fatemi_socie", "normal_sensitivity": 0.3, "yield_strength": 400.0}
    contacts = swtstudy.physical(**own)
    found = contacts.solve(constants=swtstudy.FatigueConstants(73.1e3, 900.0, -0.1, 0.5, -0.6), rtol=1e-2)
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
    assert tuple(swtstudy.solve(rtol=1e-2).regime.attrs["flag_meanings"].split()) == REGIMES
    verdicts = made_up_audit().verdict.attrs["flag_meanings"]
    assert verdicts == "none line_search plane_through_y symmetry_line surface not_finite"


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


#: Symbol and comment of each variable that all results have, or those with a bulk stress, with forces, with
#: units or with points that failed.
TOLD = {
    "s": ("s", "one elastic half-space with E*, G* against a rigid indenter"),
    "s_error": (r"\Delta s", "estimated"),
    "s_surface": (r"s_\mathrm{surface}", "over all planes"),
    "stick_zone": (None, "whether s and all beside it have the stick zone moved by the bulk stress"),
    "bulk_shift": ("e/a_H", "by the strain of the bulk stress, in a_H"),
    "bulk_shift_ratio": ("e/(a - c)", "where stick_zone is in_place, s leaves it out and is too low"),
    "prescribed_force_ratio": (r"\max |F_x|/(\mu F_N)", "above 1 there is no equilibrium"),
    "radius_ratio": (r"a_\mathrm{max}/R", "half the width in plane contacts, over the radius R"),
    "slide_ratio": (
        r"(u_\mathrm{A} - u_\mathrm{slip})/a_\mathrm{max}",
        "exceeds the limit of partial slip, over the largest contact radius of a cycle",
    ),
    "critical_x": ("x/a_H", "in units of a_H = sqrt(R delta0)"),
    "critical_angle": (r"\varphi", "of the normal of the critical plane against the x axis, in (-90, 90]"),
    "regime": (None, "over the stationary cycle"),
    "status": (None, "whether the point has been computed"),
    "run": (None, "an index into the attribute runs; -1 if missing"),
    "message": (None, "there if points failed"),
}


def test_what_a_reader_is_told_of_each_variable(tmp_path):
    forces = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.5}
    moved = swtstudy.solve(**forces, bulk_stress_amplitude=0.01, rtol=1e-2)
    contact = swtstudy.physical(**RIG, depth=0.01, tangential_amplitude=1e-3)
    study = swtstudy.Study.from_text('title = "t"\naxes.friction = [0.3, 0.4]\n')
    failed = swtstudy.run(study, tmp_path / "a.nc", workers=1, solver=partial(stand_in.fail_at, 0.3))
    found = {**contact.solve(1e-2).data_vars, **failed.data_vars, **moved.data_vars}
    assert {*TOLD} == {*moved, *failed, "radius_ratio", "slide_ratio"}
    for name, (symbol, words) in TOLD.items():
        attributes = found[name].attrs
        assert attributes.get("symbol") == symbol, name
        assert words in attributes["comment"], name
        # A pure number has no unit: xarray would show it as [1].
        assert attributes.get("units") == ("degree" if name == "critical_angle" else None)
    assert "SWT0 = E* delta0 / R" in found["s"].attrs["comment"]
    for name, meanings in (("regime", " ".join(REGIMES)), ("status", "computed failed missing")):
        assert found[name].attrs["flag_meanings"] == meanings
        assert found[name].attrs["flag_values"].tolist() == [*range(len(meanings.split()))]
