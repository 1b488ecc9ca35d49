"""Figures of evaluations: Sobol indices as bars, predicted against observed lives."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

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
    count, at = indices.sizes["parameter"], np.arange(indices.sizes["parameter"])
    sheet = Sheet(indices.sizes["quantity"], columns.sizes["place"], width, (1.0 + 0.75 * count, 3.0))
    with styled(style, width):
        figure = sheet.figure()
        panels = sheet.panels(figure, share_y="all")
        for (row, column), panel in np.ndenumerate(panels):
            one = columns.isel(quantity=row, place=column)
            for number, (key, words) in enumerate(_WORDS.items()):
                value, low, high = (one[f"{key}{end}"].values for end in ("", "_low", "_high"))
                error, places = np.maximum([value - low, high - value], 0.0), at + 0.4 * (number - 0.5)
                # A legend would not know the line style of a container of bars.
                panel.bar(places, value, 0.38, color=COLOURS[number]).patches[0].set_label(words)
                panel.errorbar(places, value, error, **stroke(dashes="none", elinewidth=1.2, capsize=2.5))
            panel.axhline(0.0, color="black", linewidth=0.8, linestyle="-")
            panel.set_xticks(at, [f"${symbol}$" for symbol in one.symbol.values])
            panel.grid(False, axis="x")
            if column % sheet.across == 0:
                panel.set_ylabel(f"share of the variance of {one.quantity.item()}".replace("_", " "))
            where = [place_words(name, columns[name][column].item(), columns[name].attrs) for name in axes]
            panel.set_title(", ".join(where if row == 0 else []), loc="left")
        title = str(indices.attrs["title"])
        figure.suptitle(as_text(title) if wrong_formula(title) else title)
        add_legend(figure)
        wrap_texts(figure)
    return figure


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
        look = {"color": COLOURS[0], "linestyle": "none"}
        for some, words, marker in (
            (~survived, "tests with a crack" if survived.any() else "tests", {"marker": "o"}),
            (survived, "run-outs: no crack so far", {"marker": ">", "fillstyle": "none"}),
        ):
            if some.any():
                axes.plot(fitted.observed[some], fitted.predicted[some], label=words, **look, **marker)
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
        axes.set(xlabel="observed load cycles", ylabel="predicted load cycles")
        add_legend(figure)
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
