"""Figures of a sample: a quantity over each of its parameters, and how often it has which values."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from numpy.typing import NDArray

from swtstudy.figures.lines import mark_points
from swtstudy.figures.sheet import Figure, Sheet, Width
from swtstudy.figures.style import COLOURS
from swtstudy.figures.words import (
    flag_words,
    is_life,
    part_words,
    quantity_words,
    slices,
    tick_flags,
    tick_in_pi,
)
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside
from swtstudy.results.evaluate import quantity
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import axis_words, place_words, raised

#: Colours of the points of values of hue, dark and light by turns, and markers: in grey, too, they differ.
_SHADES = ("#0072B2", "#E69F00", "#000000", "#56B4E9", "#D55E00", "#CC79A7", "#009E73")
_POINTS = ("o", "^", "s", "D", "v")
#: Percentiles that a histogram marks, and their lines.
_PERCENTILES = {5: ":", 50: "-", 95: "--"}
#: Hatches of histograms: their number is coprime to the number of the colours, so that no pair repeats early.
_HATCHES = ("", "////", "....", "\\\\\\\\", "xxxx")


def draw_scatter(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Points of the quantities over every sampled parameter, a panel each."""
    names = [str(name) for name in dataset.coords if name in AXES and dataset[name].dims == (SAMPLE,)]
    sheet = Sheet(len(layout.y), len(names), width)
    figure = sheet.figure()
    axes = sheet.panels(figure, share_x="none")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        for one, name in zip(axes[row], names, strict=True):
            for index, (label, part) in enumerate(_by(dataset, layout.hue)):
                _draw_points(one, part, y, name, label, index, layout.validity)
            one.set_xlabel(axis_words(name, dataset[name].attrs))
            tick_flags(one, flag_words(whole))
            if AXES[name].units == "rad":
                tick_in_pi(one.xaxis, float(dataset[name].min()), float(dataset[name].max()))
            if is_life(whole.attrs):
                one.set_yscale("log")
        for first in sheet.first_of_lines(axes)[row]:
            first.set_ylabel(quantity_words(whole, y))
    return figure


def _draw_points(
    axes: Axes, part: xr.Dataset, y: str, name: str, label: str | None, index: int, validity: bool
) -> None:
    """The points of one value of hue: in grey a marker and a shade tell them apart."""
    drawn, x = quantity(part, y), part[name].values
    values = drawn.values
    if x.dtype.kind not in "fiu":
        words, x = np.unique(x.astype(str), return_inverse=True)
        axes.set_xticks(range(len(words)), [place_words(name, str(word)) for word in words])
    look: dict[str, Any] = {"marker": _POINTS[index % len(_POINTS)], "color": _SHADES[index % len(_SHADES)]}
    look |= {"markersize": 0.6 * rcParams["lines.markersize"], "linestyle": "none", "mew": 0}
    # Points of a cloud are the fainter the more there are; in the legend they are to be seen.
    axes.plot(x, values, alpha=min(1.0, (100 / len(values)) ** 0.5), **look)
    axes.plot([], [], label=label, **look | {"markersize": 1.4 * rcParams["lines.markersize"]})
    if validity:
        out = outside(part, drawn)
        mark_points(axes, x[out.values], values[out.values], out.attrs["long_name"])


def draw_histogram(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Draw the distribution of the quantities over the points, with percentiles."""
    panels = _by(dataset, layout.panels)
    sheet = Sheet(len(layout.y), len(panels), width)
    figure = sheet.figure()
    axes = sheet.panels(figure, share_x="row")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        edges, flags = _edges(whole), flag_words(whole)
        for one, (title, panel) in zip(axes[row], panels, strict=True):
            lines = [title]
            for index, (label, part) in enumerate(_by(panel, layout.hue)):
                values = _finite(quantity(part, y))
                places = np.percentile(values, [*_PERCENTILES]) if len(values) and not flags else []
                said = [f"{n} %: {raised(f'{at:.3g}')}" for n, at in zip(_PERCENTILES, places, strict=False)]
                words = ", ".join(filter(None, (label, *said)))
                # An entry of the legend is for all panels: of several each has its own percentiles above.
                alone = axes.size == 1 and label is not None
                lines += [] if alone else [words]
                colour, hatch = COLOURS[index % len(COLOURS)], _HATCHES[index % len(_HATCHES)]
                look: dict[str, Any] = {"facecolor": to_rgba(colour, 0.35), "edgecolor": colour}
                look |= {"histtype": "stepfilled", "linestyle": "-", "hatch": hatch}
                one.hist(values, edges, label=words if alone else label, **look)
                for place, dashes in zip(places, _PERCENTILES.values(), strict=False):
                    one.axvline(place, color=colour, linestyle=dashes, linewidth=1.4)
            one.set_title("\n".join(filter(None, lines)), loc="left")
            one.set_xlabel(quantity_words(whole, y))
            if is_life(whole.attrs):
                one.set_xscale("log")
            if flags:
                one.set_xticks(range(len(flags)), flags, rotation=30, ha="right")
        for first in sheet.first_of_lines(axes)[row]:
            first.set_ylabel("points")
            first.yaxis.get_major_locator().set_params(integer=True)
    return figure


def _finite(values: xr.DataArray) -> NDArray[Any]:
    flat = values.values.ravel()
    return flat[np.isfinite(flat)]


def _edges(values: xr.DataArray) -> list[float]:
    """Edges of bins by NumPy's rule, of lives in their logarithms; one for each flag."""
    if words := flag_words(values):
        return [place - 0.5 for place in range(len(words) + 1)]
    known = _finite(values)
    if is_life(values.attrs):
        return (10.0 ** np.histogram_bin_edges(np.log10(known[known > 0.0]), "auto")).tolist()
    return np.histogram_bin_edges(known if len(known) else [0.0, 1.0], "auto").tolist()


def _by(dataset: xr.Dataset, name: str | None) -> list[tuple[str | None, xr.Dataset]]:
    """The slices of a Dataset along a dimension, with their values in words."""
    return [(part_words(part, name) if name else None, part) for part in slices(dataset, name)]
