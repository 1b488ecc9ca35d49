"""The outcome of a run in one line, as a run and swtstudy info print it."""

import re
from pathlib import Path

import pytest
from command import call
from real import CONTACT, CRITERIA
from words import number

import swtstudy
from swtstudy.archive.describe import INDENT

SOFT = CONTACT.replace("yield_strength = 350", "yield_strength = 150")
FORCES = "normal_force = 200\ntangential_force_amplitude = {}\n"


def told(tmp_path: Path, text: str) -> list[str]:
    """The lines of a run below that with its points, which swtstudy info has, too."""
    file = tmp_path / "mine.toml"
    file.write_text(text, encoding="utf-8")
    done = call("run", file, "--results", tmp_path, "--workers", 1)
    assert done.exit_code == 0, done.output
    first, *lines = done.stdout.splitlines()
    assert "point" in first
    about = call("info", tmp_path / "mine.nc").stdout.splitlines()
    for sizes in (line[INDENT:] for line in about if line.startswith("  at rest")):
        assert lines.pop() == f"Contact at rest: {sizes}."
        assert f"contact at rest: {sizes}" in " ".join(call("validate", file).stdout.split())
    assert [line.strip() for line in about[1 : 1 + len(lines)]] == lines
    return lines


def test_a_contact_has_its_value_its_place_and_its_lives(tmp_path: Path) -> None:
    result, outside = told(tmp_path, SOFT + FORCES.format(60) + "critical_distance = 0.01\n")
    dataset = swtstudy.open_results(tmp_path / "mine.nc")
    words = (
        r"SWT = (.*) MPa at x = (.*) mm; N = (.*) load cycles \(worst point\), (.*) \(mean over 0.01 mm\)\."
    )
    said = [number(each) for each in re.fullmatch(words, result).groups()]
    found = [float(dataset[each]) for each in ("SWT", "critical_position", "cycles", "cycles_volume")]
    assert said == pytest.approx(found, rel=0.05)
    assert said[:2] == pytest.approx(found[:2], rel=5e-3)
    assert outside.startswith("Outside of the model: ")
    (ratio,) = re.findall(r"; first yield \((.*) of the strength\)\.$", outside)
    assert number(ratio) == pytest.approx(float(dataset.yield_ratio), rel=5e-3)


def test_several_points_have_a_range_with_its_ends(tmp_path: Path) -> None:
    lines = told(tmp_path, SOFT + "normal_force = 200\n[axes]\ntangential_force_amplitude = [20, 60, 150]\n")
    assert "MPa (tangential_force_amplitude = 20 N; x = " in lines[0]
    assert "MPa (tangential_force_amplitude = 60 N; x = " in lines[0]
    assert lines[1].startswith("Outside of the model: no equilibrium at 1 of 3 points; ")
    assert "first yield at " in lines[1]


def test_each_criterion_has_its_own_value_and_life(tmp_path: Path) -> None:
    (result, *_) = told(tmp_path, CRITERIA)
    parts = result.split("; ")
    names = ["SWT", "findley_stress", "FS", "N by SWT", "N by FS"]
    assert [part.partition(" = ")[0] for part in parts] == names


@pytest.mark.parametrize(
    ("axis", "words"), [("0.5", r"s = (\S+) at x/a_H = "), ("[0.5, 0.6]", r"s = (\S+) \(friction")]
)
def test_without_units_it_is_s_and_its_place(tmp_path: Path, axis: str, words: str) -> None:
    table = "axes" if "[" in axis else "fixed"
    (result,) = told(tmp_path, f'title = "t"\nrtol = 1e-3\n[{table}]\nfriction = {axis}\n')
    least = float(swtstudy.open_results(tmp_path / "mine.nc").s.min())
    assert number(re.match(words, result)[1]) == pytest.approx(least, rel=5e-4)


def test_criteria_without_units_are_not_compared() -> None:
    several = {"criterion": ["swt", "findley"], "normal_sensitivity": 0.3, "friction": [0.2, 0.4]}
    lines = repr(swtstudy.solve(rtol=1e-2, **several).swt).splitlines()
    assert lines[1].startswith("  swt: s = ")
    assert "; findley: s = " in lines[1]


def test_what_has_no_value_says_so() -> None:
    lost = swtstudy.solve(normal_force_amplitude=0, tangential_force_amplitude=[1.1, 1.2], rtol=1e-2)
    _, *lines = repr(lost.swt).splitlines()
    assert lines[0] == "  s is finite at no point."
    assert lines[1] == "  Outside of the model: no equilibrium at all 2 points."
