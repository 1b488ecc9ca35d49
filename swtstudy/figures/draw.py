"""The line figure of a study."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.words import axis_words, parameter_words, pi_words, value_words
from swtstudy.parameters import PARAMETERS
from swtstudy.study.figure import FigureLayout, reference

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Okabe and Ito's colours, told apart with any colour vision, darkest first; without the yellow.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00")
#: As many as colours have in common no factor with, so that no pair repeats early.
STYLES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (8, 2, 3, 2)))

#: What marks the point at which a regime begins; of "not_finite", the last point before it.
MARKS = {"stick": "D", "partial_slip": "^", "gross_slip": "o", "lift_off": "s", "not_finite": "x"}
#: A logarithmic axis pays from this ratio of its ends on.
_LOG_RATIO = 100.0

_PANEL_WIDTH, _PANEL_HEIGHT, _LEGEND_WIDTH = 4.0, 3.2, 1.5


def draw(dataset: xr.Dataset, layout: FigureLayout | None = None) -> Figure:
    """Draw the figure of an archive.

    Parameters
    ----------
    dataset
        Results, as from `open_results`.
    layout
        What goes where; that of the archive if not given.

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
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    layout = layout or layout_of(dataset)
    for role, name in layout.roles():
        if name not in dataset.s.dims:
            raise ValueError(f"the figure's {role} is {name}, which is not a dimension of these results")
    columns = _slices(dataset, layout.panels)
    rows = len(layout.y)
    width = _PANEL_WIDTH * len(columns) + (_LEGEND_WIDTH if layout.hue else 0)
    figure = Figure(
        figsize=(width, _PANEL_HEIGHT * rows), layout=ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06)
    )
    axes = figure.subplots(rows, len(columns), sharex=True, sharey="row", squeeze=False)
    begun: set[str] = set()
    for row, y in enumerate(layout.y):
        for column, panel in enumerate(columns):
            begun |= _draw_panel(axes[row, column], panel, layout, y)
            _head_panel(axes[row, column], panel, layout, row * len(columns) + column, rows * len(columns))
        axes[row, 0].set_ylabel(_quantity_words(y))
    for bottom in axes[-1]:
        bottom.set_xlabel(axis_words(layout.x))
    if layout.hue:
        handles, labels = axes[0, 0].get_legend_handles_labels()
        marks, names = _mark_legend(begun)
        handles, labels = handles + marks, labels + names
        figure.legend(handles, labels, loc="outside right upper", frameon=False)
    if layout.title:
        figure.suptitle(layout.title)
    return figure


def layout_of(dataset: xr.Dataset) -> FigureLayout:
    """The layout of the figure that the study of these results asks for."""
    if "figure" not in dataset.attrs:
        raise ValueError("the study of these results has no figure")
    return FigureLayout.from_json(dataset.attrs["figure"])


def quantity(dataset: xr.Dataset, y: str) -> xr.DataArray:
    """s, or s over its value at the place that `y` names, e.g. "s/s(flat_radius=0)"."""
    place = reference(y)
    if place is None:
        return dataset.s
    name, value = place
    if isinstance(value, str):
        return dataset.s / dataset.s.sel({name: value}, drop=True)
    return dataset.s / dataset.s.sel({name: float(value)}, method="nearest", drop=True)


def _slices(dataset: xr.Dataset, name: str | None) -> list[xr.Dataset]:
    return [dataset] if name is None else [dataset.isel({name: i}) for i in range(dataset.sizes[name])]


def _draw_panel(axes: Axes, panel: xr.Dataset, layout: FigureLayout, y: str) -> set[str]:
    """Draw the lines of a panel; the regimes whose begin is marked."""
    curves = quantity(panel, y)
    begun: set[str] = set()
    for index in range(curves.sizes[layout.hue] if layout.hue else 1):
        curve, words = curves, None
        if layout.hue:
            curve = curves.isel({layout.hue: index})
            value = curve[layout.hue].item()
            words = f"{_short_name(layout.hue)}{value_words(layout.hue, value)}"
        order = np.argsort(curve[layout.x].values)
        x, y_values = curve[layout.x].values[order], curve.values[order]
        axes.plot(
            x,
            y_values,
            color=COLOURS[index % len(COLOURS)],
            linestyle=STYLES[index % len(STYLES)],
            linewidth=1.6,
            label=words,
        )
        if layout.regimes:
            regime = panel.regime.isel({layout.hue: index}) if layout.hue else panel.regime
            names = panel.regime.attrs["flag_meanings"].split()
            begun |= _mark_regimes(axes, x, y_values, [names[value] for value in regime.values[order]], index)
    x = panel[layout.x].values
    axes.set_xlim(float(x.min()), float(x.max()) if x.max() > x.min() else float(x.min()) + 1)
    if _in_equal_ratios(x):
        axes.set_xscale("log")
        s = curves.values[np.isfinite(curves.values) & (curves.values > 0.0)]
        if s.size and s.max() > _LOG_RATIO * s.min():
            axes.set_yscale("log")
    axes.grid(color="0.9", linewidth=0.6)
    if PARAMETERS[layout.x].units == "rad":
        _tick_in_pi(axes, float(x.min()), float(x.max()))
    return begun


def _mark_regimes(axes: Axes, x: np.ndarray, y: np.ndarray, names: list[str], index: int) -> set[str]:
    """Mark where the regime of a line changes, and say to which ones."""
    begun = set()
    for place in range(1, len(names)):
        if names[place] != names[place - 1]:
            begun.add(names[place])
            at = place - 1 if names[place] == "not_finite" else place
            colour = COLOURS[index % len(COLOURS)]
            axes.plot(x[at], y[at], MARKS[names[place]], color=colour, markersize=5, markerfacecolor="none")
    return begun


def _mark_legend(begun: set[str]) -> tuple[list[Any], list[str]]:
    """Handles and words for the marks of the regimes."""
    from matplotlib.lines import Line2D

    names = [name for name in MARKS if name in begun]
    style: dict[str, Any] = {"color": "0.3", "linestyle": "none", "markerfacecolor": "none"}
    handles = [Line2D([], [], marker=MARKS[name], **style) for name in names]
    words = [name.replace("_", " ") + (" from here on" if name == "not_finite" else "") for name in names]
    return handles, words


def _in_equal_ratios(x: np.ndarray) -> bool:
    """Whether the values of an axis are spaced in equal ratios over a long range."""
    x = np.sort(x)
    if len(x) < 3 or x[0] <= 0.0 or x[-1] < _LOG_RATIO * x[0]:
        return False
    ratio = x[1:] / x[:-1]
    return bool(np.ptp(ratio) <= 1e-6 * ratio[0])


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


def _tick_in_pi(axes: Axes, low: float, high: float) -> None:
    """Ticks at multiples of π/2, or coarser ones over a long range."""
    span = (high - low) / math.pi
    step = next((step for step in (Fraction(1, 4), Fraction(1, 2), Fraction(1)) if span / step <= 6), None)
    step = step or Fraction(math.ceil(span / 6))
    first, last = math.ceil(low / math.pi / step - 1e-9), math.floor(high / math.pi / step + 1e-9)
    multiples = [step * index for index in range(first, last + 1)]
    axes.set_xticks([float(multiple) * math.pi for multiple in multiples], list(map(pi_words, multiples)))
