"""Small drawings of loops in a legend: a name such as "L" says less than the loop itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.legend_handler import HandlerLine2D
from matplotlib.lines import Line2D

from swtstudy.mechanics.load.load_path import LoadPath

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.legend import Legend

#: Length and height of a handle with a loop, in em.
HANDLE = {"handlelength": 4.6, "handleheight": 1.9, "labelspacing": 0.7}
#: Share of its length that the sample of the line has.
_SAMPLE = 0.52


class LoopHandler(HandlerLine2D):
    """A line's sample, and beside it the loop that the line is about: tangential across, normal upwards."""

    def __init__(self, loops: Mapping[str, LoadPath]) -> None:
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
        normal, tangential = np.array([*loop.vertices, loop.vertices[0]])[:, :2].T
        side = 0.85 * height
        left, bottom = width - side - xdescent, -ydescent + 0.5 * (height - side)
        x, y = left + side * _unit(tangential), bottom + side * _unit(normal)
        look: dict[str, Any] = {"color": orig_handle.get_color(), "linestyle": "-", "linewidth": 1.0}
        return [*artists, Line2D(x, y, marker="", transform=trans, **look)]


def _unit(values: np.ndarray) -> np.ndarray:
    """From 0 to 1; in the middle where they are all the same."""
    spread = float(np.ptp(values))
    return (values - values.min()) / spread if spread else np.full(len(values), 0.5)


def loops_of(dataset: xr.Dataset) -> dict[str, LoadPath]:
    """The loops of straight lines among the loads of results, by the words of their lines."""
    from swtstudy.archive.attributes import defined_in

    loads = defined_in(dataset.attrs).get("load", {})
    return {name.replace("_", " "): load for name, load in loads.items() if isinstance(load, LoadPath)}
