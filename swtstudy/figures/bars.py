"""Bar charts of Sobol indices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.figures.legend import add_legend
from swtstudy.figures.sheet import Sheet, Width
from swtstudy.figures.style import COLOURS, Style, styled
from swtstudy.figures.wrap import wrap_texts, wrap_title
from swtstudy.study.figure_check import wrong_formula
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.wording import as_text, place_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from swtstudy.figures.figure import Figure

#: Size of a panel, inches: its width grows with the number of parameters.
_BAR_WIDTH, _MARGIN, _PANEL_HEIGHT = 0.75, 1.0, 3.0
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
    panel_size = (_MARGIN + _BAR_WIDTH * indices.sizes["parameter"], _PANEL_HEIGHT)
    sheet = Sheet(indices.sizes["quantity"], columns.sizes["place"], width, panel_size)
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
        wrap_title(figure)  # also on a screen: few parameters make a narrow figure
    return figure


def _draw_one(axes: Axes, indices: xr.Dataset, first: bool) -> None:
    names = indices.parameter.values.tolist()
    places = np.arange(len(names))
    for number, (key, words) in enumerate(_WORDS.items()):
        value, low, high = (indices[f"{key}{end}"].values for end in ("", "_low", "_high"))
        error = np.maximum([value - low, high - value], 0.0)
        at = places + 0.4 * (number - 0.5)
        # Of a container of bars a legend would not know the line style.
        axes.bar(at, value, 0.38, color=COLOURS[number]).patches[0].set_label(words)
        axes.errorbar(
            at, value, error, linestyle="none", marker="", color="black", elinewidth=1.2, capsize=2.5
        )
    axes.axhline(0.0, color="black", linewidth=0.8, linestyle="-")
    # Indices of before do not say how their study, which may have units, calls them.
    symbols = indices.symbol.values if "symbol" in indices.coords else [AXES[name].symbol for name in names]
    axes.set_xticks(places, [f"${symbol}$" for symbol in symbols])
    axes.grid(False, axis="x")
    if first:
        axes.set_ylabel(f"share of the variance of {indices.quantity.item()}".replace("_", " "))
