"""Figures of samples and of tests: clouds, histograms, Sobol indices, predicted against observed lives."""

from __future__ import annotations

from itertools import cycle
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.colors import to_rgba
from numpy.typing import NDArray

from swtstudy.figures.lines import add_scale, hue_scale, mark_points
from swtstudy.figures.sheet import Figure, Sheet, Width, add_legend
from swtstudy.figures.style import COLOURS, Style, dots, entitle, stroke
from swtstudy.figures.words import flag_words, is_life, parts_of, quantity_words, tick_angles, tick_flags
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside
from swtstudy.points.values import unit_of
from swtstudy.results.evaluate import quantity
from swtstudy.study.figure import FigureLayout, wrong_formula
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import as_text, axis_words, place_words, raised

#: Colours of the points of values of hue, dark and light by turns, and markers: in grey, too, they differ.
_SHADES = ("#0072B2", "#E69F00", "#000000", "#56B4E9", "#D55E00", "#CC79A7", "#009E73")
_POINTS = ("o", "^", "s", "D", "v")
#: Percentiles that a histogram marks, and their lines.
_PERCENTILES = {5: ":", 50: "-", 95: "--"}
#: Hatches of histograms: their number is coprime to the number of the colours, so that no pair repeats early.
_HATCHES = ("", "////", "....", "\\\\\\\\", "xxxx")
#: So many tests at most are numbered in the figure of a fit.
NUMBERED = 20


def draw_scatter(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Points of the quantities over every sampled parameter, a panel each."""
    names = [str(name) for name in dataset.coords if name in AXES and dataset[name].dims == (SAMPLE,)]
    scale = hue_scale(dataset[layout.hue]) if layout.hue else None
    sheet = Sheet(len(layout.y), len(names), width)
    figure = sheet.figure(bool(scale))
    axes = sheet.panels(figure, share_x="none")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        for one, name in zip(axes[row], names, strict=True):
            looks = zip(parts_of(dataset, layout.hue), cycle(_SHADES), cycle(_POINTS), strict=False)
            for (label, part), shade, marker in looks:
                drawn, x = quantity(part, y), part[name].values
                look: dict[str, Any] = {"color": shade, "marker": marker, "mew": 0}
                if scale:
                    look |= {"color": scale.to_rgba(part[layout.hue].item()), "marker": "o"}
                if x.dtype.kind not in "fiu":
                    words, x = np.unique(x.astype(str), return_inverse=True)
                    one.set_xticks(range(len(words)), [place_words(name, str(word)) for word in words])
                # Points of a cloud are the fainter the more there are; in the legend they are to be seen.
                alpha = min(1.0, (100 / drawn.size) ** 0.5)
                one.plot(x, drawn.values, **dots(size=0.6, alpha=alpha, **look))
                one.plot([], [], label="" if scale else label, **dots(size=1.4, **look))
                if layout.validity:
                    out = outside(part, drawn)
                    mark_points(one, x[out.values], drawn.values[out.values], out.attrs["long_name"])
            one.set_xlabel(axis_words(name, dataset[name].attrs))
            tick_flags(one, flag_words(whole))
            tick_angles(one.xaxis, dataset[name])
            if is_life(whole.attrs):
                one.set_yscale("log")
        sheet.label_left(axes[row], quantity_words(whole, y))
    if scale:
        add_scale(figure, axes, scale, dataset[layout.hue])
    return figure


def draw_histogram(dataset: xr.Dataset, layout: FigureLayout, width: Width | None = None) -> Figure:
    """Draw the distribution of the quantities over the points, with percentiles."""
    panels = [*parts_of(dataset, layout.panels)]
    sheet = Sheet(len(layout.y), len(panels), width)
    figure = sheet.figure()
    axes = sheet.panels(figure, share_x="row")
    for row, y in enumerate(layout.y):
        whole = quantity(dataset, y)
        edges, flags = _edges(whole), flag_words(whole)
        for one, (title, panel) in zip(axes[row], panels, strict=True):
            lines = [title]
            looks = zip(parts_of(panel, layout.hue), cycle(COLOURS), cycle(_HATCHES), strict=False)
            for (label, part), colour, hatch in looks:
                values = _finite(quantity(part, y))
                places = np.percentile(values, [*_PERCENTILES]) if len(values) and not flags else []
                said = [f"{n} %: {raised(f'{at:.3g}')}" for n, at in zip(_PERCENTILES, places, strict=False)]
                words = ", ".join(filter(None, (label, *said)))
                # An entry of the legend is for all panels: of several each has its own percentiles above.
                alone = axes.size == 1 and label
                lines += [] if alone else [words]
                look: dict[str, Any] = {"facecolor": to_rgba(colour, 0.35), "edgecolor": colour}
                look |= {"histtype": "stepfilled", "linestyle": "-", "hatch": hatch}
                one.hist(values, edges, label=words if alone else label, **look)
                for place, (share, dashes) in zip(places, _PERCENTILES.items(), strict=False):
                    one.axvline(place, color=colour, linestyle=dashes, linewidth=1.4)
                    one.plot([], [], label=f"{share} % lie below", **stroke("0.3", dashes, linewidth=1.4))
            entitle(one, "\n".join(filter(None, lines)))
            one.set_xlabel(quantity_words(whole, y))
            if is_life(whole.attrs):
                one.set_xscale("log")
            if flags:
                one.set_xticks(range(len(flags)), flags, rotation=30, ha="right")
        sheet.label_left(axes[row], "points")
        axes[row, 0].yaxis.get_major_locator().set_params(integer=True)  # of all panels of the row
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


_WORDS = {"first_order": "alone (first order)", "total": "alone and with others (total)"}


def draw_sensitivity(indices: xr.Dataset, style: Style | None = None, width: Width | None = None) -> Figure:
    """Bars of the indices of every parameter with their confidence intervals.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.

    Returns
    -------
    matplotlib.figure.Figure
        A row of panels for every quantity, a column for every place on the axes.
    """
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    columns = indices.stack(place=axes).transpose("place", ...) if axes else indices.expand_dims("place")
    count, at = indices.sizes["parameter"], np.arange(indices.sizes["parameter"])
    sheet = Sheet(indices.sizes["quantity"], columns.sizes["place"], width, (1.0 + 0.75 * count, 3.0))
    with sheet.drawn(style, "all", "all") as (figure, panels):
        for (row, column), panel in np.ndenumerate(panels):
            one = columns.isel(quantity=row, place=column)
            for number, (key, words) in enumerate(_WORDS.items()):
                value, low, high = (one[f"{key}{end}"].values for end in ("", "_low", "_high"))
                error, places = np.maximum([value - low, high - value], 0.0), at + 0.4 * (number - 0.5)
                # A legend would not know the line style of a container of bars.
                panel.bar(places, value, 0.38, color=_SHADES[number]).patches[0].set_label(words)
                panel.errorbar(places, value, error, **stroke(dashes="none", elinewidth=1.2, capsize=2.5))
            panel.axhline(0.0, color="black", linewidth=0.8, linestyle="-")
            turned = {"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if width else {}
            panel.set_xticks(at, [f"${symbol}$" for symbol in one.symbol.values], **turned)
            panel.grid(False, axis="x")
            where = [place_words(name, columns[name][column].item(), columns[name].attrs) for name in axes]
            entitle(panel, ", ".join(where if row == 0 else []))
        for own, name in zip(panels, indices.quantity.values, strict=True):
            sheet.label_left(own, f"share of the variance of {name}".replace("_", " "))
        title = str(indices.attrs["title"])
        figure.suptitle(as_text(title) if wrong_formula(title) else title)
        add_legend(figure)
    return figure


def draw_fit(fitted: xr.Dataset, style: Style | None = None, width: Width | None = None) -> Figure:
    """Predicted over observed lives, with the lines of equal lives and of factors of 2 and 5.

    Few tests are numbered, in the order of their table.

    Parameters
    ----------
    fitted
        From `swtstudy.fit`.
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.
    """
    sheet = Sheet(1, 1, width, (4.6, 4.4))
    with sheet.drawn(style) as (figure, ((axes,),)):
        both = np.concatenate([fitted.observed.values, fitted.predicted.values])
        ends = np.array([both.min() / 8.0, both.max() * 8.0])
        for factor, dashes, label in ((1, "-", "equal"), (2, "--", "factor of 2"), (5, ":", "factor of 5")):
            look = stroke("0.4", dashes, linewidth=0.8)
            axes.plot(ends, ends * factor, label=label, **look)
            if factor > 1:
                axes.plot(ends, ends / factor, **look)
        survived = fitted.runout.values == 1
        for some, words, marker, fill in (
            (~survived, "tests with a crack" if survived.any() else "tests", "o", "full"),
            (survived, "run-outs: no crack so far", ">", "none"),
        ):
            if some.any():
                look = dots(COLOURS[0], marker=marker, fillstyle=fill)
                axes.plot(fitted.observed[some], fitted.predicted[some], label=words, **look)
        for number in fitted.test.values.tolist() if fitted.sizes["test"] <= NUMBERED else ():
            place = (float(fitted[name].sel(test=number)) for name in ("observed", "predicted"))
            axes.annotate(str(number), (*place,), (3, 3), textcoords="offset points", fontsize="x-small")
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
        axes.set(xlabel="observed load cycles", ylabel="predicted load cycles")
        add_legend(figure)
        figure.suptitle("\n".join(fit_lines(fitted, math=True)))
    return figure


def fit_lines(fitted: xr.Dataset, math: bool = False) -> list[str]:
    """Caption of a fit: its results with their intervals, and its scatter; ``math`` for math text."""
    lines = []
    level = f"{100 * fitted.attrs['confidence']:g} %"
    for name in ("critical_distance", "friction"):
        if f"{name}_low" not in fitted:
            continue
        value, low, high = (float(fitted[f"{name}{end}"]) for end in ("", "_low", "_high"))
        shown = f"${fitted[name].attrs['symbol']}$" if math else name
        lines.append(f"{shown} = {value:.4g}{unit_of(fitted[name])} ({level}: {low:.4g} to {high:.4g})")
    count = fitted.sizes["test"]
    scatter = 10.0 ** float(fitted.scatter)
    within = ", ".join(f"{int(fitted[f'within_{factor}'])} within a factor of {factor}" for factor in (2, 5))
    return [*lines, f"scatter: a factor of {scatter:.3g}", f"of {count} tests {within}"]
