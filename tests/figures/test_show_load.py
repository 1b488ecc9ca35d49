"""The picture of a load of a study, and what the command says of its record."""

from pathlib import Path

import numpy as np
import pytest
import real
from command import call

from swtstudy import Study, draw_load, read_signal

RIG = f"""{real.RIG}[loads.rig]
file = "rig.csv"
absolute = true
recorded_cycles = 3
"""
CYCLE = np.array([[200, 0, 0], [220, 60, 30], [205, 20, 10], [190, -57, -30]])


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    noise = np.random.default_rng(1).normal(size=(12, 3))
    rows = [",".join(map(repr, row)) for row in (np.tile(CYCLE, (3, 1)) + 0.1 * noise).tolist()]
    (tmp_path / "rig.csv").write_text("\n".join(["normal,tangential,bulk", *rows]))
    (tmp_path / "rig.toml").write_text(RIG)
    return tmp_path / "rig.toml"


def test_all_panels_begin_where_the_record_does(rig: Path) -> None:
    signal = read_signal(rig.with_name("rig.csv"), absolute=True, recorded_cycles=3)
    figure = draw_load(Study.from_toml(rig), "rig", signal, width="column")
    course, _, margin = figure.axes
    normal, tangential = (line.get_ydata() for line in course.get_lines()[-3:-1])
    np.testing.assert_allclose(normal[:-1], signal.mean_cycle[:, 0], atol=1e-9)
    np.testing.assert_allclose(margin.get_lines()[0].get_ydata(), abs(tangential) / (0.5 * normal), rtol=1e-9)
    # A long title is broken, on a screen too.
    smooth = read_signal(rig.with_name("rig.csv"), absolute=True, recorded_cycles=3, harmonics=1)
    words = draw_load(Study.from_toml(rig), "rig", smooth).get_suptitle()
    assert words.replace("\n", " ") == f"rig: {smooth.words}"
    assert "\n" in words


def test_cycles_that_are_the_same_do_not_scatter(tmp_path: Path) -> None:
    """Means of sevenths have roundings."""
    rows = ["normal,tangential", *(f"{a / 7!r},{b / 7!r}" for a, b, _ in 7 * CYCLE.tolist())]
    (tmp_path / "rig.csv").write_text("\n".join(rows))
    found = read_signal(tmp_path / "rig.csv", absolute=True, recorded_cycles=7)
    assert found.scatter.max() > 0.0
    assert "scatter" not in found.words


def test_the_command_draws_a_load_of_a_study_and_says_how_its_cycles_scatter(rig: Path) -> None:
    picture = rig.with_name("rig.png")
    done = call("show", "--load", "rig", rig, "-o", picture)
    assert done.exit_code == 0, done.output
    assert done.output.startswith("rig: 3 cycles of 4 samples; mean normal load 203.")
    assert "scatter by 0.1" in done.output
    assert picture.stat().st_size > 10_000
    done = call("show", "--load", "rg", rig)
    assert done.exit_code == 2
    assert "did you mean rig" in done.output


def test_a_depth_and_a_force_have_units_each() -> None:
    mixed = "depth = 0.006\ntangential_force_amplitude = 1\nload = "
    text = RIG.replace("load = ", mixed, 1)
    text = text[: text.index("file = ")] + "vertices = [[0, -20], [0, 20]]\n"
    path = draw_load(Study.from_text(text), "rig").axes[1]
    assert (path.get_xlabel(), path.get_ylabel()) == ("normal load (mm)", "tangential load (N)")


@pytest.mark.usefixtures("unwrapped")
@pytest.mark.parametrize("modulus", ["210e3", "[210e3, 206e3]"])
def test_friction_limits_the_load_on_bodies_of_two_moduli(modulus: str) -> None:
    loop = "[loads.rig]\nabsolute = true\nvertices = [[300, -80], [320, 80]]\n"
    figure = draw_load(Study.from_text(real.RIG.replace("73.1e3", modulus) + loop), "rig")
    assert figure.axes[2].get_title(loc="left") == r"friction, at most 0.53 at $\mu$ = 0.5"  # 80/(0.5 · 300)


@pytest.mark.usefixtures("unwrapped")
def test_a_normal_force_at_rest_is_drawn_as_what_it_is() -> None:
    given = "normal_force = 200\ntangential_force_amplitude = 1\n"
    loop = "[loads.rig]\nvertices = [[0, -60], [0, 60]]\n"
    figure = draw_load(Study.from_text(real.RIG + given + loop), "rig")
    course, path, margin = figure.axes
    assert path.get_xlabel() == "normal load (N)"
    np.testing.assert_allclose(course.lines[0].get_ydata(), 200.0)
    assert margin.get_title(loc="left") == r"friction, at most 0.60 at $\mu$ = 0.5"  # 60/(0.5 · 200)
