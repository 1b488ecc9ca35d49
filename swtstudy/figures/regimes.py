"""Marks where a regime of the contact begins along a line, and a test for logarithmic axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
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
#: An axis is logarithmic from this ratio of its ends: two decades.
LOG_RATIO = 100.0
#: Relative difference of ratios that are equal but for the digits in which a study gives values.
_EQUAL = 1e-6


def mark_regimes(
    axes: Axes, x: NDArray[Any], s: NDArray[Any], regimes: list[str | None], colour: Any
) -> None:
    """Mark the points of a line where the regime changes; there is one for each point, None if unknown."""
    for place in range(1, len(regimes)):
        before, name = regimes[place - 1 : place + 1]
        if name and before and name != before:
            at = place - 1 if name in WITHOUT_S else place
            words = _WORDS.get(name, f"{name.replace('_', ' ')} begins")
            style: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "none", "markersize": 5}
            axes.plot(x[at : at + 1], s[at : at + 1], marker=MARKS[name], color=colour, label=words, **style)


def in_equal_ratios(x: NDArray[Any]) -> bool:
    """Whether ascending values have equal ratios, and a long range."""
    if len(x) < 3 or x[0] <= 0.0 or x[-1] < LOG_RATIO * x[0]:
        return False
    ratio = x[1:] / x[:-1]
    return bool(np.ptp(ratio) <= _EQUAL * ratio[0])
