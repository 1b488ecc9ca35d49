"""Curves of a panel as the values that were drawn, without the gaps where another maximum takes over."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D


def curves(axes: Axes) -> list[Line2D]:
    """The curves, without the marks at their jumps."""
    return [line for line in axes.lines if line.get_linestyle() != "None"]


def whole(line: Line2D) -> np.ndarray:
    """Abscissae and values of a curve, shape (2, n)."""
    values = np.array([line.get_xdata(), line.get_ydata()], dtype=float)
    return values[:, np.isfinite(values[0])]
