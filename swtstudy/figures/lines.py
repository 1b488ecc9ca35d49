"""A panel of lines, with error bands where these are visible."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rcParams

from swtstudy.figures.outside import mark_along
from swtstudy.figures.quantity_words import flag_words, is_life, part_words
from swtstudy.figures.regimes import LOG_RATIO, in_equal_ratios, mark_regimes, shade_without
from swtstudy.figures.ticks import tick_in_pi, tick_in_ratios
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.quantities import DISTANCE, QUANTITIES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from numpy.typing import NDArray

#: Distance between two markers of a line, as a fraction of the panel's diagonal.
_MARK_EVERY = 0.1
#: An error below this fraction of the panel's range of values is thinner than its line.
_VISIBLE_ERROR = 0.004
#: A step of a place is a jump from this share of its range, if it is so many times those beside it.
_FAIR_SHARE, _LONGER = 0.02, 3.0
_NONE = np.array([], dtype=np.intp)
#: The plane of a normal at this angle, in degrees, is that at 0.
_HALF_TURN = 180.0


def draw_lines(
    axes: Axes, panel: xr.Dataset, y: str, layout: FigureLayout, scale: ScalarMappable | None = None
) -> None:
    """Draw the curves of one panel.

    Parameters
    ----------
    axes
        The panel.
    panel
        Over x and hue: ``value``; ``error``, which is a band around a curve where it is visible; and
        ``regime`` and ``outside``, if these are to be marked.
    y
        The quantity, as the layout names it.
    layout
        What goes where.
    scale
        Colours of the values of hue; without it the curves have the styles of the property cycle, and labels.
    """
    panel = panel.sortby(layout.x)
    x, whole = panel[layout.x].values, panel.value
    parts = [panel.isel({layout.hue: i}) for i in range(panel.sizes[layout.hue])] if layout.hue else [panel]
    visible = _VISIBLE_ERROR * float(whole.max() - whole.min())
    for part in parts:
        look: dict[str, Any] = {"markevery": _MARK_EVERY}
        if scale:
            look = {"color": scale.to_rgba(part[layout.hue].item()), "linestyle": "-", "marker": ""}
        elif layout.hue:
            look["label"] = part_words(part, layout.hue)
        if flag_words(whole):
            look["drawstyle"] = "steps-mid"
        curve = part.value.values
        gaps = _NONE
        if may_jump(y) and not flag_words(whole):
            gaps = place_jumps(np.log(curve) if is_life(whole.attrs) else curve, y)
        at, broken = np.insert(x, gaps, np.nan), np.insert(curve.astype(float), gaps, np.nan)
        across, up = (broken, at) if layout.kind == "life" else (at, broken)
        (line,) = axes.plot(across, up, **look)
        ends = np.concatenate([gaps - 1, gaps])
        dots = (curve[ends], x[ends]) if layout.kind == "life" else (x[ends], curve[ends])
        _mark_jumps(axes, *dots, line.get_color())
        if layout.validity:
            out, words = np.insert(part.outside.values, gaps, False), part.outside.attrs["long_name"]
            mark_along(axes, across, up, out, words, line.get_drawstyle())
        banded = layout.kind != "life" and visible > 0.0 and "error" in part
        if banded and np.any(part.error.values > visible):
            low, high = curve - part.error.values, curve + part.error.values
            axes.fill_between(x, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
        if layout.regimes:
            mark_regimes(axes, x, curve, _names(part.regime))
    if layout.kind == "life":
        _scale_upright(axes, x, whole, layout.x)
        return
    _scale_axes(axes, x, whole, layout.x)
    if layout.regimes:
        shade_without(axes, x, [_names(part.regime) for part in parts])


def may_jump(name: str) -> bool:
    """Return whether a quantity belongs to the place of a maximum, which jumps where another one takes over.

    Places and planes themselves, and what is found about a place: means over a volume or a line.
    """
    row = QUANTITIES.get(name)
    about = ("_position", "_volume", "_point", "_line")
    known = name in ("critical_x", "critical_angle") or name.endswith(about)
    return known or (row is not None and row.is_place)


def place_jumps(curve: NDArray[Any], name: str) -> NDArray[np.intp]:
    """Indices of the points of a curve that another maximum begins at.

    A step is a jump if it is a fair share of the range of the curve, and much longer than those beside it in
    its direction: a steep part of a curve has steps of its length there, a point between two jumps has not.
    """
    step = np.diff(curve)
    if name == "critical_angle":
        step = (step + _HALF_TURN / 2) % _HALF_TURN - _HALF_TURN / 2  # a plane has no direction
    known = curve[np.isfinite(curve)]
    if len(known) < 3:
        return _NONE
    before, after = np.append(0.0, step[:-1]), np.append(step[1:], 0.0)
    beside = np.fmax(np.fmax(before * np.sign(step), after * np.sign(step)), 0.0)
    jump = (np.abs(step) > _FAIR_SHARE * np.ptp(known)) & (np.abs(step) > _LONGER * beside)
    return np.flatnonzero(jump) + 1


def _mark_jumps(axes: Axes, across: NDArray[Any], up: NDArray[Any], colour: Any) -> None:
    """Open dots at both ends of each gap."""
    if len(across):
        size = 0.8 * rcParams["lines.markersize"]
        look: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": size, "zorder": 3}
        axes.plot(across, up, color=colour, markerfacecolor="white", **look)


def _names(regime: xr.DataArray) -> list[str | None]:
    """Regimes by name; None where unknown."""
    names = regime.attrs["flag_meanings"].split()
    return [names[int(value)] if np.isfinite(value) else None for value in regime.values]


def _ends(x: NDArray[Any]) -> tuple[float, float]:
    """Limits of the axis of x, also of a single value."""
    return float(x.min()), float(x.max()) if x.max() > x.min() else float(x.min()) + 1


def _scale_upright(axes: Axes, x: NDArray[Any], values: xr.DataArray, name: str) -> None:
    """Limits and ticks of a panel whose upright axis is x, over a logarithmic one of the values."""
    axes.set_xscale("log")
    tick_in_ratios(axes.xaxis, float(values.where(values > 0.0).min()), float(values.max()))
    axes.set_ylim(*_ends(x))
    if in_equal_ratios(x):
        axes.set_yscale("log")
        tick_in_ratios(axes.yaxis, float(x[0]), float(x[-1]))
    if AXES[name].units == "rad":
        tick_in_pi(axes.yaxis, float(x.min()), float(x.max()))


def _scale_axes(axes: Axes, x: NDArray[Any], values: xr.DataArray, name: str) -> None:
    """Set limits, logarithmic axes and ticks that suit the curves."""
    axes.set_xlim(*_ends(x))
    words = flag_words(values)
    if words:
        axes.set_yticks(range(len(words)), words)
        axes.set_ylim(-0.5, len(words) - 0.5)
    if in_equal_ratios(x):
        axes.set_xscale("log")
        tick_in_ratios(axes.xaxis, float(x[0]), float(x[-1]))
        ratio = float(values.max()) / float(values.where(values > 0.0).min())
        if not words and float(values.min()) >= 0.0 and (ratio > LOG_RATIO or name == DISTANCE):
            axes.set_yscale("log")
    if is_life(values.attrs) and float(values.min()) > 0.0:
        axes.set_yscale("log")
    if axes.get_yscale() == "log":
        tick_in_ratios(axes.yaxis, float(values.where(values > 0.0).min()), float(values.max()))
    if AXES[name].units == "rad":
        tick_in_pi(axes.xaxis, float(x.min()), float(x.max()))
