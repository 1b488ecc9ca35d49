"""Units of the columns of a user's table, beside those of the study."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.study.units.rows import KNOWN, PER_LENGTH, UNIT_KINDS, Units, likely_units, unit_factor
from swtstudy.vocabulary.mistakes import Mistake, literal

if TYPE_CHECKING:
    from swtstudy.study.columns import UserTable


def unit_said(table: UserTable, name: str, kind: str) -> tuple[str, str]:
    """The unit of a column that its row of units or its header says, and its kind; empty if unknown.

    In a row of units or in brackets a unit of any kind counts, also one that is written in another way,
    elsewhere one of the kind asked for.
    """
    header, cell = table.said_of(name)
    texts = [cell.strip("[]() "), *map(str.strip, re.findall(r"[\[(]([^\[\]()]+)[\])]", header))]
    for text in texts:
        kinds = [each for each, known in KNOWN.items() if text in known]
        if kinds:
            return text, kind if kind in kinds else kinds[0]
    for text in texts:
        likely = [(unit, each) for each in UNIT_KINDS for unit in likely_units(each, text)]
        if len(likely) == 1:
            return likely[0]
    for text in (cell, header):
        words = re.findall(r"[A-Za-zµμ]+/[A-Za-zµμ]+$", text) + re.findall(r"[A-Za-zµμ]+", text)[-1:]
        for each in (PER_LENGTH, "force") if kind in (PER_LENGTH, "force") else (kind,):
            for word in (word for word in words if word in KNOWN[each] and word != "in"):
                return word, each
    return "", kind


def strange_unit(table: UserTable, name: str) -> str:
    """The cell in the row of units, or the text in square brackets in the header, of a column."""
    header, cell = table.said_of(name)
    bracket = re.search(r"\[([^\[\]]+)\]", header)
    text = cell.strip("[]() ") or (bracket[1].strip() if bracket else "")
    return text if any(map(str.isalpha, text)) else ""


def wrong_units(table: UserTable, kinds: Mapping[str, str | None], units: Units) -> list[Mistake]:
    """The mistakes of columns that have a kind, in other units than the study's; see `wrong_unit`."""
    labels = {
        name: (kind, "rad" if kind == "angle" else units.label(kind)) for name, kind in kinds.items() if kind
    }
    return [each for name, own in labels.items() for each in wrong_unit(table, name, *own)]


def different_units(table: UserTable, kinds: Mapping[str, str]) -> list[Mistake]:
    """The mistake of columns of one kind in different units, where no study says which unit is right."""
    scale, first = table.form.scale, dict[str, tuple[str, str]]()
    for name, kind in kinds.items():
        unit, own_kind = unit_said(table, name, kind)
        other, label = first.setdefault(own_kind, (name, unit)) if unit else (name, "")
        if not {name, other} & {*scale} and (factor := unit_factor(own_kind, unit, label)) != 1.0:
            found = f"{literal(table.form.header(name))} in {unit} beside {other} in {label}"
            return [Mistake("", found, f"scale = {{ {name} = {factor:g} }}: one unit for both", table.source)]
    return []


#: Other kinds that a number times the column may make the right one, and the factor.
_WAYS = {
    ("force", PER_LENGTH): "the length of the contact",
    (PER_LENGTH, "force"): "1 over the length of the contact; or contact_length, with which loads are forces",
    ("stress", "strain"): "Young's modulus times the unit of the strain",
    ("stress", "force"): "1 over the area of the section",
    **{(kind, "voltage"): "what a volt stands for" for kind in ("length", "force", PER_LENGTH, "stress")},
}


def wrong_unit(table: UserTable, name: str, kind: str, label: str) -> list[Mistake]:
    """The mistake of a column of another kind, in another unit than the study's, or scaled the wrong way.

    A unit that is not known is told.
    """
    kind = PER_LENGTH if kind == "force" and label in KNOWN[PER_LENGTH] else kind
    column, (unit, own_kind) = literal(table.form.header(name)), unit_said(table, name, kind)
    factor, own = unit_factor(kind, unit, label), table.form.scale.get(name)
    way = _WAYS.get((kind, own_kind), "")
    if label and own is None and not unit and (strange := strange_unit(table, name)):
        settled = f"; scale = {{ {name} = 1 }} says so" * table.has_keys
        words = f"the unit {strange} of {column} is not known: it is read as {label}{settled}"
        warnings.warn(f"{Path(table.source).name}: {words}", stacklevel=5)
    if own_kind != kind:
        if way and own is not None:
            return []
        found = f"{column} in {unit} as {name}, which is {_one(kind)}"
        allowed = f"a column with {_one(kind)}, not {_one(own_kind)}, "
        allowed += f"or scale = {{ {name} = … }}, {way}" if way and table.has_keys else "whatever its scale"
    elif factor == 1.0 or (own is not None and not math.isclose(abs(own) * factor, 1.0)):
        return []
    else:
        study = "angles are" if kind == "angle" else f"[units] has {kind}"
        found = f"{column} in {unit} as {name}, while {study} in {label}"
        found += "" if own is None else f", and scale has {name} = {own:g}"
        allowed = f"scale = {{ {name} = {factor:g} }}; {name} = 1 if the unit in the file is wrong"
        if not table.has_keys:
            allowed = f"a column in {label}: its values times {factor:g}"
    return [Mistake("", found, allowed, table.source)]


def _one(kind: str) -> str:
    """A kind with its article."""
    return f"an {kind}" if kind == "angle" else f"a {kind}"
