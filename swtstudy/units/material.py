"""Materials of the bodies of a study, given there or by name from a file, and their critical distance.

From a threshold of crack growth and a fatigue limit that is L = (ΔK_th/Δσ_0)²/π.
"""

from __future__ import annotations

import logging
import math
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

from swtstudy.points.values import read_exact
from swtstudy.units.grid import ContactDetails
from swtstudy.units.labels import KNOWN, Units, wrong_size
from swtstudy.units.life import FatigueConstants, ShearConstants
from swtstudy.vocabulary.files import parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, meant, nearest, plain_number

#: ΔK_th in stress times √length, and Δσ_0: ranges, both at one ratio of least over largest stress.
RANGES = ("threshold_stress_intensity_range", "fatigue_limit_range")
LOAD_RATIO = "load_ratio"
#: Critical distances of metals, in m: a few µm (hard steels) to about a mm (cast iron, mild steel).
USUAL = 1e-6, 3e-3


@dataclass(frozen=True)
class CriticalDistance:
    """A critical distance from a threshold and a fatigue limit.

    Attributes
    ----------
    intensity, limit
        Both ranges.
    load_ratio
        At which both were found; None if it is not said.
    """

    intensity: float
    limit: float
    load_ratio: float | None = None

    @property
    def length(self) -> float:
        """L."""
        return (self.intensity / self.limit) ** 2 / math.pi

    def words(self, units: Units) -> tuple[bool, str]:
        """Check whether a metal may have a critical distance, and describe it."""
        ratio = "one load ratio, which load_ratio would name"
        if self.load_ratio is not None:
            ratio = f"the load ratio {self.load_ratio:g}"
        found = (
            f"critical_distance = {self.length:.4g} {units.length}, (ΔK_th/Δσ_0)²/π of ranges at {ratio}: "
            f"{self.intensity:g} {units.stress}√{units.length} and {self.limit:g} {units.stress}"
        )
        metre = KNOWN["length"].get(units.length)
        if metre is None or USUAL[0] <= metre * self.length <= USUAL[1]:
            return True, found
        words = f"{found}; metals have {USUAL[0] / metre:g} to {USUAL[1] / metre:g} {units.length}"
        if metre != 1.0:
            words += f": 1 {units.stress}√m is {metre**-0.5:.4g} {units.stress}√{units.length}"
        return False, words


def critical_distance(tables: Sequence[Mapping[str, Any]], report: Report) -> CriticalDistance | None:
    """That of the properties of both bodies; None without them, or with mistakes, which are added."""
    given = [[table.get(name) for name in (*RANGES, LOAD_RATIO)] for table in tables]
    one = given[0]
    if all(value is None for each in given for value in each):
        return None
    found: list[Mistake] = []
    for name, *values in zip((*RANGES, LOAD_RATIO), *given, strict=True):
        if values[0] != values[1]:
            allowed = "one value: there is one critical distance for both bodies"
            found.append(Mistake(name, ", ".join(map(literal, values)), allowed))
        elif name == LOAD_RATIO:
            if values[0] is not None and not -math.inf < plain_number(values[0]) < 1.0:
                found.append(
                    Mistake(name, literal(values[0]), "a number below 1: the least over the largest")
                )
        elif values[0] is None:
            other = RANGES[1 - RANGES.index(name)]
            found.append(Mistake(name, "nothing", f"a positive number, since there is {other}"))
        else:
            found += wrong_size(name, values[0], "a positive number")
    report += found
    if found:
        return None
    ratio = None if one[2] is None else plain_number(one[2])
    return CriticalDistance(plain_number(one[0]), plain_number(one[1]), ratio)


_log = logging.getLogger(__name__)

#: Constants of a material; Young's modulus is that of the body unless it is given.
CONSTANTS = tuple(item.name for item in fields(FatigueConstants))
#: Above which von Mises stress it yields.
STRENGTH = "yield_strength"
#: What the Findley stress is compared with.
LIMIT = "findley_limit"
#: Constants in torsion by their keys; the shear modulus is that of the body unless it is given.
SHEAR_CONSTANTS = {f"shear_{item.name.removeprefix('shear_')}": item.name for item in fields(ShearConstants)}
_MODULUS = "shear_modulus"
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
    by_name = bool({*BY_NAME} & raw.keys())
    own = [{name: two_of(value)[body] for name, value in raw.items()} for body in range(_BOTH)]
    tables = _named(raw, folder, report) if by_name else own
    tables = [{name: _number(value) for name, value in table.items()} for table in tables]
    intended = {meant(str(name), KEYS) for name in unknown}
    mistakes = Report()
    constants = _constants(tables, young, intended, mistakes)
    shears = _shear_constants(tables, shear, intended, mistakes)
    strengths, limits = (_stresses(name, tables, mistakes) for name in (STRENGTH, LIMIT))
    distance = None if len(tables) < _BOTH else critical_distance(tables, mistakes)
    for mistake in dict.fromkeys(mistakes):  # both bodies may have the same one
        report(*_in_units(mistake, units))
    if mistakes or unknown:
        # A criterion may need the strengths: they are not lacking, too.
        return ContactDetails(units, yield_strengths=strengths), None
    if distance is not None:
        usual, words = distance.words(units)
        if usual:
            _log.info(words)
        else:
            warnings.warn(words, stacklevel=2)
    given = ContactDetails(
        units, {}, constants, yield_strengths=strengths, shear_materials=shears, findley_limits=limits
    )
    return given, None if distance is None else distance.length


def _constants(
    tables: list[dict[str, Any]], young: _Moduli, intended: Iterable[object], report: Report
) -> tuple[FatigueConstants, ...]:
    """The strain–life constants of both bodies; none if there are none, or mistakes."""
    others = {*SHEAR_CONSTANTS, STRENGTH, LIMIT, *RANGES}
    told = any({*CONSTANTS} & table.keys() for table in tables)
    if not told and any(others & table.keys() for table in tables) and not {*intended} & {*CONSTANTS}:
        return ()
    own = dict(zip(CONSTANTS, CONSTANTS, strict=True))
    return _of_both(FatigueConstants, own, tables, young, intended, report)


def _of_both(
    make: Callable[..., _Constants],
    fields_of: Mapping[str, str],
    tables: list[dict[str, Any]],
    moduli: _Moduli,
    intended: Iterable[object],
    report: Report,
) -> tuple[_Constants, ...]:
    """Constants of both bodies, from fields by their keys; none if there are mistakes in them."""
    (modulus,) = (key for key in fields_of if key.endswith("_modulus"))
    found: list[_Constants] = []
    for body, table in enumerate(tables):
        own = {key: table.get(key) for key in fields_of}
        if own[modulus] is None and moduli is not None:
            own[modulus] = moduli[body]
        try:
            found.append(make(**{field: own[key] for key, field in fields_of.items()}))
        except StudyError as error:
            keys = {field: key for key, field in fields_of.items()}
            # What is misspelt is not lacking, too.
            for each in error.mistakes:
                key = keys[each.key]
                lacks = own[key] is None
                if not lacks or key not in intended:
                    report(key, "nothing" if lacks else each.found, each.allowed)
    return tuple(found) if len(found) == _BOTH else ()


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


def _shear_constants(
    tables: list[dict[str, Any]], moduli: _Moduli, intended: Iterable[object], report: Report
) -> tuple[ShearConstants, ...]:
    """The constants of both bodies in torsion; none if there are none, or mistakes."""
    if not any(SHEAR_CONSTANTS.keys() & table.keys() for table in tables):
        return ()
    needed = [name for name in SHEAR_CONSTANTS if name != _MODULUS]
    lacking = [name for name in needed if any(name not in table for table in tables)]
    if lacking:
        if not {*intended} & {*lacking}:  # what is misspelt is not lacking, too
            allowed = (
                "all four shear constants of both bodies, or none, to have them estimated from tensile ones"
            )
            report(", ".join(lacking), "nothing", allowed)
        return ()
    return _of_both(ShearConstants, SHEAR_CONSTANTS, tables, moduli, (), report)


def _stresses(name: str, tables: list[dict[str, Any]], report: Report) -> tuple[float, ...]:
    """A property of both bodies that is a stress; none if there is none, or mistakes."""
    given = [table[name] for table in tables if name in table]
    wrong = [each for value in given for each in wrong_size(name, value, "a positive number")]
    if 0 < len(given) < len(tables):
        wrong.append(Mistake(name, "that of one body", "that of both bodies, or of none"))
    report += wrong
    return () if wrong or not given else tuple(map(float, given))


def _in_units(mistake: Mistake, units: Units) -> tuple[str, str, str]:
    """Key, found and allowed of a mistake."""
    allowed = mistake.allowed
    if mistake.key in _STRESSES:
        allowed = allowed.replace("number", f"stress in {units.stress}", 1)
    if mistake.key in ("young_modulus", _MODULUS) and mistake.found == "nothing":
        allowed += ", since that of the bodies is no single value"
    keys = ", ".join(f"material.{key}" for key in mistake.key.split(", "))
    return keys, mistake.found, allowed


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
