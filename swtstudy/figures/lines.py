"""A panel of lines, with visible errors as bands, marks where a regime begins, and a colour scale."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps, rcParams
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, LogNorm, Normalize, to_rgba
from matplotlib.figure import Figure
from numpy.typing import NDArray

from swtstudy.figures.marks import mark_along
from swtstudy.figures.quantity_words import flag_words, is_life, part_words, slices
from swtstudy.figures.style import stroke
from swtstudy.figures.ticks import tick_flags, tick_in_pi, tick_in_ratios
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.choices import WITHOUT_S
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import DISTANCE, QUANTITIES
from swtstudy.vocabulary.wording import axis_words

#: Markers at the point where a regime begins; for those without s at the last point before.
MARKS = {
    "stick": "D",
    "partial_slip": "^",
    "gross_slip": "o",
    "lift_off": "s",
    "not_finite": "x",
    "no_equilibrium": "X",
}
_WORDS = {
    "not_finite": "not finite from here on",
    "no_equilibrium": "no equilibrium from here on",
    "lift_off": "lift-off begins",
}
#: A vertical axis over a logarithmic one is so, too, from this ratio of its ends: two decades.
LOG_RATIO = 100.0
#: Values in equal ratios make a logarithmic axis from this ratio of their ends: one decade.
_DECADE = 10.0
#: Where no line has a value: what is said there.
_WITHOUT = {"not_finite": "not finite", "no_equilibrium": "no equilibrium"}
#: Marks mean the same on every line: the legend shows them in no line's colour.
_GREY = "0.25"
#: Size of a mark over that of other markers.
_SIZE = 1.4
#: Words stand upright where they have less than this share of a panel.
_NARROW = 0.3
#: Relative difference of ratios that are equal but for the digits in which a study gives values.
_EQUAL = 1e-6
#: Share of ratios that are equal: a study may have a few values more where curves bend.
_MOST = 0.9


def mark_regimes(axes: Axes, x: NDArray[Any], s: NDArray[Any], regimes: list[str | None]) -> None:
    """Mark the points of a line where the regime changes; there is one for each point, None if unknown."""
    for place in range(1, len(regimes)):
        before, name = regimes[place - 1 : place + 1]
        if name and before and name != before:
            at = place - 1 if name in WITHOUT_S else place
            words = _WORDS.get(name, f"{name.replace('_', ' ')} begins")
            # On white and above all lines, or marks where these come together were buried.
            style: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "white", "zorder": 4}
            style["markersize"] = _SIZE * rcParams["lines.markersize"]
            axes.plot(x[at : at + 1], s[at : at + 1], marker=MARKS[name], color=_GREY, label=words, **style)


def shade_without(axes: Axes, x: NDArray[Any], regimes: list[list[str | None]]) -> None:
    """Shade the end of a panel where no line has a value, and say why.

    Parameters
    ----------
    axes
        The panel, with its limits.
    x
        Places in ascending order.
    regimes
        For each line those at the places; None if unknown.
    """
    without = np.array([all(name in WITHOUT_S for name in names) for names in zip(*regimes, strict=True)])
    if not without[-1] or without.all():
        return
    last = int(np.flatnonzero(~without)[-1])
    low, high = float(x[last]), axes.get_xlim()[1]
    axes.axvspan(low, high, color="0.93", zorder=0)
    middle = (low * high) ** 0.5 if axes.get_xscale() == "log" else 0.5 * (low + high)
    words = " or ".join(dict.fromkeys(_WITHOUT[str(line[-1])] for line in regimes))
    look: dict[str, Any] = {"ha": "center", "va": "center", "color": "0.3", "fontsize": "small"}
    wide = high - low > _NARROW * (high - axes.get_xlim()[0])
    transform = axes.get_xaxis_transform()
    axes.text(middle, 0.5, words, rotation=0 if wide else 90, transform=transform, **look)


def in_equal_ratios(x: NDArray[Any]) -> bool:
    """Return whether ascending values have equal ratios, but for a few among them, and a long range."""
    if len(x) < 3 or x[0] <= 0.0 or x[-1] < _DECADE * x[0]:
        return False
    ratio = x[1:] / x[:-1]
    usual = float(np.median(ratio))
    return bool(np.mean(np.abs(ratio - usual) <= _EQUAL * usual) >= _MOST)


#: From this number of lines a colour scale is used: the property cycle has 7 colours.
_MANY = 8
#: The lightest colours of a colour map cannot be seen on white: the scale ends at this fraction of it.
_END = 0.9


def hue_scale(values: xr.DataArray) -> ScalarMappable | None:
    """Colours of many numerical values; None for few values, or for names."""
    if values.size < _MANY or values.dtype.kind not in "fi":
        return None
    known = np.sort(values.values)
    norm = (LogNorm if in_equal_ratios(known) else Normalize)(known[0], known[-1])
    colours = colormaps[rcParams["image.cmap"]](np.linspace(0.0, _END, 256))
    return ScalarMappable(norm, ListedColormap(colours))


def add_scale(figure: Figure, axes: NDArray[Any], scale: ScalarMappable, values: xr.DataArray) -> None:
    """Add the colour bar of a parameter beside all panels."""
    bar = figure.colorbar(scale, ax=axes, label=axis_words(str(values.name), values.attrs), pad=0.02)
    if AXES[str(values.name)].units == "rad":
        tick_in_pi(bar.ax.yaxis, *bar.ax.get_ylim())


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
    axes: Axes, panel: xr.Dataset, y: str, layout: FigureLayout, scale: ScalarMappable | None
) -> None:
    """Draw the curves of one panel.

    Parameters
    ----------
    axes
        The panel.
    panel
        Over x and hue: ``value``; ``error``, which is a band around a curve where it is visible; ``early``
        and ``late``, the ends of a band of lives; and ``regime`` and ``outside``, if these are to be marked.
    y
        The quantity, as the layout names it.
    layout
        What goes where.
    scale
        Colours of the values of hue; without it the curves have the styles of the property cycle, and labels.
    """
    panel = panel.sortby(layout.x)
    x, whole = panel[layout.x].values, panel.value
    parts = slices(panel, layout.hue)
    visible = _VISIBLE_ERROR * float(whole.max() - whole.min())
    for part in parts:
        look: dict[str, Any] = {"markevery": _MARK_EVERY}
        if scale:
            look = stroke(scale.to_rgba(part[layout.hue].item()))
        elif layout.hue:
            look["label"] = part_words(part, layout.hue)
        if flag_words(whole):
            look["drawstyle"] = "steps-mid"
        curve = part.value.values
        gaps = _NONE
        if may_jump(y) and not flag_words(whole):
            with np.errstate(divide="ignore"):
                gaps = place_jumps(np.log(curve) if is_life(whole.attrs) else curve, y)
        at, broken = np.insert(x, gaps, np.nan), np.insert(curve.astype(float), gaps, np.nan)
        across, up = (broken, at) if layout.kind == "life" else (at, broken)
        (line,) = axes.plot(across, up, **look)
        ends = np.concatenate([gaps - 1, gaps])
        first, second = (curve, x) if layout.kind == "life" else (x, curve)
        _mark_jumps(axes, first[ends], second[ends], line.get_color())
        if len(alone := _alone(curve)):
            axes.plot(first[alone], second[alone], linestyle="none", marker="o", color=line.get_color())
        if layout.validity:
            out, words = np.insert(part.outside.values, gaps, False), part.outside.attrs["long_name"]
            mark_along(axes, across, up, out, words, line.get_drawstyle())
        banded = layout.kind != "life" and visible > 0.0 and "error" in part
        if banded and np.any(part.error.values > visible):
            low, high = curve - part.error.values, curve + part.error.values
            axes.fill_between(x, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
        if "early" in part:
            _fill_between(axes, part, x, line.get_color(), layout.kind == "life")
        if layout.regimes:
            mark_regimes(axes, x, curve, _names(part.regime))
    if not np.isfinite(whole).any():
        axes.text(0.5, 0.5, "no value", ha="center", va="center", color="0.3", transform=axes.transAxes)
    if layout.kind == "life":
        _scale_upright(axes, x, whole, layout.x)
        return
    _scale_axes(axes, x, whole, layout.x)
    if layout.regimes:
        shade_without(axes, x, [_names(part.regime) for part in parts])


def _fill_between(axes: Axes, part: xr.Dataset, x: NDArray[Any], colour: Any, upright: bool) -> None:
    """A band between the lives before which 10 and 90 % of the draws of constants fail."""
    fill = axes.fill_betweenx if upright else axes.fill_between
    look: dict[str, Any] = {"facecolor": to_rgba(colour, 0.18), "edgecolor": to_rgba(colour, 0.6)}
    fill(x, part.early.values, part.late.values, linewidth=0.6, label="10 to 90 % fail", **look)


def may_jump(name: str) -> bool:
    """Return whether a quantity belongs to the place of a maximum, which jumps where another one takes over.

    Places and planes themselves, and what is found about a place: means over a volume or a line.
    """
    row = QUANTITIES.get(name)
    about = ("_position", "_volume", "_point", "_line")
    known = name in ("critical_x", "critical_angle") or name.endswith(about)
    return known or (row is not None and row.is_place)


def place_jumps(curve: NDArray[Any], name: str) -> IndexArray:
    """Indices of the points of a curve that another maximum begins at.

    A step is a jump if it is a fair share of the range of the curve, and much longer than those beside it in
    its direction: a steep part of a curve has steps of its length there, a point between two jumps has not.
    """
    with np.errstate(invalid="ignore"):
        step = np.diff(curve)  # none of two infinite lives
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


def _alone(curve: NDArray[Any]) -> IndexArray:
    """Indices of the values with none beside them, which no line shows."""
    known = np.pad(np.isfinite(curve), 1)
    return np.flatnonzero(known[1:-1] & ~known[:-2] & ~known[2:])


def _names(regime: xr.DataArray) -> list[str | None]:
    """Regimes by name; None where unknown."""
    names = regime.attrs["flag_meanings"].split()
    return [names[int(value)] if np.isfinite(value) else None for value in regime.values]


def _ends(x: NDArray[Any]) -> tuple[float, float]:
    """Limits of the axis of x; a single value is in its middle."""
    low, high = float(x.min()), float(x.max())
    margin = 0.0 if high > low else 0.1 * abs(low) or 1.0
    return low - margin, high + margin


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
    tick_flags(axes, words)
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
