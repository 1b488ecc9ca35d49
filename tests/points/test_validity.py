"""Validity, told with every result: margins against closed forms, and what is said of points outside."""

from pathlib import Path

import numpy as np
import pytest
from command import call
from real import ALUMINIUM, CONSTANTS, UNITS
from told import refused, warned

import swtstudy
from swtstudy import Study, physical, run

#: Forces of a rig: constant load, so that all is in closed form.
RIG = f"""
title = "A rig"
rtol = 1e-2
{UNITS}[material]
yield_strength = 210
{CONSTANTS}[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.3
radius = 50
friction = 0.5
normal_force = 200
[axes]
tangential_force_amplitude = [30, 60, 120]
"""
E_STAR = 73.1e3 / (2 * (1 - 0.3**2))
#: The sphere of the rig.
OWN = {"young_modulus": 73.1e3, "poisson_ratio": 0.3, "radius": 50.0, "friction": 0.5}
#: A normal load at rest under a bulk stress.
PULLED = {"rtol": 1e-2, "normal_amplitude": 0.0}


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    return run(Study.from_text(RIG), tmp_path_factory.mktemp("rig") / "rig.nc", workers=1)


@pytest.mark.slow
def test_contact_radius_over_r(rig):
    radius = (0.75 * 200.0 * 50.0 / E_STAR) ** (1 / 3)
    np.testing.assert_allclose(rig.radius_ratio, radius / 50.0, rtol=1e-9)
    # Of a cycle the largest; a table has the R of the paraboloid that is as wide and as deep.
    own = OWN
    more = physical(**own, normal_force=200.0, normal_force_amplitude=150.0, tangential_force_amplitude=9.0)
    expected = (0.75 * 350.0 * 50.0 / E_STAR) ** (1 / 3) / 50.0
    np.testing.assert_allclose(more.solve(1e-2).radius_ratio, expected, rtol=1e-9)
    cap = np.linspace(0.0, 3.0, 40)
    table = swtstudy.TabulatedProfile("cap", cap, cap**2 / 100.0)
    flat = physical(**{**own, "radius": None, "profile": table}, depth=0.01, tangential_amplitude=1e-3)
    np.testing.assert_allclose(flat.solve(1e-2).radius_ratio, np.sqrt(0.01 / 50.0), rtol=1e-6)
    # Beside a flat face the slope of the profile is (a − b)/R: a wide face alone is no reason for doubt.
    pad = physical(**{**own, "profile": "rounded_flat"}, flat_half_width=6.5, normal_force=1e3,
                   tangential_force_amplitude=100.0).solve(1e-2)  # fmt: skip
    np.testing.assert_allclose(pad.radius_ratio, (float(pad.contact_radius) - 6.5) / 50.0, rtol=1e-6)
    # Heights in µm beside radii in mm.
    wrong = swtstudy.TabulatedProfile("cap", cap, 10.0 * cap**2)
    own = own | {"radius": None, "profile": wrong, "normal_force": 200.0, "tangential_force_amplitude": 9.0}
    with pytest.warns(UserWarning, match="are heights and positions in one unit"):
        dataset = physical(**own).solve(1e-2)
    assert "contact too large for half-spaces" in dataset.swt.validity()[0]


def test_slide_over_the_contact_radius(rig):
    own = OWN | {"depth": 0.01}
    limit, radius = 0.5 * 0.01 * (2.0 - 0.3) / (2.0 - 2.0 * 0.3), np.sqrt(0.01 * 50.0)
    for amplitude in (0.9 * limit, 2.0 * limit, limit + 0.2 * radius):
        found = physical(**own, tangential_amplitude=amplitude).solve(1e-2)
        expected = max(amplitude - limit, 0.0) / radius
        np.testing.assert_allclose(found.slide_ratio, expected, rtol=1e-9)
        lines = [line for line in found.swt.validity() if line.startswith("slide too long")]
        assert len(lines) == (expected > 0.1)
    lost = physical(**own, normal_amplitude=0.012, tangential_amplitude=0.01).solve(1e-2)
    assert np.isnan(lost.slide_ratio).all()
    # Without units no radius is known; a prescribed force lets nothing slide.
    assert "slide_ratio" not in swtstudy.solve(tangential_amplitude=2.0, rtol=1e-2)
    assert "slide_ratio" not in rig


def test_the_yield_ratio_is_that_of_the_table(rig):
    """At Q = 0.6 μP and μ = 0.5 a sphere with ν = 0.3 begins to yield at p0 = 1.30 of the yield strength."""
    at = rig.sel(tangential_force_amplitude=60)
    assert float(rig.peak_pressure / 210.0 / at.yield_ratio) == pytest.approx(1.30, rel=1e-2)
    np.testing.assert_allclose(at.von_mises / 210.0, at.yield_ratio, rtol=1e-12)
    assert rig.von_mises.attrs["units"] == "MPa"


def test_each_body_has_its_own_strength():
    contact = physical(**OWN, normal_force=200.0, tangential_force_amplitude=60.0)
    found = contact.solve(1e-2, yield_strength=(150.0, 300.0))
    np.testing.assert_allclose(found.yield_ratio[0], 2.0 * found.yield_ratio[1], rtol=1e-12)


def test_the_prescribed_force_ratio_is_that_of_the_forces(rig):
    np.testing.assert_allclose(rig.prescribed_force_ratio, [0.3, 0.6, 1.2], rtol=1e-12)
    # Of oscillating forces it is what the quantity finds where there is equilibrium, by another way.
    found = swtstudy.solve(
        rtol=1e-2,
        quantities=["force_ratio"],
        normal_force_amplitude=[0.0, 0.3, 0.5],
        phase=[0.0, 1.1, "pi/2"],
        tangential_force_amplitude=0.6,
    )
    known = found.force_ratio.notnull()
    assert int(known.sum()) == 8
    expected = found.prescribed_force_ratio.where(known)
    np.testing.assert_allclose(expected, found.force_ratio, rtol=1e-3)
    # At ψ = 0 in closed form: 0.6 sin φ over 1 + 0.5 sin φ, at φ = 3π/2.
    assert found.prescribed_force_ratio[2, 0] == pytest.approx(1.2)
    mixed = swtstudy.solve(rtol=1e-2, quantities=["force_ratio"], tangential_force_amplitude=0.05)
    assert mixed.prescribed_force_ratio == pytest.approx(float(mixed.force_ratio), rel=1e-3)
    assert "prescribed_force_ratio" not in swtstudy.solve(rtol=1e-2)


def test_forces_along_a_loop_have_their_ratio_at_a_vertex():
    loop = swtstudy.LoadPath("way", [[0.0, 0.0], [-0.5, 0.4], [0.5, 0.4]])
    found = swtstudy.solve(rtol=1e-2, load=loop, normal_force_amplitude=1, tangential_force_amplitude=1)
    assert float(found.prescribed_force_ratio) == pytest.approx(0.8)


def test_the_bulk_shift_over_the_slip_zone():
    """As in closed form at δA = 0, also where the shift is larger than the slip zone and the shift NaN."""
    amplitude = np.array([0.01, 0.1, 0.4])
    found = swtstudy.solve(**PULLED, bulk_stress_amplitude=amplitude, tangential_amplitude=0.75)
    shift = 2.0 * amplitude / (0.3 * 1.3 * 3.1)
    np.testing.assert_allclose(found.bulk_shift_ratio, shift / (1.0 - np.sqrt(0.25)), rtol=1e-12)
    assert np.isnan(found.bulk_shift[-1])


def test_a_shift_that_is_unknown_is_said_to_be():
    profiles = {"profile": ["paraboloid", "rounded_punch"], "flat_radius": 0.5}
    found = swtstudy.solve(**PULLED, bulk_stress_amplitude=0.02, **profiles)
    (line,) = found.swt.validity()
    assert line.startswith("shift of the stick zone by bulk strain unknown at 1 of 2 points")
    # Where the bulk stress does not move there is no shift.
    punch = {"profile": "rounded_punch", "flat_radius": 0.5}
    still = swtstudy.solve(**PULLED, bulk_stress_amplitude=[0.0, 0.02], **punch)
    assert still.bulk_shift[0] == 0.0
    assert "unknown at 1 of 2 points" in still.swt.validity()[0]


def test_the_shift_is_a_length_of_the_study():
    loads = {"normal_force": 200.0, "bulk_stress_amplitude": 20.0, "tangential_force_amplitude": 60.0}
    contact = physical(**OWN, **loads)
    found = contact.solve(1e-2)
    plain = swtstudy.solve(rtol=1e-2, **contact.parameters()).bulk_shift
    assert float(found.bulk_shift[0]) == pytest.approx(float(plain) * contact.length_scale)
    assert found.bulk_shift.dims == ("body",)


def test_what_is_outside_is_said(rig):
    lines = rig.swt.validity()
    assert lines[0] == (
        "no equilibrium at 1 of 3 points: tangential_force_amplitude 120 N exceeds μ F_N = 100 N"
    )
    assert lines[1].startswith(
        "beyond first yield at 1 of 3 points: largest von Mises stress over the yield "
    )
    assert lines[1].endswith("up to 1.07, limit 1, at tangential_force_amplitude = 60 N")
    assert len(lines) == 2
    assert rig.attrs["validity"] == "\n".join(lines)
    assert rig.sel(tangential_force_amplitude=30).swt.validity() == ()
    within = rig.sel(tangential_force_amplitude=[30]).swt.validity(inside=True)
    assert "contact radius over R up to 0.0114, limit 0.1" in within
    assert [line for line in repr(rig.swt).splitlines() if "validity" in line][:2] == [
        f"  validity       {line}" for line in lines
    ]
    assert "beyond first yield" in rig.swt._repr_html_()


def test_a_maximum_off_the_line_is_found():
    """A bulk stress that presses: the line has the less tension."""
    found = swtstudy.solve(rtol=1e-2, bulk_stress_mean=[0.0, -0.3], tangential_amplitude=0.5)
    plain, above = (found.s_surface / found.s).values
    assert plain == 1.0
    assert above > 1.1


def test_a_point_of_a_sample_has_its_number(tmp_path):
    study = Study.from_text(
        'title = "t"\n[fixed]\nnormal_force_amplitude = 0\nfriction = 0.3\n'
        "[sample.points]\ntangential_force_amplitude = [0.5, 1.2]"
    )
    (line,) = run(study, tmp_path / "sample.nc", workers=1).swt.validity()
    assert line.endswith("1 of 2 points: tangential_force_amplitude 1.2 exceeds 1, in μ F_N at sample = 1")


def test_old_results_say_what_they_can(rig):
    margins = ["radius_ratio", "yield_ratio", "prescribed_force_ratio"]
    assert rig.drop_vars(margins).swt.validity()[0].startswith("no equilibrium at 1 of 3 points")


@pytest.mark.usefixtures("unwrapped")
def test_inspection_says_it():
    figure = swtstudy.inspect(normal_amplitude=0.0, bulk_stress_amplitude=0.4, tangential_amplitude=0.75)
    assert "shift of the stick zone by bulk strain too large" in figure.get_suptitle().replace("\n", " ")


@pytest.mark.parametrize("phase", ["90 deg", "90°", "90 degrees", "pi/2", "1.5707963267948966 rad"])
def test_an_angle_may_have_a_unit(phase):
    assert Study.from_text(f'title = "t"\n[fixed]\nphase = "{phase}"').grid.fixed["phase"] == np.pi / 2


def test_degrees_in_axes_and_samples():
    axis = 'title = "t"\n[axes]\nphase = { start = "0 deg", stop = "180 deg", num = 3 }'
    assert Study.from_text(axis).grid.axes["phase"] == (0.0, np.pi / 2, np.pi)
    drawn = 'title = "t"\n[sample]\ndesign = "sobol"\nsize = 4\n[sample.ranges]\nphase = ["0 deg", "180 deg"]'
    assert max(Study.from_text(drawn).grid.samples["phase"]) <= np.pi
    refused('or "90 deg"', swtstudy.solve, phase="90 grad")


@pytest.mark.parametrize(
    "text",
    [
        "[fixed]\nphase = 90",
        '[fixed]\nphase = "90"',
        "[fixed]\nphase = -26",
        "[fixed]\nbulk_stress_phase = 90",
        "[axes]\nphase = [0, 90]",
        "[axes]\nphase = { start = 0, stop = 360, num = 3 }",
        '[sample]\ndesign = "random"\nsize = 8\n[sample.ranges]\nphase = [30, 360]',
    ],
)
def test_degrees_without_a_word_are_warned_of(text):
    with pytest.warns(UserWarning, match=r'phase: .* is in radians; for degrees write ".* deg"'):
        Study.from_text(f'title = "t"\n{text}')


@pytest.mark.parametrize("phase", ["25", '"90 deg"', '"30*pi"', '"90 rad"'])
def test_what_is_meant_is_not(phase):
    _, told = warned(Study.from_text, f'title = "t"\n[fixed]\nphase = {phase}')
    assert told == []


@pytest.mark.slow
def test_lives_of_each_distance_count():
    rig = {"young_modulus": 115e3, "poisson_ratio": 0.32, "radius": 40.0, "friction": 0.7, "body": 1}
    contact = physical(**rig, normal_force=[900.0, 1000.0], tangential_force_amplitude=500.0)
    found = contact.solve(critical_distance=[0.02, 0.5], constants=ALUMINIUM, rtol=1e-2)
    short, long = found.cycles_volume.transpose("critical_distance", ...).values
    assert (short < 1e7).all()
    assert (long > 1e7).tolist() == [False, True]
    (line,) = [line for line in found.swt.validity() if line.startswith("cycles_volume")]
    assert line.startswith("cycles_volume extrapolated at 1 of 2 points: ")


def test_empty_results_have_no_validity():
    found = swtstudy.solve(friction=[0.3, 0.6], rtol=1e-2).isel(friction=[])
    assert found.swt.validity() == ()


@pytest.mark.filterwarnings("ignore:Dundurs")
@pytest.mark.parametrize("profile", ["paraboloid", "cylinder"])
@pytest.mark.parametrize(("young", "poisson"), [((70e3, 200e3), (0.45, 0.45)), ((200e3, 70e3), (0.44, 0.45))])
@pytest.mark.parametrize("moving", [0.0, 40.0])
def test_a_softer_specimen_shifts_the_stick_zone_further(profile, young, poisson, moving):
    """The strain of the bulk stress over that of both surfaces by the shifted traction, in closed form.

    Both bodies have the stick zone, also where s leaves the shift out.
    """
    given = {"radius": 50.0, "normal_force": 200.0, "friction": 0.5, "similar": 0.2}
    moduli = {"young_modulus": young, "poisson_ratio": poisson}
    contact = physical(
        **given,
        **moduli,
        normal_force_amplitude=moving,
        tangential_force_amplitude=60.0,
        bulk_stress_amplitude=10.0,
        profile=profile,
    )
    found = contact.solve(rtol=1e-2)
    compliances = [(1.0 - ν**2) / e for e, ν in zip(young, poisson, strict=True)]
    if profile == "cylinder":
        a = np.sqrt(4.0 * 200.0 * 50.0 / np.pi * sum(compliances))
        p0 = 2.0 * 200.0 / (np.pi * a)
        # Of tractions ±q √(1 − x²/a²) one shifted by e leaves the strain 2 q e/a² · (1 − ν²)/E.
        shift = 10.0 * compliances[0] / (2.0 * 0.5 * p0 * sum(compliances)) * a
    else:
        a = (0.75 * 200.0 * 50.0 * sum(compliances)) ** (1.0 / 3.0)
        p0 = 1.5 * 200.0 / (np.pi * a**2)
        # Mindlin: u_x falls with x by π q (4 − 3ν) x²/(32 G a).
        bends = [np.pi * (4.0 - 3.0 * ν) * (1.0 + ν) / (8.0 * e) for e, ν in zip(young, poisson, strict=True)]
        shift = 10.0 / young[0] / (0.5 * p0 * sum(bends)) * a
    assert found.bulk_shift.values == pytest.approx([shift, shift], rel=1e-6)


@pytest.mark.parametrize("control", ["amplitude", "force_amplitude"])
def test_margins_without_a_compiler_are_those_of_results(control: str, tmp_path: Path) -> None:
    """What `swtstudy validate` tells of a study is what its results tell, to all digits shown."""
    for bulk in (0.2, 0.35, 0.5):
        loads = {f"normal_{control}": 0.3, f"tangential_{control}": 0.25, "stick_zone_shift": "none"}
        loads |= {
            "phase": [0.1, 1.3, 2.0, 4.4],
            "frequency_ratio": ["1", "3/2"],
            "bulk_stress_amplitude": bulk,
        }
        fixed = "\n".join(f"{name} = {each!r}" for name, each in loads.items() if not isinstance(each, list))
        axes = "\n".join(f"{name} = {each}" for name, each in loads.items() if isinstance(each, list))
        (tmp_path / "loads.toml").write_text(f'title = "t"\n[fixed]\n{fixed}\n[axes]\n{axes}\n')
        told = call("validate", tmp_path / "loads.toml").stderr.splitlines()
        lines = [f"validity: {line}" for line in swtstudy.solve(**loads, rtol=1e-2).swt.validity()]
        assert [line for line in told if "stick zone" in line] == [
            line for line in lines if "stick zone" in line
        ]
        assert told
