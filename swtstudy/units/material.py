"""Materials of the bodies of a study, given there or by name from a file, and their critical distance.

From a threshold of crack growth and a fatigue limit that is L = (ΔK_th/Δσ_0)²/π.
"""

from __future__ import annotations

import logging
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from swtstudy.points.values import read_exact
from swtstudy.units.grid import ContactDetails
from swtstudy.units.life import FatigueConstants, ShearConstants
from swtstudy.units.rows import KNOWN, Units, wrong_size
from swtstudy.vocabulary.files import parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, literal, meant, nearest, plain_number

#: ΔK_th in stress times √length, and Δσ_0: ranges, both at one ratio of least over largest stress.
RANGES = ("threshold_stress_intensity_range", "fatigue_limit_range")
LOAD_RATIO = "load_ratio"
#: Critical distances of metals, in m: a few µm (hard steels) to about a mm (cast iron, mild steel).
USUAL = 1e-6, 3e-3


_log = logging.getLogger(__name__)

#: Constants of a material; Young's modulus is that of the body unless it is given.
CONSTANTS = tuple(item.name for item in fields(FatigueConstants))
#: Above which von Mises stress it yields.
STRENGTH = "yield_strength"
#: What the Findley stress is compared with.
LIMIT = "findley_limit"
#: Constants in torsion by their keys; the shear modulus is that of the body unless it is given.
SHEAR_CONSTANTS = {f"shear_{item.name.removeprefix('shear_')}": item.name for item in fields(ShearConstants)}
_YOUNG, _MODULUS = "young_modulus", "shear_modulus"
#: The shear constants that go together, and why a modulus is needed.
_FOUR = "all four shear constants of both bodies, or none, to have them estimated from tensile ones"
_SINGLE = ", since that of the bodies is no single value"
#: The other way: names from a file.
BY_NAME = ("file", "name")
#: What may stand in the table.
PROPERTIES = (*CONSTANTS, *SHEAR_CONSTANTS, STRENGTH, LIMIT, *RANGES, LOAD_RATIO)
KEYS = (*PROPERTIES, *BY_NAME)
_STRESSES = ("young_modulus", "strength", _MODULUS, "shear_strength", STRENGTH, LIMIT, "fatigue_limit_range")
_FILE = "a TOML file with a table of constants for each material"
#: Strengths over Young's modulus: metals are well within.
USUAL_STRAINS = 2e-4, 0.05
#: Constants of all metals are within these, and a percentage is not.
USUAL_CONSTANTS = {
    "strength_exponent": (-0.5, 0.0),
    "ductility": (1e-3, 5.0),
    "ductility_exponent": (-2.0, 0.0),
}
#: Of each body.
_BOTH = 2


def critical_distance(intensity: float, limit: float, load_ratio: float | None, units: Units) -> float:
    """L of a threshold and a fatigue limit, both ranges; a message tells it, a warning one of no metal."""
    length = (intensity / limit) ** 2 / math.pi
    ratio = "one load ratio, which load_ratio would name"
    if load_ratio is not None:
        ratio = f"the load ratio {load_ratio:g}"
    words = (
        f"critical_distance = {length:.4g} {units.length}, (ΔK_th/Δσ_0)²/π of ranges at {ratio}: "
        f"{intensity:g} {units.stress}√{units.length} and {limit:g} {units.stress}"
    )
    metre = KNOWN["length"].get(units.length)
    if metre is None or USUAL[0] <= metre * length <= USUAL[1]:
        _log.info(words)
        return length
    words += f"; metals have {USUAL[0] / metre:g} to {USUAL[1] / metre:g} {units.length}"
    if metre != 1.0:
        words += f": 1 {units.stress}√m is {metre**-0.5:.4g} {units.stress}√{units.length}"
    warnings.warn(words, stacklevel=2)
    return length


#: Moduli of both bodies, as far as they are single values.
_Moduli = tuple[object, object] | None
_Constants = TypeVar("_Constants", FatigueConstants, ShearConstants)


def read_material(
    raw: Mapping[str, Any], young: _Moduli, shear: _Moduli, units: Units, folder: Path, report: Report
) -> tuple[ContactDetails, float | None]:
    """Read the materials of both bodies, and their critical distance, None without a threshold.

    As far as they are sound: mistakes are reported.

    Parameters
    ----------
    raw
        The table: properties, each a value or one for each body; or the names of materials in a file.
    young, shear
        Young's and shear moduli of the bodies, None if they are not single values.
    units, folder
        Of the study.
    report
        Called with key, found and allowed of each mistake.
    """
    unknown = [name for name in raw if name not in KEYS]
    for name in unknown:
        report(f"material.{name}", f"unknown key {literal(name)}", nearest(str(name), KEYS))
    own = [{name: two_of(value)[body] for name, value in raw.items()} for body in range(_BOTH)]
    tables = _named(raw, folder, report) if {*BY_NAME} & raw.keys() else own
    told = [key for key in PROPERTIES if any(key in table for table in tables)]
    # What is misspelt is not lacking, too.
    silent = {*told, *(meant(str(name), KEYS) for name in unknown)} if tables else {*KEYS}
    before = len(report)
    moduli = {_YOUNG: young, _MODULUS: shear}
    values = {key: _both(key, tables, moduli.get(key), units, report) for key in told}
    own_fields = {name: name for name in CONSTANTS}
    tensile, torsion = own_fields.keys() & silent, SHEAR_CONSTANTS.keys() & {*told}
    if tensile or not silent & {*SHEAR_CONSTANTS, STRENGTH, LIMIT, *RANGES}:
        for key in (key for key in CONSTANTS if key not in silent and (key != _YOUNG or young is None)):
            report(f"material.{key}", "nothing", _allowed(key, units) + _SINGLE * (key == _YOUNG))
    lacking = [key for key in SHEAR_CONSTANTS if key not in silent and key != _MODULUS]
    if torsion and lacking:
        report(", ".join(f"material.{key}" for key in lacking), "nothing", _FOUR)
    elif torsion and shear is None and _MODULUS not in told:
        report(f"material.{_MODULUS}", "nothing", _allowed(_MODULUS, units) + _SINGLE)
    _check_ranges(values, units, report)
    strengths = values.get(STRENGTH) or ()
    if len(report) > before or unknown or not tables:
        # A criterion may need the strengths: they are not lacking, too.
        return ContactDetails(units, yield_strengths=strengths), None
    ranges = [values[name][0] for name in RANGES if name in values]
    ratio = values[LOAD_RATIO][0] if LOAD_RATIO in values else None
    details = ContactDetails(
        units,
        {},
        _of_both(FatigueConstants, own_fields, moduli | values) if tensile else (),
        yield_strengths=strengths,
        shear_materials=_of_both(ShearConstants, SHEAR_CONSTANTS, moduli | values) if torsion else (),
        findley_limits=values.get(LIMIT) or (),
    )
    return details, critical_distance(ranges[0], ranges[1], ratio, units) if ranges else None


def _both(
    key: str, tables: Sequence[Mapping[str, Any]], others: _Moduli, units: Units, report: Report
) -> tuple[float, ...]:
    """A property of both bodies; none if there are mistakes, which are reported."""
    both = [_number(table.get(key, others and others[body])) for body, table in enumerate(tables)]
    allowed, sign = _allowed(key, units), -1.0 if key.endswith("exponent") else 1.0
    wrong = dict.fromkeys(each for value in both for each in wrong_size(key, value, allowed, sign))
    if key == LOAD_RATIO:
        below = [-math.inf < plain_number(value) < 1.0 for value in both]
        wrong = {} if all(below) else {Mistake(key, literal(both[below.index(False)]), allowed): None}
    if None in both:
        words = _FOUR if key in SHEAR_CONSTANTS else "that of both bodies, or of none"
        wrong = {Mistake(key, "that of one body", words): None}
    elif not wrong and key in (*RANGES, LOAD_RATIO) and both[0] != both[1]:
        words = "one value: there is one critical distance for both bodies"
        wrong = {Mistake(key, ", ".join(map(literal, both)), words): None}
    for mistake in wrong:
        report(f"material.{key}", mistake.found, mistake.allowed)
    return () if wrong else tuple(map(plain_number, both))


def _check_ranges(values: Mapping[str, object], units: Units, report: Report) -> None:
    """Report a threshold without a fatigue limit, or the reverse."""
    for name, other in (RANGES, RANGES[::-1]):
        if name not in values and (other in values or LOAD_RATIO in values):
            report(f"material.{name}", "nothing", f"{_allowed(name, units)}, since there is {other}")


def _of_both(
    make: Callable[..., _Constants], fields_of: Mapping[str, str], values: Mapping[str, Any]
) -> tuple[_Constants, ...]:
    """Constants of both bodies, from fields by their keys."""
    return tuple(
        make(**{field: values[key][body] for key, field in fields_of.items()}) for body in range(_BOTH)
    )


def _allowed(key: str, units: Units) -> str:
    """Words for the values that a property may have."""
    if key == LOAD_RATIO:
        return "a number below 1: the least over the largest"
    if key.endswith("exponent"):
        return "a negative number"
    return f"a positive stress in {units.stress}" if key in _STRESSES else "a positive number"


def warn_of_units(of: ContactDetails, young: tuple[float, float]) -> None:
    """Warn of constants that no metal has, alone or beside the modulus of its body: a unit is another one."""
    given = {
        "strength": [each.strength for each in of.materials],
        "shear_strength": [each.strength for each in of.shear_materials],
        STRENGTH: of.yield_strengths,
        LIMIT: of.findley_limits,
    }
    for name, values in given.items():
        for value, modulus in dict.fromkeys(zip(values, young, strict=False)):
            if not USUAL_STRAINS[0] <= value / modulus <= USUAL_STRAINS[1]:
                words = f"material.{name} {value:g} over young_modulus {modulus:g} is {value / modulus:.3g}"
                ends = " to ".join(f"{end:g}" for end in USUAL_STRAINS)
                stress = of.units.stress or "one unit"
                warnings.warn(f"{words}, of metals {ends}: are both in {stress}?", stacklevel=2)
    for name, (least, largest) in USUAL_CONSTANTS.items():
        for value in dict.fromkeys(getattr(each, name) for each in of.materials):
            if not least <= value <= largest:
                warnings.warn(f"material.{name} {value:g}, of metals {least:g} to {largest:g}", stacklevel=2)


def _number(raw: object) -> object:
    """A text such as "1/3" as the number that it stands for; others as they are."""
    try:
        return float(read_exact(raw)) if isinstance(raw, str) else raw
    except ValueError:
        return raw


def two_of(value: object) -> list[Any]:
    """Values of both bodies."""
    return value if isinstance(value, list) and len(value) == _BOTH else [value, value]


def _named(raw: Mapping[str, Any], folder: Path, report: Report) -> list[dict[str, Any]]:
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
        report("material.file", f"{literal(file)} ({reason_of(error)})", _FILE)
        return []
    known = [name for name, table in materials.items() if isinstance(table, dict)]
    wrong = {str(name or ""): name for name in names if str(name or "") not in known}
    for word, name in wrong.items():
        found = "nothing" if name is None else literal(name)
        report("material.name", found, f"a material in {file}: {nearest(word, known)}")
    return [] if wrong or others else [materials[str(name)] for name in names]
