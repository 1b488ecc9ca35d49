"""A real contact as a table of a notebook."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.labelled import ATTRIBUTES
from swtstudy.points.margins import margins
from swtstudy.points.unique import unique_points
from swtstudy.units.labels import KINDS, Units
from swtstudy.units.rows import REST_DEPENDS_ON, rows
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.wording import place_words

if TYPE_CHECKING:
    from swtstudy.contacts.contact import PhysicalContact
    from swtstudy.units.grid import PhysicalGrid

#: What a contact is at rest, and what everything else is measured in.
_AT_REST = {
    "depth": "mean indentation depth δ0",
    "normal_force": "normal force F0",
    "contact_radius": "contact radius",
    "peak_pressure": "largest pressure",
    "length_scale": "a_H",
    "slip_scale": "μ E* δ0/G*, at which the whole contact slides",
    "stress_scale": "E* δ0/a_H",
}


def as_html(contact: PhysicalContact) -> str:
    """A table: what is given, the contact at rest, and the parameters without units of the first body."""
    body = "".join(
        f"<tr><td>{escape(kind)}</td><td><b>{escape(name)}</b></td><td>{escape(value)}</td>"
        f"<td>{escape(meaning)}</td></tr>"
        for kind, name, value, meaning in _rows(contact)
    )
    return f"<div><b>Real contact</b>, in any consistent set of units<table>{body}</table></div>"


def as_text(contact: PhysicalContact) -> str:
    """The same in lines: a name, its value and its meaning in columns."""
    rows = [*_rows(contact)]
    kinds, names, values = (max(len(row[column]) for row in rows) for column in range(3))
    return "\n".join(
        f"  {kind:<{kinds}}  {name:<{names}}  {value:>{values}}  {meaning}".rstrip()
        for kind, name, value, meaning in rows
    )


def headline(contact: PhysicalContact, body: int, at_rest: bool = False) -> str:
    """List what is given of one contact with symbols and units: of one of its bodies, or of it at rest."""
    grid = contact.grid
    words = {}
    for name, values in {"profile": grid.values("profile"), **_given(grid)}.items():
        if grid.row(name).part == "bulk" and body != grid.bulk_stress_body + 1:
            continue
        if at_rest and name not in REST_DEPENDS_ON:
            continue
        row = grid.row(name)
        value: Any = values[body - 1 if name in grid.pairs else 0]
        value = str(value) if row.kind == "name" else value
        words[name] = place_words(name, value, {"symbol": row.symbol, "units": row.units})
    return ",  ".join(words.values())


def _given(grid: PhysicalGrid) -> dict[str, tuple[Any, ...]]:
    """The values of what is given of contacts, but for what goes without saying."""
    values = {name: grid.pairs.get(name) or grid.values(name) for name in grid.rows if name != "body"}
    return {
        name: each
        for name, each in values.items()
        if each and not all(map(grid.row(name).goes_without_saying, each))
    }


def _rows(contact: PhysicalContact) -> Iterator[tuple[str, str, str, str]]:
    grid = contact.grid
    table = rows(Units(*(f"the unit of {kind}" for kind in KINDS)))
    for name, each in _given(grid).items():
        if name not in _AT_REST:
            yield "given", name, ", ".join(map(_value, each)), table[name].meaning
    for name, meaning in _AT_REST.items():
        found = np.unique(getattr(contact, name))
        yield "at rest", name, " to ".join(map(_value, dict.fromkeys((found[0], found[-1])))), meaning
    yield from _margins(grid)
    if grid.dims not in ((), ("body",)):
        return
    for name, value in contact.parameters(grid.bulk_stress_body + 1).items():
        if PARAMETERS[name].scale:
            yield "without units", name, _value(value), PARAMETERS[name].notation


def _margins(grid: PhysicalGrid) -> Iterator[tuple[str, str, str, str]]:
    """Say how far the contacts are from where the model ends, as far as that is known without solving."""
    for name, values in margins(unique_points(grid), grid).items():
        if name != "bulk_shift" and np.isfinite(values).any():
            yield "margin", name, f"up to {_value(float(np.nanmax(values)))}", ATTRIBUTES[name]["comment"]


def _value(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
