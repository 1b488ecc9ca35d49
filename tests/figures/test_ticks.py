"""Labels of cells have room, and use it."""

import itertools

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from swtstudy.figures.ticks import tick_cells


@pytest.mark.parametrize("across", [True, False])
@pytest.mark.parametrize("letters", [1, 6, 20])
def test_cells_have_as_many_labels_as_there_is_room_for(letters, across):
    words = [f"{k:0{letters}d}" for k in range(10)] * 6
    figure = Figure(figsize=(5.0, 2.0) if across else (2.0, 5.0))
    axes = figure.add_subplot()
    axes.set(xlim=(-0.5, 59.5), ylim=(-0.5, 59.5))
    axis = axes.xaxis if across else axes.yaxis
    tick_cells(axis, words, 60)
    FigureCanvasAgg(figure).draw()
    boxes = [label.get_window_extent() for label in axis.get_ticklabels() if label.get_text()]
    pairs = itertools.pairwise((box.x0, box.x1) if across else (box.y0, box.y1) for box in boxes)
    gaps = [after[0] - before[1] for before, after in pairs]
    size = max(box.width if across else box.height for box in boxes)
    letter = boxes[0].width / letters
    assert len(boxes) > 1
    # They are half a letter apart at least, and there is no room for twice as many.
    assert min(gaps) > 0.5 * letter
    assert min(gaps) < 1.5 * size + 3.0 * letter or len(boxes) == len(words)
