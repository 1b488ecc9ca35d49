"""Labels of contours are whole, on their level, and cover neither one another nor other lines."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from folders import RESULTS
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.contour_labels import places_of_labels


@pytest.mark.quick(2)
@pytest.mark.parametrize("width", [None, "column", pytest.param("page", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", ["contour", "bulk_stress", "fretting_map"])
def test_labels_of_maps_are_whole_and_apart(name: str, width: str | None) -> None:
    figure = swtstudy.open_results(RESULTS / f"{name}.nc").swt.figure(width=width)
    FigureCanvasAgg(figure).draw()
    axes = figure.axes[0]
    panel = axes.get_window_extent()
    labels = [text for text in axes.texts if any(sign.isdigit() for sign in text.get_text())]
    boxes = [text.get_window_extent() for text in labels]
    assert len(boxes) > 2
    for box in boxes:
        assert panel.x0 <= box.x0 <= box.x1 <= panel.x1
        assert panel.y0 <= box.y0 <= box.y1 <= panel.y1
    assert not [pair for pair in combinations(boxes, 2) if pair[0].overlaps(pair[1])]


def drawn(line: bool = False) -> tuple[Figure, list[tuple[float, float]]]:
    """Circles about (0.5, 0.5) in a panel, and where their labels go."""
    figure = Figure()
    axes = figure.subplots()
    x, y = np.meshgrid(np.linspace(0.0, 1.0, 101), np.linspace(0.0, 1.0, 101))
    radius = np.hypot(x - 0.5, y - 0.5)
    lines = axes.contour(x, y, radius, levels=[0.03, 0.2, 0.4, 0.65])
    if line:
        axes.plot([0.1, 0.1, 0.9, 0.9], [0.9, 0.1, 0.1, 0.9])
    return figure, places_of_labels(axes, lines, [0.03, 0.4, 0.65])


def test_a_label_lies_on_its_contour_where_that_is_long_enough() -> None:
    _, places = drawn()
    radii = np.hypot(*(np.array(places) - 0.5).T)
    # The least circle is shorter than a label, and 0.65 is so long in none of the four corners.
    np.testing.assert_allclose(radii, 0.4, atol=1e-3)
    assert len(radii) == 1


def test_a_label_keeps_away_from_lines() -> None:
    _, (free,) = drawn()
    _, (beside,) = drawn(line=True)
    x, y = beside
    assert min(abs(x - 0.1), abs(x - 0.9), abs(y - 0.1)) >= 0.05
    assert y > 0.5  # the upper side has no line
    assert beside != free


def test_a_contour_beneath_a_line_has_no_label() -> None:
    axes = Figure().subplots()
    x, y = np.meshgrid(np.linspace(0.0, 1.0, 51), np.linspace(0.0, 1.0, 51))
    lines = axes.contour(x, y, x, levels=[0.3, 0.7])
    axes.plot([0.3, 0.3], [0.0, 1.0])
    ((place, _),) = places_of_labels(axes, lines, [0.3, 0.7])
    assert place == pytest.approx(0.7)


def test_labels_of_crowded_contours_keep_apart() -> None:
    axes = Figure().subplots()
    x, y = np.meshgrid(np.linspace(0.0, 1.0, 51), np.linspace(0.0, 1.0, 51))
    levels = np.linspace(0.2, 0.8, 61)
    places = np.array(places_of_labels(axes, axes.contour(x, y, x, levels=levels), levels))
    assert 8 < len(places) < len(levels)
    assert min(np.hypot(*(a - b)) for a, b in combinations(places, 2)) > 0.16
