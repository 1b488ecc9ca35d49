"""A study with several mistakes is refused once, with all of them."""

from pathlib import Path

import pytest

from swtstudy import Study, StudyError

WRONG = """
rtol = 5
[units]
length = "mm"
force = "N"
stress = "MPa"
[fixed]
friction = -1
young_modulus = 210e3
poisson_ratio = 0.3
radius = 50
normal_force = 200
depth = 0.1
[axes]
phase = [0, 0]
"""


def test_each_mistake_has_its_file_its_keys_the_value_and_a_way_out(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(WRONG)
    with pytest.raises(StudyError) as caught:
        Study.from_toml(path)
    assert str(caught.value).splitlines() == [
        f"{path}: {words}"
        for words in (
            "rtol: found 5; allowed: a number in [1e-07, 0.1]",
            "title: found nothing; allowed: a text that is not empty",
            "fixed.friction: found -1 (out of range); allowed: a number in [0, 10]",
            "axes.phase[1]: found 0, the same as axes.phase[0]; allowed: distinct values",
            "fixed.depth, fixed.normal_force: found both; allowed: one of the two: it says how deep the "
            "contact is",
            "fixed.tangential_amplitude: found nothing; allowed: a length in mm, ≥ 0; or "
            "tangential_force_amplitude",
        )
    ]
    assert [str(each) for each in caught.value.mistakes] == str(caught.value).splitlines()
