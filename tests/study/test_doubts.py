"""What is said of studies that are sound, and in which a unit is probably another one."""

import logging
from pathlib import Path

import pytest
import real
from command import call
from told import RIG, sayings, warned

from swtstudy import Study, physical

LOADS = "normal_force = 200\ntangential_force_amplitude = 60\n"
CONTACT = f"[fixed]\nyoung_modulus = 73.1e3\npoisson_ratio = 0.33\nradius = 50\nfriction = 0.5\n{LOADS}"
MATERIAL = f"[material]\n{real.CONSTANTS}"
SHEAR = "shear_strength = 50000\nshear_strength_exponent = -0.1\nshear_ductility = 0.5\n"
SHEAR += "shear_ductility_exponent = -0.6\nyield_strength = 300\n"
THRESHOLD = "[material]\nthreshold_stress_intensity_range = {}\nfatigue_limit_range = 200\n"
DISTANCE = "of the point method: (ΔK_th/Δσ_0)²/π with the ranges {1} MPa√mm and 200 MPa at {0}"
UNSAID = "one load ratio"
RATIO = '[axes]\nnormal_force = [200, 300]\n[figure]\nx = "normal_force"\ny = "s/s(normal_force=200)"\n'
SPHERE = CONTACT.replace("radius = 50", "radius = 0.02")


def told(text: str) -> list[str]:
    return warned(Study.from_text, f'title = "t"\n{text}', "s")[1]


def cap(factor: float, power: float, depth: float) -> str:
    """A contact of a table at a depth."""
    radius = [k / 10 for k in range(51)]
    fixed = CONTACT.replace("radius = 50\n", "").replace(
        LOADS, f"depth = {depth}\ntangential_amplitude = 0\n"
    )
    table = f"[profiles.cap]\nradius = {radius}\nheight = {[factor * r**power for r in radius]}\n"
    return f'{fixed}profile = "cap"\n{table}'


DOUBTS = sayings(r"""
CONTACT
f"{MATERIAL}{CONTACT}normal_force_amplitude = 20\n[axes]\nfrequency_ratio = [1, 2]\n"
» s: a load cycle at frequency_ratio p/q has p tangential and q normal oscillations: cycles at several ratios
    are not of one length
CONTACT.replace("normal_force = 200", "") + RATIO
» s: figure.y: in s/s(normal_force=200) s is over E* δ0/R, which changes with normal_force: SWT has another
    ratio
f"{CONTACT}bulk_stress_amplitude = 20\nbodies = ['pad', 'specimen']\n"
» 'pad' carries the bulk stress, as the first of bodies; if it is the other one, bulk_stress_body = 'specimen'
f"{CONTACT}bulk_stress_amplitude = 20\nbodies = ['pad', 'specimen']\nbulk_stress_body = 'specimen'\n"
f"{CONTACT}bodies = ['pad', 'specimen']\n"
MATERIAL + CONTACT
f"{CONTACT.replace('60', '0.6')}normal_force_amplitude = 0.2\n"
» s: normal_force_amplitude 0.2 N is 0.001 of the normal force: is it meant as a share of that?
» s: tangential_force_amplitude 0.6 N is 0.006 of friction times the normal force: is it meant as a share of
    that?
f"{CONTACT}normal_force_amplitude = 5\n"
MATERIAL.replace("927", "[9, 92700]") + CONTACT
» material.strength 9 over young_modulus 73100 is 0.000123, of metals 0.0002 to 0.05: are both in MPa?
» material.strength 92700 over young_modulus 73100 is 1.27, of metals 0.0002 to 0.05: are both in MPa?
MATERIAL.replace("0.409", "40.9").replace("-0.113", "-1.13").replace("-0.713", "-7.13") + CONTACT
» material.strength_exponent -1.13, of metals -0.5 to 0
» material.ductility 40.9, of metals 0.001 to 5
» material.ductility_exponent -7.13, of metals -2 to 0
f"{MATERIAL}young_modulus = [30e3, 73.1e3]\n{CONTACT}"
» material.young_modulus 30000 is 0.41 times the body's 73100: are both of one material, and in MPa?
# An odd modulus of the body has been told by the strength.
f"{MATERIAL}young_modulus = 73.1e3\n" + CONTACT.replace("73.1e3", "7e3")
» material.strength 927 over young_modulus 7000 is 0.132, of metals 0.0002 to 0.05: are both in MPa?
f"{MATERIAL}yield_strength = 35000\nfindley_limit = [0.2, 200]\n{CONTACT}"
» material.yield_strength 35000 over young_modulus 73100 is 0.479, of metals 0.0002 to 0.05: are both in MPa?
» material.findley_limit 0.2 over young_modulus 73100 is 2.74e-06, of metals 0.0002 to 0.05: are both in MPa?
f'[material]\n{SHEAR}{CONTACT}criterion = "fatemi_socie"\nnormal_sensitivity = 0.3\n'
» material.shear_strength 50000 over young_modulus 73100 is 0.684, of metals 0.0002 to 0.05: are both in MPa?
THRESHOLD.format(3) + CONTACT
» critical_distance = 7.162e-05 mm, of the point method: (ΔK_th/Δσ_0)²/π with the ranges 3 MPa√mm and 200 MPa
    at one load ratio; metals have 0.001 to 3 mm: 1 MPa√m is 31.62 MPa√mm
f"{THRESHOLD.format(1e3)}load_ratio = 0.1\n" + CONTACT.replace("= 200\n", "= 2e5\n").replace("= 50\n", "=
    5e3\n")
» critical_distance = 7.958 mm, of the point method: (ΔK_th/Δσ_0)²/π with the ranges 1000 MPa√mm and 200 MPa
    at the load ratio 0.1; metals have 0.001 to 3 mm: 1 MPa√m is 31.62 MPa√mm
CONTACT.replace("friction = 0.5", "friction = 5") » s: friction 5: metals have some 0.1 to 1.5
CONTACT.replace("normal_force = 200\n", "load = 'rig'\n") + "[loads.rig]\nvertices = [[190, -50], [210,
    50]]\nabsolute = true\n"
» s: tangential_force_amplitude 60 multiplies the column tangential of rig: 1 takes it as it is
SPHERE
» s: radius 0.02 mm is smaller than the contact (0.0418 mm): is the radius in another unit, such as metres?
f'{SPHERE}profile = "rounded_punch"\nflat_radius = 0.02\n'
» s: radius 0.02 mm is smaller than the contact beside its flat face (0.0313 mm): is the radius in another
    unit, such as metres?
f"{CONTACT}[axes]\nphase = [0, 1]\nfrequency_ratio = [1, 2]\n"
» s: axes.phase has no effect: what it is of does not oscillate
» s: axes.frequency_ratio changes no stress under a constant normal load, only how many oscillations a load
    cycle has: 1 has one
CONTACT.replace("73.1e3", "[73.1e3, 65e3]").replace("0.33", "[0.33, 0.30]")
» Dundurs' β = -0.0346 is 0.069 times the friction 0.5: pressure p drags tangential tractions of about β p
    along, which s leaves out
CONTACT.replace("73.1e3", "[73.1e3, 67e3]")
CONTACT.replace("73.1e3", "[73.1e3, 7e3]").replace("= 0.5", "= 0").replace("= 60", "= 0")
cap(0.1, 1.5, 0.05)
cap(0.1, 1.5, 0.05) + "smoothing = 0.0001"
cap(0.1, 1.5, 0.05) + "smoothing = 0.001"
» s: profile cap: its smoothing is 0.039 of its rise within the contact at the mean load, so that the largest
    local values, such as s, may be off by more than that share; a mean over a critical_distance is nearer
CONTACT.replace("= 200", "= 2e5")
» s: a mean pressure of 1976 MPa is 0.048 of E*; metals yield below 0.03: is the force or the modulus
    in another unit?
CONTACT.replace("= 200", "= 2e4") + "profile = 'cylinder'"
» s: a mean pressure of 1795 MPa is 0.044 of E*; metals yield below 0.03: is a contact_length missing, or the
    force per length in another unit?
CONTACT.replace("= 200", "= 2e4") + "profile = 'cylinder'\ncontact_length = 10"
cap(0.1, 1.5, 0.06)
» s: profile cap: a contact radius of 0.4812 mm over R is 0.125, p0 over E* is 0.107: are heights and
    positions in one unit?
""")


@pytest.mark.parametrize(("text", "lines"), DOUBTS)
def test_what_is_doubted(text: str, lines: list[str]) -> None:
    assert told(real.UNITS + eval(text)) == lines


def test_a_contact_of_python_is_doubted_as_one_of_a_study() -> None:
    contact = physical(**RIG | {"friction": 5.0}, normal_force=2e5, tangential_force_amplitude=2e5)
    _, lines = warned(contact.solve, 1e-1)
    assert [line.partition(" of ")[0] for line in lines] == [
        "friction 5: metals have some 0.1 to 1.5",
        "a mean pressure",
    ]


def test_a_plan_says_which_limits_are_exceeded_already_as_validate_does(tmp_path: Path) -> None:
    file = tmp_path / "big.toml"
    file.write_text(f'title = "t"\n{real.UNITS}{CONTACT.replace("= 60", "= 150")}', encoding="utf-8")
    planned = " ".join(call("plan", file, "--results", tmp_path).stdout.split())
    said = call("validate", file).stderr.splitlines()
    lines = [line.removeprefix("validity: ") for line in said if line.startswith("validity: ")]
    assert lines
    assert all(line in planned for line in lines)


@pytest.mark.parametrize(("ratio", "words"), [("", UNSAID), ("load_ratio = -1\n", "the load ratio -1")])
def test_the_critical_distance_of_a_threshold_is_told(
    ratio: str, words: str, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    text = f"{real.UNITS}{THRESHOLD.format(100)}{ratio}{CONTACT}"
    assert told(text) == []
    assert caplog.messages == [f"critical_distance = 0.07958 mm, {DISTANCE.format(words, 100)}"]
    (own,) = Study.from_text(f'title = "t"\n{text}').asked.distances
    assert own == pytest.approx(0.25 / 3.141592653589793, rel=1e-12)


def test_units_without_a_size_have_no_metals() -> None:
    text = f"{real.UNITS}{THRESHOLD.format(3)}{CONTACT}".replace('"mm"', '"furlong"')
    assert told(text) == []
    metres = 'units = {length = "m", force = "N", stress = "Pa"}\n' + THRESHOLD.format(20) + CONTACT
    assert told(metres)[0].endswith("20 Pa√m and 200 Pa at one load ratio; metals have 1e-06 to 0.003 m")
