"""Axes whose numbers are lengths, forces or stresses, of what is drawn without units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

#: By the name of a variable: what its unit is worth, and the words of an axis of it.
Labels = Mapping[str, tuple[float, str]]
#: Ticks of an axis at most.
_TICKS = 5


def show_units(axes: Axes, of: tuple[str | None, str | None], labels: Labels) -> None:
    """Label the axes of a panel, x and y, of which each is that of a variable or of none."""
    for axis, name in zip((axes.xaxis, axes.yaxis), of, strict=True):
        if name in labels:
            _show(axis, *labels[name])  # type: ignore[index]


def _show(axis: Axis, scale: float, words: str) -> None:
    """Ticks at round numbers of the unit."""
    from matplotlib.ticker import MaxNLocator

    low, high = sorted(axis.get_view_interval())
    ticks = MaxNLocator(_TICKS, steps=[1, 2, 2.5, 5, 10]).tick_values(low * scale, high * scale)
    inside = [tick for tick in ticks if low * scale <= tick <= high * scale]
    axis.set_ticks([tick / scale for tick in inside], labels=[f"{tick:.6g}" for tick in inside])
    axis.set_label_text(words)
