"""Ticks at fractions of π and at cells, as many as an axis has room for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, Locator, LogLocator, MaxNLocator, NullFormatter, ScalarFormatter

from swtstudy.vocabulary.wording import pi_words

#: An end of an axis is a multiple of π if it is relatively this close to it.
_TOLERANCE = 1e-9
#: Logarithmic axes with a smaller ratio of their ends have plain numbers.
_DECADES = 1e3
#: What is ticked of a decade; of fewer ticks than these so many are even steps.
_DIGITS, _FEW, _EVEN = (1.0, 2.0, 5.0), 2, 4
#: From this ratio of the ends on, powers of ten beside each other are whole: others would not have room.
_WHOLE = 100.0
#: Numbers from this on, and below one over it, are powers of ten, and all beside them on an axis.
_PLAIN = 1e5
#: Most steps between ticks, however long the axis.
_STEPS = 6
#: Width of a letter, and distance of two labels upwards, in em.
_LETTER, _UPWARDS = 0.62, 1.1
#: Largest denominator of a multiple of π that is ticked.
_DENOMINATOR = 4


class _Plain(ScalarFormatter):
    """Numbers as words: each that is a formula takes milliseconds to read."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        return super().__call__(x, pos).removeprefix(r"$\mathdefault{").removesuffix("}$")


def plain_ticks(axes: Axes) -> None:
    """Write the numbers at both axes as words, quicker to draw; the power at the end of an axis stays."""
    for axis in (axes.xaxis, axes.yaxis):
        if isinstance(axis.get_major_formatter(), ScalarFormatter):
            axis.set_major_formatter(_Plain())


def tick_in_pi(axis: Axis, low: float, high: float) -> None:
    """Put ticks at multiples of π/4, or at coarser ones over a long range or a short axis."""
    axis.set_major_locator(_InPi(low / math.pi, high / math.pi))
    axis.set_major_formatter(
        FuncFormatter(lambda x, _: pi_words(Fraction(x / math.pi).limit_denominator(_DENOMINATOR)))
    )


def tick_in_ratios(axis: Axis, low: float, high: float) -> None:
    """Put plain numbers at 1, 2, 5 of each decade of a logarithmic axis of few; even ones where few lie.

    Large and small ones are powers of ten; on an axis across, those of 1, 2, 5 of two decades have no room.
    """
    if high >= _DECADES * low or not low > 0.0:
        return
    powers = high >= _PLAIN or low < 1.0 / _PLAIN
    across = axis.axis_name == "x"  # type: ignore[attr-defined]
    whole = powers and across and high >= _WHOLE * low
    digits = (1.0,) if whole else _DIGITS
    if sum(low <= digit * 10.0**power <= high for power in _powers(low, high) for digit in digits) < _FEW:
        axis.set_major_locator(MaxNLocator(_EVEN, steps=[1, 2, 2.5, 5, 10]))
    else:
        axis.set_major_locator(LogLocator(subs=digits))
    axis.set_major_formatter(FuncFormatter(lambda x, _: power_words(x) if powers else f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def _powers(low: float, high: float) -> range:
    """Exponents of the decades between two numbers."""
    return range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)


def power_words(value: float) -> str:
    """A number below 10 and a power of ten, such as 5·10⁶."""
    if value <= 0.0:
        return ""
    exponent = math.floor(math.log10(value) + _TOLERANCE)
    digits = f"{value / 10.0**exponent:.3g}"
    power = f"10^{{{exponent}}}"
    return f"${power}$" if digits == "1" else rf"${digits}\cdot{power}$"


def tick_flags(axes: Axes, words: Sequence[str]) -> None:
    """Put a tick with its words at each of the flags up a panel, if there are any."""
    if words:
        axes.set_yticks(range(len(words)), words)
        axes.set_ylim(-0.5, len(words) - 0.5)


def tick_cells(axis: Axis, words: Sequence[str], most: int) -> None:
    """Put a tick with its words at each of the places 0, 1, …, or at some where there is no room for more."""
    axis.set_major_locator(_Cells(words, most))
    axis.set_major_formatter(FuncFormatter(lambda x, _: words[round(x)] if 0 <= x < len(words) else ""))


class _InPi(Locator):
    """Multiples of π between two ends, which are given in π."""

    def __init__(self, low: float, high: float) -> None:
        self.low, self.high = low, high

    def __call__(self) -> list[float]:
        span = self.high - self.low
        room = max(min(_STEPS, self.axis.get_tick_space()), 1)  # type: ignore[union-attr]
        step = next((s for s in (Fraction(1, 4), Fraction(1, 2), Fraction(1)) if span / s <= room), None)
        step = step or Fraction(math.ceil(span / room))
        first, last = math.ceil(self.low / step - _TOLERANCE), math.floor(self.high / step + _TOLERANCE)
        return [float(step * index) * math.pi for index in range(first, last + 1)]


class _Cells(Locator):
    """Every cell, or every second, third … one, with the shortest words that steps of this size give."""

    def __init__(self, words: Sequence[str], most: int) -> None:
        self.words, self.most = words, most

    def __call__(self) -> list[float]:
        least = next((step for step in range(1, len(self.words)) if self._fits(step)), len(self.words))
        step = min(range(least, 2 * least), key=self._longest)
        return [float(place) for place in range(0, len(self.words), step)]

    def _longest(self, step: int) -> int:
        return max(map(len, self.words[::step]))

    def _fits(self, step: int) -> bool:
        """Return whether labels have room; matplotlib counts 3 em for each across, and 2 upwards."""
        axis: Any = self.axis
        count = -(-len(self.words) // step)
        if axis.axis_name == "y":
            return count <= min(self.most, axis.get_tick_space() * 2.0 / _UPWARDS)
        return count <= min(self.most, axis.get_tick_space() * 3.0 / (_LETTER * self._longest(step) + 1.0))
