"""The table of quantities that may be asked of every point beside s.

Reading, validation, the schema, attributes, figures and the command line read it; none of them repeats a
name, a symbol or a meaning. A quantity is the same at a point and at its mirror image.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from swtstudy.mistakes import Report, literal, nearest


@dataclass(frozen=True)
class Quantity:
    """One quantity.

    Attributes
    ----------
    name
        Name of the data variable, and what a study asks for.
    symbol
        LaTeX without dollar signs.
    meaning
        A few words, used as ``long_name`` and in help texts.
    comment
        What it is exactly, in one line.
    function
        Name of the function in `swtstudy.mechanics.stress.work` that computes it.
    has_error
        Whether the function gives its estimated absolute error, too, which becomes ``NAME_error``.
    units
        CF units.
    """

    name: str
    symbol: str
    meaning: str
    comment: str
    function: str
    has_error: bool = False
    units: str = "1"

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of its data variables."""
        return (self.name, error_of(self.name)) if self.has_error else (self.name,)


QUANTITIES: dict[str, Quantity] = {
    row.name: row
    for row in (
        Quantity(
            "dissipation",
            r"W/(\mu F_0\, \mu E^* \delta_0/G^*)",
            "dissipated work",
            "work by friction in a cycle over mu F0 mu E* delta0 / G*, F0 the normal force at depth delta0",
            "dissipated_work",
            has_error=True,
        ),
        Quantity(
            "stick_radius",
            r"c/a_H",
            "radius that always sticks",
            "radius of the permanent stick zone in units of a_H; NaN if the whole contact slides or is lost",
            "permanent_stick_radius",
        ),
        Quantity(
            "contact_radius",
            r"a_\mathrm{max}/a_H",
            "largest contact radius",
            "largest contact radius over the cycle, in units of a_H",
            "largest_contact_radius",
        ),
        Quantity(
            "force_ratio",
            r"\max |F_x|/(\mu F_N)",
            "largest force ratio",
            "largest |F_x| over mu F_N while there is contact; 1 if the whole contact slides",
            "largest_force_ratio",
        ),
    )
}

ALLOWED = f"a list of {', '.join(QUANTITIES)}"


def error_of(name: str) -> str:
    """Name of the estimated absolute error of a data variable."""
    return f"{name}_error"


def variables_of(names: Iterable[str]) -> tuple[str, ...]:
    """Names of the data variables that quantities become."""
    return tuple(variable for name in names for variable in QUANTITIES[name].variables)


def attributes_of(variable: str) -> dict[str, Any]:
    """CF attributes of a data variable."""
    row = QUANTITIES.get(variable)
    if row is None:
        row = QUANTITIES[variable.removesuffix(error_of(""))]
        words = {"long_name": f"error of {row.name.replace('_', ' ')}", "comment": "absolute, estimated"}
        return {**words, "units": row.units, "symbol": rf"\Delta {row.symbol}"}
    attributes = {"long_name": row.meaning, "comment": row.comment, "units": row.units, "symbol": row.symbol}
    return attributes | ({"ancillary_variables": error_of(variable)} if row.has_error else {})


def read_quantities(raw: object, key: str, report: Report) -> tuple[str, ...]:
    """Names of quantities as the user gave them; every mistake is reported."""
    if isinstance(raw, str) or not isinstance(raw, Sequence):
        report(key, literal(raw), ALLOWED)
        return ()
    for index, name in enumerate(raw):
        place = f"{key}[{index}]"
        if not isinstance(name, str):
            report(place, literal(name), ALLOWED)
        elif name not in QUANTITIES:
            report(place, f"unknown quantity {literal(name)}", nearest(name, QUANTITIES))
        elif name in raw[:index]:
            report(place, f"{literal(name)}, the same as {key}[{raw.index(name)}]", "each quantity once")
    return tuple(dict.fromkeys(name for name in raw if isinstance(name, str) and name in QUANTITIES))
