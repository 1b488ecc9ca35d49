"""Colours of many lines, by a scale of the values that they stand for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.regimes import in_equal_ratios
from swtstudy.parameters import PARAMETERS
from swtstudy.wording import axis_words, tick_in_pi

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

#: From so many values of a number on, lines are told apart by a scale: there are 7 colours of lines.
_MANY = 8
#: The lightest end of a map of colours cannot be seen on white: a scale ends at this part of it.
_END = 0.9


def hue_scale(values: xr.DataArray) -> ScalarMappable | None:
    """The colours of many values of a number; None for few, or for names."""
    from matplotlib import colormaps, rcParams
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, LogNorm, Normalize

    if values.size < _MANY or values.dtype.kind not in "fi":
        return None
    known = np.sort(values.values)
    norm = (LogNorm if in_equal_ratios(known) else Normalize)(known[0], known[-1])
    colours = colormaps[rcParams["image.cmap"]](np.linspace(0.0, _END, 256))
    return ScalarMappable(norm, ListedColormap(colours))


def add_scale(figure: Figure, axes: NDArray[Any], scale: ScalarMappable, name: str) -> None:
    """The bar of colours beside all panels, for a parameter."""
    bar = figure.colorbar(scale, ax=axes, label=axis_words(name), pad=0.02)
    if PARAMETERS[name].units == "rad":
        tick_in_pi(bar.ax.yaxis, *bar.ax.get_ylim())
