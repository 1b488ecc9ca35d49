"""Labels of contours are whole, on their level, and cover neither one another nor other lines."""

from itertools import combinations

import pytest
from folders import RESULTS
from matplotlib.backends.backend_agg import FigureCanvasAgg

import swtstudy


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
