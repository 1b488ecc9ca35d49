"""The legend below all panels, for which the figure grows in height, with small drawings of loops.

A name such as "L" says less than the loop itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerLine2D
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from swtstudy.figures.style import stroke
from swtstudy.loads.loop import Loop

if TYPE_CHECKING:
    from swtstudy.figures.sheet import Figure

#: Length and height of a handle with a loop, in em.
HANDLE = {"handlelength": 4.6, "handleheight": 1.9, "labelspacing": 0.7}
#: Share of its length that the sample of the line has.
_SAMPLE = 0.52


class LoopHandler(HandlerLine2D):
    """A line's sample, and beside it the loop that the line is about: tangential across, normal upwards."""

    def __init__(self, loops: Mapping[str, Loop]) -> None:
        super().__init__()
        self._loops = loops

    def create_artists(
        self,
        legend: Legend,
        orig_handle: Artist,
        xdescent: float,
        ydescent: float,
        width: float,
        height: float,
        fontsize: float,
        trans: Any,
    ) -> list[Artist]:
        sample = width * _SAMPLE
        artists = super().create_artists(
            legend, orig_handle, xdescent, ydescent, sample, height, fontsize, trans
        )
        loop = self._loops.get(str(orig_handle.get_label()))
        if loop is None or not isinstance(orig_handle, Line2D):
            return [*artists]
        normal, tangential = loop.course().T[:2]
        side = 0.85 * height
        left, bottom = width - side - xdescent, -ydescent + 0.5 * (height - side)
        x, y = left + side * _unit(tangential), bottom + side * _unit(normal)
        look = stroke(orig_handle.get_color(), linewidth=1.0)
        return [*artists, Line2D(x, y, transform=trans, **look)]


def _unit(values: np.ndarray) -> np.ndarray:
    """From 0 to 1; in the middle where they are all the same."""
    spread = float(np.ptp(values))
    return (values - values.min()) / spread if spread else np.full(len(values), 0.5)


def loops_of(dataset: xr.Dataset) -> dict[str, Loop]:
    """The loops among the loads of results, by the words of their lines."""
    from swtstudy.archive.attributes import defined_in

    loads = defined_in(dataset.attrs).get("load", {})
    return {name.replace("_", " "): load for name, load in loads.items() if isinstance(load, Loop)}


_NO_LOOPS: Mapping[str, Any] = MappingProxyType({})
#: Points in an inch.
_POINTS = 72.0


def add_legend(figure: Figure, axes: NDArray[Any], loops: Mapping[str, Loop] = _NO_LOOPS) -> None:
    """Add one legend for all panels, lines before bands beneath them and markers; no entry is cut off.

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
    handles: dict[str, Line2D] = {}
    for one in axes.flat:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    labels = sorted(handles, key=lambda label: _rank(handles[label]))
    if not labels:
        return
    look: dict[str, Any] = {"handler_map": {Line2D: LoopHandler(loops)}, **HANDLE} if loops else {}
    place_legend(figure, [handles[label] for label in labels], labels, look)


def _rank(handle: Line2D) -> tuple[bool, bool]:
    return handle.get_linestyle() == "None", handle.get_zorder() < Line2D.zorder


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
