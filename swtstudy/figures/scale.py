"""A colour scale for many lines, by the values of their dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.regimes import in_equal_ratios
from swtstudy.figures.ticks import tick_in_pi
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.wording import axis_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

#: From this number of lines a colour scale is used: the property cycle has 7 colours.
_MANY = 8
#: The lightest colours of a colour map cannot be seen on white: the scale ends at this fraction of it.
_END = 0.9


def hue_scale(values: xr.DataArray) -> ScalarMappable | None:
    """Colours of many numerical values; None for few values, or for names."""
    from matplotlib import colormaps, rcParams
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, LogNorm, Normalize

    if values.size < _MANY or values.dtype.kind not in "fi":
        return None
    known = np.sort(values.values)
    norm = (LogNorm if in_equal_ratios(known) else Normalize)(known[0], known[-1])
    colours = colormaps[rcParams["image.cmap"]](np.linspace(0.0, _END, 256))
    return ScalarMappable(norm, ListedColormap(colours))


def add_scale(figure: Figure, axes: NDArray[Any], scale: ScalarMappable, values: xr.DataArray) -> None:
    """Add the colour bar of a parameter beside all panels."""
    bar = figure.colorbar(scale, ax=axes, label=axis_words(str(values.name), values.attrs), pad=0.02)
    if AXES[str(values.name)].units == "rad":
        tick_in_pi(bar.ax.yaxis, *bar.ax.get_ylim())
