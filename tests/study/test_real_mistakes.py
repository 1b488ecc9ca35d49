"""Studies in units of the user's own: what is wrong in them."""

from dataclasses import replace

import pytest
from real import ALUMINIUM, STUDY
from told import RIG, refused

from swtstudy import Study, StudyError, physical


@pytest.mark.filterwarnings("ignore:critical_distance = 7.958e")
def test_a_critical_distance_far_beyond_the_contact_is_refused_wherever_it_comes_from():
    thresholds = "threshold_stress_intensity_range = 5e5\nfatigue_limit_range = 100\n[fixed]"
    text = STUDY.replace("critical_distance = 0.05\n", "").replace("[fixed]", thresholds)
    with pytest.raises(StudyError, match=r"material.critical_distance: found 7.95775e\+06 mm at radius"):
        Study.from_text(text.replace(', "SWT_volume"', ""))
    contact = physical(**RIG, normal_force=200, tangential_amplitude=1e-3)
    with pytest.raises(StudyError, match=r"^critical_distance: found 60 at radius = 50, .* a_H; allowed: at"):
        contact.solve(critical_distance=[0.05, 60])


def test_constants_that_no_metal_has_are_warned_of() -> None:
    soft = RIG | {"young_modulus": 73.1, "normal_force": 0.2, "tangential_force_amplitude": 0.06}
    contact = physical(**soft)
    with pytest.warns(UserWarning, match=r"^strength 927 over young_modulus 73.1 is 12.7"):
        contact.solve(1e-2, constants=ALUMINIUM)
    # Constants with a modulus in another unit, which would give a life 10¹³ times as long.
    sound = physical(**RIG, normal_force=200.0, tangential_force_amplitude=60.0)
    with pytest.warns(UserWarning, match=r"^young_modulus 73.1 is 0.001 times the body's 73100"):
        sound.solve(1e-2, constants=replace(ALUMINIUM, young_modulus=73.1))
    findley = contact.with_parameters(criterion="findley", normal_sensitivity=0.3)
    with pytest.raises(StudyError, match="constants: found constants with the criterion findley alone"):
        findley.solve(1e-2, constants=ALUMINIUM)


@pytest.mark.parametrize(
    ("key", "other", "letter"),
    [
        ("strength", "fatigue_strength_coefficient", "fatigue strength coefficient"),
        ("ductility", "epsilon_f'", "ε_f"),
        ("strength_exponent", "b", "b"),
        ("ductility_exponent", "c", "c"),
    ],
)
def test_a_constant_has_one_message_whatever_others_call_it(key: str, other: str, letter: str):
    with pytest.raises(StudyError) as raised:
        Study.from_text(STUDY.replace(f"\n{key} =", f'\n"{other}" ='))
    (mistake,) = raised.value.mistakes
    assert mistake.allowed.startswith(f"did you mean {key} ({letter})?")


def test_a_property_of_a_material_among_the_fixed_values_is_told_its_table():
    text = STUDY.replace("[fixed]", "[fixed]\nyield_strength = 300")
    words = r"fixed.yield_strength: found a property of a material; allowed: this under \[material\]$"
    assert len(refused(words, Study.from_text, text).mistakes) == 1
