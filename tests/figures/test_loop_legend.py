"""A legend of loops draws each beside its name."""

from pathlib import Path

import numpy as np
import pytest
import stand_in
from folders import RESULTS
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

import swtstudy

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


def small_lines(legend: Legend) -> list[Line2D]:
    """What is drawn beside the samples of the lines."""
    return [line for line in legend.findobj(Line2D) if line.get_linewidth() == 1.0]


ROUND = """
title = "Round and square"
rtol = 1e-2
[loads.round]
normal = [[1, 0.2, 0.0]]
tangential = [[1, 1.0, 1.5707963267948966]]
[loads.square]
vertices = [[0.2, 1], [0.2, -1], [-0.2, -1], [-0.2, 1]]
[fixed]
normal_amplitude = 1
tangential_amplitude = 0.5
[axes]
friction = [0.3, 0.6]
load = ["round", "square"]
"""


def test_a_loop_of_harmonics_is_drawn_as_one_of_straight_lines(tmp_path: Path) -> None:
    """A circle, which fills the square."""
    results = swtstudy.run(swtstudy.Study.from_text(ROUND), tmp_path / "round.nc", solver=stand_in.smooth)
    (legend,) = results.swt.panels("friction", hue="load").legends
    drawn, _ = small_lines(legend)
    x, y = (np.asarray(each) for each in (drawn.get_xdata(), drawn.get_ydata()))
    radius = np.hypot(x - 0.5 * (x.max() + x.min()), y - 0.5 * (y.max() + y.min()))
    assert radius == pytest.approx(0.5 * np.ptp(x), rel=1e-3)


def test_loops_at_a_constant_normal_load_are_not_drawn(tmp_path: Path) -> None:
    """They are straight lines, which look like another sample of the line."""
    text = (
        ROUND.replace("[[1, 0.2, 0.0]]", "[[1, 0, 0]]").replace("[0.2, ", "[0, ").replace("[-0.2, ", "[0, ")
    )
    results = swtstudy.run(swtstudy.Study.from_text(text), tmp_path / "flat.nc", solver=stand_in.smooth)
    (legend,) = results.swt.panels("friction", hue="load").legends
    assert [text.get_text() for text in legend.get_texts()] == ["round", "square"]
    assert small_lines(legend) == []


def test_other_legends_are_as_they_were() -> None:
    (legend,) = swtstudy.open_results(RESULTS / "figure3.nc").swt.figure().legends
    assert small_lines(legend) == []
