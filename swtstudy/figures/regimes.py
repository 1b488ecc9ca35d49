"""Marks where a regime of the contact begins along a line, and a test for logarithmic axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rcParams
from numpy.typing import NDArray

from swtstudy.mechanics.points import WITHOUT_S

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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
