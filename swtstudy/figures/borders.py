"""Borders between the regimes of the contact on a map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rcParams

from swtstudy.figures.quantity_words import flag_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: A regime with a smaller share of the points is not named.
_NAMED = 0.03


def mark_borders(axes: Axes, regime: xr.DataArray) -> None:
    """Draw the borders between regimes over (vertical, x), and name each where it has most room.

    Parameters
    ----------
    axes
        A panel with contours.
    regime
        Flags, NaN where unknown.
    """
    from scipy.ndimage import gaussian_filter

    vertical, x = map(str, regime.dims)
    regime = regime.sortby([vertical, x])
    at, up = regime[x].values, regime[vertical].values
    names = flag_words(regime)
    width = 1.6 * rcParams["lines.linewidth"]
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": "small", "bbox": box, "zorder": 5}
    for code in np.unique(regime.values[np.isfinite(regime.values)]).astype(int):
        inside = regime.values == code
        if inside.all():
            continue
        # Flags alone give a border in steps from point to point.
        smooth = gaussian_filter(inside.astype(float), 1.0, mode="nearest")
        for colour, wide in (("white", 2.0 * width), ("black", width)):
            axes.contour(at, up, smooth, levels=[0.5], colors=colour, linewidths=wide)
        if inside.mean() > _NAMED:
            row, column = _middle(inside)
            axes.text(at[column], up[row], names[code], **look)


def _middle(inside: Any) -> tuple[int, int]:
    """The point of a region that is furthest from what is not in it and from the frame."""
    from scipy.ndimage import distance_transform_edt

    # Words are wider than high: points count less across.
    distance = distance_transform_edt(np.pad(inside, 1), sampling=(1.0, 0.4))[1:-1, 1:-1]
    row, column = np.unravel_index(int(distance.argmax()), inside.shape)
    return int(row), int(column)
