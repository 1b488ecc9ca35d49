"""A legend of loops draws each beside its name."""

import numpy as np
import pytest
from folders import RESULTS
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

import swtstudy
from swtstudy.figures.legend import loops_of


def small_lines(legend: Legend) -> list[Line2D]:
    """What is drawn beside the samples of the lines."""
    return [line for line in legend.findobj(Line2D) if line.get_linewidth() == 1.0]


def test_each_loop_is_drawn_beside_its_name_in_its_colour() -> None:
    dataset = swtstudy.open_results(RESULTS / "loops.nc")
    figure = dataset.swt.figure()
    (legend,) = figure.legends
    lines = {line.get_label(): line for line in figure.axes[0].lines}
    loops = loops_of(dataset)
    assert [text.get_text() for text in legend.get_texts()] == [*lines] == [*loops]
    drawn = small_lines(legend)
    assert len(drawn) == len(loops)
    for loop, line in zip(loops.values(), drawn, strict=True):
        assert line.get_color() == lines[loop.name].get_color()
        x, y = (np.asarray(each) for each in (line.get_xdata(), line.get_ydata()))
        normal, tangential = loop.vertices.T[:2]
        # Both loads fill their side of the same square.
        assert (x[:-1] - x.min()) / np.ptp(x) == pytest.approx((tangential + 1.0) / 2.0)
        assert (y[:-1] - y.min()) / np.ptp(y) == pytest.approx((normal + 1.0) / 2.0)
        assert np.ptp(x) == pytest.approx(np.ptp(y))
        assert (x[0], y[0]) == (x[-1], y[-1])


def test_other_legends_are_as_they_were() -> None:
    (legend,) = swtstudy.open_results(RESULTS / "figure3.nc").swt.figure().legends
    assert small_lines(legend) == []
