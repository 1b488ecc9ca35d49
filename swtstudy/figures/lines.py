"""A panel of lines, with error bands where these are visible."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.quantity_words import flag_words
from swtstudy.figures.regimes import LOG_RATIO, in_equal_ratios, mark_regimes
from swtstudy.figures.ticks import tick_in_pi
from swtstudy.parameters import AXES
from swtstudy.results.quantity import known_regime, quantity, quantity_error
from swtstudy.study.figure import FigureLayout
from swtstudy.wording import place_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from numpy.typing import NDArray

#: Distance between two markers of a line, as a fraction of the panel's diagonal.
_MARK_EVERY = 0.1
#: An error below this fraction of the panel's range of values is thinner than its line.
_VISIBLE_ERROR = 0.004


def draw_lines(
    axes: Axes, panel: xr.Dataset, layout: FigureLayout, y: str, scale: ScalarMappable | None = None
) -> None:
    """Draw the curves of one panel.

    Parameters
    ----------
    axes
        The panel.
    panel
        Results over x and hue.
    layout, y
        What is drawn. A band around a curve shows its estimated error, where it is visible.
    scale
        Colours of the values of hue; without it the curves have the styles of the property cycle, and labels.
    """
    panel = panel.sortby(layout.x)
    x = panel[layout.x].values
    parts = [panel.isel({layout.hue: i}) for i in range(panel.sizes[layout.hue])] if layout.hue else [panel]
    curves, whole = [quantity(part, y) for part in parts], quantity(panel, y)
    visible = _VISIBLE_ERROR * float(whole.max() - whole.min())
    for part, curve in zip(parts, curves, strict=True):
        look: dict[str, Any] = {"markevery": _MARK_EVERY}
        if scale:
            look = {"color": scale.to_rgba(part[layout.hue].item()), "linestyle": "-", "marker": ""}
        elif layout.hue:
            look["label"] = place_words(layout.hue, part[layout.hue].item())
        if flag_words(curve):
            look["drawstyle"] = "steps-mid"
        (line,) = axes.plot(x, curve.values, **look)
        error = quantity_error(part, y)
        if error is not None and visible > 0.0 and np.any(error.values > visible):
            low, high = curve.values - error.values, curve.values + error.values
            axes.fill_between(x, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
        if layout.regimes:
            names, regime = panel.regime.attrs["flag_meanings"].split(), known_regime(part).values
            regimes = [names[int(value)] if np.isfinite(value) else None for value in regime]
            mark_regimes(axes, x, curve.values, regimes, line.get_color())
    _scale_axes(axes, x, whole, layout.x)


def _scale_axes(axes: Axes, x: NDArray[Any], values: xr.DataArray, name: str) -> None:
    """Set limits, logarithmic axes and ticks that suit the curves."""
    axes.set_xlim(float(x.min()), float(x.max()) if x.max() > x.min() else float(x.min()) + 1)
    words = flag_words(values)
    if words:
        axes.set_yticks(range(len(words)), words)
        axes.set_ylim(-0.5, len(words) - 0.5)
    if in_equal_ratios(x):
        axes.set_xscale("log")
        ratio = float(values.max()) / float(values.where(values > 0.0).min())
        if not words and float(values.min()) >= 0.0 and ratio > LOG_RATIO:
            axes.set_yscale("log")
    if AXES[name].units == "rad":
        tick_in_pi(axes.xaxis, float(x.min()), float(x.max()))
