"""Figures of a sample: a quantity over each of its parameters, and how often it has which values."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from swtstudy.figures.legend import add_legend
from swtstudy.figures.marks import mark_points
from swtstudy.figures.quantity_words import flag_words, is_life, part_words, quantity_words, slices
from swtstudy.figures.sheet import Figure, Sheet, Width
from swtstudy.figures.style import COLOURS
from swtstudy.figures.ticks import tick_flags, tick_in_pi
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside
from swtstudy.results.evaluate import quantity
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import axis_words, place_words, raised

#: Points of a cloud are the fainter the more there are: so many are drawn without transparency.
_OPAQUE = 100
#: Colours of the points of values of hue, dark and light by turns, and markers: in grey, too, they differ.
SHADES = ("#0072B2", "#E69F00", "#000000", "#56B4E9", "#D55E00", "#CC79A7", "#009E73")
POINTS = ("o", "^", "s", "D", "v")
#: Their sizes over that of a marker.
_POINT, _IN_LEGEND = 0.6, 1.4
#: Percentiles that a histogram marks.
PERCENTILES = (5, 50, 95)
_DASHES = (":", "-", "--")
#: Hatches of histograms: their number is coprime to that of the colours, so that no pair repeats early.
HATCHES = ("", "////", "....", "\\\\\\\\", "xxxx")


def draw_scatter(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Points of the quantities over every sampled parameter, a panel each."""
    names = [str(name) for name in dataset.coords if name in AXES and dataset[name].dims == (SAMPLE,)]
    sheet = Sheet(len(layout.y), len(names), width)
    figure = sheet.figure()
    axes = sheet.panels(figure, share_x="none")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        words = outside(dataset, whole).attrs["long_name"] if layout.validity else ""
        for one, name in zip(axes[row], names, strict=True):
            for index, (label, part) in enumerate(_by(dataset, layout.hue)):
                drawn = quantity(part, y)
                values = drawn.values
                x, at = _numbers(part[name])
                faint = min(1.0, (_OPAQUE / len(values)) ** 0.5)
                one.plot(x, values, **_look(index), alpha=faint, label=label)
                if layout.validity:
                    out = outside(part, drawn).values
                    mark_points(one, x[out], values[out], words)
                if at is not None:
                    one.set_xticks(range(len(at)), at)
            one.set_xlabel(axis_words(name, dataset[name].attrs))
            _scale_axes(one, dataset, name, whole)
            if is_life(whole.attrs):
                one.set_yscale("log")
        for first in sheet.first_of_lines(axes)[row]:
            first.set_ylabel(quantity_words(whole, y))
    return _finished(figure, axes, layout)


def _look(index: int) -> dict[str, Any]:
    """Of the points of one value of hue: in grey a marker and a shade tell them apart."""
    look = {"marker": POINTS[index % len(POINTS)], "markersize": _POINT * rcParams["lines.markersize"]}
    return {"linestyle": "none", **look, "mew": 0, "color": SHADES[index % len(SHADES)]}


def draw_histogram(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Draw the distribution of the quantities over the points, with percentiles."""
    panels = _by(dataset, layout.panels)
    sheet = Sheet(len(layout.y), len(panels), width)
    figure = sheet.figure()
    axes = sheet.panels(figure, share_x="row")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        edges = _edges(whole)
        for one, (title, panel) in zip(axes[row], panels, strict=True):
            lines = [title]
            for index, (label, part) in enumerate(_by(panel, layout.hue)):
                values = quantity(part, y)
                words = ", ".join(filter(None, (label, _percentile_words(values))))
                # An entry of the legend is for all panels: of several each has its own percentiles above.
                alone = axes.size == 1 and label is not None
                lines += [] if alone else [words]
                _draw_one(one, values, edges, words if alone else label, index)
            one.set_title("\n".join(filter(None, lines)), loc="left")
            one.set_xlabel(quantity_words(whole, y))
            if is_life(whole.attrs):
                one.set_xscale("log")
            flags = flag_words(whole)
            if flags:
                one.set_xticks(range(len(flags)), flags, rotation=30, ha="right")
        for first in sheet.first_of_lines(axes)[row]:
            first.set_ylabel("points")
            first.yaxis.get_major_locator().set_params(integer=True)
    return _finished(figure, axes, layout)


def _draw_one(axes: Axes, values: xr.DataArray, edges: list[float], label: str | None, index: int) -> None:
    """One histogram, with lines at its percentiles; colours and hatches differ between those of one panel."""
    colour, hatch = COLOURS[index % len(COLOURS)], HATCHES[index % len(HATCHES)]
    look: dict[str, Any] = {"facecolor": to_rgba(colour, 0.35), "edgecolor": colour, "hatch": hatch}
    axes.hist(_finite(values), edges, histtype="stepfilled", linestyle="-", label=label, **look)
    for place, dashes in zip(_percentiles(values), _DASHES, strict=False):
        axes.axvline(place, color=colour, linestyle=dashes, linewidth=1.4)


def _percentiles(values: xr.DataArray) -> list[float]:
    """The values at `PERCENTILES`; none of flags."""
    known = _finite(values)
    return [] if flag_words(values) or not len(known) else np.percentile(known, PERCENTILES).tolist()


def _percentile_words(values: xr.DataArray) -> str:
    places = zip(PERCENTILES, _percentiles(values), strict=False)
    return ", ".join(f"{percent} %: {raised(f'{place:.3g}')}" for percent, place in places)


def _finite(values: xr.DataArray) -> NDArray[Any]:
    flat = values.values.ravel()
    return flat[np.isfinite(flat)]


def _edges(values: xr.DataArray) -> list[float]:
    """Edges of bins: those of NumPy's rule, one for each flag."""
    words = flag_words(values)
    if words:
        return [place - 0.5 for place in range(len(words) + 1)]
    known = _finite(values)
    if is_life(values.attrs):
        # People read lives in decades.
        return (10.0 ** np.histogram_bin_edges(np.log10(known[known > 0.0]), "auto")).tolist()
    return np.histogram_bin_edges(known if len(known) else [0.0, 1.0], "auto").tolist()


def _scale_axes(axes: Axes, dataset: xr.Dataset, name: str, values: xr.DataArray) -> None:
    tick_flags(axes, flag_words(values))
    if AXES[name].units == "rad":
        tick_in_pi(axes.xaxis, float(dataset[name].min()), float(dataset[name].max()))


def _numbers(values: xr.DataArray) -> tuple[NDArray[Any], list[str] | None]:
    """Places along an axis, and the names there of values that are no numbers."""
    if values.dtype.kind in "fiu":
        return values.values, None
    names, places = np.unique(values.values.astype(str), return_inverse=True)
    return places, [place_words(str(values.name), str(name)) for name in names]


def _by(dataset: xr.Dataset, name: str | None) -> list[tuple[str | None, xr.Dataset]]:
    """The slices of a Dataset along a dimension, with their values in words."""
    return [(part_words(part, name) if name else None, part) for part in slices(dataset, name)]


def _finished(figure: Figure, axes: NDArray[Any], layout: FigureLayout) -> Figure:
    if layout.title:
        figure.suptitle(layout.title)
    add_legend(figure, axes)
    for handle in (each for legend in figure.legends for each in legend.legend_handles):
        # The marker of a faint point is to be seen.
        if isinstance(handle, Line2D) and handle.get_linestyle() == "None":
            handle.set(markersize=_IN_LEGEND * rcParams["lines.markersize"], alpha=1.0)
    return figure
