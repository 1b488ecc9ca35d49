"""Figures for print: as wide as asked, nothing cut off, nothing over anything else."""

from itertools import pairwise

import matplotlib
import numpy as np
import pytest
from command import call
from made_up import PANELS, made_up
from matplotlib.transforms import Bbox
from words import PROFILES

import swtstudy
from swtstudy.figures.sheet import new_figure, wrap_texts

CM = 2.54
WIDTHS = {"column": 8.5 / CM, "page": 17.5 / CM}
#: What fits into a column has more room on a page.
EACH_WIDTH = ["column", pytest.param("page", marks=pytest.mark.slow)]
PHASE = np.linspace(0.0, 2.0 * np.pi, 25)
LONG = "One quantity over another, with a title that is longer than any column with $s = a$ is wide in print"

FIGURES = {
    "lines": (
        {"phase": PHASE, "friction": np.linspace(0.1, 0.7, 7)},
        {"x": "phase", "hue": "friction", "title": LONG},
    ),
    "panels": (
        {"phase": PHASE, "friction": [0.1, 0.2], "normal_amplitude": [0.25, 0.5, 0.75, 0.9]},
        {"x": "phase", "hue": "friction", "panels": "normal_amplitude", "y": ["s", "critical_angle"]},
    ),
    "names": (
        {"phase": PHASE, "profile": PROFILES, "tangential_amplitude": [1 / 3, 5 / 6]},
        {"x": "phase", "hue": "profile", "panels": "tangential_amplitude"},
    ),
    "scale": (
        {"phase": PHASE, "friction": np.linspace(0.1, 0.9, 9), "profile": PROFILES},
        {"x": "phase", "hue": "friction", "panels": "profile"},
    ),
    "contours": (
        {"phase": PHASE, "friction": np.linspace(0.1, 0.9, 9), "normal_amplitude": [0.25, 0.5]},
        {"x": "phase", "vertical": "friction", "panels": "normal_amplitude", "kind": "contour"},
    ),
    "cells": (
        {"phase": PHASE, "frequency_ratio": [p / 7 for p in range(1, 20)], "normal_amplitude": [0.25, 0.5]},
        {"x": "phase", "vertical": "frequency_ratio", "panels": "normal_amplitude", "kind": "heatmap"},
    ),
}


def wave(phase, **others):
    """A made-up s that all parameters change, names in their order."""
    return np.sin(phase) + 0.1 * sum(each.copy(data=np.arange(each.size)) for each in others.values())


def drawn(name, width, **more):
    axes, layout = FIGURES[name]
    return made_up(wave, **axes).swt.panels(**layout, width=width, **more)


def assert_printable(figure, width):
    """As wide as asked; every artist on the sheet; texts, legends and panels apart."""
    figure.draw_without_rendering()
    assert figure.get_figwidth() == pytest.approx(WIDTHS[width])
    tight = figure.get_tightbbox()
    assert tight.x0 >= 0.0
    assert tight.y0 >= 0.0
    assert tight.x1 <= figure.get_figwidth()
    assert tight.y1 <= figure.get_figheight()
    panels = [axes.get_tightbbox() for axes in figure.axes]
    for legend in figure.legends:
        box = legend.get_window_extent()
        assert not any(Bbox.intersection(box, panel) for panel in panels)
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            boxes = [text.get_window_extent() for text in axis.get_ticklabels() if text.get_text()]
            visible = [box for box in boxes if box.width and box.height]
            assert not any(Bbox.intersection(a, b) for a, b in pairwise(visible))


@pytest.mark.quick(2)
@pytest.mark.parametrize("width", EACH_WIDTH)
@pytest.mark.parametrize("name", FIGURES)
def test_nothing_is_cut_and_nothing_covered(name, width):
    figure = drawn(name, width)
    assert_printable(figure, width)
    titles = [axes.title.get_window_extent() for axes in figure.axes]
    titles += [axes._left_title.get_window_extent() for axes in figure.axes]
    shown = [box for box in titles if box.width > 1.0]
    for index, box in enumerate(shown):
        assert not any(Bbox.intersection(box, other) for other in shown[index + 1 :])


@pytest.mark.slow
@pytest.mark.parametrize("width", EACH_WIDTH)
def test_a_point_and_a_profile(width):
    assert_printable(swtstudy.inspect(width=width), width)
    assert_printable(swtstudy.draw_profile(profile="rounded_punch", flat_radius=0.5, width=width), width)


def test_a_long_title_has_lines_and_its_formulae_are_whole():
    figure = drawn("lines", "column")
    lines = figure.get_suptitle().splitlines()
    assert len(lines) == 2 + (len(lines) > 2)
    assert " ".join(lines) == LONG
    assert all(line.count("$") % 2 == 0 for line in lines)


def test_a_value_stays_with_its_unit():
    figure = new_figure((2.0, 2.0), "column")
    figure.subplots()
    figure.suptitle(r"$F_0$ = 1200 N,  $u_A$ = 0.003 mm,  $\psi$ = π/2")
    wrap_texts(figure)
    lines = figure.get_suptitle().splitlines()
    assert len(lines) > 1
    assert not any(line.startswith(("N", "mm", "=", ",")) for line in lines)


@pytest.mark.slow
def test_letters_of_print_unless_the_user_wants_others():
    def size(**more):
        return drawn("lines", "column", **more).axes[0].xaxis.label.get_fontsize()

    assert size() == 8.0
    assert size(style={"font.size": 6.0}) == 6.0
    with matplotlib.rc_context({"font.size": 9.5}):
        assert size() == 9.5
    assert drawn("lines", None).axes[0].xaxis.label.get_fontsize() == 10.0


@pytest.mark.slow
def test_commands(tmp_path):
    (tmp_path / "panels.toml").write_text(PANELS, encoding="utf-8")
    assert call("run", tmp_path / "panels.toml", "--results", tmp_path, "--width", "page").exit_code == 0
    archive = tmp_path / "panels.nc"
    for command in (
        ("plot", archive, "-o", tmp_path / "panels.png", "--width", "column"),
        ("show", "--profile", "paraboloid", "-o", tmp_path / "profile.png", "--width", "column"),
    ):
        assert call(*command).exit_code == 0
        picture = (tmp_path / command[command.index("-o") + 1]).read_bytes()
        assert int.from_bytes(picture[16:20], "big") == pytest.approx(8.5 / CM * 300, abs=1)
