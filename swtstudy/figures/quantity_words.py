"""Quantities of results as they appear in a figure: their names, and numbers with units along axes.

What is drawn without units may have axes whose numbers are lengths, forces or stresses.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from swtstudy.points.values import as_number
from swtstudy.study.figure import reference
from swtstudy.vocabulary.choices import CRITERIA, SWT, family_of
from swtstudy.vocabulary.quantities import EVERY_VARIABLE, QUANTITIES, attributes_of
from swtstudy.vocabulary.variables import ATTRIBUTES
from swtstudy.vocabulary.wording import as_text, place_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

_UNITS = {"degree": "°"}


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
        # Of several s is not one thing.
        return f"$s = {CRITERIA[criterion].over_unit}$" if criterion in CRITERIA else "$s$"
    symbol, units = (values.attrs.get(key) for key in ("symbol", "units"))
    # Arrays computed from a variable keep its symbol in xarray: it would be wrong for them.
    known = {**ATTRIBUTES, **{name: attributes_of(name) for name in EVERY_VARIABLE}}
    kept = any(symbol == row.get("symbol") for name, row in known.items() if name != values.name)
    words = str(values.name).replace("_", " ") if kept or not symbol else f"${symbol}$"
    if not kept and symbol and _is_unfamiliar(str(values.name)):
        words = f"{_meaning(values)}, {words}"
    return words if units in (None, "1") else f"{words} ({as_text(_UNITS.get(units, units))})"


def _is_unfamiliar(name: str) -> bool:
    """Return whether a symbol alone says too little: lives, means of SWT, usages, places."""
    known = "cycles", "FS_cycles", "failure_probability", "SWT_", "findley_usage", "critical_"
    return name.startswith(known) and name not in ("critical_angle",)


def _meaning(values: xr.DataArray) -> str:
    """Explain an unfamiliar symbol in a few words."""
    if is_life(values.attrs):
        return "load cycles to a crack"
    nonlocal_one = QUANTITIES.get(str(values.name).replace("SWT_", "s_"))
    if nonlocal_one:
        return nonlocal_one.meaning.replace("swt", "SWT")
    return str(values.attrs.get("long_name", values.name)).removesuffix(" x/a_H")


def title_words(values: xr.DataArray, y: str) -> str:
    """The quantity in the title of a panel: its symbol."""
    if y.strip() == "s":
        return "$s$"
    words, found, symbol = quantity_words(values.assign_attrs(units="1"), y).partition("$")
    return f"${symbol}" if found else words.rpartition(", ")[2]


def part_words(part: xr.Dataset, name: str) -> str:
    """Label a part of results by the value of a parameter; a profile with its shape where that is fixed.

    Parameters
    ----------
    part
        Results at one value.
    name
        The parameter.
    """
    shape = family_of(part[name].item()).shape if name == "profile" else ()
    fixed = [each for each in shape if each in part.coords and part[each].ndim == 0]
    return ", ".join(place_words(each, part[each].item(), part[each].attrs) for each in (name, *fixed))


def slices(dataset: xr.Dataset, name: str | None) -> list[xr.Dataset]:
    """The parts of a Dataset at each value of a dimension; the whole without one."""
    return [dataset] if name is None else [dataset.isel({name: i}) for i in range(dataset.sizes[name])]


def is_life(attributes: Mapping[Any, Any]) -> bool:
    """Return whether a quantity with these attributes is a number of cycles, which people read in decades."""
    return str(attributes.get("symbol", "")).startswith("N")


def flag_words(values: xr.DataArray) -> list[str]:
    """The meanings of flags, in the order of their values from 0; empty if the values are not flags."""
    return [words.replace("_", " ") for words in values.attrs.get("flag_meanings", "").split()]


#: Ticks of an axis at most.
_TICKS = 5


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

    def axis(self) -> str:
        """Label of an axis of it."""
        return f"${self.symbol}$" + (f" ({self.unit.strip()})" if self.unit else "")

    def number(self, value: float, digits: int = 4) -> str:
        """A value with its unit."""
        return f"{self.scale * value:.{digits}g}{self.unit}"


#: By the name of a variable.
Labels = Mapping[str, Label]
NO_LABELS: Labels = MappingProxyType({})


def show_units(axes: Axes, of: tuple[str | None, str | None], labels: Labels) -> None:
    """Label the axes of a panel, x and y, of which each is that of a variable or of none."""
    for axis, name in zip((axes.xaxis, axes.yaxis), of, strict=True):
        if name in labels:
            _show(axis, labels[name])  # type: ignore[index]


def _show(axis: Axis, label: Label) -> None:
    """Ticks at round numbers of the unit."""
    from matplotlib.ticker import MaxNLocator

    low, high = sorted(end * label.scale for end in axis.get_view_interval())
    ticks = MaxNLocator(_TICKS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    inside = [tick for tick in ticks if low <= tick <= high]
    axis.set_ticks([tick / label.scale for tick in inside], labels=[f"{tick:.6g}" for tick in inside])
    axis.set_label_text(label.axis())
