"""Marks of points that are outside of what the model holds for, and of the borders between regimes on a map.

Along lines the former are a grey band, elsewhere dots.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.patheffects import Normal, Stroke
from numpy.typing import ArrayLike, NDArray

from swtstudy.figures.quantity_words import flag_words
from swtstudy.figures.style import stroke
from swtstudy.vocabulary.arrays import BoolArray

#: Colours of the band and of its rim, which is seen beside the lightest line; width over that of a line.
_BAND, _RIM, _WIDE = "0.9", "0.45", 4.5
#: Width of the rim, points.
_RIM_WIDTH = 0.8
#: Length of the line of one point alone, over its step to the next.
_STUB = 1e-3
#: Most dots across a map, and up: more would hide it.
_MOST = 32


def mark_along(
    axes: Axes, x: NDArray[Any], y: NDArray[Any], outside: BoolArray, words: str, drawstyle: str
) -> None:
    """A band under the parts of a line that are outside; of a single point a disc.

    Parameters
    ----------
    axes
        The panel.
    x, y
        Shape (n,): the line.
    outside
        Shape (n,): which of its points are.
    words
        For the legend.
    drawstyle
        That of the line.
    """
    if not outside.any():
        return
    width = _WIDE * rcParams["lines.linewidth"]
    rim = [Stroke(linewidth=width + 2.0 * _RIM_WIDTH, foreground=_RIM), Normal()]
    look = stroke(_BAND, linewidth=width, solid_capstyle="round", zorder=1.5, path_effects=rim)
    band = np.where(outside[:, None], _with_stubs(x, y), np.nan).reshape(2, -1)
    axes.plot(*band, drawstyle=drawstyle, label=words, **look)


def _with_stubs(x: NDArray[Any], y: NDArray[Any]) -> NDArray[Any]:
    """Each point, and one close to it on the line, shape (2, n, 2): one point alone would have no band."""
    line = np.stack([x, y]).astype(float)
    nowhere = np.full((2, 1), np.nan)
    after, before = np.hstack([line[:, 1:], nowhere]), np.hstack([nowhere, line[:, :-1]])
    toward = np.where(np.isfinite(after).all(axis=0), after, before)
    return np.stack([line, line + _STUB * (toward - line)], axis=-1)


def mark_cells(axes: Axes, x: ArrayLike, y: ArrayLike, outside: BoolArray, words: str) -> None:
    """Dots on what is outside of a map, thinned where its points are many.

    Parameters
    ----------
    axes
        The panel.
    x, y
        Shape (nx,) and (ny,): places across and up.
    outside
        Shape (ny, nx).
    words
        For the legend.
    """
    rows, columns = np.nonzero(outside)
    blocks = np.stack([rows // -(-outside.shape[0] // _MOST), columns // -(-outside.shape[1] // _MOST)])
    _, kept = np.unique(blocks, axis=1, return_index=True)
    mark_points(axes, np.asarray(x)[columns[kept]], np.asarray(y)[rows[kept]], words)


def mark_points(axes: Axes, x: NDArray[Any], y: NDArray[Any], words: str) -> None:
    """White dots with a black rim, which are seen on dark and on light."""
    if len(x):
        look: dict[str, Any] = {"linestyle": "none", "marker": "o", "zorder": 4}
        look |= {"color": "black", "markerfacecolor": "white", "markeredgewidth": 0.6, "clip_on": False}
        axes.plot(x, y, markersize=0.8 * rcParams["lines.markersize"], label=words, **look)


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
    from scipy.ndimage import distance_transform_edt, gaussian_filter

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
            axes.contour(at, up, smooth, levels=[0.5], colors=colour, linewidths=wide, zorder=3)
        if inside.mean() > _NAMED:
            # The point furthest from what is not inside. Words are wider than high: points count less across.
            distance = distance_transform_edt(np.pad(inside, 1), sampling=(1.0, 0.4))[1:-1, 1:-1]
            row, column = np.unravel_index(int(distance.argmax()), inside.shape)
            axes.text(at[column], up[row], names[code], **look)
