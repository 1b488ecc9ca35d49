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
        side = 0.85 * height
        corner = np.array([width - side - xdescent, -ydescent + 0.5 * (height - side)])
        path = loop.course()[:, 1::-1]  # tangential across
        spread = np.ptp(path, axis=0)
        # A load that rests is in the middle.
        share = np.where(spread > 0.0, (path - path.min(axis=0)) / np.where(spread > 0.0, spread, 1.0), 0.5)
        look = stroke(orig_handle.get_color(), linewidth=1.0)
        return [*artists, Line2D(*(corner + side * share).T, transform=trans, **look)]


def loops_of(dataset: xr.Dataset) -> dict[str, Loop]:
    """The loops among the loads of results, by the words of their lines."""
    from swtstudy.archive.attributes import defined_in

    loads = defined_in(dataset.attrs).get("load", {})
    return {name.replace("_", " "): load for name, load in loads.items() if isinstance(load, Loop)}


_NO_LOOPS: Mapping[str, Any] = MappingProxyType({})


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

    def rank(label: str) -> tuple[bool, bool]:
        handle = handles[label]
        return handle.get_linestyle() == "None", handle.get_zorder() < Line2D.zorder

    labels = sorted(handles, key=rank)
    if labels:
        look: dict[str, Any] = {"handler_map": {Line2D: LoopHandler(loops)}, **HANDLE} if loops else {}
        place_legend(figure, [handles[label] for label in labels], labels, look)


def place_legend(
    figure: Figure, handles: list[Any], labels: list[str], look: Mapping[str, Any] = _NO_LOOPS
) -> None:
    """Add a legend of these entries in as many columns as fit; see `add_legend`."""

    def place(columns: int, size: float | None = None) -> tuple[Legend, float, float]:
        """A legend with its width and height, inches, padding included."""
        made = figure.legend(
            handles, labels, loc="outside lower center", ncols=columns, fontsize=size, **look
        )
        around = 2.0 * made.borderaxespad * float(made.get_texts()[0].get_fontsize()) / 72.0
        box = made.get_window_extent()
        return made, box.width / figure.dpi + around, box.height / figure.dpi + around

    room = figure.get_figwidth()
    for columns in range(len(labels), 0, -1):
        legend, width, height = place(columns)
        if width <= room or columns == 1:
            break
        legend.remove()
    if width > room and figure.width is not None:
        size = float(legend.get_texts()[0].get_fontsize())
        legend.remove()
        legend, width, height = place(1, size * room / width)
    figure.set_size_inches(room if figure.width else max(room, width), figure.get_figheight() + height)
