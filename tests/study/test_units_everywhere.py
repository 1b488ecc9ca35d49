"""Units beyond studies: extrema, optima, the field and the inspection of a contact; names of its bodies."""

import numpy as np
import pytest
import told
from command import call, merged
from real import ALUMINIUM, SPHERE, UNITS
from told import refused, written

import swtstudy
from swtstudy import Study, physical

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

RIG = told.RIG | {"normal_force": 200.0, "tangential_force_amplitude": 60.0}


@pytest.fixture
def shown(monkeypatch):
    """Show a study's point by the command, and the title of the figure."""
    figures = []
    monkeypatch.setattr("swtstudy.figures.style.save_figure", lambda figure, *_: figures.append(figure))

    def show(*words):
        done = call("show", *words)
        assert done.exit_code == 0, done.stderr
        return figures[-1].get_suptitle().replace("\n", " ")

    return show


@pytest.fixture(scope="module")
def rig():
    return physical(**RIG)


@pytest.fixture(scope="module")
def solved():
    several = {**RIG, "tangential_force_amplitude": [30.0, 60.0], "normal_force": [150.0, 200.0]}
    return physical(**several).solve(1e-2, constants=ALUMINIUM)


def test_extrema_of_any_quantity(solved):
    found = solved.swt.extrema("tangential_force_amplitude", "cycles")
    assert (found.at_maximum == 30.0).all()
    np.testing.assert_array_equal(found.minimum, solved.cycles.sel(tangential_force_amplitude=60.0))
    assert "cycles" in found.minimum.attrs["long_name"]
    assert solved.swt.extrema("normal_force").maximum.attrs["units"] == "unit of stress"


def test_the_stress_field_is_in_lengths_and_stresses(rig):
    """Hertz's pressure, in MPa, at places in mm."""
    a, p0 = rig.contact_radius, rig.peak_pressure
    x = np.array([0.0, 0.5 * a])
    field = rig.stress_field(x, 0.0, 0.0, time=0.0)
    np.testing.assert_allclose(field.x, x, rtol=1e-12)
    np.testing.assert_allclose(-field.sigma_zz, p0 * np.sqrt(1.0 - x**2 / a**2), rtol=1e-6)
    assert float(field.contact_radius) == pytest.approx(a)
    assert field.sigma_zz.attrs["units"] == "unit of stress"
    assert "E*" not in field.sigma_zz.attrs["long_name"]


def test_the_swt_field_has_the_largest_swt_where_it_is(rig):
    solved = rig.solve(1e-4)
    place = float(solved.critical_position.sel(body=2))
    found = rig.swt_field(place, 0.0, 0.0, body=2).SWT
    assert float(found) == pytest.approx(float(solved.SWT.sel(body=2)), rel=1e-3)


def test_a_point_of_a_study_is_a_contact(solved):
    point = solved.sel(tangential_force_amplitude=60.0, normal_force=200.0)
    contact = point.swt.contact()
    assert contact.grid.fixed["normal_force"] == 200.0
    assert contact.parameters() == physical(**RIG).parameters()


def test_an_inspected_contact_is_in_forces_and_stresses(rig):
    point = rig.inspect_point()
    assert float(point.tangential_force.max()) == pytest.approx(60.0, rel=1e-3)
    np.testing.assert_allclose(point.normal_force, 200.0, rtol=1e-6)
    assert float(point.s_local.max()) == pytest.approx(float(rig.solve(1e-4).SWT[0]), rel=0.02)
    # SWT from the cycle on the critical plane: a strain of this body, of two equal ones.
    swing = float(point.normal_strain.max() - point.normal_strain.min()) / 2.0
    assert float(point.normal_stress.max()) * swing == pytest.approx(float(rig.solve(1e-4).SWT[0]), rel=1e-3)
    assert float(point.tangential_force_amplitude) == pytest.approx(60.0)


@pytest.mark.slow
def test_the_best_contact_in_units(rig):
    """SWT rises with the tangential force, and life falls: ends of the range, in newtons."""
    over = {"tangential_force_amplitude": (40, "80")}
    found = rig.optimise(over, rtol=1e-2)
    assert found.tangential_force_amplitude.values.tolist() == [40.0, 80.0]
    expected = [
        float(physical(**{**RIG, "tangential_force_amplitude": q}).solve(1e-2).SWT[0]) for q in (40, 80)
    ]
    np.testing.assert_allclose(found.SWT.sel(body=1), expected, rtol=1e-2)
    assert found.attrs["minimise"] == "SWT"


@pytest.mark.slow
def test_the_best_life_is_the_longest(rig):
    lives = rig.optimise({"tangential_force_amplitude": (40, 80)}, "cycles", rtol=1e-2, constants=ALUMINIUM)
    assert lives.tangential_force_amplitude.values.tolist() == [40.0, 80.0]
    assert (lives.cycles.sel(case="best") > lives.cycles.sel(case="worst")).all()


def test_an_end_of_a_range_that_cannot_be_is_named(rig):
    refused(r"over.radius\[0\]: found -1", rig.optimise, {"radius": (-1, 1)})


STUDY = f"""
title = "A pad on a test piece"
rtol = 1e-2
{UNITS}[fixed]
{SPHERE}normal_force = 200
normal_force_amplitude = 10
tangential_force_amplitude = 60
bulk_stress_amplitude = 30
bodies = ["test piece", "pad"]
bulk_stress_body = "test piece"
[axes]
phase = ["0 deg", "90 deg"]
[figure]
x = "phase"
hue = "body"
y = "SWT"
"""


def test_bodies_have_names(tmp_path):
    found = swtstudy.run(Study.from_text(STUDY), tmp_path / "pad.nc", workers=1)
    assert found.body.values.tolist() == [1, 2]
    assert found.body.attrs["flag_meanings"] == "test_piece pad"
    assert "  axis           body: test piece, pad" in repr(found.swt).splitlines()
    figure = found.swt.figure()
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
    assert [text.get_text() for text in legends[0].get_texts()] == ["test piece", "pad"]
    again = Study.from_text(merged(tmp_path / "pad.nc").attrs["study"])
    assert again.grid.body_names == ("test piece", "pad")
    lines = found.assign(radius_ratio=found.radius_ratio + 0.2 * (found.body == 2)).swt.validity()
    assert any(line.startswith("contact too large") and line.endswith("body = pad") for line in lines)
    assert found.swt.to_table().body.tolist() == ["test_piece", "pad"] * 2
    first = found.swt.slice(body="test piece")
    assert (first.body, {*first.swt.to_table().body}) == (1, {"test_piece"})
    refused("body: found 'rod' .*; allowed: test piece, pad", found.swt.slice, body="rod")
    # Alone by its name; written and read again.
    one = Study.from_text(STUDY.replace("bodies =", 'body = "pad"\nbodies =').replace('hue = "body"\n', ""))
    assert one.grid.fixed["body"] == 2.0
    again = written(one, tmp_path)
    assert (again.grid.body_names, again.grid.fixed["body"]) == (("test piece", "pad"), 2.0)


def test_names_in_python():
    contact = physical(**RIG, bulk_stress_amplitude=10.0, bodies=("pad", "specimen"), bulk_stress_body=1)
    assert contact.solve(1e-2).body.attrs["flag_meanings"] == "pad specimen"


def test_the_title_of_a_contact_says_what_was_given_and_its_validity(tmp_path, shown):
    file = tmp_path / "pad.toml"
    strength = "[material]\nyield_strength = 150\n[fixed]"
    file.write_text(STUDY.replace("[fixed]", strength), encoding="utf-8")
    words = shown(file, "--phase", "90 deg")
    for given in ("$F_0$ = 200 N", "$R$ = 50 mm", r"$Q_A$ = 60 N", r"$\sigma_{B,A}$ = 30 MPa"):
        assert given in words
    assert "a_H" not in words
    assert "beyond first yield: largest von Mises stress over the yield strength up to" in words
    # The other body carries no bulk stress.
    assert "sigma_{B" not in shown(file, "--phase", "90 deg", "--body", "2")


def test_the_command_shows_a_study(tmp_path, shown):
    file = tmp_path / "pad.toml"
    file.write_text(STUDY, encoding="utf-8")
    words = shown(file, "--phase", "90 deg", "--tangential-amplitude", "1e-3", "--body", "2")
    for given in (r"$\psi$ = π/2", "$u_A$ = 0.001 mm", "pad"):
        assert given in words
    assert "Q_A" not in words
    assert "pad" in shown(file, "--phase", "90 deg", "--body", "pad")
    done = call("show", file, "--phase", "90 deg", "--body", "rod")
    assert "body: found 'rod'; allowed: 1 or 2 or 'test piece' or 'pad'" in done.stderr


def title(contact, body=1):
    return contact.inspect(body=body).get_suptitle().replace("\n", " ")


@pytest.mark.slow
def test_titles_leave_out_the_factors_of_a_measured_load():
    """F_A = 1 N was said of forces of 60 N, and ψ and ω2/ω1 of a loop that has neither."""
    load = swtstudy.LoadPath("rig", [[60.0, 50.0], [-60.0, 40.0]], mean_normal=200.0)
    words = title(physical(**told.RIG, load=load))
    assert "$F_0$ = 200" in words
    assert "rig" in words
    assert not any(symbol in words for symbol in ("F_A", "Q_A", "omega", "psi"))
    half = {"tangential_force_amplitude": 0.5, "normal_force_amplitude": 1.0}
    assert "$Q_A$ = 0.5" in title(physical(**told.RIG, load=load, **half))
    loop = swtstudy.LoadPath("loop", [[1.0, 0.0], [-1.0, 0.0]])
    given = told.RIG | {"normal_force": 200.0, "load": loop, "tangential_force_amplitude": 1.0}
    words = title(physical(**given, normal_force_amplitude=1.0))
    assert "$Q_A$ = 1" in words
    assert "psi" not in words
    refused("normal_amplitude: .* in lengths; or .*, 1 if it is in forces", physical, **given)


@pytest.mark.slow
def test_titles_name_the_body():
    named = physical(**RIG, bulk_stress_amplitude=10.0, bodies=["pad", "specimen"], bulk_stress_body=1)
    assert [name in title(named, body) for body in (1, 2) for name in ("pad", "specimen")] == [1, 0, 0, 1]
