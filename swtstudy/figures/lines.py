"""A panel of lines, with their errors where these can be seen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.figures.words import place_words, tick_in_pi
from swtstudy.parameters import PARAMETERS
from swtstudy.results.normalise import normalised, normalised_error
from swtstudy.study.figure import FigureLayout

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Markers, where a line has them, are so far apart, as a share of the panel's diagonal.
_MARK_EVERY = 0.1
#: An error below this share of the panel's range of values is thinner than its line.
_VISIBLE_ERROR = 0.004


def draw_lines(axes: Axes, panel: xr.Dataset, layout: FigureLayout, y: str) -> None:
    """Draw the curves of one panel; a band around a curve is its estimated error, where it can be seen."""
    curves, errors = normalised(panel, y), normalised_error(panel, y)
    order = np.argsort(panel[layout.x].values)
    x = panel[layout.x].values[order]
    visible = _VISIBLE_ERROR * float(curves.max() - curves.min())
    for index in range(curves.sizes[layout.hue] if layout.hue else 1):
        curve, error, words = curves, errors, None
        if layout.hue:
            curve, error = (values.isel({layout.hue: index}) for values in (curves, errors))
            words = place_words(layout.hue, curve[layout.hue].item())
        s, half = curve.values[order], error.values[order]
        (line,) = axes.plot(x, s, label=words, markevery=_MARK_EVERY)
        if visible > 0.0 and np.any(half > visible):
            axes.fill_between(x, s - half, s + half, color=line.get_color(), alpha=0.25, linewidth=0)
    axes.set_xlim(float(x.min()), float(x.max()) if x.max() > x.min() else float(x.min()) + 1)
    if PARAMETERS[layout.x].units == "rad":
        tick_in_pi(axes.xaxis, float(x.min()), float(x.max()))
