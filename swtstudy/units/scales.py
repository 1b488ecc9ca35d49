"""Scales of a real contact: the units of its lengths, forces and stresses, and the way there and back."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS

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


def may_vanish(row: Parameter) -> bool:
    """Return whether a parameter may be 0 in a real contact: nothing else is measured in it."""
    return not row.open_lower and all(scale.made_of != row.name for scale in SCALES.values())


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
