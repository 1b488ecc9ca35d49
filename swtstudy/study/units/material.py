"""Materials of the bodies of a study, given there or by name from a file, and their critical distance.

From a threshold of crack growth and a fatigue limit that is L = (ΔK_th/Δσ_0)²/π.
"""

from __future__ import annotations

import logging
import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from swtstudy.points.values import read_exact
from swtstudy.study.units.at_rest import Moduli
from swtstudy.study.units.grid import ContactDetails
from swtstudy.study.units.life import FatigueConstants, ShearConstants
from swtstudy.study.units.rows import KNOWN, OF_BODIES, TABLES, Units, right_place, wrong_size
from swtstudy.vocabulary.files import parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import Report, literal, meant, nearest, plain_number
from swtstudy.vocabulary.parameters import SYMBOLS, spelled

#: ΔK_th in stress times √length, and Δσ_0: ranges, both at one ratio of least over largest stress.
LOAD_RATIO = "load_ratio"
_THRESHOLD = ("threshold_stress_intensity_range", "fatigue_limit_range", LOAD_RATIO)
#: Above which von Mises stress it yields; and what the Findley stress is compared with.
STRENGTH, LIMIT = "yield_strength", "findley_limit"
_YOUNG, _MODULUS = "young_modulus", "shear_modulus"
#: Properties by their keys: words for their values, and meanings. Both moduli are the body's unless given.
PROPERTIES: dict[str, dict[str, Any]] = TABLES["properties"]
#: Properties by what others call them, as one types it.
CALLED = SYMBOLS | {
    spelled(word): (key, word) for key, row in PROPERTIES.items() for word in row.get("called", ())
}
#: The other way: names from a file.
BY_NAME: dict[str, str] = TABLES["by_name"]
#: Keys that may stand in the table.
KEYS = (*PROPERTIES, *BY_NAME)
#: Keys of constants, and fields of shear constants by their keys.
TENSILE = tuple(item.name for item in fields(FatigueConstants))
SHEAR_CONSTANTS = {f"shear_{item.name.removeprefix('shear_')}": item.name for item in fields(ShearConstants)}
#: Properties that go together, of which the load ratio alone may be left out.
_TORSION = tuple(SHEAR_CONSTANTS)
_TOGETHER = (TENSILE, _TORSION, _THRESHOLD)
#: Values of metals, least and largest.
USUAL: dict[str, Any] = TABLES["usual"]

_log = logging.getLogger(__name__)
#: A table of a study.
Table = Mapping[str, Any]
#: Values of both bodies; none of what is not given, or wrong.
Both = Sequence[Any]


def read_given(
    units: Units, material: Table | None, fixed: Table, folder: Path, report: Report
) -> tuple[ContactDetails, float | None]:
    """Units and materials of a study, and the critical distance, None without a threshold.

    As far as they are sound: mistakes are reported.

    Parameters
    ----------
    units
        Labels of its units.
    material, fixed
        These tables.
    folder
        Folder of the study.
    report
        Called with key, found and allowed of each mistake.
    """
    if material is None:
        return ContactDetails(units), None
    # 0 for what is no positive number: 0 is not below NaN.
    young, poisson = (
        [max(0.0, plain_number(_number(each))) for each in two_of(fixed.get(name))] for name in OF_BODIES
    )
    moduli: dict[str, Both] = {}
    if _YOUNG in fixed:
        # A wrong one is reported elsewhere: meanwhile any stands for it.
        one, two = moduli[_YOUNG] = [each or 1.0 for each in young]
        if "poisson_ratio" in fixed:
            moduli[_MODULUS] = Moduli((one, two), (poisson[0], poisson[1])).shear
    found, distance = _read_material(material, moduli, units, folder, report)
    if all(young):
        warn_of_units(found, young)
    return found, distance


def two_of(value: object) -> list[Any]:
    """Values of both bodies."""
    return value if isinstance(value, list) and len(value) == 2 else [value, value]


def _read_material(
    raw: Table, moduli: Mapping[str, Both], units: Units, folder: Path, report: Report
) -> tuple[ContactDetails, float | None]:
    """The materials in a table, with Young's and shear moduli of the bodies where these are single values."""
    before, unknown = len(report), [name for name in raw if name not in KEYS]
    for name in unknown:
        report(f"material.{name}", f"unknown key {literal(name)}", right_place(str(name), KEYS, CALLED))
    tables = [{name: two_of(value)[body] for name, value in raw.items()} for body in range(2)]
    if BY_NAME.keys() & raw.keys():
        tables = _named(raw, folder, report)
    told = [key for key in PROPERTIES if any(key in table for table in tables)]
    # A misspelt key is not lacking, too.
    silent = {*told, *(meant(str(name), KEYS, CALLED) for name in unknown)} if tables else {*KEYS}
    values = {key: _both(key, tables, moduli.get(key), units, report) for key in told}
    groups = {group: [key for key in group if key in silent] for group in _TOGETHER}
    if not silent & {*PROPERTIES}:
        groups[TENSILE] = [*TENSILE]
    for group, there in groups.items():
        for key in group if there else ():
            if key not in silent and key not in moduli and key != LOAD_RATIO:
                why = f", beside {there[0]}" * (there[0] in silent)
                if key in (_YOUNG, _MODULUS):
                    why = ", since that of the bodies is no single value"
                report(f"material.{key}", "nothing", _allowed(key, units) + why)
    strengths = tuple(values.get(STRENGTH, ()))
    if len(report) > before or not tables:
        # A criterion may need the strengths: they are not lacking, too.
        return ContactDetails(units, yield_strengths=strengths), None
    known = {**moduli, **values}

    def of_both(make: Any, keys: tuple[str, ...]) -> tuple[Any, ...]:
        return tuple(make(*(known[key][k] for key in keys)) for k in range(2)) if groups[keys] else ()

    details = ContactDetails(
        units,
        materials=of_both(FatigueConstants, TENSILE),
        yield_strengths=strengths,
        shear_materials=of_both(ShearConstants, _TORSION),
        findley_limits=tuple(values.get(LIMIT, ())),
    )
    ranges = [values[name][0] for name in _THRESHOLD if name in values]
    return details, critical_distance(units, *ranges) if ranges else None


def _both(key: str, tables: list[dict[str, Any]], others: Both | None, units: Units, report: Report) -> Both:
    """A property of both bodies; none if there are mistakes, which are reported."""
    both = [_number(table.get(key, others and others[body])) for body, table in enumerate(tables)]
    allowed = _allowed(key, units)
    wrong = {each.found: each.allowed for value in both for each in wrong_size(key, value, allowed)}
    if key == LOAD_RATIO:
        wrong = {literal(each): allowed for each in both if not -math.inf < plain_number(each) < 1.0}
    if None in both:
        wrong = {"that of one body": "that of both bodies, or of none"}
    elif not wrong and key in _THRESHOLD and both[0] != both[1]:
        words = "one value: there is one critical distance for both bodies"
        wrong = {", ".join(map(literal, both)): words}
    for found, words in wrong.items():
        report(f"material.{key}", found, words)
    return () if wrong else [*map(plain_number, both)]


def _allowed(key: str, units: Units) -> str:
    """Words for the values that a property may have."""
    return str(PROPERTIES[key]["allowed"].format(units.stress))


def _number(raw: object) -> object:
    """A text such as "1/3" as the number that it stands for; others as they are."""
    try:
        return float(read_exact(raw)) if isinstance(raw, str) else raw
    except ValueError:
        return raw


def _named(raw: Table, folder: Path, report: Report) -> list[dict[str, Any]]:
    """The properties of both bodies by the names of their materials in a file."""
    others = sorted(raw.keys() & {*PROPERTIES})
    if others:
        report("material", f"a name and {', '.join(others)}", "constants, or file and name")
    file, names = raw.get("file"), two_of(raw.get("name"))
    if not isinstance(file, str):
        found = "nothing" if file is None else literal(file)
        report("material.file", found, "a TOML file with a table of each material")
        return []
    try:
        materials = parse_toml(read_text(folder / file))
    except (OSError, ValueError) as error:
        allowed = "a TOML file with a table of constants for each material"
        report("material.file", f"{literal(file)} ({reason_of(error)})", allowed)
        return []
    known = [name for name, table in materials.items() if isinstance(table, dict)]
    wrong = {str(name or ""): name for name in names if str(name or "") not in known}
    for word, name in wrong.items():
        found = "nothing" if name is None else literal(name)
        report("material.name", found, f"a material in {file}: {nearest(word, known)}")
    return [] if wrong or others else [materials[str(name)] for name in names]


def critical_distance(units: Units, intensity: float, limit: float, load_ratio: float | None = None) -> float:
    """L of a threshold and a fatigue limit, both ranges; a message tells it, a warning one of no metal."""
    length = (intensity / limit) ** 2 / math.pi
    ratio = "one load ratio" if load_ratio is None else f"the load ratio {load_ratio:g}"
    words = (
        f"critical_distance = {length:.4g} {units.length}, of the point method: (ΔK_th/Δσ_0)²/π with the "
        f"ranges {intensity:g} {units.stress}√{units.length} and {limit:g} {units.stress} at {ratio}"
    )
    metre, (least, largest) = KNOWN["length"].get(units.length), USUAL["critical_distance"]
    if metre is None or least <= metre * length <= largest:
        _log.info(words)
        return length
    words += f"; metals have {least / metre:g} to {largest / metre:g} {units.length}"
    if metre != 1.0:
        words += f": 1 {units.stress}√m is {metre**-0.5:.4g} {units.stress}√{units.length}"
    warnings.warn(words, stacklevel=2)
    return length


def warn_of_units(of: ContactDetails, young: Sequence[float], table: str = "material.") -> None:
    """Warn of constants that no metal has, alone or beside the modulus of its body: a unit is another one."""
    given = {
        "strength": [each.strength for each in of.materials],
        "shear_strength": [each.strength for each in of.shear_materials],
        STRENGTH: of.yield_strengths,
        LIMIT: of.findley_limits,
    }
    stress, (weakest, strongest) = of.units.stress or "one unit", USUAL["strain"]
    for name, values in given.items():
        for value, modulus in dict.fromkeys(zip(values, young, strict=False)):
            if not weakest <= value / modulus <= strongest:
                words = f"{table}{name} {value:g} over young_modulus {modulus:g} is {value / modulus:.3g}"
                words += f", of metals {weakest:g} to {strongest:g}"
                warnings.warn(f"{words}: are both in {stress}?", stacklevel=2)
    least, largest = USUAL["modulus_ratio"]
    for each, own in dict.fromkeys(zip(of.materials, young, strict=False)):
        ratio, strain = each.young_modulus / own, each.strength / own
        # With an unusual strength the body's modulus is the odd one, of which a warning has told.
        if weakest <= strain <= strongest and not least <= ratio <= largest:
            words = f"{table}young_modulus {each.young_modulus:g} is {ratio:.3g} times the body's {own:g}"
            warnings.warn(f"{words}: are both of one material, and in {stress}?", stacklevel=2)
    for name, (least, largest) in USUAL["constants"].items():
        for value in dict.fromkeys(getattr(each, name) for each in of.materials):
            if not least <= value <= largest:
                warnings.warn(f"{table}{name} {value:g}, of metals {least:g} to {largest:g}", stacklevel=2)
