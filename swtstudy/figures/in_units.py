"""Axes whose numbers are lengths, forces or stresses, of what is drawn without units."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from swtstudy.vocabulary.wording import as_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

#: Ticks of an axis at most.
_TICKS = 5


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

    def axis(self) -> str:
        """Label of an axis of it."""
        return f"${self.symbol}$" + (f" ({self.unit.strip()})" if self.unit else "")

    def number(self, value: float, digits: int = 4) -> str:
        """A value with its unit."""
        return f"{self.scale * value:.{digits}g}{self.unit}"


#: By the name of a variable.
Labels = Mapping[str, Label]
NO_LABELS: Labels = MappingProxyType({})


def show_units(axes: Axes, of: tuple[str | None, str | None], labels: Labels) -> None:
    """Label the axes of a panel, x and y, of which each is that of a variable or of none."""
    for axis, name in zip((axes.xaxis, axes.yaxis), of, strict=True):
        if name in labels:
            _show(axis, labels[name])  # type: ignore[index]


def _show(axis: Axis, label: Label) -> None:
    """Ticks at round numbers of the unit."""
    from matplotlib.ticker import MaxNLocator

    low, high = sorted(end * label.scale for end in axis.get_view_interval())
    ticks = MaxNLocator(_TICKS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    inside = [tick for tick in ticks if low <= tick <= high]
    axis.set_ticks([tick / label.scale for tick in inside], labels=[f"{tick:.6g}" for tick in inside])
    axis.set_label_text(label.axis())
