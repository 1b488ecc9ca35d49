"""The families of indenters (eqs. 3–6 of the paper): what the table of parameters must know of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeGuard


@dataclass(frozen=True)
class Family:
    """One family of indenters (eqs. 3–6); its class is in `swtstudy.mechanics.indenter.PROFILES`.

    Attributes
    ----------
    name
        Value of the parameter ``profile``.
    shape
        The shape parameters κ_i that it has.
    plain
        The shape parameter and its value that make it the `PLAIN` family, whatever the others are; None for
        none.
    """

    name: str
    shape: tuple[str, ...] = ()
    plain: tuple[str, float] | None = None


FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        Family("paraboloid"),
        Family("rounded_punch", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("truncated_paraboloid", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("wavy_paraboloid", ("waviness_amplitude", "wavelength"), plain=("waviness_amplitude", 0.0)),
        Family("power_law", ("exponent",), plain=("exponent", 2.0)),
    )
}

#: The family of what the user has defined.
TABLE = Family("table")

#: The family that others are at their plain shape.
PLAIN = "paraboloid"


def is_profile(raw: object) -> TypeGuard[str]:
    """Whether something is the name of a profile."""
    return isinstance(raw, str) and raw in FAMILIES


def family_of(profile: object) -> Family:
    """The family of a profile, or of that of a name; what the user has defined has no shape parameters."""
    return FAMILIES.get(str(profile), TABLE)


def families_with(name: str) -> list[str]:
    """Names of the families that have a shape parameter."""
    return [family.name for family in FAMILIES.values() if name in family.shape]
