"""Studies in units of the user's own: their numbers, archives and mistakes."""

import json
import math

import numpy as np
import pytest
import stand_in
import xarray as xr

import swtstudy
from swtstudy import FatigueConstants, Study, StudyError, open_results, physical, run
from swtstudy.archive.merge import merge
from swtstudy.archive.recall import grid_of
from swtstudy.archive.write import save
from swtstudy.grid.unique import unique_points
from swtstudy.runner.run import Stopped

STUDY = """
title = "A sphere on a flat"
rtol = 1e-3
quantities = ["dissipation", "stick_radius", "contact_radius"]
[units]
length = "mm"
force = "N"
stress = "MPa"
[material]
strength = 927
strength_exponent = -0.113
ductility = 0.409
ductility_exponent = -0.713
[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
normal_amplitude = 2e-3
critical_distance = 0.05
[axes]
normal_force = [150, 200]
tangential_amplitude = [1e-3, 2.5e-3]
phase = [0, "pi/2"]
[figure]
x = "phase"
hue = "tangential_amplitude"
panels = "normal_force"
y = ["SWT", "cycles", "SWT_volume", "critical_position"]
"""
ALUMINIUM = FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
#: Two bodies of which each has its own constants, alike in (1 − 2ν)/G as steel and brass nearly are.
BODIES = (
    STUDY.replace("73.1e3", "[210e3, 150e3]")
    .replace("0.33", "[0.3, 0.33]")
    .replace("ductility = 0.409", "ductility = [0.409, 0.2]")
)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    return run(Study.from_text(STUDY), tmp_path_factory.mktemp("real") / "sphere.nc", workers=1)


def without(text, *lines):
    return "\n".join(line for line in text.splitlines() if not line.startswith(lines))


def plain(*lines):
    """The study without a figure, and without some lines."""
    return without(STUDY, "[figure]", "x =", "hue =", "panels =", "y =", *lines)


def test_values_are_those_of_the_single_contact(solved):
    assert solved.s.dims == ("normal_force", "tangential_amplitude", "phase")
    point = solved.sel(normal_force=200, tangential_amplitude=2.5e-3).isel(phase=1)
    contact = physical(
        young_modulus=73.1e3,
        poisson_ratio=0.33,
        radius=50.0,
        friction=0.5,
        normal_force=200.0,
        normal_amplitude=2e-3,
        tangential_amplitude=2.5e-3,
        phase=np.pi / 2,
    )
    alone = contact.solve(rtol=1e-3)
    assert point.SWT.item() == pytest.approx(alone.SWT.values[0], rel=1e-9)
    assert point.SWT_error.item() == pytest.approx(alone.SWT_error.values[0], rel=1e-6)
    assert abs(point.critical_position.item()) == pytest.approx(abs(alone.critical_position.values[0]))
    near = swtstudy.solve(rtol=1e-3, critical_distance=0.05 / contact.length_scale, **contact.parameters())
    for name in ("volume", "point", "line"):
        np.testing.assert_allclose(point[f"s_{name}"], near[f"s_{name}"], rtol=1e-6)
        np.testing.assert_allclose(point[f"SWT_{name}"], contact.swt(near[f"s_{name}"]), rtol=1e-6)
        np.testing.assert_allclose(point[f"cycles_{name}"], ALUMINIUM.cycles(point[f"SWT_{name}"]))
    assert point.cycles.item() == pytest.approx(contact.cycles(ALUMINIUM, point.s.item()))


def test_the_contact_at_rest_is_hertz(solved):
    e_star = 73.1e3 / (2 * (1 - 0.33**2))
    for force in (150.0, 200.0):
        radius = (3 * force * 50.0 / (4 * e_star)) ** (1 / 3)
        here = solved.sel(normal_force=force)
        assert here.contact_radius.item() == pytest.approx(radius)
        assert here.depth.item() == pytest.approx(radius**2 / 50.0)
        assert here.peak_pressure.item() == pytest.approx(3 * force / (2 * math.pi * radius**2))
    assert solved.contact_radius.dims == ("normal_force",)


def test_work_and_radii_are_in_the_units(solved, tmp_path):
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
    assert solved.dissipation.attrs["units"] == "N mm"


def test_units_are_said(solved):
    units = {name: solved[name].attrs.get("units") for name in ("s", "SWT", "cycles", "critical_position")}
    assert units == {"s": None, "SWT": "MPa", "cycles": None, "critical_position": "mm"}
    coordinates = ("radius", "normal_force", "tangential_amplitude", "young_modulus", "phase", "friction")
    found = [solved[name].attrs.get("units") for name in coordinates]
    assert found == ["mm", "N", "mm", "MPa", "rad", None]
    assert solved.critical_distance.attrs["units"] == "mm"
    assert solved.SWT_volume_error.attrs["units"] == "MPa"


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
    grid = Study.from_text(text).grid
    assert grid.size == 3
    assert len(unique_points(grid).table) == 1


def test_bodies_that_differ_have_a_dimension(tmp_path):
    text = without(BODIES, "critical_distance", "[figure]", "x =", "hue =", "panels =", "y =")
    found = run(Study.from_text(text), tmp_path / "two.nc", workers=1)
    assert found.s.dims == ("normal_force", "tangential_amplitude", "phase", "body")
    assert found.young_modulus.values.tolist() == [210e3, 150e3]
    assert found.body.values.tolist() == [1, 2]
    point = found.isel(normal_force=1, tangential_amplitude=1, phase=1)
    pair = (ALUMINIUM, FatigueConstants(150e3, 927.0, -0.113, 0.2, -0.713))
    pair = (FatigueConstants(210e3, *list(vars(ALUMINIUM).values())[1:]), pair[1])
    contact = physical(
        young_modulus=(210e3, 150e3),
        poisson_ratio=(0.3, 0.33),
        radius=50.0,
        friction=0.5,
        normal_force=200.0,
        normal_amplitude=2e-3,
        tangential_amplitude=2.5e-3,
        phase=np.pi / 2,
    )
    alone = contact.solve(rtol=1e-3)
    np.testing.assert_allclose(point.SWT, alone.SWT, rtol=1e-9)
    np.testing.assert_allclose(point.cycles, contact.cycles(pair, alone.s), rtol=1e-6)
    again = open_results(tmp_path / "two.nc")
    assert again.identical(found)
    assert grid_of(again) == Study.from_text(text).grid
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
    assert mean.values.tolist() == [pytest.approx(1.5 * amplitude.values[0]), 0.0]  # (1 + R)/(1 − R)
    stress = (
        73.1e3 / (2 * (1 - 0.33**2)) * (3 * 200 * 50 / (4 * 73.1e3 / (2 * (1 - 0.33**2)))) ** (1 / 3) / 50
    )
    assert amplitude.values[0] == pytest.approx(60 / stress)


def test_archives_resume_and_extend(tmp_path, solved):
    path = tmp_path / "sphere.nc"
    with pytest.raises(Stopped, match="4 of 8 distinct points are saved"):
        run(Study.from_text(STUDY), path, workers=1, solver=_StopsAfter(4))
    partial = open_results(path)
    assert int(partial.SWT.notnull().sum()) == 4
    found = run(Study.from_text(STUDY), path, workers=1)
    np.testing.assert_array_equal(found.s, solved.s)
    np.testing.assert_array_equal(found.SWT_line, solved.SWT_line)
    assert "4 of 8 distinct points computed" in found.attrs["history"]
    more = (
        STUDY.replace("[150, 200]", "[150, 200, 250]")
        .replace("critical_distance = 0.05", "")
        .replace("[axes]", "[axes]\ncritical_distance = [0.02, 0.05]")
        .replace('"SWT_volume", ', "")
    )
    longer = run(Study.from_text(more), path, workers=1)
    np.testing.assert_array_equal(longer.SWT.sel(normal_force=[150, 200]), solved.SWT)
    kept = longer.SWT_point.sel(normal_force=[150, 200], critical_distance=0.05)
    np.testing.assert_array_equal(kept, solved.SWT_point)
    assert "4 of 12 distinct points computed, and quantities that 8 others lacked" in longer.attrs["history"]
    assert longer.SWT_volume.notnull().all()
    # The same bodies with others units: everything is known.
    changed = run(Study.from_text(STUDY.replace("927", "800")), path, workers=1)
    assert "0 of 8 distinct points computed" in changed.attrs["history"]
    assert (changed.cycles < solved.cycles).all()
    np.testing.assert_array_equal(changed.dissipation, solved.dissipation)


class _StopsAfter:
    """The solver, which is interrupted after some points."""

    def __init__(self, points):
        self.left = points

    def __call__(self, points, rtol):
        from swtstudy.mechanics import solve_points

        if self.left <= 0:
            raise KeyboardInterrupt
        self.left -= len(points)
        return solve_points(points, rtol)


#: A line of the study, what stands there instead, and what is said of it.
MISTAKES = [
    (
        'length = "mm"',
        'length = "m"',
        "units: found N over m², which is 1e-06 MPa; allowed: a consistent set",
    ),
    ('force = "N"', "force = 1", "units.force: found 1; allowed: the name of a unit, such as 'N'"),
    ('stress = "MPa"', "", "units.stress: found nothing; allowed: the name of a unit"),
    ("strength = 927", "strength = -1", "material.strength: found -1; allowed: a positive stress in MPa"),
    ("strength = 927", "", "material.strength: found nothing; allowed: a positive stress in MPa"),
    (
        "ductility = 0.409",
        "ductlity = 1",
        "material.ductlity: found unknown key 'ductlity'; allowed: did you",
    ),
    (
        "radius = 50",
        "radius = -50",
        "fixed.radius: found -50 (out of range); allowed: a positive length in mm",
    ),
    ("radius = 50", "", "fixed.radius: found nothing; allowed: a positive length in mm"),
    (
        "radius = 50",
        "radius = 50\ndepth = 1e-3",
        "fixed.depth, axes.normal_force: found both; allowed: one of",
    ),
    (
        "73.1e3",
        "[73.1e3, 0]",
        "fixed.young_modulus[1]: found 0 (out of range); allowed: a positive stress in MPa",
    ),
    (
        "73.1e3",
        "[1, 2, 3]",
        "fixed.young_modulus: found [1, 2, 3]; allowed: a positive stress in MPa; or two",
    ),
    ("73.1e3", "[210e3, 3e3]", "fixed.young_modulus, fixed.poisson_ratio: found bodies that are not similar"),
    ("friction = 0.5", "", "fixed.friction: found nothing; allowed: a number in [0, 10]"),
    (
        "normal_amplitude = 2e-3",
        "normal_amplitude = 1",
        "fixed.normal_amplitude: found 1 mm at radius = 50 mm, normal_force = 150 N, 188 δ0; 1 more like it; "
        "allowed: at most 0.05319 mm, 10 δ0",
    ),
    (
        "normal_amplitude = 2e-3",
        "normal_force_amplitude = 1e5",
        "fixed.normal_force_amplitude: found 100000 N at radius = 50 mm, normal_force = 150 N, 666.7 F0; "
        "1 more "
        "like it; allowed: at most 1500 N, 10 F0",
    ),
    (
        "normal_amplitude = 2e-3",
        "bulk_stress_mean = -1e6\nbody = 1",
        "fixed.bulk_stress_mean: found -1e+06 MPa at radius = 50 mm, normal_force = 150 N, -2364 E* δ0/a_H; "
        "1 more "
        "like it; allowed: at least -4230 MPa, -10 E* δ0/a_H",
    ),
    (
        "critical_distance = 0.05",
        "critical_distance = 0",
        "fixed.critical_distance: found 0 (out of range); allowed: a positive length in mm",
    ),
    ("friction = 0.5", "friction = 0", "axes.tangential_amplitude: found 0.001 mm at radius = 50 mm"),
    ("friction = 0.5", "friction = 0.5\nbody = 1.5", "fixed.body: found [1.5]; allowed: 1 or 2"),
    ("friction = 0.5", "friction = 0.5\nsimilar = -1", "fixed.similar: found -1; allowed: a number ≥ 0"),
    (
        "friction = 0.5",
        "friction = 0.5\nbulk_stress_mean = 1\nbulk_stress_ratio = 0",
        "fixed.bulk_stress_mean, fixed.bulk_stress_ratio: found both; allowed: one of the two",
    ),
    (
        "friction = 0.5",
        'friction = 0.5\nprofile = "wavy_paraboloid"\nwaviness_amplitude = 1e-3\nwavelength = 0.05',
        "fixed.wavelength: found 0.05 at waviness_amplitude 0.001 at radius = 50 mm, normal_force = 150 N",
    ),
    (
        "friction = 0.5",
        'friction = 0.5\nprofile = "rounded_punch"\nflat_radius = 60',
        "fixed.flat_radius: found 60.0 at normal_force 150.0 at radius = 50 mm, normal_force = 150 N",
    ),
    (
        'y = ["SWT", "cycles"',
        'y = ["SWTs", "cycles"',
        "figure.y: found 'SWTs' (not a quantity); allowed: did you",
    ),
    (
        "[150, 200]",
        "[150, -200]",
        "axes.normal_force[1]: found -200 (out of range); allowed: a positive force in N",
    ),
]


@pytest.mark.parametrize(("line", "instead", "words"), MISTAKES)
def test_mistakes_are_said_in_the_users_quantity_and_unit(line, instead, words):
    assert line in STUDY
    with pytest.raises(StudyError) as error:
        Study.from_text(STUDY.replace(line, instead, 1), "mine.toml")
    found = str(error.value).splitlines()
    assert len(found) == 1, found
    assert found[0].startswith(f"mine.toml: {words}")


def test_all_mistakes_are_said_at_once():
    wrong = STUDY
    for line, instead, _ in (MISTAKES[3], MISTAKES[6], MISTAKES[16], MISTAKES[-1]):
        wrong = wrong.replace(line, instead, 1)
    with pytest.raises(StudyError) as error:
        Study.from_text(wrong, "mine.toml")
    assert sorted(mistake.key for mistake in error.value.mistakes) == [
        *("axes.normal_force[1]", "fixed.critical_distance", "fixed.radius", "material.strength"),
    ]


def test_constants_of_a_material_need_units():
    text = 'title = "t"\n[material]\nstrength = 1\n'
    with pytest.raises(StudyError, match=r"material: found constants without \[units\]"):
        Study.from_text(text)


RIG = {
    "young_modulus": 73.1e3,
    "poisson_ratio": 0.33,
    "radius": 50.0,
    "friction": 0.5,
    "normal_amplitude": 2e-3,
}


def test_arrays_in_python_are_the_study(solved):
    swings = {"normal_force": [150, 200], "tangential_amplitude": [1e-3, 2.5e-3], "phase": [0, "pi/2"]}
    contacts = physical(**RIG, **swings)
    asked = ["dissipation", "stick_radius", "contact_radius"]
    found = contacts.solve(1e-3, quantities=asked, critical_distance=0.05, constants=ALUMINIUM)
    assert repr(contacts) == "<PhysicalContacts: 8 = 2 normal_force × 2 tangential_amplitude × 2 phase>"
    assert {*found.data_vars} == {*solved.data_vars} - {"status", "run"}
    for name in found.data_vars:
        np.testing.assert_allclose(found[name], solved[name], rtol=1e-9, err_msg=name)
    pair = (ALUMINIUM, FatigueConstants(73.1e3, 800.0, -0.113, 0.409, -0.713))
    both = physical(**RIG, normal_force=[150.0], tangential_amplitude=1e-3).solve(1e-3, constants=pair)
    assert both.cycles.dims == ("normal_force", "body")
    assert both.cycles[0, 1] < both.cycles[0, 0]
    assert both.SWT[0, 1] == both.SWT[0, 0]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"radius": [50.0, -1.0]}, "radius[1]: found -1.0 (out of range); allowed: a positive length"),
        (
            {"radius": [[50.0]]},
            "radius: found [[50.0]]; allowed: a single value or a one-dim",
        ),
        ({"frictoin": 1}, "frictoin: found unknown parameter 'frictoin'; allowed: did you mean friction?"),
        (
            {"young_modulus": (73e3, -1)},
            "young_modulus[1]: found -1 (out of range); allowed: a positive",
        ),
        ({"bulk_stress_body": 2}, "bulk_stress_body: found 2; allowed: 0 or 1"),
        ({"similar": -1}, "similar: found -1; allowed: a number ≥ 0"),
    ],
)
def test_mistakes_in_arrays_are_named(changes, words):
    given = {**RIG, "tangential_amplitude": 1e-3, "normal_force": [150, 200], **changes}
    with pytest.raises(StudyError) as error:
        physical(**given)
    assert str(error.value).splitlines()[0].startswith(words)


def test_mistakes_in_what_is_asked_of_arrays_are_named_at_once():
    contacts = physical(**RIG, tangential_amplitude=1e-3, normal_force=[150, 200])
    with pytest.raises(StudyError) as error:
        contacts.solve(2.0, quantities=["x"], critical_distance=-1, constants=3)
    assert [each.key for each in error.value.mistakes] == [
        *("rtol", "critical_distance", "quantities[0]", "constants"),
    ]


def test_a_contact_in_a_notebook():
    contact = physical(**RIG, tangential_amplitude=1e-3, normal_force=200.0)
    text = contact._repr_html_()
    for words in ("73100", "<b>radius</b></td><td>50<", "0.567588", "296.418", "0.310408", "δA/δ0"):
        assert words in text, words
    assert "bulk_stress" not in text
    assert "waviness" not in text


LOOP = """
[loads.cycle]
vertices = [[0, -60, 10], [20, -60, 30], [20, 60, 30], [0, 60, -10]]
"""


def test_the_columns_of_a_loop_are_in_newtons_and_megapascals(tmp_path):
    text = without(
        STUDY, "critical_distance", "normal_amplitude", "tangential_amplitude", "phase", "[figure]"
    )
    text = without(text, "x =", "hue =", "panels =", "y =", "quantities")
    loop = "normal_force_amplitude = 1\ntangential_force_amplitude = 1\nload = 'cycle'\n[axes]"
    study = Study.from_text(text.replace("[axes]", loop) + LOOP)
    numbers = study.grid.numbers
    np.testing.assert_allclose(numbers["normal_amplitude"], [1 / 150, 1 / 200])
    np.testing.assert_allclose(numbers["tangential_amplitude"], [1 / 75, 1 / 100])
    stress = numbers["bulk_stress_amplitude"]
    p0 = physical(**RIG, tangential_amplitude=0, normal_force=150.0).peak_pressure
    np.testing.assert_allclose(stress[0], [1 / (np.pi * p0 / 2), 0.0])  # of the first body alone
    found = run(study, tmp_path / "loop.nc", workers=1)
    vertices = np.array([[0, -60, 10], [20, -60, 30], [20, 60, 30], [0, 60, -10]])
    alone = physical(
        **{name: value for name, value in RIG.items() if name != "normal_amplitude"},
        normal_force=200.0,
        load=swtstudy.LoadPath("cycle", vertices),
        normal_force_amplitude=1.0,
        tangential_force_amplitude=1.0,
        bulk_stress_amplitude=1.0,
    )
    np.testing.assert_allclose(found.SWT[1], alone.solve(1e-3).SWT, rtol=1e-6)
    with pytest.raises(StudyError, match="1 if the column normal of the loop is in mm; or normal_force_amp"):
        Study.from_text(text.replace("[axes]", loop.replace("normal_force_amplitude = 1\n", "")) + LOOP)


PAD = """
[profiles.pad]
radius = [0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6]
height = [0, 4e-4, 1.6e-3, 3.6e-3, 6.4e-3, 1e-2, 1.44e-2, 1.96e-2, 2.56e-2]
"""


def test_a_table_in_lengths_is_a_profile(tmp_path):
    """f = r²/(2 · 50): the table of the paraboloid of R = 50."""
    text = plain("critical_distance", "radius = 50")
    text = text.replace('phase = [0, "pi/2"]', "").replace("[axes]", "profile = 'pad'\n[axes]")
    found = run(Study.from_text(text + PAD), tmp_path / "pad.nc", workers=1)
    smooth = text.replace("profile = 'pad'", "radius = 50")
    like = run(Study.from_text(smooth), tmp_path / "like.nc", workers=1)
    for name in ("SWT", "contact_radius", "peak_pressure", "depth", "dissipation", "cycles"):
        np.testing.assert_allclose(found[name], like[name], rtol=1e-4, atol=1e-9, err_msg=name)
    assert open_results(tmp_path / "pad.nc").identical(found)
    both = text.replace("profile = 'pad'", "profile = 'pad'\nradius = 50")
    with pytest.raises(StudyError, match=r"fixed\.radius: found a radius; allowed: nothing"):
        Study.from_text(both + PAD)


def test_a_sample_of_what_is_known_badly(tmp_path):
    text = without(
        STUDY, "critical_distance", "friction", "normal_force", "tangential", "phase", "[axes]", "[figure]"
    )
    text = without(text, "x =", "hue =", "panels =", "y =", "quantities")
    text += """
tangential_amplitude = 1e-3
[sample]
design = "sobol"
size = 4
[sample.ranges]
friction = [0.3, 0.6]
normal_force = { distribution = "normal", mean = 200, deviation = 20 }
"""
    study = Study.from_text(text)
    found = run(study, tmp_path / "sample.nc", workers=1)
    assert found.SWT.dims == ("sample",)
    assert found.normal_force.attrs["units"] == "N"
    e_star = 73.1e3 / (2 * (1 - 0.33**2))
    np.testing.assert_allclose(found.contact_radius**3, 0.75 * found.normal_force * 50 / e_star)
    assert grid_of(open_results(tmp_path / "sample.nc")).samples == study.grid.samples


def test_archives_are_merged(tmp_path):
    parts = [STUDY.replace("[150, 200]", "[150]"), STUDY.replace("[150, 200]", "[200]")]
    for index, text in enumerate(parts):
        run(Study.from_text(text), tmp_path / f"{index}.nc", workers=1, solver=stand_in.smooth)
    whole = run(Study.from_text(STUDY), tmp_path / "whole.nc", workers=1, solver=stand_in.smooth)
    merged = merge([tmp_path / "0.nc", tmp_path / "1.nc"])
    for name in ("s", "SWT", "cycles", "contact_radius"):
        np.testing.assert_allclose(merged[name], whole[name], rtol=1e-9)
    assert Study.from_text(merged.attrs["study"]).grid.shape == (2, 2, 2)
    other = STUDY.replace('"MPa"', '"N/mm²"')
    run(Study.from_text(other), tmp_path / "other.nc", workers=1, solver=stand_in.smooth)
    with pytest.raises(ValueError, match="other units"):
        merge([tmp_path / "0.nc", tmp_path / "other.nc"])


MATERIALS = """
[weak]
strength = 600
strength_exponent = -0.1
ductility = 0.2
ductility_exponent = -0.6
source = "nobody"
[strong]
young_modulus = 70e3
strength = 1200
strength_exponent = -0.1
ductility = 0.2
ductility_exponent = -0.6
"""


def test_materials_come_by_name_from_a_file(tmp_path):
    (tmp_path / "materials.toml").write_text(MATERIALS)
    start, rest = STUDY.split("[material]")[0], STUDY[STUDY.index("[fixed]") :]
    rest = rest[: rest.index("[figure]")]

    def study(table):
        return Study.from_text(f"{start}[material]\n{table}\n{rest}", "mine.toml", tmp_path)

    grid = study('file = "materials.toml"\nname = ["weak", "strong"]').grid
    assert grid.materials == (
        FatigueConstants(73.1e3, 600.0, -0.1, 0.2, -0.6),
        FatigueConstants(70e3, 1200.0, -0.1, 0.2, -0.6),
    )
    assert grid.dims[-1] == "body"
    assert len(unique_points(grid).table) == 8  # s is that of both
    for table, words in (
        (
            'file = "materials.toml"\nname = "wek"',
            "material.name: found 'wek'; allowed: a material in",
        ),
        ('file = "other.toml"\nname = "weak"', "material.file: found 'other.toml' (No such file"),
        ('name = "weak"', "material.file: found nothing; allowed: a TOML file with a table"),
        (
            'file = "materials.toml"\nname = "weak"\nstrength = 1',
            "material: found a name and strength;",
        ),
    ):
        with pytest.raises(StudyError) as error:
            study(table)
        assert str(error.value).startswith(f"mine.toml: {words}"), error.value
        assert len(error.value.mistakes) == 1


def test_the_contact_of_an_archive_is_checked(tmp_path):
    run(Study.from_text(STUDY), tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    found = open_results(tmp_path / "a.nc")
    raw = json.loads(found.attrs["contact"])
    wrong = found.assign_attrs(contact=json.dumps({**raw, "materials": [1]}))
    save(wrong, tmp_path / "b.nc")
    with pytest.raises(ValueError, match=r"attribute contact: found .*not a contact"):
        open_results(tmp_path / "b.nc")
    lacking = found.drop_vars("friction")
    save(lacking, tmp_path / "c.nc")
    with pytest.raises(ValueError, match="friction: found nothing"):
        open_results(tmp_path / "c.nc")
    assert xr.open_dataset(tmp_path / "a.nc").SWT.attrs["units"] == "MPa"
