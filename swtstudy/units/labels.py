"""The units of a study: labels of any consistent set, and bounds on the size of numbers with one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from swtstudy.vocabulary.mistakes import Mistake, Report, literal, nearest, plain_number

#: What has a unit of its own.
UNIT_KINDS = ("length", "force", "stress")

#: Labels that are known, in m, N and Pa: a set of them that is not consistent is a mistake.
KNOWN: dict[str, dict[str, float]] = {
    "length": {
        "m": 1.0,
        "cm": 1e-2,
        "mm": 1e-3,
        "µm": 1e-6,
        "μm": 1e-6,
        "um": 1e-6,
        "nm": 1e-9,
        "in": 0.0254,
    },
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3, "µN": 1e-6, "μN": 1e-6, "lbf": 4.4482216152605},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "psi": 6894.757293168, "ksi": 6894757.293168},
}
KNOWN["force"]["kip"] = 1e3 * KNOWN["force"]["lbf"]

#: Relative rounding of the numbers above.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Units:
    """Labels of the units of length, force and stress; empty where nobody has said them."""

    length: str = ""
    force: str = ""
    stress: str = ""

    def label(self, kind: str) -> str:
        """Label of a unit: of length, force, stress, or work."""
        if kind == "work":
            return f"{self.force} {self.length}".strip()
        return str(getattr(self, kind))


def read_units(raw: Mapping[str, object], report: Report) -> Units | None:
    """The units that a study says; every mistake is reported."""
    sound = True
    for name in (each for each in raw if each not in UNIT_KINDS):
        report(f"units.{name}", f"unknown key {literal(name)}", nearest(str(name), UNIT_KINDS))
        sound = False
    for kind in UNIT_KINDS:
        label = raw.get(kind)
        named = isinstance(label, str) and label.strip() not in ("", "1", "rad")
        word = str(label).strip()
        alike = [each for each in KNOWN[kind] if each.lower() == word.lower()]
        if named and alike and word not in alike:
            report(f"units.{kind}", literal(label), f"did you mean {' or '.join(alike)}?")
            sound = False
        elif not named or not str(label).isprintable():
            found = literal(label) if kind in raw else "nothing"
            report(f"units.{kind}", found, f"the name of a unit, such as {literal(next(iter(KNOWN[kind])))}")
            sound = False
    if not sound:
        return None
    labels = {kind: str(raw[kind]).strip() for kind in UNIT_KINDS}
    if not all(label in KNOWN[kind] for kind, label in labels.items()):
        return Units(**labels)
    length, force, stress = (KNOWN[kind][labels[kind]] for kind in UNIT_KINDS)
    if math.isclose(force / length**2, stress, rel_tol=_ROUNDING):
        return Units(**labels)
    number = f"{force / length**2 / stress:.3g}"
    found = f"{labels['force']} over {labels['length']}², which is {number} {labels['stress']}"
    report("units", found, f"a consistent set, such as N, mm and MPa: that is to be 1 {labels['stress']}")
    return None


#: No unit makes a quantity smaller or larger; the product of three of them, and a square, is still a number.
SMALLEST, LARGEST = 1e-100, 1e100


def wrong_size(name: str, value: object, allowed: str, sign: float = 1.0) -> list[Mistake]:
    """The mistake of a value that is no number of this sign, or of no size that can be computed with."""
    number = sign * plain_number(value)
    if SMALLEST <= number <= LARGEST:
        return []
    if number > 0.0:
        allowed += f", in magnitude from {SMALLEST:g} to {LARGEST:g}"
    return [Mistake(name, literal(value), allowed)]
