"""Words and ticks of figures: quantities by their symbols, and numbers with units along axes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from swtstudy.points.values import as_number
from swtstudy.study.figure import reference
from swtstudy.vocabulary.choices import CRITERIA, SWT, family_of
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import ATTRIBUTES, EVERY_VARIABLE, attributes_of
from swtstudy.vocabulary.wording import as_text, pi_words, place_words


class Label(NamedTuple):
    """The scale, symbol and unit that a variable has of a real contact.

    Attributes
    ----------
    scale
        What 1 is worth.
    symbol
        Its symbol with a unit, as LaTeX.
    units
        Label of the unit; "1" for a plain number.
    """

    scale: float
    symbol: str
    units: str

    @property
    def unit(self) -> str:
        """The unit in words of a figure, after a blank."""
        return "" if self.units == "1" else f" {as_text(self.units)}"

    def number(self, value: float, digits: int = 4) -> str:
        """A value with its unit."""
        return f"{self.scale * value:.{digits}g}{self.unit}".replace("-", "−")


#: By the name of a variable.
Labels = Mapping[str, Label]
NO_LABELS: Labels = MappingProxyType({})

#: Width of a letter of a tick over the size of its font.
LETTER = 0.65


def quantity_words(values: xr.DataArray, y: str) -> str:
    """Label of the quantity that a figure's ``y`` names: symbol and unit.

    Parameters
    ----------
    values
        The quantity, as from `swtstudy.results.evaluate.quantity`.
    y
        Its name in the layout.
    """
    place = reference(y)
    if place is not None:
        name, value = place
        return f"$s$ / $s$({place_words(name, value if isinstance(value, str) else as_number(value))})"
    if values.name == "s":
        criterion = values.attrs.get("criterion", SWT)
        # With several criteria s is not one thing.
        return f"$s = {CRITERIA[criterion].over_unit}$" if criterion in CRITERIA else "$s$"
    symbol, units = (values.attrs.get(key) for key in ("symbol", "units"))
    # Arrays computed from a variable keep its symbol in xarray: it would be wrong for them.
    known = {name: attributes_of(name) for name in (*ATTRIBUTES, *EVERY_VARIABLE)}
    kept = any(symbol == row.get("symbol") for name, row in known.items() if name != values.name)
    words = str(values.name).replace("_", " ") if kept or not symbol else f"${symbol}$"
    # A symbol alone says too little of a life, a mean of SWT, a usage, a place.
    unfamiliar = "cycles", "FS_cycles", "failure_probability", "SWT_", "findley_usage", "critical_"
    if not kept and symbol and str(values.name).startswith(unfamiliar) and values.name != "critical_angle":
        meaning = str(values.attrs.get("long_name", values.name)).removesuffix(" x/a_H")
        words = f"{'load cycles to a crack' if is_life(values.attrs) else meaning}, {words}"
    return words if units in (None, "1") else f"{words} ({'°' if units == 'degree' else as_text(units)})"


def title_words(values: xr.DataArray, y: str) -> str:
    """The quantity in the title of a panel: its symbol."""
    if y.strip() == "s":
        return "$s$"
    words, found, symbol = quantity_words(values.assign_attrs(units="1"), y).partition("$")
    return f"${symbol}" if found else words.rpartition(", ")[2]


def parts_of(dataset: xr.Dataset, name: str | None) -> Iterator[tuple[str, xr.Dataset]]:
    """The parts of results at each value of a parameter, with its words; the whole without one.

    The words of a profile include its shape where that is fixed.
    """
    if name is None:
        yield "", dataset
    for part in (dataset.isel({name: i}) for i in range(dataset.sizes[name] if name else 0)):
        shape = family_of(part[name].item()).shape if name == "profile" else ()
        said = (str(name), *(each for each in shape if each in part.coords and part[each].ndim == 0))
        yield ", ".join(place_words(each, part[each].item(), part[each].attrs) for each in said), part


def is_life(attributes: Mapping[Any, Any]) -> bool:
    """Return whether a quantity with these attributes is a number of cycles, which people read in decades."""
    return str(attributes.get("symbol", "")).startswith("N")


def flag_words(values: xr.DataArray) -> list[str]:
    """The meanings of flags, in the order of their values from 0; empty if the values are not flags."""
    return [words.replace("_", " ") for words in values.attrs.get("flag_meanings", "").split()]


#: Most characters of all labels of the ticks across a panel.
MOST_ACROSS = 20


def show_units(axes: Axes, of: tuple[str | None, str | None], labels: Labels) -> None:
    """Label the axes of a panel, x and y, each with the unit of a variable, and tick round numbers of it."""
    for axis, name in zip((axes.xaxis, axes.yaxis), of, strict=True):
        if name is not None and name in labels:
            scale, symbol, _ = label = labels[name]
            low, high = sorted(end * scale for end in axis.get_view_interval())
            for most in (5, 3):
                ticks = MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
                inside = [tick for tick in ticks if low <= tick <= high]
                words = [f"{tick:.6g}".replace("-", "−") for tick in inside]
                if axis is axes.yaxis or sum(map(len, words)) <= MOST_ACROSS:
                    break
            axis.set_ticks([tick / scale for tick in inside], labels=words)
            axis.set_label_text(f"${symbol}$" + (f" ({label.unit.strip()})" if label.unit else ""))


def tick_angles(axis: Axis, values: xr.DataArray) -> None:
    """Put ticks at multiples of π along an axis of a parameter, if that is an angle."""
    if AXES[str(values.name)].units == "rad":
        tick_in_pi(axis, float(values.min()), float(values.max()))


def tick_in_pi(axis: Axis, low: float, high: float) -> None:
    """Put ticks at multiples of π/4, or at coarser ones over a long range."""
    turns = (high - low) / math.pi
    step = next((s for s in (0.25, 0.5) if turns <= 6 * s), float(max(1, math.ceil(turns / 6))))
    first, last = math.ceil(low / math.pi / step - 1e-9), math.floor(high / math.pi / step + 1e-9)
    places = [step * number for number in range(first, last + 1)]
    axis.set_ticks([math.pi * each for each in places], labels=[pi_words(Fraction(each)) for each in places])


def tick_in_ratios(axis: Axis, low: float, high: float) -> None:
    """Tick 1, 2 and 5 of each decade of a logarithmic axis of less than three decades.

    Where fewer than two of these lie on the axis, ticks are at even steps. Numbers above 1e5, and below its
    inverse, are written as powers of ten.
    """
    if high >= 1e3 * low or not low > 0.0:
        return  # matplotlib's ticks, at powers of ten
    powers = high >= 1e5 or low < 1e-5
    across = axis.axis_name == "x"  # type: ignore[attr-defined]
    digits = (1.0,) if powers and across and high >= 100.0 * low else (1.0, 2.0, 5.0)
    decades = np.arange(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    at = np.outer(10.0**decades, digits)
    few = np.sum((at >= low) & (at <= high)) < 2
    axis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]) if few else LogLocator(subs=digits))
    axis.set_major_formatter(FuncFormatter(lambda x, _: power_words(x) if powers else f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def power_words(value: float) -> str:
    """A number below 10 and a power of ten, such as 5·10⁶."""
    if value <= 0.0:
        return ""
    number, exponent = f"{value:.2e}".split("e")
    digits, power = f"{float(number):g}", f"10^{{{int(exponent)}}}"
    return f"${power}$" if digits == "1" else rf"${digits}\cdot{power}$"


def tick_names(axis: Axis, words: Sequence[str], most: int) -> None:
    """Put words at the places 0, 1, …, or at every second, third … where there is no room for more.

    The step with the shortest words is taken among steps that are about as long.
    """
    count, across, axes = len(words), axis.axis_name == "x", axis.axes  # type: ignore[attr-defined]
    width = 72.0 * axes.bbox.width / axes.figure.dpi  # of the layout so far, in points
    letters = int(width / (LETTER * FontProperties(size=rcParams["xtick.labelsize"]).get_size_in_points()))
    longest = {step: max(map(len, words[::step])) for step in range(1, 2 * count + 1)}
    room = {step: min(most, letters // (longest[step] + 2)) if across else most for step in longest}
    least = next((step for step in range(1, count) if -(-count // step) <= room[step]), count)
    step = min(range(least, 2 * least), key=longest.__getitem__)
    axis.set_ticks(range(0, count, step), labels=words[::step])


def tick_flags(axes: Axes, words: Sequence[str]) -> None:
    """Put a tick with its words at each of the flags up a panel, if there are any."""
    if words:
        axes.set_yticks(range(len(words)), words)
        axes.set_ylim(-0.5, len(words) - 0.5)
