"""Figures of the fields of one parameter point: swt over a section, the stress cycle, stick and slip."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch

from swtstudy.figures.style import COLOURS, DASHES, stroke
from swtstudy.figures.words import flag_words, tick_in_pi

#: A component below this fraction of the largest one is 0 but for rounding.
_ROUNDING = 1e-9

#: Colours of open contact, stick, forward and backward slip; in greyscale white, light, dark and medium.
STATE_COLOURS = ("#FFFFFF", "#D9D9D9", "#0072B2", "#E69F00")


def draw_swt_map(axes: Axes, dataset: xr.Dataset, highest: float, stretch: float = 1.0) -> QuadMesh:
    """Draw swt over the section that the Dataset spans, depth downwards.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        From `swtstudy.swt_field`, with two of the dimensions x, y and z.
    highest
        swt at the upper end of the colour scale, whose lower end is 0.
    stretch
        How many times larger the upright direction is drawn; the label of its axis says so.

    Returns
    -------
    mesh
        For a colour bar, which several maps may share.

    Raises
    ------
    ValueError
        If the Dataset spans anything but two of x, y and z.
    """
    if len(dataset.s_local.dims) != 2 or not set(dataset.s_local.dims) <= set("xyz"):
        raise ValueError(f"found swt over {', '.join(dataset.s_local.dims)}; allowed: two of x, y and z")
    across, along = sorted(map(str, dataset.s_local.dims))
    swt = dataset.s_local.transpose(along, across)
    look: Any = {"cmap": "cividis", "shading": "gouraud", "rasterized": True}
    mesh = axes.pcolormesh(swt[across], swt[along], swt, vmin=0.0, vmax=highest, **look)
    axes.set_xlabel(f"${across}/a_H$")
    stretched = "" if stretch == 1.0 else f", drawn {stretch:g} times larger"
    axes.set_ylabel(f"${along}/a_H$" + stretched)
    axes.set_aspect(stretch)
    if along == "z":
        axes.invert_yaxis()
    return mesh


def draw_stress_cycle(axes: Axes, dataset: xr.Dataset) -> None:
    """Draw the stress components that are not 0 over one cycle at one point.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        From `swtstudy.stress_field` with a given time, at a single position.
    """
    names = [str(name) for name in dataset.data_vars if str(name).startswith("sigma_")]
    largest = max(float(abs(dataset[name]).max()) for name in names)
    shown = [name for name in names if float(abs(dataset[name]).max()) > _ROUNDING * largest]
    for index, name in enumerate(shown):
        words = f"${dataset[name].attrs['symbol']}$"
        look = stroke(COLOURS[index], DASHES[index % len(DASHES)], label=words)
        axes.plot(dataset.time, dataset[name], **look)
    draw_time_axis(axes, dataset.time)
    axes.set_ylabel(r"$\sigma\,a_H/(E^* \delta_0)$")
    axes.grid(color="0.9", linewidth=0.6)
    axes.legend(frameon=False)


def draw_slip_map(axes: Axes, dataset: xr.Dataset) -> list[Patch]:
    """Draw stick and slip over the distance from the axis and time.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        From `swtstudy.slip_map`.

    Returns
    -------
    handles
        For a legend of the states.
    """
    colours = ListedColormap(STATE_COLOURS)
    norm = BoundaryNorm(np.arange(len(STATE_COLOURS) + 1) - 0.5, colours.N)
    state = dataset.state.transpose("r", "time")
    # Borders of cells are half way between places. An image: a mesh of so many cells takes longer than all
    # else in the panel.
    edges = []
    for places in (state.time.values, state.r.values):
        middle = 0.5 * (places[1:] + places[:-1])
        edges.append(np.array([2.0 * places[0] - middle[0], *middle, 2.0 * places[-1] - middle[-1]]))
    axes.pcolorfast(*edges, state.values, cmap=colours, norm=norm, rasterized=True)
    both_sides = float(state.r[0]) < 0.0
    for sign in (1.0, -1.0) if both_sides else (1.0,):
        axes.plot(dataset.time, sign * dataset.contact_radius, **stroke(linewidth=1.2))
    draw_time_axis(axes, dataset.time)
    axes.set_ylabel("$x/a_H$" if both_sides else "$r/a_H$")
    return [
        Patch(facecolor=colour, edgecolor="black", label=words)
        for words, colour in zip(flag_words(state), STATE_COLOURS, strict=True)
    ]


def draw_time_axis(axes: Axes, time: xr.DataArray) -> None:
    """Set up the horizontal axis of a panel over time."""
    first, last = float(time.min()), float(time.max())
    axes.set_xlim(first, last)
    tick_in_pi(axes.xaxis, first, last)
    axes.set_xlabel(f"${time.attrs['symbol']}$")
