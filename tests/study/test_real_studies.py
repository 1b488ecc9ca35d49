"""Studies in units of the user's own: their numbers, words and figures."""

import math

import numpy as np
import pytest
import stand_in
import told
from command import merged
from real import ALUMINIUM, BODIES, STUDY, plain, without

import swtstudy
from swtstudy import FatigueConstants, Study, open_results, physical, run


def sphere(young_modulus, poisson_ratio):
    """One contact of the study."""
    loads = {"normal_force": 200.0, "normal_amplitude": 2e-3, "tangential_amplitude": 2.5e-3}
    bodies = {"young_modulus": young_modulus, "poisson_ratio": poisson_ratio}
    return physical(**told.RIG | bodies, **loads, phase=np.pi / 2)


@pytest.fixture(scope="module")
def alike(tmp_path_factory):
    """Results of the study by stand-ins for the solver."""
    return stand_in.computed(STUDY, tmp_path_factory.mktemp("alike") / "sphere.nc")


@pytest.mark.slow
def test_values_are_those_of_the_single_contact(solved):
    assert solved.s.dims == ("normal_force", "tangential_amplitude", "phase")
    point = solved.sel(normal_force=200, tangential_amplitude=2.5e-3).isel(phase=1)
    contact = sphere(73.1e3, 0.33)
    alone = contact.solve(rtol=1e-2)
    assert point.SWT.item() == pytest.approx(alone.SWT.values[0], rel=1e-9)
    assert point.SWT_error.item() == pytest.approx(alone.SWT_error.values[0], rel=1e-6)
    assert abs(point.critical_position.item()) == pytest.approx(abs(alone.critical_position.values[0]))
    near = swtstudy.solve(rtol=1e-2, critical_distance=0.05 / contact.length_scale, **contact.parameters())
    for name in ("volume", "point", "line"):
        np.testing.assert_allclose(point[f"s_{name}"], near[f"s_{name}"], rtol=1e-6)
        np.testing.assert_allclose(point[f"SWT_{name}"], contact.swt(near[f"s_{name}"]), rtol=1e-6)
        np.testing.assert_allclose(point[f"cycles_{name}"], ALUMINIUM.cycles(point[f"SWT_{name}"]))
    assert point.cycles.item() == pytest.approx(contact.cycles(ALUMINIUM, point.s.item()))


def test_the_contact_at_rest_is_hertz(alike):
    e_star = 73.1e3 / (2 * (1 - 0.33**2))
    for force in (150.0, 200.0):
        radius = (3 * force * 50.0 / (4 * e_star)) ** (1 / 3)
        here = alike.sel(normal_force=force)
        assert here.contact_radius.item() == pytest.approx(radius)
        assert here.depth.item() == pytest.approx(radius**2 / 50.0)
        assert here.peak_pressure.item() == pytest.approx(3 * force / (2 * math.pi * radius**2))
    assert alike.contact_radius.dims == ("normal_force",)


@pytest.mark.filterwarnings("ignore:.* has no effect:UserWarning")
def test_work_and_radii_are_in_the_units(tmp_path):
    """δA = 0: stick zone and loop of Cattaneo and Mindlin, the work from Johnson's Contact Mechanics, 7.4."""
    still = STUDY.replace("normal_amplitude = 2e-3", "").replace("critical_distance = 0.05", "")
    still = still.replace('"SWT_volume", ', "")
    found = run(Study.from_text(still), tmp_path / "still.nc", workers=1).isel(phase=0)
    g_star = 4 * (73.1e3 / 2.66) / (2 * (2 - 0.33))
    for force in (150.0, 200.0):
        for swing in (1e-3, 2.5e-3):
            here = found.sel(normal_force=force, tangential_amplitude=swing)
            a = here.contact_radius.item()
            full = 3 * 0.5 * force / (4 * g_star * a)  # the displacement of full sliding
            stuck = max(1 - swing / full, 0.0)
            assert here.stick_radius.item() == pytest.approx(a * stuck**0.5, rel=1e-6)
            q = 1 - stuck**1.5  # Q over μ F
            compliance = 2 * (2 - 0.33) / (73.1e3 / 2.66)  # Σ (2 − ν)/G
            energy = 9 * (0.5 * force) ** 2 / (10 * a) * compliance
            term = 1 - (1 - q) ** (5 / 3) - 5 * q / 6 * (1 + (1 - q) ** (2 / 3))
            assert here.dissipation.item() == pytest.approx(energy * term, rel=1e-3)
            assert here.largest_contact_radius.item() == pytest.approx(a)
    assert found.dissipation.attrs["units"] == "N mm"


@pytest.mark.slow
def test_the_same_in_si_units_is_the_same(solved, tmp_path):
    si = STUDY
    for old, new in (
        ('"mm"', '"m"'),
        ('"MPa"', '"Pa"'),
        ("strength = 927", "strength = 927e6"),
        ("73.1e3", "73.1e9"),
        ("radius = 50", "radius = 0.05"),
        ("normal_amplitude = 2e-3", "normal_amplitude = 2e-6"),
        ("critical_distance = 0.05", "critical_distance = 5e-5"),
        ("[1e-3, 2.5e-3]", "[1e-6, 2.5e-6]"),
    ):
        assert old in si
        si = si.replace(old, new)
    found = run(Study.from_text(si), tmp_path / "si.nc", workers=1)
    for name in ("s", "s_error", "regime", "s_volume", "s_line", "normalised_dissipation"):
        np.testing.assert_array_equal(found[name], solved[name])
    np.testing.assert_allclose(found.SWT, 1e6 * solved.SWT, rtol=1e-12)
    np.testing.assert_allclose(found.cycles_volume, solved.cycles_volume, rtol=1e-9)
    np.testing.assert_allclose(found.dissipation, 1e-3 * solved.dissipation, rtol=1e-12)
    assert found.dissipation.attrs["units"] == "N m"


def test_what_coincides_without_units_is_computed_once():
    """R = 10, 20, 40 at the same δ0/R, δA/δ0 and uA/δ0: one point, whose SWT grows with nothing."""
    text = without(STUDY, "normal_force", "quantities", "critical_distance", "radius", "y =")
    text = text.replace("[axes]", "[sample.points]\nradius = [10, 20, 40]\ndepth = [1e-3, 2e-3, 4e-3]")
    text = text.replace("normal_amplitude = 2e-3", "")
    text = text.replace("tangential_amplitude = [1e-3, 2.5e-3]", "tangential_amplitude = [1e-4, 2e-4, 4e-4]")
    text = text[: text.index("phase =")]
    study = Study.from_text(text)
    assert study.grid.size == 3
    assert stand_in.distinct(study) == 1


@pytest.mark.slow
def test_bodies_that_differ_have_a_dimension(tmp_path):
    text = without(BODIES, "critical_distance", "[figure]", "x =", "hue =", "panels =", "y =")
    found = run(Study.from_text(text), tmp_path / "two.nc", workers=1)
    assert found.s.dims == ("normal_force", "tangential_amplitude", "phase", "body")
    assert found.young_modulus.values.tolist() == [210e3, 150e3]
    assert found.body.values.tolist() == [1, 2]
    point = found.isel(normal_force=1, tangential_amplitude=1, phase=1)
    pair = (ALUMINIUM, FatigueConstants(150e3, 927.0, -0.113, 0.2, -0.713))
    pair = (FatigueConstants(210e3, *list(vars(ALUMINIUM).values())[1:]), pair[1])
    contact = sphere((210e3, 150e3), (0.3, 0.33))
    alone = contact.solve(rtol=1e-2)
    np.testing.assert_allclose(point.SWT, alone.SWT, rtol=1e-9)
    np.testing.assert_allclose(point.cycles, contact.cycles(pair, alone.s), rtol=1e-6)
    again = open_results(tmp_path / "two.nc")
    assert again.identical(found)
    assert Study.from_text(merged(tmp_path / "two.nc").attrs["study"]).grid == Study.from_text(text).grid
    one = run(Study.from_text(text.replace("[axes]", "body = 2\n[axes]")), tmp_path / "one.nc", workers=1)
    np.testing.assert_array_equal(one.cycles, found.cycles.sel(body=2))
    assert one.young_modulus.item() == 150e3


def test_a_bulk_stress_is_that_of_the_first_body(tmp_path):
    """At δA = uA = 0 nothing moves but the bulk stress: SWT = σ_max σ_A/E far from the contact."""
    text = without(
        STUDY, "critical_distance", "normal_amplitude", "tangential_amplitude", "phase", "[figure]"
    )
    text = without(
        text, "x =", "hue =", "panels =", "y =", "[material]", "strength", "ductility", "quantities"
    )
    text += "\ntangential_amplitude = [0, 1e-6]\nbulk_stress_amplitude = [30, 60]\n"
    text = text.replace("[axes]", "bulk_stress_ratio = 0.2\n[axes]")
    grid = Study.from_text(text).grid
    assert grid.dims[-1] == "body"
    mean = grid.numbers["bulk_stress_mean"].isel(bulk_stress_amplitude=1, normal_force=1)
    amplitude = grid.numbers["bulk_stress_amplitude"].isel(bulk_stress_amplitude=1, normal_force=1)
    assert mean.values.tolist() == [pytest.approx(1.5 * float(amplitude)), 0.0]  # (1 + R)/(1 − R)
    assert (grid.numbers["bulk_strain_share"] == [1.0, -1.0]).all()
    stress = (
        73.1e3 / (2 * (1 - 0.33**2)) * (3 * 200 * 50 / (4 * 73.1e3 / (2 * (1 - 0.33**2)))) ** (1 / 3) / 50
    )
    assert float(amplitude) == pytest.approx(60 / stress)


def test_a_study_with_units_in_words(tmp_path):
    study = Study.from_text(without(BODIES, "[figure]", "x =", "hue =", "panels =", "y ="))
    text = study._repr_html_()
    for words in ("150, 200 N", "50 mm", "210000, 150000 MPa", "0.05 mm", "of each body", "<b>body</b>"):
        assert words in text, words
    archive = run(Study.from_text(plain("quantities", "critical_distance")), tmp_path / "a.nc", workers=1)
    assert archive.swt.slice(normal_force="150", phase="pi/2").SWT.dims == ("tangential_amplitude",)
    ratio = archive.swt.normalised("normal_force=200")
    np.testing.assert_allclose(ratio.sel(normal_force=150), archive.s[0] / archive.s[1])


@pytest.mark.slow
def test_of_two_profiles_one_has_a_wavelength():
    text = plain("quantities", "critical_distance")
    text = text.replace("[fixed]", "[fixed]\nwaviness_amplitude = 1e-3\nwavelength = 2")
    study = Study.from_text(text.replace("[axes]", '[axes]\nprofile = ["paraboloid", "wavy_paraboloid"]'))
    assert stand_in.distinct(study) == study.grid.size == 16
