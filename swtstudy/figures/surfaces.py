"""Panels of a quantity over two dimensions: contours, or a heat map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.quantity_words import flag_words
from swtstudy.figures.ticks import tick_cells, tick_in_pi
from swtstudy.parameters import AXES
from swtstudy.results.extrema import extrema
from swtstudy.wording import value_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

#: Largest numbers of ticks of a heat map's axes whose labels do not overlap, and of labels along an extremum.
_TICKS_ACROSS, _TICKS_UP, _LABELLED = 9, 20, 5

#: Approximate number of contours: as many as are legible with labels.
_LEVELS = 13


def draw_surfaces(
    figure: Figure, axes: NDArray[Any], surfaces: list[xr.DataArray], kind: str, words: str
) -> None:
    """Draw a row of panels with one colour scale.

    Parameters
    ----------
    figure, axes
        The figure and the panels of the row.
    surfaces
        A quantity over (vertical, x) for each panel; each flag has a colour, with its meaning at the colour
        bar.
    kind
        "contour" or "heatmap".
    words
        Label of the colour bar.
    """
    names = flag_words(surfaces[0])
    look = _flag_colours(names) if names else {"norm": _scale_of(surfaces, kind)}
    for one, surface in zip(axes, surfaces, strict=True):
        if kind == "heatmap":
            filled = draw_cells(one, surface, look)
        elif names:
            filled = draw_areas(one, surface, look)
        else:
            filled = draw_contours(one, surface, look)
    bar = figure.colorbar(filled, ax=axes, label=words, pad=0.02)
    if names:
        bar.set_ticks(range(len(names)), labels=names)
        bar.ax.tick_params(which="both", length=0)


def _scale_of(surfaces: list[xr.DataArray], kind: str) -> Normalize:
    """One colour scale for all panels of a row, in steps for contours."""
    from matplotlib.colors import BoundaryNorm, Normalize
    from matplotlib.ticker import MaxNLocator

    values = np.concatenate([surface.values.ravel() for surface in surfaces])
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if kind == "heatmap":
        return Normalize(low, high)
    return BoundaryNorm(MaxNLocator(_LEVELS).tick_values(low, high), 256)


def _flag_colours(names: list[str]) -> dict[str, Any]:
    """A colour for each flag, in order from dark to light."""
    from matplotlib import colormaps, rcParams
    from matplotlib.colors import BoundaryNorm

    colours = colormaps[rcParams["image.cmap"]].resampled(len(names))
    return {"cmap": colours, "norm": BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names))}


def draw_areas(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw areas of flags over (vertical, x), with borders half way between points; grey where NaN."""
    vertical, x = map(str, surface.dims)
    axes.set_facecolor("0.8")
    surface = surface.sortby([vertical, x])
    at = surface[x], surface[vertical]
    mesh = axes.pcolormesh(*at, surface, shading="nearest", rasterized=True, **look)
    axes.set(xlim=surface[x].values[[0, -1]], ylim=surface[vertical].values[[0, -1]])
    axes.grid(False)
    _tick_angles(axes, surface)
    return mesh


def draw_contours(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw contours of a surface over (vertical, x); for s also its minima and maxima along x, labelled."""
    vertical, x = map(str, surface.dims)
    levels = look["norm"].boundaries
    surface = surface.sortby([vertical, x])
    at = surface[x], surface[vertical]
    axes.set_facecolor("0.8")
    filled = axes.contourf(*at, surface, levels=levels, **look)
    lines = axes.contour(*at, surface, levels=levels, colors="black", linewidths=0.5, alpha=0.6)
    axes.clabel(lines, levels[::2], fontsize="x-small", fmt="%g")
    if surface.name == "s":
        _draw_extrema(axes, surface)
    axes.grid(False)
    _tick_angles(axes, surface)
    return filled


def _draw_extrema(axes: Axes, surface: xr.DataArray) -> None:
    vertical, x = map(str, surface.dims)
    found = extrema(surface.to_dataset(name="s"), x)
    for kind, look in (("minimum", {"linestyle": "-"}), ("maximum", {"linestyle": (0, (4, 2))})):
        places = found[f"at_{kind}"]
        # The curve has a gap where the extremum jumps from one place to another.
        jumps = np.abs(np.diff(places, prepend=places[0])) > 0.25 * np.ptp(surface[x].values)
        label = "least $s$" if kind == "minimum" else "greatest $s$"
        with_gaps = np.where(jumps, np.nan, places)
        # Not clipped: an extremum may lie on the frame.
        over: dict[str, Any] = {"marker": "", "clip_on": False, "zorder": 3}
        axes.plot(with_gaps, places[vertical], color="white", linewidth=3.4, **over)
        axes.plot(with_gaps, places[vertical], color="#B22222", label=label, **look, **over)
        _label_places(axes, places, x, vertical)


def _tick_angles(axes: Axes, surface: xr.DataArray) -> None:
    for axis, name in zip((axes.yaxis, axes.xaxis), map(str, surface.dims), strict=True):
        if AXES[name].units == "rad":
            tick_in_pi(axis, float(surface[name].min()), float(surface[name].max()))


def _label_places(axes: Axes, places: xr.DataArray, x: str, vertical: str) -> None:
    chosen = np.linspace(0, places.size - 1, _LABELLED + 2).round().astype(int)[1:-1]
    low, high = axes.get_xlim()
    for index in dict.fromkeys(chosen.tolist()):
        value = float(places[index])
        words = f"{np.degrees(value):.0f}°" if AXES[x].units == "rad" else f"{value:.3g}"
        share = (value - low) / (high - low)
        side = "left" if share < 0.04 else "right" if share > 0.96 else "center"
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.8}
        at = value, float(places[vertical][index])
        axes.text(*at, words, fontsize="x-small", ha=side, va="center", bbox=box, zorder=4)


def draw_cells(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw a cell for each point of a surface over (vertical, x), in the order of values; grey where NaN."""
    vertical, x = map(str, surface.dims)
    axes.set_facecolor("0.8")
    columns, rows = (np.arange(surface.sizes[name]) for name in (x, vertical))
    mesh = axes.pcolormesh(columns, rows, surface, shading="nearest", rasterized=True, **look)
    axes.grid(False)
    for axis, name, most in ((axes.xaxis, x, _TICKS_ACROSS), (axes.yaxis, vertical, _TICKS_UP)):
        tick_cells(axis, [value_words(name, value) for value in surface[name].values.tolist()], most)
    axes.tick_params(axis="y", labelsize="small")
    return mesh
