"""A panel of lines, with visible errors as bands, marks where a regime begins, and a colour scale."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps, rcParams
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, LogNorm, Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke
from numpy.typing import ArrayLike, NDArray

from swtstudy.figures.style import dots, stroke
from swtstudy.figures.words import flag_words, is_life, parts_of, tick_angles, tick_flags, tick_in_ratios
from swtstudy.results.evaluate import words_of
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.arrays import BoolArray, IndexArray
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.quantities import DISTANCE, QUANTITIES
from swtstudy.vocabulary.wording import axis_words

#: Markers at the point where a regime begins; a regime without s has it at the last point before.
_MARKERS = dict(zip(REGIMES, "D^osxX", strict=True))
#: Points of a line up to which each has a marker: between few points a line is not the curve.
_FEW = 10
#: A vertical axis over a logarithmic one is so, too, from this ratio of its ends: two decades.
_LOG_RATIO = 100.0


def in_equal_ratios(x: NDArray[Any]) -> bool:
    """Return whether ascending values have equal ratios, but for a few among them, and a decade at least."""
    if len(x) < 3 or x[0] <= 0.0 or x[-1] < 10.0 * x[0]:
        return False
    ratio = x[1:] / x[:-1]
    # A study may have a few values more where curves bend.
    return bool(np.mean(np.isclose(ratio, np.median(ratio), rtol=1e-6, atol=0.0)) >= 0.9)


def hue_scale(values: xr.DataArray) -> ScalarMappable | None:
    """Colours of many numerical values; None for few values, or for names."""
    if values.size < 8 or values.dtype.kind not in "fi":  # the property cycle has 7 colours
        return None
    known = np.sort(values.values)
    norm = (LogNorm if in_equal_ratios(known) else Normalize)(known[0], known[-1])
    # The lightest colours cannot be seen on white.
    colours = colormaps[rcParams["image.cmap"]](np.linspace(0.0, 0.9, 256))
    return ScalarMappable(norm, ListedColormap(colours))


def add_scale(figure: Figure, axes: NDArray[Any], scale: ScalarMappable, values: xr.DataArray) -> None:
    """Add the scale of `hue_scale` beside the panels of a figure."""
    bar = figure.colorbar(scale, ax=axes, label=axis_words(str(values.name), values.attrs), pad=0.02)
    tick_angles(bar.ax.yaxis, values)


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
        and ``late``, the ends of a band of lives; ``zone``, where the stick zone is, with a gap where that
        changes; and ``regime`` and ``outside``, if these are to be marked.
    y
        The quantity, as the layout names it.
    layout
        The layout: axes and their roles.
    scale
        Colours of the values of hue; without it the curves have the styles of the property cycle, and labels.
    """
    panel = panel.sortby(layout.x)
    parts = [*parts_of(panel, layout.hue)]
    for words, part in parts:
        look: dict[str, Any] = {"markevery": 0.1}
        if scale:
            look = stroke(scale.to_rgba(part[layout.hue].item()))
        elif words or "early" in part:
            look["label"] = words or "constants as given"
        _draw_line(axes, part, panel.value, y, layout, look)
    if not np.isfinite(panel.value).any():
        axes.text(0.5, 0.5, "no value", ha="center", va="center", color="0.3", transform=axes.transAxes)
    _scale_axes(axes, panel[layout.x], panel.value, layout)
    if layout.regimes:
        regimes = [words_of(part, "regime").values.tolist() for _, part in parts]
        _shade_without(axes, panel[layout.x].values, regimes)


def _draw_line(
    axes: Axes, part: xr.Dataset, whole: xr.DataArray, y: str, layout: FigureLayout, look: dict[str, Any]
) -> None:
    """One curve with its dots, marks and bands."""
    x, curve, upright = part[layout.x].values, part.value.values.astype(float), layout.kind == "life"
    jumps: dict[str, IndexArray] = {}
    if flag_words(whole):
        look["drawstyle"] = "steps-mid"
    elif may_jump(y):
        jumps["another maximum takes over"] = place_jumps(curve, y)
    if "zone" in part:
        jumps["another model of the stick zone"] = np.flatnonzero(np.diff(part.zone.values)) + 1
    gaps = np.unique(np.concatenate([np.array([], np.intp), *jumps.values()]))

    def turned(one: Any, other: Any) -> tuple[Any, Any]:
        return (other, one) if upright else (one, other)

    across, up = turned(np.insert(x.astype(float), gaps, np.nan), np.insert(curve, gaps, np.nan))
    (line,) = axes.plot(across, up, **look)
    colour = line.get_color()
    if len(x) <= _FEW:
        line.set_markevery(1)
        if line.get_marker() in ("", "None"):
            line.set(marker=".", markersize=1.6 * rcParams["lines.markersize"])
    for words, own in jumps.items():
        if ends := [*(own - 1), *own]:
            dot = dots(colour, 0.8, markerfacecolor="white", zorder=3)
            axes.plot(*turned(x[ends], curve[ends]), label=words, **dot)
    known = np.pad(np.isfinite(curve), 1)
    alone = known[1:-1] & ~known[:-2] & ~known[2:]  # which no line shows
    if alone.any():
        axes.plot(*turned(x[alone], curve[alone]), **dots(colour))
    if layout.validity:
        out = np.insert(part.outside.values, gaps, False)
        _mark_along(axes, across, up, out, part.outside.attrs["long_name"], line.get_drawstyle())
    # An error below this fraction of the panel's range of values is thinner than its line.
    visible = 0.004 * float(whole.max() - whole.min())
    if not upright and visible > 0.0 and "error" in part and np.any(part.error.values > visible):
        error = part.error.values
        axes.fill_between(x, curve - error, curve + error, color=colour, alpha=0.25, linewidth=0)
    if "early" in part:
        fill = axes.fill_betweenx if upright else axes.fill_between
        shade: dict[str, Any] = {"facecolor": to_rgba(colour, 0.18), "edgecolor": to_rgba(colour, 0.6)}
        fill(x, part.early.values, part.late.values, linewidth=0.6, label="10 to 90 % fail", **shade)
    if layout.regimes:
        _mark_regimes(axes, x, curve, words_of(part, "regime").values.tolist())


def may_jump(name: str) -> bool:
    """Return whether a quantity is the place of a maximum, or its plane: these jump where another takes over.

    The maximum itself does not, nor does the largest mean of all places.
    """
    place = name in QUANTITIES and QUANTITIES[name].is_place
    return place or name in ("critical_x", "critical_angle") or name.endswith("_position")


def place_jumps(curve: NDArray[Any], name: str) -> IndexArray:
    """Indices of the points of a curve that another maximum begins at.

    A step is a jump if it is a fair share of the largest value, which the steps of a tolerance are not, and
    much longer than steps beside it in its direction: a steep part of a curve has steps of its length there,
    a point between two jumps has not.
    """
    step = np.diff(curve)
    if name == "critical_angle":
        step = (step + 90.0) % 180.0 - 90.0  # a plane has no direction
    known = np.abs(curve[np.isfinite(curve)])
    if len(known) < 3:
        return np.array([], dtype=np.intp)
    before, after = np.append(0.0, step[:-1]), np.append(step[1:], 0.0)
    beside = np.fmax(np.fmax(before * np.sign(step), after * np.sign(step)), 0.0)
    return np.flatnonzero((np.abs(step) > 0.02 * known.max()) & (np.abs(step) > 3.0 * beside)) + 1


def _mark_regimes(axes: Axes, x: NDArray[Any], s: NDArray[Any], regimes: list[str]) -> None:
    """Mark the points of a line where the regime changes; there is one for each point, empty if unknown."""
    for place, (before, name) in enumerate(pairwise(regimes), 1):
        if name and before and name != before:
            at, begins = (place - 1, "from here on") if name in WITHOUT_S else (place, "begins")
            words = f"{name.replace('lift_off', 'lift-off').replace('_', ' ')} {begins}"
            # On white, above all lines, and in no line's colour: marks mean the same on every line.
            look = dots("0.25", 1.4, markerfacecolor="white", marker=_MARKERS[name])
            axes.plot([x[at]], [s[at]], zorder=4, label=words, **look)


def _shade_without(axes: Axes, x: NDArray[Any], regimes: list[list[str]]) -> None:
    """Shade the end of a panel where no line has a value, and say why; x is ascending."""
    without = np.array([all(name in WITHOUT_S for name in names) for names in zip(*regimes, strict=True)])
    if not without[-1] or without.all():
        return
    first, high = axes.set_xlim(axes.get_xlim())  # the shade would widen them
    low = float(x[np.flatnonzero(~without)[-1]])
    axes.axvspan(low, high, color="0.93", zorder=0)
    middle = (low * high) ** 0.5 if axes.get_xscale() == "log" else 0.5 * (low + high)
    words = " or ".join(dict.fromkeys(line[-1].replace("_", " ") for line in regimes))
    turn = 0 if high - low > 0.3 * (high - first) else 90
    look: dict[str, Any] = {"ha": "center", "va": "center", "color": "0.3", "fontsize": "small"}
    axes.text(middle, 0.5, words, rotation=turn, transform=axes.get_xaxis_transform(), **look)


def _mark_along(
    axes: Axes, x: NDArray[Any], y: NDArray[Any], outside: BoolArray, words: str, drawstyle: str
) -> None:
    """A grey band under the parts of a line that are outside of the model; of a single point a disc."""
    if not outside.any():
        return
    # Each point, and one close to it on the line: one point alone would have no band.
    line = np.stack([x, y]).astype(float)
    padded = np.pad(line, ((0, 0), (1, 1)), constant_values=np.nan)
    before, after = padded[:, :-2], padded[:, 2:]
    toward = np.where(np.isfinite(before).all(axis=0), before, 2.0 * line)  # of one between two breaks
    toward = np.where(np.isfinite(after).all(axis=0), after, toward)
    both = np.stack([line, line + 1e-3 * (toward - line)], axis=-1)
    band = np.where(outside[:, None], both, np.nan).reshape(2, -1)
    width = 4.5 * rcParams["lines.linewidth"]
    rim = [Stroke(linewidth=width + 1.6, foreground="0.45"), Normal()]
    look = stroke("0.9", linewidth=width, solid_capstyle="round", zorder=1.5, path_effects=rim)
    axes.plot(*band, drawstyle=drawstyle, label=words, **look)


def mark_points(axes: Axes, x: ArrayLike, y: ArrayLike, words: str) -> None:
    """White dots with a black rim, seen on dark and on light, on points that are outside of the model."""
    if np.size(x):
        look = dots("black", 0.8, markerfacecolor="white", markeredgewidth=0.6)
        axes.plot(x, y, label=words, zorder=4, **look)


def _scale_axes(axes: Axes, x: xr.DataArray, values: xr.DataArray, layout: FigureLayout) -> None:
    """Set limits, logarithmic axes and ticks that suit the curves; of lives x is upright."""
    upright = layout.kind == "life"
    own, other = ("y", "x") if upright else ("x", "y")
    low, high = float(x.min()), float(x.max())
    # Also where a line has no value; with room for the points of few.
    axes.update_datalim([(low, low), (high, high)], updatex=not upright, updatey=upright)
    margin = 0.03 if x.size <= _FEW else 0.0
    axes.margins(x=None if upright else margin, y=margin if upright else None)
    words = flag_words(values)
    if not upright:
        tick_flags(axes, words)
    least, most = float(values.where(values > 0.0).min()), float(values.max())
    positive = not words and float(values.min()) >= 0.0
    decades = upright or (is_life(values.attrs) and float(values.min()) > 0.0)
    if in_equal_ratios(x.values):
        axes.set(**{f"{own}scale": "log"})
        tick_in_ratios(getattr(axes, f"{own}axis"), low, high)
        decades |= positive and (most / least > _LOG_RATIO or layout.x == DISTANCE)
    if decades:
        axes.set(**{f"{other}scale": "log"})
        tick_in_ratios(getattr(axes, f"{other}axis"), least, most)
    tick_angles(getattr(axes, f"{own}axis"), x)
