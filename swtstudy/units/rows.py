"""The parameters of real contacts, with their units: rows as those of
`swtstudy.vocabulary.parameters.PARAMETERS`."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, fields
from typing import Any

from swtstudy.units.labels import Units
from swtstudy.units.scales import SCALES, may_vanish
from swtstudy.units.sizes import LARGEST, SMALLEST
from swtstudy.vocabulary.axes import AXES, CONTACT_AXES, QUANTITY_AXES
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS

#: What must be given of a real contact: it has no usual friction.
WITHOUT_DEFAULT = ("poisson_ratio", "friction", "tangential_amplitude")
#: Parameters that each of the two bodies has.
OF_BODIES = ("young_modulus", "poisson_ratio")
#: A fixed value that is no parameter: Dundurs' |β| up to which the bodies count as similar, and what that is.
SIMILAR_KEY, SIMILAR = "similar", 0.05
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


@dataclass(frozen=True)
class SizeRow(Parameter):
    """A parameter that is a length, a force or a stress, in the units of a study."""

    kind_of_size: str = "length"

    @property
    def allowed(self) -> str:
        """The allowed range in words."""
        unit = f" in {self.units}" if self.units else ""
        words = f"{self.kind_of_size}{unit}"
        if self.lower < 0.0:
            return f"a {words}"
        return f"a {words}, ≥ 0" if self.lower == 0.0 else f"a positive {words}"


@dataclass(frozen=True)
class RowInWords(Parameter):
    """A parameter whose range is said in words of its own."""

    words: str = ""

    @property
    def allowed(self) -> str:
        """The allowed range in words."""
        return self.words


def rows(units: Units) -> dict[str, Parameter]:
    """The rows by name: those of every parameter, of the critical distance, and of sizes of the contact."""
    ratio = {"lower": -LARGEST, "upper": 1.0 - 1e-9, "words": "a number below 1: the least over the largest"}
    body = {"lower": 1.0, "upper": 2.0, "open_lower": False, "words": "1 or 2"}
    own: dict[str, Parameter] = {
        name: RowInWords(**_fields(CONTACT_AXES[name]) | changes)
        for name, changes in (("bulk_stress_ratio", ratio), ("body", body))
    }
    names = [*CONTACT_AXES, *PARAMETERS, *(name for name, row in QUANTITY_AXES.items() if row.kind != "name")]
    return {name: own.get(name) or _row(AXES[name], units) for name in names}


def kind_of(name: str) -> str | None:
    """Dimension of a parameter: "length", "force" or "stress"; None if it has none of them."""
    scale = AXES[name].scale
    return SCALES[scale].kind if scale else _KINDS.get(name)


def _row(row: Parameter, units: Units) -> Parameter:
    default = None if row.name in WITHOUT_DEFAULT else 0.0 if row.name in _ZERO else row.default
    kind = kind_of(row.name)
    if kind is None:
        return Parameter(**_fields(row) | {"default": default})
    vanishes = bool(row.scale) and may_vanish(row) and row.part != "quantity"
    lower = -LARGEST if row.lower < 0.0 else 0.0 if vanishes else SMALLEST
    own = {"default": default, "units": units.label(kind), "lower": lower, "upper": LARGEST}
    own |= {"open_lower": False, "symbol": _SYMBOLS.get(row.name, row.symbol.split("/")[0])}
    return SizeRow(**_fields(row) | own, kind_of_size=kind)


def _fields(row: Parameter) -> dict[str, Any]:
    return {field.name: getattr(row, field.name) for field in fields(Parameter)}
