"""The line figure of a study."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.figures.style import Style, styled
from swtstudy.figures.words import axis_words, parameter_words, pi_words, value_words
from swtstudy.parameters import PARAMETERS
from swtstudy.results.normalise import normalised
from swtstudy.study.figure import FigureLayout, reference

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Markers, where a line has them, are so far apart, as a share of the panel's diagonal.
_MARK_EVERY = 0.1

_PANEL_WIDTH, _PANEL_HEIGHT, _LEGEND_WIDTH = 4.0, 3.2, 1.5


def draw(dataset: xr.Dataset, layout: FigureLayout | None = None, style: Style | None = None) -> Figure:
    """Draw the figure of an archive.

    Parameters
    ----------
    dataset
        Results, as from `open_results`.
    layout
        What goes where; that of the archive if not given.
    style
        A matplotlib style of one's own: a name, a file or rcParams. Without one the look is that of
        `swtstudy.figures.style`, but for rcParams that are not matplotlib's own any more.

    Returns
    -------
    matplotlib.figure.Figure
        One row of panels for every quantity, one column for every value of the panels' dimension. It is
        independent of pyplot.

    Raises
    ------
    ValueError
        If the archive has no figure, or lacks a dimension of it.
    """
    layout = layout or layout_of(dataset)
    roles = dict(layout.roles())
    for role, name in roles.items():
        if name not in dataset.s.dims:
            raise ValueError(f"the figure's {role} is {name}, which is not a dimension of these results")
    spare = [str(name) for name in dataset.s.dims if name not in roles.values()]
    if spare:
        raise ValueError(f"the figure has no place for {', '.join(spare)}: slice these results first")
    with styled(style):
        return _draw_rows(dataset, layout)


def _draw_rows(dataset: xr.Dataset, layout: FigureLayout) -> Figure:
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    columns = _slices(dataset, layout.panels)
    rows = len(layout.y)
    width = _PANEL_WIDTH * len(columns) + (_LEGEND_WIDTH if layout.hue else 0)
    figure = Figure(
        figsize=(width, _PANEL_HEIGHT * rows), layout=ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06)
    )
    axes = figure.subplots(rows, len(columns), sharex=True, sharey="row", squeeze=False)
    for row, y in enumerate(layout.y):
        for column, panel in enumerate(columns):
            _draw_panel(axes[row, column], panel, layout, y)
            _head_panel(axes[row, column], panel, layout, row * len(columns) + column, rows * len(columns))
        axes[row, 0].set_ylabel(_quantity_words(y))
    for bottom in axes[-1]:
        bottom.set_xlabel(axis_words(layout.x))
    if layout.hue:
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside right upper", frameon=False)
    if layout.title:
        figure.suptitle(layout.title)
    return figure


def layout_of(dataset: xr.Dataset) -> FigureLayout:
    """The layout of the figure that the study of these results asks for, without dimensions sliced away.

    Raises
    ------
    ValueError
        If the results come from no study, or from one without a figure.
    """
    if "figure" not in dataset.attrs:
        raise ValueError("these results have no figure of a study; allowed: a layout of your own")
    layout = FigureLayout.from_json(dataset.attrs["figure"])
    hue, panels = (None if name not in dataset.dims else name for name in (layout.hue, layout.panels))
    return replace(layout, hue=hue, panels=panels)


def _slices(dataset: xr.Dataset, name: str | None) -> list[xr.Dataset]:
    return [dataset] if name is None else [dataset.isel({name: i}) for i in range(dataset.sizes[name])]


def _draw_panel(axes: Axes, panel: xr.Dataset, layout: FigureLayout, y: str) -> None:
    curves = normalised(panel, y)
    for index in range(curves.sizes[layout.hue] if layout.hue else 1):
        curve, words = curves, None
        if layout.hue:
            curve = curves.isel({layout.hue: index})
            value = curve[layout.hue].item()
            words = f"{_short_name(layout.hue)}{value_words(layout.hue, value)}"
        order = np.argsort(curve[layout.x].values)
        axes.plot(
            curve[layout.x].values[order],
            curve.values[order],
            label=words,
            markevery=_MARK_EVERY,
        )
    x = panel[layout.x].values
    axes.set_xlim(float(x.min()), float(x.max()) if x.max() > x.min() else float(x.min()) + 1)
    if PARAMETERS[layout.x].units == "rad":
        tick_in_pi(axes, float(x.min()), float(x.max()))


def _head_panel(axes: Axes, panel: xr.Dataset, layout: FigureLayout, index: int, count: int) -> None:
    words = []
    if count > 1:
        words.append(f"({chr(ord('A') + index % 26)})")
    if layout.panels:
        value = panel[layout.panels].item()
        words.append(f"{_short_name(layout.panels)}{value_words(layout.panels, value)}")
    axes.set_title("  ".join(words), loc="left", fontsize="medium")


def _short_name(name: str) -> str:
    return "" if PARAMETERS[name].kind == "profile" else f"{parameter_words(name)} = "


def _quantity_words(y: str) -> str:
    place = reference(y)
    if place is None:
        return r"$s = \mathrm{SWT}/\mathrm{SWT}_0$"
    name, value = place
    words = value_words(name, value if isinstance(value, str) else float(value))
    return f"$s$ / $s$({_short_name(name)}{words})"


def tick_in_pi(axes: Axes, low: float, high: float) -> None:
    """Ticks at multiples of π/2, or coarser ones over a long range."""
    span = (high - low) / math.pi
    step = next((step for step in (Fraction(1, 4), Fraction(1, 2), Fraction(1)) if span / step <= 6), None)
    step = step or Fraction(math.ceil(span / 6))
    first, last = math.ceil(low / math.pi / step - 1e-9), math.floor(high / math.pi / step + 1e-9)
    multiples = [step * index for index in range(first, last + 1)]
    axes.set_xticks([float(multiple) * math.pi for multiple in multiples], list(map(pi_words, multiples)))
