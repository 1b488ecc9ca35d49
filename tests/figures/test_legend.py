"""Legends that are never cut off, and the colour scale of many lines."""

from io import BytesIO

import numpy as np
import pytest
from made_up import made_up
from matplotlib import colormaps
from matplotlib.colors import to_rgba
from matplotlib.transforms import Bbox
from words import PROFILES

PHASE = np.linspace(0, 2, 5)


def lines_over(friction):
    return made_up(lambda phase, friction: friction + np.sin(phase), phase=PHASE, friction=friction)


def of_loops(names):
    return made_up(lambda phase, load: phase, phase=PHASE, load=names)


def assert_whole(figure, entries):
    """All entries of the legend are in the figure as it is saved, and do not cover a panel."""
    figure.savefig(BytesIO(), format="png")
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == entries
    boxes = [text.get_window_extent() for text in legend.get_texts()]
    boxes += [handle.get_window_extent() for handle in legend.legend_handles]
    for box in boxes:
        assert figure.bbox.x0 <= box.x0 <= box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 <= box.y1 <= figure.bbox.y1
        assert not any(Bbox.intersection(box, axes.bbox) for axes in figure.axes)
    assert all(axes.bbox.width > 0.5 * 72 for axes in figure.axes)


@pytest.mark.quick(1)
@pytest.mark.parametrize("size", [5, 10, 24, 40])
def test_no_entry_is_cut_in_any_size_of_letters(size):
    friction = np.arange(1, 8) / 10
    figure = lines_over(friction).swt.panels("phase", "friction", style={"font.size": size})
    assert_whole(figure, [rf"$\mu$ = {value}" for value in friction])


@pytest.mark.slow
def test_any_number_of_entries_fits():
    names = [f"the line number {index}" for index in range(60)]
    figure = of_loops(names).swt.panels("phase", "load")
    assert_whole(figure, names)
    # In several rows rather than far beyond the panels.
    assert figure.get_figwidth() == of_loops(names[:2]).swt.panels("phase", "load").get_figwidth()


def test_an_entry_wider_than_its_panels():
    """On a screen the figure grows; in print the letters get smaller."""
    names = ["a name as long as nobody gives one" * 4, "b"]
    for width in (None, "column"):
        before = of_loops(["a", "b"]).swt.panels("phase", "load", width=width).get_figwidth()
        figure = of_loops(names).swt.panels("phase", "load", width=width)
        assert_whole(figure, names)
        assert (figure.get_figwidth() > before) == (width is None)


def test_names_have_a_legend():
    dataset = made_up(lambda profile, phase: phase + 0.0, profile=PROFILES, phase=PHASE)
    figure = dataset.swt.panels("phase", "profile")
    assert_whole(figure, [name.replace("_", " ") for name in PROFILES])


@pytest.mark.quick(1)
@pytest.mark.parametrize("width", [None, "column", "page"])
def test_panels_stay_as_large_above_a_legend(width):
    dataset = lines_over([0.1, 0.2])
    alone = dataset.isel(friction=0).swt.panels("phase", width=width)
    above = dataset.swt.panels("phase", "friction", width=width)
    for figure in (alone, above):
        figure.savefig(BytesIO(), format="png")
    assert above.get_figheight() > alone.get_figheight()
    assert above.get_figwidth() == alone.get_figwidth()
    for size in ("width", "height"):
        assert getattr(above.axes[0].bbox, size) == pytest.approx(getattr(alone.axes[0].bbox, size), rel=0.03)


@pytest.mark.usefixtures("unwrapped")
@pytest.mark.parametrize(("count", "seen"), [(3, True), (10, True), (11, False)])
def test_a_line_through_few_points_shows_where_they_are(count, seen):
    phase = np.linspace(0.0, 2.0, count)
    dataset = lines_over(np.linspace(0.1, 0.6, 6)).interp(phase=phase)
    lines = dataset.swt.panels("phase", "friction").axes[0].lines
    for line in lines[:5]:
        assert (line.get_marker() in ("", "None")) != seen
    assert [line.get_markevery() == 1 for line in lines] == [seen] * 6
    assert lines[5].get_marker() == "o"  # as of the cycle


def colours_of(friction):
    lines = lines_over(friction).swt.panels("phase", "friction").axes[0].lines
    for line, value in zip(lines, friction, strict=True):
        np.testing.assert_array_equal(line.get_ydata(), value + np.sin(PHASE))
    return np.array([to_rgba(line.get_color()) for line in lines])


@pytest.mark.usefixtures("unwrapped")
def test_a_colour_stands_for_its_value():
    friction = np.array([0.1, 0.2, 0.4, 0.45, 0.5, 0.9, 0.95, 1.0])
    expected = colormaps["cividis"](0.9 * (friction - 0.1) / 0.9)
    np.testing.assert_allclose(colours_of(friction), expected, atol=0.01)
    np.testing.assert_allclose(colours_of(friction[::-1]), expected[::-1], atol=0.01)
    grey = colours_of(friction)[:, :3] @ [0.299, 0.587, 0.114]
    assert (np.diff(grey) > 0).all()
    assert grey[-1] < 0.8  # to be seen on white


@pytest.mark.usefixtures("unwrapped")
def test_colours_of_values_in_equal_ratios_are_evenly_spaced():
    expected = colormaps["cividis"](0.9 * np.linspace(0, 1, 9))
    np.testing.assert_allclose(colours_of(np.geomspace(1e-2, 1e2, 9)), expected, atol=0.01)


@pytest.mark.slow
def test_one_scale_stands_beside_all_panels():
    dataset = made_up(
        lambda phase, friction, poisson_ratio: friction + poisson_ratio * phase,
        phase=PHASE,
        friction=np.linspace(0.1, 1, 10),
        poisson_ratio=[0.2, 0.3],
    )
    figure = dataset.swt.panels("phase", "friction", "poisson_ratio", y=["s", "critical_x"])
    assert len(figure.axes) == 5
    figure.savefig(BytesIO(), format="png")
    assert all(axes.bbox.x1 < figure.axes[4].bbox.x0 for axes in figure.axes[:4])
