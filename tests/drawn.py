"""Figures of results through the accessor, by the keys of a study's ``[figure]``, and what they draw."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D


def keys(
    x: str, hue: str | None = None, panels: str | None = None, y: Any = ("s",), *more: Any, **others: Any
):
    """The keys of a figure, in the order of ``swt.panels``."""
    names = ("title", "kind", "vertical", "regimes", "validity")
    return {"x": x, "hue": hue, "panels": panels, "y": [*y], **dict(zip(names, more, strict=False)), **others}


def draw(dataset: xr.Dataset, layout: dict[str, Any] | None = None, **look: Any) -> Figure:
    """A figure with these keys, by default that of the study."""
    return dataset.swt.figure(**look) if layout is None else dataset.swt.panels(**layout, **look)


def curves(axes: Axes) -> list[Line2D]:
    """The curves, without the marks at their jumps."""
    return [line for line in axes.lines if line.get_linestyle() != "None"]


def whole(line: Line2D) -> np.ndarray:
    """Abscissae and values of a curve, shape (2, n)."""
    values = np.array([line.get_xdata(), line.get_ydata()], dtype=float)
    return values[:, np.isfinite(values[0])]
