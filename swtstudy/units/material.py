"""Fatigue constants of the bodies of a study, given there or by name from a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from swtstudy.files import parse_toml, read_text
from swtstudy.grid.values import read_exact
from swtstudy.mistakes import Mistake, Report, StudyError, literal, meant, nearest
from swtstudy.units.labels import Units
from swtstudy.units.life import FatigueConstants

#: Constants of a material; Young's modulus is that of the body unless it is given.
CONSTANTS = tuple(item.name for item in fields(FatigueConstants))
#: The other way: names from a file.
BY_NAME = ("file", "name")
#: What may stand in the table.
KEYS = (*CONSTANTS, *BY_NAME)
_STRESSES = ("young_modulus", "strength")
_FILE = "a TOML file with a table of constants for each material"
#: Of each body.
_BOTH = 2


def read_material(
    raw: Mapping[str, Any], young: tuple[object, object] | None, units: Units, folder: Path, report: Report
) -> tuple[FatigueConstants, ...]:
    """The constants of both bodies; none if there are mistakes, which are reported.

    Parameters
    ----------
    raw
        The table: constants, each a value or one for each body; or the names of materials in a file.
    young
        Young's moduli of the bodies, None if they are not single values.
    units, folder
        Of the study.
    report
        Called with key, found and allowed of each mistake.
    """
    unknown = [name for name in raw if name not in KEYS]
    for name in unknown:
        report(f"material.{name}", f"unknown key {literal(name)}", nearest(str(name), KEYS))
    by_name = bool({*BY_NAME} & raw.keys())
    tables = _named(raw, folder, report) if by_name else [_of_body(raw, i) for i in range(_BOTH)]
    intended = {meant(str(name), KEYS) for name in unknown}
    found: list[FatigueConstants] = []
    said: dict[tuple[str, str, str], None] = {}
    for body, table in enumerate(tables):
        own: dict[str, Any] = {name: _number(table.get(name)) for name in CONSTANTS}
        if own["young_modulus"] is None and young is not None:
            own["young_modulus"] = young[body]
        try:
            found.append(FatigueConstants(**own))
        except StudyError as error:
            # Both bodies may have the same mistake; what is misspelt is not lacking, too.
            wrong = (each for each in error.mistakes if own[each.key] is not None or each.key not in intended)
            said |= {_in_units(each, own[each.key] is None, units): None for each in wrong}
    for words in said:
        report(*words)
    return tuple(found) if len(found) == _BOTH and not said and not unknown else ()


def _in_units(mistake: Mistake, lacks: bool, units: Units) -> tuple[str, str, str]:
    """Key, found and allowed of a mistake in the constants."""
    allowed = mistake.allowed
    if mistake.key in _STRESSES:
        allowed = allowed.replace("number", f"stress in {units.stress}", 1)
    if mistake.key == "young_modulus" and lacks:
        allowed += ", since that of the bodies is no single value"
    return f"material.{mistake.key}", "nothing" if lacks else mistake.found, allowed


def _number(raw: object) -> object:
    """A text such as "1/3" as the number that it stands for; others as they are."""
    try:
        return float(read_exact(raw)) if isinstance(raw, str) else raw
    except ValueError:
        return raw


def _of_body(raw: Mapping[str, Any], body: int) -> dict[str, Any]:
    """The constants of one body."""
    return {
        name: value[body] if isinstance(value, list) and len(value) == _BOTH else value
        for name, value in raw.items()
    }


def _named(raw: Mapping[str, Any], folder: Path, report: Report) -> list[dict[str, Any]]:
    """The constants of both bodies by the names of their materials in a file."""
    others = sorted(raw.keys() & {*CONSTANTS})
    if others:
        report("material", f"a name and {', '.join(others)}", "constants, or file and name")
    file, names = raw.get("file"), raw.get("name")
    names = names if isinstance(names, list) and len(names) == _BOTH else [names, names]
    if not isinstance(file, str):
        report(
            "material.file",
            "nothing" if file is None else literal(file),
            "a TOML file with a table of each material",
        )
        return []
    try:
        materials = parse_toml(read_text(folder / file))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        report("material.file", f"{literal(file)} ({reason})", _FILE)
        return []
    known = [name for name, table in materials.items() if isinstance(table, dict)]
    wrong = [name for name in dict.fromkeys(map(str, names)) if name not in known]
    for name in wrong:
        report("material.name", literal(name), f"a material in {file}: {nearest(name, known)}")
    return [] if wrong or others else [materials[name] for name in names]
