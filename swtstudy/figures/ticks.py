"""Ticks at fractions of π, of logarithmic axes and at cells, as many as an axis has room for."""

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
#: Most steps between ticks at multiples of π.
_STEPS = 6
#: Logarithmic axes with a larger ratio of their ends have matplotlib's ticks, at powers of ten.
_DECADES = 1e3
#: From this ratio of the ends on, powers of ten across a panel are whole: others would not have room.
_WHOLE = 100.0
#: Numbers above this, and below its inverse, are written as powers of ten.
_PLAIN = 1e5
#: Width of a letter, and distance of two labels upwards, in em.
_LETTER, _UPWARDS = 0.62, 1.1


class _Plain(ScalarFormatter):
    """Numbers as plain text: matplotlib takes milliseconds to typeset each formula."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        return super().__call__(x, pos).removeprefix(r"$\mathdefault{").removesuffix("}$")


def plain_ticks(axes: Axes) -> None:
    """Write the numbers at both axes as plain text, quicker to draw."""
    for axis in (axes.xaxis, axes.yaxis):
        if isinstance(axis.get_major_formatter(), ScalarFormatter):
            axis.set_major_formatter(_Plain())


def tick_in_pi(axis: Axis, low: float, high: float) -> None:
    """Put ticks at multiples of π/4, or at coarser ones over a long range."""
    low, high = low / math.pi, high / math.pi
    coarse = Fraction(max(1, math.ceil((high - low) / _STEPS)))
    step = next((s for s in (Fraction(1, 4), Fraction(1, 2)) if high - low <= _STEPS * s), coarse)
    first, last = math.ceil(low / step - _TOLERANCE), math.floor(high / step + _TOLERANCE)
    places = [step * index for index in range(first, last + 1)]
    axis.set_ticks([float(place) * math.pi for place in places], labels=[pi_words(each) for each in places])


def tick_in_ratios(axis: Axis, low: float, high: float) -> None:
    """Tick 1, 2 and 5 of each decade of a logarithmic axis of less than three decades.

    Where fewer than two of these lie on the axis, ticks are at even steps.
    """
    if high >= _DECADES * low or not low > 0.0:
        return
    powers = high >= _PLAIN or low < 1.0 / _PLAIN
    across = axis.axis_name == "x"  # type: ignore[attr-defined]
    digits = (1.0,) if powers and across and high >= _WHOLE * low else (1.0, 2.0, 5.0)
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    inside = [low <= digit * 10.0**power <= high for power in decades for digit in digits]
    few = sum(inside) < 2
    axis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]) if few else LogLocator(subs=digits))
    axis.set_major_formatter(FuncFormatter(lambda x, _: power_words(x) if powers else f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def power_words(value: float) -> str:
    """A number below 10 and a power of ten, such as 5·10⁶."""
    if value <= 0.0:
        return ""
    exponent = math.floor(math.log10(value) + _TOLERANCE)
    digits, power = f"{value / 10.0**exponent:.3g}", f"10^{{{exponent}}}"
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


class _Cells(Locator):
    """Every cell, or every second, third … one, with the shortest words that steps of this size give."""

    def __init__(self, words: Sequence[str], most: int) -> None:
        self.words, self.most = words, most

    def __call__(self) -> list[float]:
        axis: Any = self.axis
        longest = {step: max(map(len, self.words[::step])) for step in range(1, 2 * len(self.words))}

        def fits(step: int) -> bool:
            # matplotlib counts 3 em for each label across, and 2 upwards.
            em = axis.get_tick_space() * (2.0 if axis.axis_name == "y" else 3.0)
            room = em / (_UPWARDS if axis.axis_name == "y" else _LETTER * longest[step] + 1.0)
            return -(-len(self.words) // step) <= min(self.most, room)

        least = next(filter(fits, range(1, len(self.words))), len(self.words))
        step = min(range(least, 2 * least), key=longest.__getitem__)
        return [float(place) for place in range(0, len(self.words), step)]
