"""Quantities of results as they appear in a figure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from swtstudy.points.labelled import ATTRIBUTES
from swtstudy.points.values import as_number
from swtstudy.study.figure import reference
from swtstudy.vocabulary.criteria import SWT, SYMBOLS
from swtstudy.vocabulary.families import family_of
from swtstudy.vocabulary.quantities import QUANTITIES, attributes_of, every_variable
from swtstudy.vocabulary.wording import as_text, place_words

if TYPE_CHECKING:
    import xarray as xr

_UNITS = {"degree": "°"}


def quantity_words(values: xr.DataArray, y: str) -> str:
    """Label of the quantity that a figure's ``y`` names: symbol and unit.

    Parameters
    ----------
    values
        The quantity, as from `swtstudy.results.quantity.quantity`.
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
        return f"$s = {SYMBOLS[criterion]}$" if criterion in SYMBOLS else "$s$"
    symbol, units = (values.attrs.get(key) for key in ("symbol", "units"))
    # Arrays computed from a variable keep its symbol in xarray: it would be wrong for them.
    known = {**ATTRIBUTES, **{name: attributes_of(name) for name in every_variable()}}
    kept = any(symbol == row.get("symbol") for name, row in known.items() if name != values.name)
    words = str(values.name).replace("_", " ") if kept or not symbol else f"${symbol}$"
    if not kept and symbol and _is_unfamiliar(str(values.name)):
        words = f"{_meaning(values)}, {words}"
    return words if units in (None, "1") else f"{words} ({as_text(_UNITS.get(units, units))})"


def _is_unfamiliar(name: str) -> bool:
    """Return whether a symbol alone says too little: lives, means of SWT, usages, places."""
    known = "cycles", "FS_cycles", "SWT_", "findley_usage", "critical_"
    return name.startswith(known) and name not in ("critical_angle",)


def _meaning(values: xr.DataArray) -> str:
    """Explain an unfamiliar symbol in a few words."""
    if is_life(values.attrs):
        return "rounds to a crack"
    nonlocal_one = QUANTITIES.get(str(values.name).replace("SWT_", "s_"))
    if nonlocal_one:
        return nonlocal_one.meaning.replace("swt", "SWT")
    return str(values.attrs.get("long_name", values.name)).removesuffix(" x/a_H")


def title_words(values: xr.DataArray, y: str) -> str:
    """The quantity in the title of a panel: its symbol."""
    if y.strip() == "s":
        return "$s$"
    return quantity_words(values.assign_attrs(units="1"), y).rpartition(", ")[2]


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


def is_life(attributes: Mapping[Any, Any]) -> bool:
    """Return whether a quantity with these attributes is a number of cycles, which people read in decades."""
    return str(attributes.get("symbol", "")).startswith("N")


def flag_words(values: xr.DataArray) -> list[str]:
    """The meanings of flags, in the order of their values from 0; empty if the values are not flags."""
    return [words.replace("_", " ") for words in values.attrs.get("flag_meanings", "").split()]
