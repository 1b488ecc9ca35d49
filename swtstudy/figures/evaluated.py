"""Figures of evaluations: Sobol indices as bars, predicted against observed lives."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from swtstudy.figures.sheet import Figure, Sheet, Width, add_legend, wrap_texts
from swtstudy.figures.style import COLOURS, Style, stroke, styled
from swtstudy.study.figure import wrong_formula
from swtstudy.vocabulary.wording import as_text, place_words

_WORDS = {"first_order": "alone (first order)", "total": "alone and with others (total)"}


def draw_sensitivity(indices: xr.Dataset, style: Style | None = None, width: Width | None = None) -> Figure:
    """Bars of the indices of every parameter with their confidence intervals.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.

    Returns
    -------
    matplotlib.figure.Figure
        A row of panels for every quantity, a column for every place on the axes.
    """
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    columns = indices.stack(place=axes).transpose("place", ...) if axes else indices.expand_dims("place")
    size = (1.0 + 0.75 * indices.sizes["parameter"], 3.0)
    sheet = Sheet(indices.sizes["quantity"], columns.sizes["place"], width, size)
    with styled(style, width):
        figure = sheet.figure()
        panels = sheet.panels(figure, share_y="all")
        for row, line in enumerate(panels):
            for column, panel in enumerate(line):
                _draw_one(panel, columns.isel(quantity=row, place=column), column % sheet.across == 0)
                where = {name: columns[name] for name in axes} if row == 0 else {}
                places = [place_words(name, each.values[column], each.attrs) for name, each in where.items()]
                panel.set_title(", ".join(places), loc="left")
        title = str(indices.attrs["title"])
        figure.suptitle(as_text(title) if wrong_formula(title) else title)
        add_legend(figure, panels)
        wrap_texts(figure)
    return figure


def _draw_one(axes: Axes, indices: xr.Dataset, first: bool) -> None:
    names = indices.parameter.values.tolist()
    places = np.arange(len(names))
    for number, (key, words) in enumerate(_WORDS.items()):
        value, low, high = (indices[f"{key}{end}"].values for end in ("", "_low", "_high"))
        error = np.maximum([value - low, high - value], 0.0)
        at = places + 0.4 * (number - 0.5)
        # A legend would not know the line style of a container of bars.
        axes.bar(at, value, 0.38, color=COLOURS[number]).patches[0].set_label(words)
        axes.errorbar(
            at, value, error, linestyle="none", marker="", color="black", elinewidth=1.2, capsize=2.5
        )
    axes.axhline(0.0, color="black", linewidth=0.8, linestyle="-")
    axes.set_xticks(places, [f"${symbol}$" for symbol in indices.symbol.values])
    axes.grid(False, axis="x")
    if first:
        axes.set_ylabel(f"share of the variance of {indices.quantity.item()}".replace("_", " "))


def draw_fit(fitted: xr.Dataset, style: Style | None = None, width: Width | None = None) -> Figure:
    """Predicted over observed lives, with the lines of equal lives and of factors of 2 and 5.

    Parameters
    ----------
    fitted
        From `swtstudy.fit`.
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.
    """
    sheet = Sheet(1, 1, width, (4.6, 4.4))
    with styled(style, width):
        figure = sheet.figure()
        axes: Any = sheet.panels(figure, share_x="none", share_y="none")[0][0]
        both = np.concatenate([fitted.observed.values, fitted.predicted.values])
        ends = np.array([both.min() / 8.0, both.max() * 8.0])
        for factor, dashes, label in ((1, "-", "equal"), (2, "--", "factor of 2"), (5, ":", "factor of 5")):
            look = stroke("0.4", dashes, linewidth=0.8)
            axes.plot(ends, ends * factor, label=label, **look)
            if factor > 1:
                axes.plot(ends, ends / factor, **look)
        survived = fitted.runout.values == 1
        for some, words, marker in (
            (~survived, "tests with a crack" if survived.any() else "tests", {"marker": "o"}),
            (survived, "run-outs: no crack so far", {"marker": ">", "fillstyle": "none"}),
        ):
            if some.any():
                look = {"color": COLOURS[0], "linestyle": "none", "label": words, **marker}
                axes.plot(fitted.observed[some], fitted.predicted[some], **look)
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
        axes.set(xlabel="observed load cycles", ylabel="predicted load cycles")
        axes.legend(loc="upper left")
        figure.suptitle("\n".join(fit_lines(fitted, math=True)))
        wrap_texts(figure)
    return figure


def fit_lines(fitted: xr.Dataset, math: bool = False) -> list[str]:
    """Caption of a fit: its results with their intervals, and its scatter; ``math`` for math text."""
    lines = []
    level = f"{100 * fitted.attrs['confidence']:g} %"
    for name in ("critical_distance", "friction"):
        if f"{name}_low" not in fitted:
            continue
        value, low, high = (float(fitted[f"{name}{end}"]) for end in ("", "_low", "_high"))
        unit = str(fitted[name].attrs["units"])
        shown = f"${fitted[name].attrs['symbol']}$" if math else name
        unit = "" if unit == "1" else f" {unit}"
        lines.append(f"{shown} = {value:.4g}{unit} ({level}: {low:.4g} to {high:.4g})")
    count = fitted.sizes["test"]
    scatter = 10.0 ** float(fitted.scatter)
    within = ", ".join(f"{int(fitted[f'within_{factor}'])} within a factor of {factor}" for factor in (2, 5))
    return [*lines, f"scatter: a factor of {scatter:.3g}", f"of {count} tests {within}"]
