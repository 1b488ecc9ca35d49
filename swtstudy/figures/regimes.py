"""Marks where a regime of the contact begins along a line, and axes for long ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: What marks the point at which a regime begins; of "not_finite", the last point before it.
MARKS = {"stick": "D", "partial_slip": "^", "gross_slip": "o", "lift_off": "s", "not_finite": "x"}
_WORDS = {"not_finite": "not finite from here on", "lift_off": "lift-off begins"}
#: A logarithmic axis pays from this ratio of its ends on.
LOG_RATIO = 100.0


def mark_regimes(
    axes: Axes, x: NDArray[Any], s: NDArray[Any], regimes: list[str | None], colour: Any
) -> None:
    """Mark where the regimes of a line, one a point, change; None if not known."""
    for place in range(1, len(regimes)):
        before, name = regimes[place - 1 : place + 1]
        if name and before and name != before:
            at = place - 1 if name == "not_finite" else place
            words = _WORDS.get(name, f"{name.replace('_', ' ')} begins")
            style: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "none", "markersize": 5}
            axes.plot(x[at : at + 1], s[at : at + 1], marker=MARKS[name], color=colour, label=words, **style)


def in_equal_ratios(x: NDArray[Any]) -> bool:
    """Whether ascending values are spaced in equal ratios over a long range."""
    if len(x) < 3 or x[0] <= 0.0 or x[-1] < LOG_RATIO * x[0]:
        return False
    ratio = x[1:] / x[:-1]
    return bool(np.ptp(ratio) <= 1e-6 * ratio[0])
