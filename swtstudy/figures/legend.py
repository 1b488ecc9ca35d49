"""The legend below all panels; the figure grows in height to hold it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from matplotlib.lines import Line2D

from swtstudy.figures.loop_legend import HANDLE, LoopHandler

if TYPE_CHECKING:
    from matplotlib.legend import Legend
    from numpy.typing import NDArray

    from swtstudy.figures.figure import Figure
    from swtstudy.mechanics.load.load_path import LoadPath

_NO_LOOPS: Mapping[str, Any] = MappingProxyType({})
#: Points in an inch.
_POINTS = 72.0


def add_legend(figure: Figure, axes: NDArray[Any], loops: Mapping[str, LoadPath] = _NO_LOOPS) -> None:
    """Add one legend for all panels, lines before markers; no entry is cut off.

    Parameters
    ----------
    figure
        The figure, which grows by the height of the legend. On a screen it gets wider where an entry is wider
        than all panels; in print the letters of the legend get smaller there.
    axes
        Its panels.
    loops
        What lines are about, by their labels, if loops: drawn beside their samples.
    """
    handles: dict[str, Any] = {}
    for one in axes.flat:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    labels = sorted(handles, key=lambda label: handles[label].get_linestyle() == "None")
    if not labels:
        return
    look: dict[str, Any] = {"handler_map": {Line2D: LoopHandler(loops)}, **HANDLE} if loops else {}
    place_legend(figure, [handles[label] for label in labels], labels, look)


def place_legend(
    figure: Figure, handles: list[Any], labels: list[str], look: Mapping[str, Any] = _NO_LOOPS
) -> None:
    """Add a legend of these entries in as many columns as fit; see `add_legend`."""
    size: float | None = None
    for count in (*range(len(labels), 0, -1), 1):
        legend = figure.legend(
            handles, labels, loc="outside lower center", ncols=count, fontsize=size, **look
        )
        width, height = _inches(legend, figure.dpi)
        if width <= figure.get_figwidth() or size is not None:
            break
        if count == 1:
            if figure.width is None:
                break
            size = _size(legend) * figure.get_figwidth() / width
        legend.remove()
    wider = max(figure.get_figwidth(), width) if figure.width is None else figure.get_figwidth()
    figure.set_size_inches(wider, figure.get_figheight() + height)


def _size(legend: Legend) -> float:
    return float(legend.get_texts()[0].get_fontsize())


def _inches(legend: Legend, dpi: float) -> tuple[float, float]:
    """Width and height of a legend with its padding, inches."""
    around = 2.0 * legend.borderaxespad * _size(legend) / _POINTS
    box = legend.get_window_extent()
    return box.width / dpi + around, box.height / dpi + around
