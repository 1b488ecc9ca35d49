"""Studies in units of the user's own: what is wrong in them."""

from dataclasses import replace

import pytest
from real import ALUMINIUM, STUDY, UNITS
from told import RIG, refused

from swtstudy import Study, StudyError, physical

#: A line of the study, what stands there instead, and what is said of it; an indented line goes on.
MISTAKES = [
    tuple(part.strip().replace(r"\n", "\n") for part in line.split(" | "))
    for line in r"""
length = "mm" | length = "m" | units: found N over m², which is 1e-06 MPa; allowed: a consistent set
force = "N" | force = 1 | units.force: found 1; allowed: the name of a unit, such as 'N'
stress = "MPa" |  | units.stress: found nothing; allowed: the name of a unit
strength = 927 | strength = -1 | material.strength: found -1; allowed: a positive stress in MPa
strength = 927 |  | material.strength: found nothing; allowed: a positive stress in MPa
ductility = 0.409 | ductlity = 1 | material.ductlity: found unknown key 'ductlity'; allowed: did you
radius = 50 | radius = -50 | fixed.radius: found -50 (out of range); allowed: a positive length in mm
radius = 50 |  | fixed.radius: found nothing; allowed: a positive length in mm
radius = 50 | radius = 50\ndepth = 1e-3 | fixed.depth, axes.normal_force: found both; allowed: one of
73.1e3 | [73.1e3, 0] | fixed.young_modulus[1]: found 0 (out of range); allowed: a positive stress in MPa
73.1e3 | [1, 2, 3] | fixed.young_modulus: found [1, 2, 3]; allowed: a positive stress in MPa; or two
73.1e3 | [210e3, 3e3] | fixed.young_modulus, fixed.poisson_ratio: found bodies that are not similar
young_modulus = 73.1e3 |  | fixed.young_modulus: found nothing; allowed: a positive stress in MPa
friction = 0.5 |  | fixed.friction: found nothing; allowed: a number in [0, 10]
normal_amplitude = 2e-3 | normal_amplitude = 1 |
    fixed.normal_amplitude: found 1 mm at radius = 50 mm, normal_force = 150 N, 188 δ0; 1 more like it;
    allowed: at most 0.05319 mm, 10 δ0
normal_amplitude = 2e-3 | normal_force_amplitude = 1e5 |
    fixed.normal_force_amplitude: found 100000 N at radius = 50 mm, normal_force = 150 N, 666.7 F0; 1 more
    like it; allowed: at most 1500 N, 10 F0
normal_amplitude = 2e-3 | bulk_stress_mean = -1e6\nbody = 1 |
    fixed.bulk_stress_mean: found -1e+06 MPa at radius = 50 mm, normal_force = 150 N, -2364 E* δ0/a_H; 1 more
    like it; allowed: at least -4230 MPa, -10 E* δ0/a_H
critical_distance = 0.05 | critical_distance = 0 |
    fixed.critical_distance: found 0 (out of range); allowed: a positive length in mm
critical_distance = 0.05 | critical_distance = [0.02, 0.05] |
    fixed.critical_distance: found [0.02, 0.05] (not a number); allowed: a positive length in mm; several
    values under [axes]
friction = 0.5 | friction = 0.5\ndepth = 1e-3 |
    fixed.depth, axes.normal_force: found both; allowed: one of the two: it says how deep
friction = 0.5 | friction = 0 | axes.tangential_amplitude: found 0.001 mm at radius = 50 mm
friction = 0.5 | friction = 0.5\nbody = 1.5 | fixed.body: found [1.5]; allowed: 1 or 2
friction = 0.5 | friction = 0.5\nsimilar = -1 | fixed.similar: found -1; allowed: a number ≥ 0
friction = 0.5 | friction = 0.5\nbulk_stress_mean = 1\nbulk_stress_ratio = 0 |
    fixed.bulk_stress_mean, fixed.bulk_stress_ratio: found both; allowed: one of the two
friction = 0.5 | friction = 0.5\nbulk_stress_ratio = -1 |
    fixed.bulk_stress_amplitude: found nothing; allowed: a stress, which bulk_stress_ratio needs
friction = 0.5 | friction = 0.5\nprofile = "wavy_paraboloid"\nwaviness_amplitude = 1e-3\nwavelength = 0.05 |
    fixed.wavelength: found 0.05 mm at radius = 50 mm, normal_force = 150 N, waviness_amplitude =
friction = 0.5 | friction = 0.5\nprofile = "rounded_punch"\nflat_radius = 60 |
    fixed.flat_radius: found 60 mm at radius = 50 mm, normal_force = 150 N; 1 more like it; allowed:
critical_distance = 0.05 | critical_distance = 60 |
    fixed.critical_distance: found 60 mm at radius = 50 mm, normal_force = 150 N, 116.3 a_H; allowed: at most
    5.157 mm, 10 a_H
critical_distance = 0.05 |  |
    figure.y: found 'SWT_volume'; allowed: in a study with a critical_distance; or s,
y = ["SWT", "cycles" | y = ["SWTs", "cycles" |
    figure.y: found 'SWTs' (not a quantity); allowed: did you mean SWT?
[150, 200] | [150, 200]\nsimilar = [0.3, 0.4] | axes.similar: found an axis; allowed: one for all points
[150, 200] | [150, -200] | axes.normal_force[1]: found -200 (out of range); allowed: a positive force in N
""".strip()
    .replace("\n    ", " ")
    .splitlines()
]


@pytest.mark.filterwarnings("ignore:material.strength 927 over young_modulus 3000 is")
@pytest.mark.parametrize(("line", "instead", "words"), MISTAKES)
def test_mistakes_are_said_in_the_users_quantity_and_unit(line, instead, words):
    assert line in STUDY
    (found,) = str(refused("", Study.from_text, STUDY.replace(line, instead, 1), "mine.toml")).splitlines()
    assert found.startswith(f"mine.toml: {words}")


def test_all_mistakes_are_said_at_once():
    wrong = STUDY
    for line, instead, _ in (MISTAKES[3], MISTAKES[6], MISTAKES[17], MISTAKES[-1]):
        wrong = wrong.replace(line, instead, 1)
    keys = ["axes.normal_force[1]", "fixed.critical_distance", "fixed.radius", "material.strength"]
    error = refused("", Study.from_text, wrong, "mine.toml")
    assert sorted(mistake.key for mistake in error.mistakes) == keys


def test_constants_of_a_material_need_units():
    text = 'title = "t"\n[material]\nstrength = 1\n'
    refused(r"material: found constants without \[units\]", Study.from_text, text)


@pytest.mark.parametrize(
    ("fixed", "keys"),
    [
        ("", ["fixed.normal_amplitude", "fixed.tangential_amplitude"]),
        ('tangential_force_amplitude = "x"', ["fixed.normal_amplitude", "fixed.tangential_force_amplitude"]),
        ('profile = "cylinder"', ["fixed.normal_force_amplitude, fixed.tangential_force_amplitude"]),
    ],
)
def test_an_amplitude_of_a_loop_beside_sines_is_asked_for_once(fixed, keys):
    text = f"""title = "t"
[loads.up]
vertices = [[0.1, 1], [0, -1]]
[axes]
load = ["harmonic", "up"]
{UNITS}[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
normal_force = 200
{fixed}
"""
    assert sorted(mistake.key for mistake in refused("", Study.from_text, text).mistakes) == keys


def test_an_unknown_unit_does_not_hide_that_units_are_inconsistent():
    wrong = STUDY.replace('length = "mm"', 'length = "m"\nmass = "kg"', 1)
    error = refused("", Study.from_text, wrong)
    assert [mistake.key for mistake in error.mistakes] == ["units.mass", "units"]


@pytest.mark.parametrize("label", ["rad", "1", " "])
def test_what_is_no_unit_of_stress_is_none(label: str) -> None:
    with pytest.raises(StudyError, match=f"units.stress: found '{label}'; allowed: the name of a unit"):
        Study.from_text(STUDY.replace('stress = "MPa"', f'stress = "{label}"'))


@pytest.mark.filterwarnings("ignore:critical_distance = 7.958e")
def test_a_critical_distance_far_beyond_the_contact_is_refused_wherever_it_comes_from():
    thresholds = "threshold_stress_intensity_range = 5e5\nfatigue_limit_range = 100\n[fixed]"
    text = STUDY.replace("critical_distance = 0.05\n", "").replace("[fixed]", thresholds)
    with pytest.raises(StudyError, match=r"material.critical_distance: found 7.95775e\+06 mm at radius"):
        Study.from_text(text.replace(', "SWT_volume"', ""))
    contact = physical(**RIG, normal_force=200, tangential_amplitude=1e-3)
    with pytest.raises(StudyError, match=r"^critical_distance: found 60 at radius = 50, .* a_H; allowed: at"):
        contact.solve(critical_distance=[0.05, 60])


@pytest.mark.parametrize(
    ("kind", "label", "meant"),
    [
        ("length", "cm2", "cm"),
        ("length", "milimeter", "mm"),
        ("length", "MPa", "m or cm or mm"),
        ("force", "Newton", "N"),
        ("force", "mn", "MN or mN"),
        ("stress", "Mpa", "MPa"),
        ("stress", "megapascals", "MPa"),
    ],
)
def test_a_unit_that_is_nearly_known_is_asked_about(kind: str, label: str, meant: str) -> None:
    known = {"length": "mm", "force": "N", "stress": "MPa"}[kind]
    text = STUDY.replace(f'{kind} = "{known}"', f'{kind} = "{label}"')
    expected = f"^mine.toml: units.{kind}: found '{label}'; allowed: did you mean {meant}"
    assert len(refused(expected, Study.from_text, text, "mine.toml").mistakes) == 1


def test_a_unit_of_the_user_is_taken_as_it_is() -> None:
    study = Study.from_text(STUDY.replace('length = "mm"', 'length = "furlong"'))
    assert study.grid.units.length == "furlong"


def test_constants_that_no_metal_has_are_warned_of() -> None:
    with pytest.warns(UserWarning, match=r"material.ductility 40.9, of metals 0.001 to 5"):
        Study.from_text(STUDY.replace("ductility = 0.409", "ductility = 40.9"))
    soft = RIG | {"young_modulus": 73.1, "normal_force": 0.2, "tangential_force_amplitude": 0.06}
    contact = physical(**soft)
    with pytest.warns(UserWarning, match=r"material.strength 927 over young_modulus 73.1 is 12.7"):
        contact.solve(1e-2, constants=ALUMINIUM)
    # Constants with a modulus in another unit, which would give a life 10¹³ times as long.
    sound = physical(**RIG, normal_force=200.0, tangential_force_amplitude=60.0)
    with pytest.warns(UserWarning, match=r"material.young_modulus 73.1 is 0.001 times the body's 73100"):
        sound.solve(1e-2, constants=replace(ALUMINIUM, young_modulus=73.1))
    findley = contact.with_parameters(criterion="findley", normal_sensitivity=0.3)
    with pytest.raises(StudyError, match="constants: found constants with the criterion findley alone"):
        findley.solve(1e-2, constants=ALUMINIUM)


@pytest.mark.parametrize(
    "life", ["cycles", "FS_cycles", "cycles_volume", "repetitions", "FS_damage_share_line"]
)
def test_a_life_in_a_figure_asks_for_fatigue_constants(life: str) -> None:
    text = f'title = "t"\n[axes]\nphase = [0, 1]\n[figure]\nx = "phase"\ny = "{life}"\n'
    words = (
        rf"figure.y: found '{life}'; allowed: in a study with units and .*fatigue constants \(\[material\], "
    )
    refused(words, Study.from_text, text)
    # With constants, the criterion of this life or its blocks are asked for.
    if life not in ("cycles", "cycles_volume"):
        lacks = 'the criterion "fatemi_socie"' if life.startswith("FS") else "blocks"
        words = rf"figure.y: found '{life}'; allowed: in a study with .*{lacks}"
        refused(words, Study.from_text, STUDY.replace('y = ["SWT", "cycles"', f'y = ["{life}", "cycles"'))


def test_more_contacts_than_can_be_made_are_refused() -> None:
    axes = "[axes]\nradius = { start = 40, stop = 60, num = 600 }\n"
    axes += "young_modulus = { start = 7e4, stop = 8e4, num = 600 }\n"
    text = f'title = "t"\n{UNITS}[fixed]\npoisson_ratio = 0.33\nnormal_force = 150\nfriction = 0.5\n'
    text += f"tangential_amplitude = 1e-3\n{axes}"
    words = (
        "axes.radius, axes.young_modulus: found 360000 different contacts at rest; allowed: at most 300000"
    )
    refused(words, Study.from_text, text)


def test_a_criterion_asks_for_the_stress_that_it_measures_in() -> None:
    own = RIG | {"normal_force": 200.0, "tangential_force_amplitude": 60.0}
    own |= {"criterion": "fatemi_socie", "normal_sensitivity": 1.0}
    words = "yield_strength: found nothing; allowed: a stress: the criterion fatemi_socie measures the normal"
    refused(words, physical, **own)
