"""The parameters of real contacts, with their units and scales.

Their rows are as those of `swtstudy.vocabulary.parameters.PARAMETERS`. The scales are the units of a
contact's lengths, forces and stresses, and the way there and back.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from swtstudy.units.labels import LARGEST, SMALLEST, Units
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import AXES, CONTACT_AXES, PAIRS, PARAMETERS, QUANTITY_AXES, STRAIN_SHARE

if TYPE_CHECKING:
    from swtstudy.units.at_rest import Contact


@dataclass(frozen=True)
class Scale:
    """One length, force or stress that others are measured in.

    Attributes
    ----------
    of
        That of a contact.
    power
        Of δ0, in proportion to which it grows with the depth; None if it follows no power.
    made_of
        The parameter whose length it is made of, if it is that of one.
    kind
        "length", "force" or "stress".
    """

    of: Callable[[Contact], float]
    power: float | None
    made_of: str = ""
    kind: str = "length"


#: Scales by the name that rows of `swtstudy.vocabulary.parameters.PARAMETERS` have for them.
SCALES: dict[str, Scale] = {
    "a_H": Scale(lambda contact: contact.length_scale, 0.5),
    "δ0": Scale(lambda contact: contact.depth, 1.0),
    "μ E* δ0/G*": Scale(lambda contact: contact.slip_scale, 1.0),
    "E* δ0/a_H": Scale(lambda contact: contact.stress_scale, 0.5, kind="stress"),
    "F0": Scale(lambda contact: contact.normal_force, None, kind="force"),
    "μ F0": Scale(lambda contact: contact.friction * contact.normal_force, None, kind="force"),
    "√(hR)": Scale(
        lambda contact: math.sqrt(contact.shape["waviness_amplitude"] * (contact.radius or math.nan)),
        0.0,
        made_of="waviness_amplitude",
    ),
}


def number_of(name: str, value: Any, contact: Contact) -> Any:
    """The non-dimensional parameter from its length; what is no length stays as it is."""
    if not PARAMETERS[name].scale:
        return value
    unit = SCALES[PARAMETERS[name].scale].of(contact)
    if unit == 0.0:
        return math.inf if value else 0.0
    return value / unit


def length_of(name: str, number: Any, contact: Contact) -> Any:
    """The inverse of `number_of`."""
    scale = PARAMETERS[name].scale
    return number * SCALES[scale].of(contact) if scale else number


def least_depths(contact: Contact) -> dict[str, float]:
    """The depths below which shape parameters are beyond their range, for those that grow as it falls."""
    return {
        name: contact.depth * (number_of(name, length, contact) / PARAMETERS[name].upper) ** (1.0 / power)
        for name, length in contact.shape.items()
        if PARAMETERS[name].scale and (power := SCALES[PARAMETERS[name].scale].power)
    }


#: What must be given of a real contact: it has no usual friction.
WITHOUT_DEFAULT = ("poisson_ratio", "friction", "tangential_amplitude")
#: Parameters that each of the two bodies has.
OF_BODIES = ("young_modulus", "poisson_ratio")
#: A fixed value that is no parameter: |β|/μ up to which the bodies count as similar, β Dundurs' constant, and
#: what that is. Pressure drags tractions of β p along, friction bears μ p.
SIMILAR_KEY, SIMILAR = "similar", 0.3
#: |β|/μ above which it is warned of, a fifth of that.
NOTICEABLE_MISMATCH = 0.06
#: Another: what the two bodies are called.
NAMES_KEY = "bodies"
#: What is 0 unless given: a constant normal load is the plainest one.
_ZERO = ("normal_amplitude",)
#: The kinds of what has a unit.
_KINDS = {
    **{"young_modulus": "stress", "radius": "length", "depth": "length", "normal_force": "force"},
    "contact_length": "length",
}
#: Symbols that are not the numerator of the non-dimensional one.
_SYMBOLS = {"tangential_amplitude": "u_A"}
#: Of which exactly one is given.
MEAN_LOADS = ("depth", "normal_force")
#: Of which one takes the other's place.
ONE_OF = (*PAIRS.items(), MEAN_LOADS, ("bulk_stress_mean", "bulk_stress_ratio"))
#: What a contact at rest depends on.
REST_DEPENDS_ON = (
    *("young_modulus", "poisson_ratio", "radius", *MEAN_LOADS, "load", "contact_length", "body"),
    *(name for name, row in PARAMETERS.items() if row.part == "shape"),
)


def wrong_mean_load(given: Collection[str]) -> tuple[str, str] | None:
    """Return what was found and what is allowed, unless just one of `MEAN_LOADS` is among the names given."""
    found = [name for name in MEAN_LOADS if name in given]
    if len(found) == 1:
        return None
    return "both" if found else "neither", "one of the two: it says how deep the contact is"


def rows(units: Units) -> dict[str, Parameter]:
    """The rows by name: those of every parameter, of the critical distance, and of sizes of the contact."""
    ratio: dict[str, Any] = {
        "lower": -LARGEST,
        "upper": 1.0 - 1e-9,
        "words": "a number below 1: the least over the largest; of stresses that press bulk_stress_mean",
    }
    body: dict[str, Any] = {"lower": 1.0, "upper": 2.0, "open_lower": False, "words": "1 or 2"}
    own: dict[str, Parameter] = {
        name: replace(CONTACT_AXES[name], **changes)
        for name, changes in (("bulk_stress_ratio", ratio), ("body", body))
    }
    # The share of the strain follows from the moduli.
    parameters = [name for name in PARAMETERS if name != STRAIN_SHARE]
    names = [*CONTACT_AXES, *parameters, *(name for name, row in QUANTITY_AXES.items() if row.kind != "name")]
    return {name: own.get(name) or _row(AXES[name], units) for name in names}


def kind_of(name: str) -> str | None:
    """Dimension of a parameter: "length", "force" or "stress"; None if it has none of them."""
    scale = AXES[name].scale
    return SCALES[scale].kind if scale else _KINDS.get(name)


def _row(row: Parameter, units: Units) -> Parameter:
    default = None if row.name in WITHOUT_DEFAULT else 0.0 if row.name in _ZERO else row.default
    kind = kind_of(row.name)
    if kind is None:
        return replace(row, default=default)
    # Nothing else can be measured in what may be 0.
    is_measure = any(scale.made_of == row.name for scale in SCALES.values())
    vanishes = row.scale and not row.open_lower and not is_measure and row.part != "quantity"
    lower = -LARGEST if row.lower < 0.0 else 0.0 if vanishes else SMALLEST
    label = units.label(kind)
    size = f"{kind} in {label}" if label else kind
    words = f"a {size}" if lower < 0.0 else f"a {size}, ≥ 0" if lower == 0.0 else f"a positive {size}"
    own: dict[str, Any] = {"default": default, "units": label, "lower": lower, "upper": LARGEST}
    own |= {"open_lower": False, "symbol": _SYMBOLS.get(row.name, row.symbol.split("/")[0])}
    return replace(row, **own, words=words)
