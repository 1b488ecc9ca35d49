"""A panel of s over two dimensions: contours, or a heat map of cells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.words import tick_in_pi, value_words
from swtstudy.parameters import PARAMETERS
from swtstudy.results.extrema import extrema

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

#: Ticks of the axes of cells, at most, and places at which an optimum is labelled.
_TICKS_ACROSS, _TICKS_UP, _LABELLED = 9, 20, 5


def colours_of(surfaces: list[xr.DataArray], levels: int | None = None) -> Normalize:
    """One scale of colours for all panels of a row, in about so many steps."""
    from matplotlib.colors import BoundaryNorm, Normalize
    from matplotlib.ticker import MaxNLocator

    low = min(float(values.min()) for values in surfaces)
    high = max(float(values.max()) for values in surfaces)
    if levels is None:
        return Normalize(low, high)
    return BoundaryNorm(MaxNLocator(levels).tick_values(low, high), 256)


def draw_contours(axes: Axes, surface: xr.DataArray, norm: Normalize) -> ScalarMappable:
    """Contours of a surface over (vertical, x), and along x its minima and maxima, labelled with x."""
    vertical, x = map(str, surface.dims)
    levels = norm.boundaries  # type: ignore[attr-defined]
    surface = surface.sortby([vertical, x])
    at = surface[x], surface[vertical]
    filled = axes.contourf(*at, surface, levels=levels, norm=norm)
    lines = axes.contour(*at, surface, levels=levels, colors="black", linewidths=0.5, alpha=0.6)
    axes.clabel(lines, levels[::2], fontsize="x-small", fmt="%g")
    found = extrema(surface.to_dataset(name="s"), x)
    for kind, look in (("minimum", {"linestyle": "-"}), ("maximum", {"linestyle": (0, (4, 2))})):
        places = found[f"at_{kind}"]
        # The curve is broken where the extremum leaps from one place to another.
        leaps = np.abs(np.diff(places, prepend=places[0])) > 0.25 * np.ptp(surface[x].values)
        label = "least $s$" if kind == "minimum" else "greatest $s$"
        unbroken = np.where(leaps, np.nan, places)
        # Over the frame: an extremum may lie on it.
        over: dict[str, Any] = {"marker": "", "clip_on": False, "zorder": 3}
        axes.plot(unbroken, places[vertical], color="white", linewidth=3.4, **over)
        axes.plot(unbroken, places[vertical], color="#B22222", label=label, **look, **over)
        _label_places(axes, places, x, vertical)
    axes.grid(False)
    for axis, name in ((axes.xaxis, x), (axes.yaxis, vertical)):
        if PARAMETERS[name].units == "rad":
            tick_in_pi(axis, float(surface[name].min()), float(surface[name].max()))
    return filled


def _label_places(axes: Axes, places: xr.DataArray, x: str, vertical: str) -> None:
    chosen = np.linspace(0, places.size - 1, _LABELLED + 2).round().astype(int)[1:-1]
    low, high = axes.get_xlim()
    for index in dict.fromkeys(chosen.tolist()):
        value = float(places[index])
        words = f"{np.degrees(value):.0f}°" if PARAMETERS[x].units == "rad" else f"{value:.3g}"
        share = (value - low) / (high - low)
        side = "left" if share < 0.04 else "right" if share > 0.96 else "center"
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.8}
        at = value, float(places[vertical][index])
        axes.text(*at, words, fontsize="x-small", ha=side, va="center", bbox=box, zorder=4)


def draw_cells(axes: Axes, surface: xr.DataArray, norm: Normalize) -> ScalarMappable:
    """A cell for every point of a surface over (vertical, x), in the order of the values; grey if NaN."""
    vertical, x = map(str, surface.dims)
    axes.set_facecolor("0.8")
    columns, rows = (np.arange(surface.sizes[name]) for name in (x, vertical))
    mesh = axes.pcolormesh(columns, rows, surface, norm=norm, shading="nearest", rasterized=True)
    axes.grid(False)
    _tick_cells(axes.xaxis, x, surface[x].values.tolist(), _TICKS_ACROSS)
    _tick_cells(axes.yaxis, vertical, surface[vertical].values.tolist(), _TICKS_UP)
    axes.tick_params(axis="y", labelsize="small")
    return mesh


def _tick_cells(axis: Axis, name: str, values: list[float | str], most: int) -> None:
    places = range(0, len(values), -(-len(values) // most))
    axis.set_ticks(list(places), [value_words(name, values[place]) for place in places])
