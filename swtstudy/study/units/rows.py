"""The parameters of real contacts, with their units and scales.

A study labels its units of length, force and stress: any consistent set. The rows are like the rows of
`swtstudy.vocabulary.parameters.PARAMETERS`. The scales are the units of a contact's lengths, forces and
stresses, and the way there and back.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from swtstudy.vocabulary.files import parse_toml, read_text
from swtstudy.vocabulary.mistakes import Mistake, Report, literal, nearest, plain_number, refused
from swtstudy.vocabulary.parameters import (
    AXES,
    CONTACT_AXES,
    DEGREES,
    PAIRS,
    PARAMETERS,
    QUANTITY_AXES,
    STRAIN_SHARE,
    SYMBOLS,
    Parameter,
)

if TYPE_CHECKING:
    from swtstudy.study.units.at_rest import Contact

#: Kinds of numbers that have a unit of their own.
UNIT_KINDS = ("length", "force", "stress")

#: Units by kind and label, in m, N and Pa, and properties of materials.
TABLES = parse_toml(read_text(Path(__file__).with_name("tables.toml")))
#: The kind of a load of a plane contact without a length.
PER_LENGTH = "force per length"
#: Labels that are known: a set of them that is not consistent is a mistake.
KNOWN: dict[str, dict[str, float]] = TABLES["known"] | {
    "angle": {"rad": 1.0} | dict.fromkeys(DEGREES, math.radians(1.0)),
    PER_LENGTH: {
        f"{force}/{length}": newtons / metres
        for force, newtons in TABLES["known"]["force"].items()
        for length, metres in TABLES["known"]["length"].items()
    },
}
#: Names of units as people write them out, and their labels.
_WRITTEN_OUT = {
    prefix + name: letter + label
    for name, label in TABLES["prefixed"].items()
    for prefix, letter in TABLES["prefixes"].items()
} | TABLES["written_out"]


@dataclass(frozen=True)
class Units:
    """Labels of the units of length, force and stress; empty where nobody has said them."""

    length: str = ""
    force: str = ""
    stress: str = ""

    def label(self, kind: str) -> str:
        """Label of a unit: of length, force, stress, or work."""
        return f"{self.force} {self.length}".strip() if kind == "work" else str(getattr(self, kind))

    def words(self, kind: str) -> str:
        """Label of a unit, or words for one without a label; other kinds of numbers as they are."""
        has_unit = kind in (*UNIT_KINDS, "work")
        return self.label(kind) or f"unit of {kind}" if has_unit else kind


@dataclass(frozen=True)
class LineUnits(Units):
    """Labels where forces, and work, are per length, as of plane contacts without a length."""

    def label(self, kind: str) -> str:
        if kind == "force" and self.force:
            return f"{self.force}/{self.length}"
        return self.force if kind == "work" else super().label(kind)


def unit_factor(kind: str, unit: str, label: str) -> float:
    """Factor from a unit to another one, given by their labels; 1 where either of them is not known."""
    known = KNOWN[kind]
    return known[unit] / known[label] if unit in known and label in known else 1.0


def right_place(name: str, known: Collection[str], symbols: Mapping[str, tuple[str, str]] = SYMBOLS) -> str:
    """Say where an unknown key of a table belongs: beside other parameters, or which keys the table has."""
    if name in (NAMES_KEY, SIMILAR_KEY):
        return "in [fixed]"
    return "in [fixed] or [axes]" if name in AXES else nearest(name, known, symbols)


def read_units(raw: Mapping[str, object], report: Report) -> Units:
    """The units that a study says; every mistake is reported, and a wrong label stands for a unit."""
    before = len(report)
    for name in (each for each in raw if each not in UNIT_KINDS):
        report(f"units.{name}", f"unknown key {literal(name)}", right_place(str(name), UNIT_KINDS))
    labels = {kind: str(raw[kind]).strip() if isinstance(raw.get(kind), str) else "" for kind in UNIT_KINDS}
    for kind, label in labels.items():
        found = literal(raw[kind]) if kind in raw else "nothing"
        if label in ("", "1", "rad") or not label.isprintable():
            report(f"units.{kind}", found, f"the name of a unit, such as {literal(next(iter(KNOWN[kind])))}")
        elif likely := likely_units(kind, label):
            report(f"units.{kind}", found, f"did you mean {' or '.join(likely)}?")
    if all(label in KNOWN[kind] for kind, label in labels.items()):
        length, force, stress = (KNOWN[kind][label] for kind, label in labels.items())
        if not math.isclose(force / length**2, stress):  # to the rounding of the table
            number, unit = f"{force / length**2 / stress:.3g}", labels["stress"]
            found = f"{labels['force']} over {labels['length']}², which is {number} {unit}"
            report("units", found, f"a consistent set, such as N, mm and MPa: that is to be 1 {unit}")
    if len(report) > before:
        labels = {kind: label or f"the unit of {kind}" for kind, label in labels.items()}
    return Units(**labels)


def likely_units(kind: str, label: str) -> list[str]:
    """The known units that a label probably means; none for a known unit, or for one of the user's own.

    Examples
    --------
    >>> likely_units("length", "milimeter"), likely_units("force", "mn"), likely_units("length", "cm2")
    (['mm'], ['MN', 'mN'], ['cm'])
    >>> likely_units("stress", "N"), likely_units("length", "furlong")
    (['Pa', 'kPa', 'MPa', 'GPa', 'bar', 'N/mm²', 'N/mm2', 'psi', 'ksi'], [])
    """
    known = KNOWN[kind]
    if label in known:
        return []
    if any(label in KNOWN[each] for each in UNIT_KINDS):
        return [*known]
    base = label.rstrip("^-²³0123456789")
    alike = [each for each in known if base in (each, each.lower()) or label.lower() == each.lower()]
    written = {name: each for name, each in _WRITTEN_OUT.items() if each in known}
    close = difflib.get_close_matches(label.lower().removesuffix("s"), written, n=1, cutoff=0.8)
    return alike or [written[name] for name in close]


#: No unit makes a quantity smaller or larger; the product of three of them, and a square, is still a number.
SMALLEST, LARGEST = 1e-100, 1e100


def wrong_size(name: str, value: object, allowed: str = "") -> list[Mistake]:
    """The mistake of a value that has the wrong sign, or no size that can be computed with.

    Exponents are negative, and all others positive.
    """
    negative = name.endswith("exponent")
    number = -plain_number(value) if negative else plain_number(value)
    allowed = allowed or f"a {'negative' if negative else 'positive'} number"
    if SMALLEST <= number <= LARGEST:
        return []
    if number > 0.0:
        allowed += f", in magnitude from {SMALLEST:g} to {LARGEST:g}"
    return [Mistake(name, literal(value), allowed)]


class Scale(NamedTuple):
    """One length, force or stress that others are measured in.

    Attributes
    ----------
    name
        The property of a contact that it is.
    kind
        "length", "force" or "stress".
    power
        Of δ0, in proportion to which it grows with the depth; None if it follows no power.
    """

    name: str
    kind: str
    power: float | None = None

    def of(self, contact: Contact) -> float:
        """Its value for a contact."""
        return float(getattr(contact, self.name))


#: Scales by the name that rows of `swtstudy.vocabulary.parameters.PARAMETERS` have for them.
SCALES = {name: Scale(**row) for name, row in TABLES["scales"].items()}


#: Defaults of real contacts: these have no usual friction, and a constant normal load is the plainest one.
_DEFAULTS = {"poisson_ratio": None, "friction": None, "tangential_amplitude": None, "normal_amplitude": 0.0}
#: Parameters that each of the two bodies has.
OF_BODIES = ("young_modulus", "poisson_ratio")
#: A fixed value that is no parameter: |β|/μ up to which the bodies count as similar, β Dundurs' constant, and
#: what that is. Pressure drags tractions of β p along, friction bears μ p.
SIMILAR_KEY, SIMILAR = "similar", 0.3
#: |β|/μ above which it is warned of, a fifth of that.
NOTICEABLE_MISMATCH = 0.06
#: Another: what the two bodies are called.
NAMES_KEY = "bodies"
#: Another: the body that carries the bulk stress, the first one unless given.
CARRIER_KEY = "bulk_stress_body"
#: The three.
OF_ALL = (SIMILAR_KEY, NAMES_KEY, CARRIER_KEY)
#: Exactly one of each group is given.
MEAN_LOADS = ("depth", "normal_force")
#: One of each pair takes the other's place.
ONE_OF = (*PAIRS.items(), MEAN_LOADS, ("bulk_stress_mean", "bulk_stress_ratio"))
_SHAPE = tuple(name for name, row in PARAMETERS.items() if row.part == "shape")
#: Parameters on which a contact at rest and its slip depend; and on which it depends without its slip, the
#: load if its mean is measured.
AT_REST_NAMES = (*OF_BODIES, "radius", *MEAN_LOADS, "friction", "contact_length", *_SHAPE)
REST_DEPENDS_ON = {*AT_REST_NAMES, "load", "body"} - {"friction"}


def with_replaced(names: Collection[str]) -> set[str]:
    """Names, and those whose place these take (`ONE_OF`)."""
    return {*names}.union(*(pair for pair in ONE_OF if {*pair} & {*names}))


def wrong_mean_load(given: Collection[str]) -> tuple[str, str] | None:
    """Return what was found and what is allowed, unless just one of `MEAN_LOADS` is among the names given."""
    found = [name for name in MEAN_LOADS if name in given]
    if len(found) == 1:
        return None
    return "both" if found else "neither", "one of the two: it says how deep the contact is"


def rows(units: Units) -> dict[str, Parameter]:
    """The rows by name, for every parameter, the critical distance, and sizes of the contact."""
    # The share of the strain follows from the moduli.
    names = [*CONTACT_AXES, *(name for name in PARAMETERS if name != STRAIN_SHARE)]
    names += [name for name, row in QUANTITY_AXES.items() if row.kind != "name"]
    found: dict[str, Parameter] = {}
    for name in names:
        row, kind = AXES[name], kind_of(name)
        own: dict[str, Any] = {"default": _DEFAULTS.get(name, row.default)}
        if kind is not None:
            is_measure = name == "waviness_amplitude"  # of √(hR): nothing is measured in what may be 0
            vanishes = row.scale and not row.open_lower and not is_measure and row.part != "quantity"
            lower = -LARGEST if row.lower < 0.0 else 0.0 if vanishes else SMALLEST
            label = units.label(kind)
            size = f"{kind} in {label}" if label else kind
            words = f"a {size}" if lower < 0.0 else f"a {size}, ≥ 0" if lower == 0.0 else f"a positive {size}"
            symbol = "u_A" if name == "tangential_amplitude" else row.symbol.split("/")[0]
            own |= {"units": label, "lower": lower, "upper": LARGEST, "open_lower": False}
            own |= {"symbol": symbol, "words": words, "note": ""}
        found[name] = replace(row, **own)
    return found


def kind_of(name: str) -> str | None:
    """Dimension of a parameter: "length", "force" or "stress"; None if it has none of them."""
    scale = AXES[name].scale
    return SCALES[scale].kind if scale else TABLES["kinds"].get(name)


def kinds_of(names: Iterable[str]) -> dict[str, str | None]:
    """Dimensions of the values of parameters in a file, by their names: of `kind_of`, or an angle."""
    return {name: "angle" if AXES[name].units == "rad" else kind_of(name) for name in names}


#: Labels of the bodies along the dimension ``body``.
LABELS = (1, 2)


def checked_body(body: object, key: str = "body", names: Sequence[str] = ()) -> int:
    """The label of a body, from that or from one of the names that the bodies may have.

    Raises
    ------
    StudyError
        If it is neither.
    """
    number = names.index(body) + 1 if isinstance(body, str) and body in names else plain_number(body)
    if number not in LABELS:
        raise refused(key, literal(body), " or ".join((*map(str, LABELS), *map(literal, names))))
    return int(number)
