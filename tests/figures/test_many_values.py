"""Figures of many values: panels wrap, patches differ, an axis is at one value, units follow decimals."""

from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
import stand_in
from command import call
from matplotlib.text import Text

import swtstudy
from swtstudy import Study

SAMPLE = """
title = "t"
[sample]
design = "sobol"
size = 16
[sample.ranges]
normal_amplitude = [0, 0.9]
[axes]
friction = { start = 0.1, stop = 1, num = 10 }
[figure]
kind = "histogram"
x = "sample"
hue = "friction"
"""
TWO = """
title = "t"
[axes]
phase = [0, 1]
friction = [0.3, 0.6]
[figure]
x = "phase"
hue = "friction"
"""


@pytest.mark.usefixtures("unwrapped")
def test_no_two_patches_of_a_legend_are_alike(tmp_path: Path) -> None:
    figure = swtstudy.run(Study.from_text(SAMPLE), tmp_path / "h.nc", solver=stand_in.smooth).swt.figure()
    (legend,) = figure.legends
    looks = [(each.get_facecolor(), each.get_hatch()) for each in legend.get_patches()]
    assert len(looks) == 10
    assert all(one != other for one, other in combinations(looks, 2))
    # In grey the hatches differ between those side by side.
    assert all(one[1] != other[1] for one, other in pairwise(looks))
    words = [text.get_text() for text in legend.get_texts()]
    assert words[:3] == ["5 % lie below", "50 % lie below", "95 % lie below"]
    assert all("50 %: " in each for each in words[3:])


@pytest.mark.usefixtures("unwrapped")
def test_points_of_many_values_share_a_scale_of_colours(tmp_path: Path) -> None:
    cloud = Study.from_text(SAMPLE.replace("histogram", "scatter"))
    figure = swtstudy.run(cloud, tmp_path / "c.nc", solver=stand_in.smooth).swt.figure()
    assert not figure.legends
    assert figure.axes[-1].get_ylabel() == r"$\mu$"


def test_an_axis_may_be_drawn_at_one_value(tmp_path: Path) -> None:
    swtstudy.run(Study.from_text(TWO), tmp_path / "two.nc", solver=stand_in.smooth)
    archive, target = str(tmp_path / "two.nc"), tmp_path / "two.png"
    done = call("plot", archive, "--x", "phase", "-o", target)
    assert done.exit_code == 2
    assert "no place for the axis friction; allowed: " in done.stderr
    assert done.stderr.rstrip().endswith("with a single value, such as by --at friction=…")
    twice = call("plot", archive, "--at", "friction=0.6", "--at", "friction=0.5")
    assert twice.stderr == "Error: --at: found friction twice; allowed: one value of each\n"
    at = ["--x", "phase", "--at", "friction=0.6"]
    assert call("plot", archive, *at, "-o", target).exit_code == 0
    assert target.stat().st_size > 0
    done = call("plot", archive, "--at", "friction=0.5")
    assert "friction: found '0.5', which is not in these results; allowed: 0.3, 0.6" in done.stderr
    done = call("plot", archive, "--x", "friction", "--at", "phase=90")
    assert 'allowed: 0, 1 rad; for degrees write "90 deg"' in done.stderr
    assert "degrees" not in call("plot", archive, "--x", "friction", "--at", "phase=pi/2").stderr
    done = call("plot", archive, "--at", "friction")
    assert "--at: found 'friction'; allowed: an axis and a value, such as friction=0.6" in done.stderr


def test_the_value_of_an_axis_is_the_title(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    swtstudy.run(Study.from_text(TWO), tmp_path / "two.nc", solver=stand_in.smooth)
    drawn = []
    monkeypatch.setattr("swtstudy.figures.style.save_figure", lambda figure, *_: drawn.append(figure))
    for more in ([], ["--title", "Mine"]):
        call("plot", tmp_path / "two.nc", "--at", "friction=0.6", *more)
    assert [figure.get_suptitle() for figure in drawn] == [r"$\mu$ = 0.6", "Mine"]
    assert not any(figure.legends for figure in drawn)  # of one line


@pytest.mark.usefixtures("unwrapped")
def test_forces_and_lengths_are_decimals() -> None:
    contact = swtstudy.physical(
        young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, friction=0.5,
        normal_force=list(np.linspace(2600 / 9, 400, 3)), tangential_force_amplitude=[10.0, 20.0, 100 / 3],
    )  # fmt: skip
    found = contact.solve(1e-2).isel(body=0)
    figure = found.swt.panels("normal_force", "tangential_force_amplitude")
    (legend,) = figure.legends
    assert [text.get_text().partition(" = ")[2] for text in legend.get_texts()] == ["10", "20", "33.33"]
    heat = found.swt.panels("normal_force", kind="heatmap", vertical="tangential_force_amplitude")
    heat.draw_without_rendering()
    words = {text.get_text() for text in heat.axes[0].findobj(Text)}
    assert {"288.9", "33.33"} <= words
    assert not any("/9" in each for each in words)
