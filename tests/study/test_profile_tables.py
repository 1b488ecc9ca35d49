"""Tables of profiles from study files to archives and back, and in calls from Python."""

import json
from pathlib import Path

import numpy as np
import pytest
import stand_in
from command import merged
from told import RIG, refused

import swtstudy

R = np.linspace(0.0, 2.0, 60)
BLUNT = 0.3 * R**2 + 0.1 * R**4

STUDY = """
title = "Two profiles"
rtol = 1e-3

[profiles.worn]
file = "tables/worn.csv"

[profiles.rough]
file = "tables/rough.csv"
smoothing = 2e-3

[axes]
profile = ["worn", "paraboloid", "rough"]
friction = [0.3, 0.6]
"""


def write(path: Path, radius: np.ndarray, height: np.ndarray) -> None:
    path.parent.mkdir(exist_ok=True)
    rows = "\n".join(f"{r!r}, {h!r}" for r, h in zip(radius.tolist(), height.tolist(), strict=True))
    path.write_text(f"radius, height\n{rows}\n", encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path / "tables" / "worn.csv", R, BLUNT)
    noise = 2e-3 * np.random.default_rng(0).standard_normal(R.size) * (R > 0.0)
    write(tmp_path / "tables" / "rough.csv", R, 0.5 * R**2 + noise)
    (tmp_path / "pads.toml").write_text(STUDY, encoding="utf-8")
    return tmp_path


@pytest.mark.slow
def test_tables_of_a_study_go_to_workers_and_into_the_archive(folder: Path) -> None:
    study = swtstudy.Study.from_toml(folder / "pads.toml")
    dataset = swtstudy.run(study, folder / "pads.nc", workers=2)
    assert dataset.profile.values.tolist() == ["worn", "paraboloid", "rough"]
    worn = swtstudy.TabulatedProfile("another name", R, BLUNT)
    expected = swtstudy.solve(profile=[worn, "paraboloid"], friction=[0.3, 0.6], rtol=1e-3)
    np.testing.assert_allclose(dataset.s[:2], expected.s, rtol=1e-12)
    assert np.all(np.abs(dataset.s[2] / dataset.s[1] - 1.0) < 0.1)
    # The file has all that it takes to compute it again.
    again = swtstudy.open_results(folder / "pads.nc")
    text = merged(folder / "pads.nc").attrs["study"]
    grid = swtstudy.Study.from_text(text).grid
    assert [str(value) for value in grid.values("profile")] == ["worn", "paraboloid", "rough"]
    np.testing.assert_array_equal(grid.values("profile")[0].height, BLUNT)
    defined = json.loads(again.attrs["definitions"])
    assert [each["name"] for each in defined] == ["worn", "rough"]
    assert defined[0]["deviation"] < 1e-14
    assert 1e-3 < defined[1]["deviation"] < 1e-2
    once_more = swtstudy.run(swtstudy.Study.from_text(text), folder / "pads.nc", solver=stand_in.none)
    np.testing.assert_array_equal(once_more.s, dataset.s)


def test_a_table_with_another_content_is_another_profile(folder: Path) -> None:
    study = swtstudy.Study.from_toml(folder / "pads.toml")
    swtstudy.run(study, folder / "pads.nc", workers=1, solver=stand_in.smooth)
    write(folder / "tables" / "worn.csv", R, np.append(BLUNT[:-1], BLUNT[-1] + 1e-9))
    anew = stand_in.Counting()
    swtstudy.run(swtstudy.Study.from_toml(folder / "pads.toml"), folder / "pads.nc", workers=1, solver=anew)
    assert anew.points == study.grid.size - 4
    one, other = (swtstudy.TabulatedProfile("a", R, height) for height in (BLUNT, 2.0 * BLUNT))
    assert one != other
    assert one.code != other.code
    assert one.code == swtstudy.TabulatedProfile("b", R, BLUNT).code != one.scaled(1.0, 2.0).code
    s = swtstudy.solve(profile=[one, swtstudy.TabulatedProfile("b", R, BLUNT)], rtol=1e-3).s.values
    assert s[0] == s[1]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"tables/worn.csv"', '"none.csv"', "profiles.worn: found no such file in the folder"),
        ('file = "tables/worn.csv"', "smoothing = 1e-4", "profiles.worn: found nothing; allowed: a table"),
        ("smoothing = 2e-3", "smoothing = -1", "profiles.rough: found -1"),
        ("smoothing = 2e-3", "", "rough touches in several places: its fit is wavy at the radius"),
        ("smoothing = 2e-3", "smooth = 2e-3", "profiles.rough.smooth: found unknown key 'smooth'"),
        (
            '["worn"',
            '["wron"',
            "axes.profile[0]: found 'wron' (no such profile); allowed: did you mean worn?",
        ),
        (
            "friction =",
            "normal_amplitude = [6.5, 7]\nfriction =",
            "the depth 8 is beyond the table of worn, which ends at the radius 2",
        ),
        ("[axes]", "[axes]\nexponent = [3]", "which no profile here has (worn, paraboloid, rough)"),
    ],
)
def test_mistakes_in_a_study(folder: Path, old: str, new: str, message: str) -> None:
    (folder / "pads.toml").write_text(STUDY.replace(old, new), encoding="utf-8")
    assert message in str(refused("", swtstudy.Study.from_toml, folder / "pads.toml"))


def test_stress_beneath_a_table_is_that_beneath_the_closed_form() -> None:
    place, load = (0.4, -0.7, 0.6), {"phase": 1.0, "time": [0.0, 2.0, 4.0]}
    cubic = swtstudy.TabulatedProfile("cubic", R, R**3 * 4.0 / (3.0 * np.pi))
    found = swtstudy.stress_field(*place, profile=cubic, **load)
    expected = swtstudy.stress_field(*place, profile="power_law", exponent=3, **load)
    for name in ("sigma_xx", "sigma_zz", "sigma_xz", "sigma_yz"):
        np.testing.assert_allclose(found[name], expected[name], rtol=0.0, atol=2e-6)


def test_a_table_under_prescribed_forces() -> None:
    load = {"normal_force_amplitude": 0.5, "tangential_force_amplitude": 0.35, "phase": 1.1, "friction": 0.5}
    square = swtstudy.TabulatedProfile("square", R, 0.5 * R**2)
    found, expected = (
        swtstudy.solve(profile=profile, rtol=1e-6, **load).s.item() for profile in (square, "paraboloid")
    )
    assert found == pytest.approx(expected, rel=1e-7)


PAD = RIG | {"radius": None, "tangential_amplitude": 0.002, "normal_amplitude": 1e-4}


def test_a_real_contact_of_a_table() -> None:
    """A paraboloid of R = 50, once in closed form and once as a table of lengths."""
    r = np.linspace(0.0, 1.5, 40)
    pad = swtstudy.TabulatedProfile("pad", r, r**2 / 100.0)
    for load in ({"normal_force": 200.0}, {"depth": 0.006}):
        table = swtstudy.physical(profile=pad, **load, **PAD)
        closed = swtstudy.physical(**load, **PAD | {"radius": 50.0})
        for name in ("depth", "normal_force", "contact_radius", "mean_pressure", "peak_pressure"):
            assert getattr(table, name) == pytest.approx(getattr(closed, name), rel=1e-8)
        assert table.length_scale == pytest.approx(closed.length_scale, rel=1e-8)
        np.testing.assert_allclose(table.solve().SWT, closed.solve().SWT, rtol=1e-6)
    harder = table.with_parameters(friction=0.7)
    assert harder.profile is pad
    assert harder.friction == 0.7


def test_a_wrong_plane_profile_makes_no_mistake_of_its_length(tmp_path):
    (tmp_path / "pad.csv").write_text("a,b\n0,0\n1,1\n")
    text = f"""title = "A pad"
[units]
length = "mm"
force = "N"
stress = "MPa"
[profiles.pad]
file = "pad.csv"
geometry = "plane"
[fixed]
profile = "pad"
contact_length = 8
{"".join(f"{name} = {value}" + chr(10) for name, value in RIG.items() if name != "radius")}
normal_force = 2400
tangential_force_amplitude = 600
"""
    with pytest.raises(swtstudy.StudyError) as raised:
        swtstudy.Study.from_text(text, "s", tmp_path)
    assert {each.key for each in raised.value.mistakes} == {"profiles.pad"}
