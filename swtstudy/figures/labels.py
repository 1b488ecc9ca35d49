"""The scale, symbol and unit that a variable of a real contact has in figures."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from swtstudy.vocabulary.wording import as_text


class Label(NamedTuple):
    """The scale, symbol and unit that a variable has of a real contact.

    Attributes
    ----------
    scale
        What 1 is worth.
    symbol
        Its symbol with a unit, as LaTeX.
    units
        Label of the unit; "1" for a plain number.
    """

    scale: float
    symbol: str
    units: str

    @property
    def unit(self) -> str:
        """The unit in words of a figure, after a blank."""
        return "" if self.units == "1" else f" {as_text(self.units)}"

    def number(self, value: float, digits: int = 4) -> str:
        """A value with its unit."""
        return f"{self.scale * value:.{digits}g}{self.unit}".replace("-", "−")


#: By the name of a variable.
Labels = Mapping[str, Label]
NO_LABELS: Labels = MappingProxyType({})
