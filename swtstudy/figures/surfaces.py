"""Panels of a quantity over two dimensions: contours, or a heat map.

Where it is least and greatest along x is found between the points of its grid.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps, rcParams
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from swtstudy.figures.lines import mark_points
from swtstudy.figures.words import flag_words, is_life, power_words, tick_angles, tick_names
from swtstudy.results.evaluate import words_of
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.choices import WITHOUT_S
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import as_text, coordinate_words

#: Approximate number of contours: as many as are legible with labels.
_LEVELS = 13
#: Panels have a scale of colours each where one fills less than this share of their common one.
_COMMON = 0.15
#: Width by which borders of regimes are smoothed, as a share of the points, and points beyond the frame.
_SMOOTHED, _PAD = 0.04, 6
#: Most dots across a map, and up: more would hide it.
_MOST = 32


def draw_maps(
    figure: Figure,
    axes: NDArray[Any],
    panels: Sequence[xr.Dataset],
    layout: FigureLayout,
    name: object,
    words: str,
) -> None:
    """Draw a row of panels, with one scale of colours unless a panel would have few of them.

    Parameters
    ----------
    figure, axes
        The figure and the panels of the row.
    panels
        Over x and vertical: ``value``, of which each flag has a colour, with its meaning at the colour bar;
        and ``regime`` and ``outside``, if these are to be marked.
    layout
        The layout: axes and their roles, and the kind, "contour" or "heatmap".
    name, words
        The quantity, and its label at the colour bar.
    """
    is_contour = layout.kind == "contour"
    panels = [panel.transpose(layout.vertical, layout.x) for panel in panels]
    if is_contour:
        panels = [panel.sortby([layout.vertical, layout.x]) for panel in panels]
    surfaces = [panel.value.rename(name) for panel in panels]
    names, life = flag_words(surfaces[0]), is_life(surfaces[0].attrs)
    ends = np.array([[float(surface.min()), float(surface.max())] for surface in surfaces])
    whole = np.nanmax(ends) - np.nanmin(ends) if np.isfinite(ends).any() else 0.0
    if not names and np.any(ends[:, 1] - ends[:, 0] < _COMMON * whole):
        for one, panel in zip(axes, panels, strict=True):
            draw_maps(figure, np.array([one]), [panel], layout, name, words)
        return
    look = _colours(surfaces, layout.kind)
    draw = _draw_cells if not is_contour else _draw_areas if names else draw_contours
    for one, panel, surface in zip(axes, panels, surfaces, strict=True):
        one.grid(False)
        _mark_unknown(one, panel)
        if layout.regimes:
            mark_borders(one, panel.regime)
        filled = draw(one, surface, look)
        if is_contour:
            tick_angles(one.xaxis, surface[layout.x])
            tick_angles(one.yaxis, surface[layout.vertical])
        if layout.validity:
            mark_cells(one, panel.outside, is_contour)
    if not np.isfinite(ends).any():
        return
    bar = figure.colorbar(filled, ax=axes, label=words, pad=0.02)
    if life and is_contour:
        bar.ax.yaxis.set_major_formatter(lambda value, _: power_words(value))
    if names:
        bar.set_ticks(range(len(names)), labels=names)
        bar.ax.tick_params(which="both", length=0)


def _mark_unknown(axes: Axes, panel: xr.Dataset) -> None:
    """Hatch the ground of a panel, which is seen where there is no value, and say why in the legend."""
    unknown = ~np.isfinite(panel.value.values)
    if not unknown.any():
        return
    why = {""}
    if "regime" in panel and flag_words(panel.regime):
        regimes = words_of(panel, "regime").broadcast_like(panel.value).transpose(*panel.value.dims)
        why = {*regimes.values[unknown].tolist()}
    words = " or ".join(sorted(why)).replace("_", " ") if why <= {*WITHOUT_S} else "no value"
    look: dict[str, Any] = {"facecolor": "white", "edgecolor": "0.6", "hatch": "////", "linewidth": 0.5}
    axes.add_patch(Rectangle((0, 0), 1, 1, transform=axes.transAxes, zorder=-1, label=words, **look))


def _colours(surfaces: list[xr.DataArray], kind: str) -> dict[str, Any]:
    """The colour map of a row and its scale, in steps for contours.

    Dark is kind: long lives are dark, and their scale is logarithmic. A ratio is pale where it is 1.
    Flags have colours from dark to light in their order.
    """
    scale = str(rcParams["image.cmap"])
    if names := flag_words(surfaces[0]):
        norm = BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names))
        return {"norm": norm, "cmap": colormaps[scale].resampled(len(names))}
    values = np.concatenate([surface.values.ravel() for surface in surfaces])
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    levels: Any = None
    if is_life(surfaces[0].attrs):
        scale = scale.removesuffix("_r") if scale.endswith("_r") else f"{scale}_r"
        if low > 0.0 and kind == "heatmap":
            return {"norm": LogNorm(low, high), "cmap": scale}
        if low > 0.0:
            first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
            digits = (1.0, 2.0, 5.0) if 3 * (last - first) <= _LEVELS else (1.0,)
            levels = np.array([digit * 10.0**power for power in range(first, last + 1) for digit in digits])
            begin, end = np.searchsorted(levels, low, "right") - 1, np.searchsorted(levels, high)
            levels = levels[max(begin, 0) : end + 1]
    elif str(surfaces[0].attrs.get("symbol")) == "s/s_0":
        most = max(high - 1.0, 1.0 - low, 1e-3)
        scale, low, high = "PuOr_r", 1.0 - most, 1.0 + most
    if kind == "heatmap":
        return {"norm": Normalize(low, high), "cmap": scale}
    levels = MaxNLocator(_LEVELS).tick_values(low, high) if levels is None else levels
    return {"norm": BoundaryNorm(levels, 256), "cmap": scale}


def _draw_areas(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw areas of flags over (vertical, x), ascending, with borders half way between points."""
    up, at = (surface[dim].values for dim in surface.dims)
    mesh = axes.pcolormesh(at, up, surface, shading="nearest", rasterized=True, **look)
    axes.set(xlim=at[[0, -1]], ylim=up[[0, -1]])
    return mesh


def draw_contours(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw contours over (vertical, x), ascending; for s also where it is least and greatest along x."""
    levels, life = look["norm"].boundaries, is_life(surface.attrs)
    up, at = (surface[dim].values for dim in surface.dims)
    filled = axes.contourf(at, up, surface, levels=levels, **look)
    lines = axes.contour(at, up, surface, levels=levels, colors="black", linewidths=0.5, alpha=0.6)
    if surface.name == "s":
        _draw_extrema(axes, at, up, surface)
    shown = levels if life else levels[::2]
    # Black or white, whichever is read on the colours beside a level.
    light = filled.to_rgba(shown)[:, :3] ** 2.2 @ [0.2126, 0.7152, 0.0722]
    labels: dict[str, Any] = {"fmt": power_words if life else "%g", "fontsize": "x-small"}
    labels["colors"] = ["black" if each > 0.18 else "white" for each in light]
    # Tried on whole lines first: only lines whose label stays are broken there.
    if places := _apart(axes, axes.clabel(lines, shown, inline=False, **labels)):
        for words in axes.clabel(lines, shown, manual=places, **labels):
            words.set(color=words.get_color()[:3], alpha=1.0)  # not as pale as the lines
    return filled


def _apart(axes: Axes, tried: list[Text]) -> list[tuple[float, float]]:
    """Places of labels inside of the frame and apart from one another, names and lines; the labels go."""
    frame, names = axes.get_window_extent(), [each for each in axes.texts if each not in tried]
    taken = [each.get_window_extent() for each in names]
    over = [path.vertices for each in axes.collections if each.get_zorder() == 3 for path in each.get_paths()]
    lines = axes.transData.transform(
        np.concatenate([np.empty((0, 2)), *map(Line2D.get_xydata, axes.lines), *over])
    )
    kept = []
    for each in tried:
        # The layout, which comes later, leaves a panel less room.
        box = each.get_window_extent().expanded(1.5, 1.5)
        inside = frame.contains(box.x0, box.y0) and frame.contains(box.x1, box.y1)
        if inside and not box.count_overlaps(taken) and not box.count_contains(lines):
            taken.append(box)
            kept.append(each.get_position())
        each.remove()
    return kept


def _draw_extrema(axes: Axes, at: FloatArray, up: FloatArray, surface: xr.DataArray) -> None:
    """Lines where the surface is least and greatest along x; with a gap where another extremum takes over."""
    width = 1.2 * rcParams["lines.linewidth"]
    over: dict[str, Any] = {"marker": "", "clip_on": False, "zorder": 3}  # an extremum may be on the frame
    for words, sign, dashes in (("minimum", 1.0, "-"), ("maximum", -1.0, (0, (4, 2)))):
        places = lowest(at, sign * surface.values, AXES[str(surface.dims[1])].units == "rad")
        if not np.isfinite(places).any():
            continue
        gaps = _jumps(places, float(np.ptp(at)))  # a gap before each run
        path = np.insert(places, gaps, np.nan), np.insert(up, gaps, np.nan)
        axes.plot(*path, color="white", linestyle="-", linewidth=2.0 * width, **over)
        label = f"{words} of ${surface.name}$"
        axes.plot(*path, color="#B22222", linestyle=dashes, linewidth=width, label=label, **over)


def lowest(x: FloatArray, values: FloatArray, angle: bool) -> FloatArray:
    """Place of the least value in each row, as the vertex of the parabola through it and its neighbours.

    Parameters
    ----------
    x
        Shape (nx,), ascending.
    values
        Shape (ny, nx); NaN where unknown.
    angle
        Whether x may close to a turn: it does if both ends of all rows are equal.

    Returns
    -------
    numpy.ndarray
        Shape (ny,): NaN where a row is flat, and for runs of few rows between two jumps.
    """
    known = np.where(np.isfinite(values), values, np.inf)
    heights = np.ma.masked_invalid(values).ptp(axis=1).filled(0.0)
    whole, turn = float(heights.max(initial=0.0)), float(x[-1] - x[0])
    closed = angle and len(x) > 2 and bool(np.all(np.abs(values[:, 0] - values[:, -1]) <= 1e-3 * whole))
    # One place more at either end: the neighbour across the turn, or a wall.
    beyond = known[:, [-2, 1]] if closed else np.full((len(known), 2), np.inf)
    padded = np.column_stack([beyond[:, 0], known, beyond[:, 1]])
    three = 1 + known.argmin(axis=1)[:, None] + np.array([-1, 0, 1])
    at = np.array([x[-2] - turn, *x, x[1] + turn])[three]
    # The slope of the parabola rises linearly from the middle of one step to the middle of the other.
    middle = 0.5 * (at[:, :-1] + at[:, 1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.diff(np.take_along_axis(padded, three, axis=1)) / np.diff(at)
        bent = np.isfinite(slope).all(axis=1) & (slope[:, 0] < slope[:, 1])
        share = slope[:, 0] / (slope[:, 1] - slope[:, 0])
        vertex = np.clip(middle[:, 0] - share * (middle[:, 1] - middle[:, 0]), *middle.T)
    places = np.where(bent, x[0] + (vertex - x[0]) % turn if closed else vertex, at[:, 1])
    places[heights <= 0.02 * whole] = np.nan
    for begin, end in pairwise([*_jumps(places, turn), len(places)]):
        if end - begin < 0.08 * len(places):
            places[begin:end] = np.nan
    return places


def _jumps(places: FloatArray, turn: float) -> IndexArray:
    """The rows at which another run begins: a step that is a larger share of the range of x."""
    return np.flatnonzero(~(np.abs(np.diff(places, prepend=np.nan)) <= 0.1 * turn))


def _draw_cells(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw a cell for each point of a surface over (vertical, x), in the order of values."""
    vertical, x = map(str, surface.dims)
    columns, rows = (np.arange(surface.sizes[name]) for name in (x, vertical))
    mesh = axes.pcolormesh(columns, rows, surface, shading="nearest", rasterized=True, **look)
    for axis, name, most in ((axes.xaxis, x, 9), (axes.yaxis, vertical, 20)):
        words = [
            coordinate_words(name, value, surface[name].attrs) for value in surface[name].values.tolist()
        ]
        tick_names(axis, [as_text(each.replace("_", " ")) for each in words], most)
    axes.tick_params(axis="y", labelsize="small" if len(rows) <= 16 else "x-small")
    return mesh


def mark_cells(axes: Axes, outside: xr.DataArray, is_contour: bool) -> None:
    """Dots on the points over (vertical, x) that are outside of the model, thinned where they are many."""
    up, across = (outside[n].values if is_contour else np.arange(size) for n, size in outside.sizes.items())
    rows, columns = np.nonzero(outside.values)
    steps = [-(-size // _MOST) for size in outside.shape]
    _, kept = np.unique([rows // steps[0], columns // steps[1]], axis=1, return_index=True)
    mark_points(axes, across[columns[kept]], up[rows[kept]], outside.attrs["long_name"])


def mark_borders(axes: Axes, regime: xr.DataArray) -> None:
    """Draw the borders between regimes over (vertical, x), and name each where it has most room.

    Parameters
    ----------
    axes
        A panel with contours.
    regime
        Flags, ascending along both dimensions; NaN where unknown.
    """
    from scipy.ndimage import distance_transform_edt, gaussian_filter

    up, at = (regime[dim].values for dim in regime.dims)
    flags, names = regime.fillna(-1).values, flag_words(regime)
    codes, width = np.unique(flags), 1.6 * rcParams["lines.linewidth"]
    if len(codes) == 1:
        return
    # Flags alone give a border in steps from point to point. Beyond the frame a border goes straight on.
    inside = flags == codes[:, None, None]
    around = ((0, 0), (_PAD, _PAD), (_PAD, _PAD))
    padded = np.pad(inside.astype(float), around, mode="reflect", reflect_type="odd")
    wide = (0.0, *(min(_SMOOTHED * size, _PAD / 4) for size in flags.shape))
    smooth = gaussian_filter(padded, wide)[:, _PAD:-_PAD, _PAD:-_PAD]
    for colour, wider in (("white", 2.0), ("black", 1.0)):
        for number, one in enumerate(smooth):
            above = one - np.delete(smooth, number, axis=0).max(axis=0)
            axes.contour(at, up, above, levels=[0.0], colors=colour, linewidths=wider * width, zorder=3)
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": "small", "bbox": box, "zorder": 5}
    for code, one in zip(codes.astype(int), inside, strict=True):
        if code >= 0 and one.mean() > 0.03:
            # The point furthest from what is not inside. Words are wider than high: points count less across.
            distance = distance_transform_edt(np.pad(one, 1), sampling=(1.0, 0.4))[1:-1, 1:-1]
            row, column = np.unravel_index(int(distance.argmax()), one.shape)
            axes.text(at[column], up[row], names[code], **look)
