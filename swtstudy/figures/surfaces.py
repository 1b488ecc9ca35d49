"""Panels of a quantity over two dimensions: contours, or a heat map.

Where it is least and greatest along x is found between the points of its grid.
"""

from __future__ import annotations

import itertools
import math
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps, rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, LogNorm, Normalize
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import BboxBase
from numpy.typing import NDArray

from swtstudy.figures.quantity_words import flag_words, is_life
from swtstudy.figures.ticks import power_words, tick_cells, tick_in_pi
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import as_text, coordinate_words

#: A row whose range is a smaller share of the whole surface's is flat: it has no place of an extremum.
_FLAT = 0.02
#: Ends that differ by a smaller share of the range are one place of a period.
_SAME_ENDS = 1e-3
#: A step along x that is a larger share of its range leads to another extremum.
_JUMP = 0.1
#: A smaller share of the rows is no line.
_LEAST_SHARE = 0.08


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
    heights = np.array([np.ptp(row[np.isfinite(row)]) if np.isfinite(row).any() else 0.0 for row in values])
    whole, turn, last = float(heights.max(initial=0.0)), float(x[-1] - x[0]), len(x) - 1
    closed = angle and last >= 2 and bool(np.all(np.abs(values[:, 0] - values[:, -1]) <= _SAME_ENDS * whole))
    places = np.full(len(values), np.nan)
    for k in np.flatnonzero(heights > _FLAT * whole):
        least = int(known[k].argmin())
        places[k] = x[least]
        if 0 < least < last:
            at, (a, b, c) = x[least - 1 : least + 2], known[k, least - 1 : least + 2]
        elif closed:
            at = np.array([x[-2] - turn, x[0], x[1]]) + (turn if least == last else 0.0)
            a, b, c = known[k, [-2, least, 1]]
        else:
            continue
        left, right = (b - a) / (at[1] - at[0]), (c - b) / (at[2] - at[1])
        if np.isfinite(left) and np.isfinite(right) and right > left:
            # The slope of the parabola falls linearly from the middle of one step to that of the other.
            first, second = 0.5 * (at[:-1] + at[1:])
            vertex = float(np.clip(first - left * (second - first) / (right - left), first, second))
            places[k] = x[0] + (vertex - x[0]) % turn if closed else vertex
    ends = [*jumps(places, turn), len(places)]
    for begin, end in pairwise(ends):
        if end - begin < _LEAST_SHARE * len(places):
            places[begin:end] = np.nan
    return places


def jumps(places: FloatArray, turn: float) -> IndexArray:
    """The rows at which another run begins."""
    step = np.abs(np.diff(places, prepend=np.nan))
    return np.flatnonzero(~(step <= _JUMP * turn))


#: Most ticks of a heat map's axes.
_TICKS_ACROSS, _TICKS_UP = 9, 20

#: More rows have smaller words.
_MANY_ROWS = 16

#: Approximate number of contours: as many as are legible with labels.
_LEVELS = 13

#: Panels have a scale of colours each where one fills less than this share of their common one.
_COMMON = 0.15

#: Colours of a lower luminance have white letters.
_DARK = 0.18

#: All in shares of a panel: a label is so far inside the frame; so far, across and up, from lines and from
#: other labels; and a contour has one from this length on.
_INSIDE, _BESIDE, _APART, _SHORTEST = 0.08, (0.07, 0.05), (0.2, 0.12), 0.16
#: A contour bends where its direction changes by more from point to point, rad.
_BENT = 0.25

#: Contours that are smaller than this share of a panel in both directions are left out.
_ISLAND = 0.05


def draw_surfaces(
    figure: Figure, axes: NDArray[Any], surfaces: list[xr.DataArray], kind: str, words: str
) -> None:
    """Draw a row of panels, with one scale of colours unless a panel would have few of them.

    Parameters
    ----------
    figure, axes
        The figure and the panels of the row.
    surfaces
        A quantity over (vertical, x) for each panel; each flag has a colour, with its meaning at the colour
        bar.
    kind
        "contour" or "heatmap".
    words
        Label of the colour bar.
    """
    names = flag_words(surfaces[0])
    if not names and not _in_common(surfaces):
        for one, surface in zip(axes, surfaces, strict=True):
            draw_surfaces(figure, np.array([one]), [surface], kind, words)
        return
    look = (
        _flag_colours(names) if names else {"norm": _scale_of(surfaces, kind), "cmap": _colours(surfaces[0])}
    )
    for one, surface in zip(axes, surfaces, strict=True):
        if kind == "heatmap":
            filled = draw_cells(one, surface, look)
        elif names:
            filled = draw_areas(one, surface, look)
        else:
            filled = draw_contours(one, surface, look)
    bar = figure.colorbar(filled, ax=axes, label=words, pad=0.02)
    if is_life(surfaces[0].attrs) and kind == "contour":
        bar.ax.yaxis.set_major_formatter(lambda value, _: power_words(value))
    if names:
        bar.set_ticks(range(len(names)), labels=names)
        bar.ax.tick_params(which="both", length=0)


def _colours(surface: xr.DataArray) -> str:
    """The colour map of a quantity: dark is kind, so that long lives are; a ratio is pale where it is 1."""
    if is_ratio(surface):
        return "PuOr_r"
    own = str(rcParams["image.cmap"])
    return (own[:-2] if own.endswith("_r") else f"{own}_r") if is_life(surface.attrs) else own


def is_ratio(surface: xr.DataArray) -> bool:
    """Return whether a quantity is s over s at one place."""
    return str(surface.attrs.get("symbol", "")) == "s/s_0"


def _in_common(surfaces: list[xr.DataArray]) -> bool:
    """Return whether every panel fills enough of a common scale of colours to be read."""
    ends = np.array([[float(surface.min()), float(surface.max())] for surface in surfaces])
    whole = np.nanmax(ends) - np.nanmin(ends) if np.isfinite(ends).any() else 0.0
    return bool(np.all(~(ends[:, 1] - ends[:, 0] < _COMMON * whole)))


def _scale_of(surfaces: list[xr.DataArray], kind: str) -> Normalize:
    """One colour scale for all panels of a row, in steps for contours."""
    values = np.concatenate([surface.values.ravel() for surface in surfaces])
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if is_life(surfaces[0].attrs) and low > 0.0:
        return LogNorm(low, high) if kind == "heatmap" else _decades(low, high)
    if is_ratio(surfaces[0]):
        most = max(high - 1.0, 1.0 - low, 1e-3)
        low, high = 1.0 - most, 1.0 + most
    if kind == "heatmap":
        return Normalize(low, high)
    return BoundaryNorm(MaxNLocator(_LEVELS).tick_values(low, high), 256)


def _decades(low: float, high: float) -> Normalize:
    """Levels in equal ratios, whole or broken parts of decades."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    digits = (1.0, 2.0, 5.0) if 3 * (last - first) <= _LEVELS else (1.0,)
    levels = [digit * 10.0**power for power in range(first, last + 1) for digit in digits]
    inner = [level for level in levels if low < level < high]
    begin = max((level for level in levels if level <= low), default=low)
    end = min((level for level in levels if level >= high), default=high)
    return BoundaryNorm([begin, *inner, end], 256)


def _flag_colours(names: list[str]) -> dict[str, Any]:
    """A colour for each flag, in order from dark to light."""
    colours = colormaps[rcParams["image.cmap"]].resampled(len(names))
    return {"cmap": colours, "norm": BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names))}


def draw_areas(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw areas of flags over (vertical, x), with borders half way between points; grey where NaN."""
    vertical, x = map(str, surface.dims)
    axes.set_facecolor("0.8")
    surface = surface.sortby([vertical, x])
    at = surface[x], surface[vertical]
    mesh = axes.pcolormesh(*at, surface, shading="nearest", rasterized=True, **look)
    axes.set(xlim=surface[x].values[[0, -1]], ylim=surface[vertical].values[[0, -1]])
    axes.grid(False)
    _tick_angles(axes, surface)
    return mesh


def draw_contours(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw contours of a surface over (vertical, x); for s also where it is least and greatest along x."""
    vertical, x = map(str, surface.dims)
    levels, life = look["norm"].boundaries, is_life(surface.attrs)
    surface = surface.sortby([vertical, x])
    at = surface[x], surface[vertical]
    axes.set_facecolor("0.8")
    filled = axes.contourf(*at, surface, levels=levels, **look)
    lines = axes.contour(*at, surface, levels=levels, colors="black", linewidths=0.5, alpha=0.6)
    if bool(surface.notnull().all()):
        for contours in (filled, lines):
            _leave_out_islands(contours, axes.dataLim)
    if surface.name == "s":
        _draw_extrema(axes, surface)
    shown = levels if life else levels[::2]
    labels: dict[str, Any] = {"fmt": power_words if life else "%g", "fontsize": "x-small"}
    places = _room_for_labels(axes, filled, lines, shown)
    labels |= {"manual": places, "colors": [_ink(filled, float(level)) for level in shown]}
    for words in axes.clabel(lines, shown, **labels) if places else ():
        words.set(color=words.get_color()[:3], alpha=1.0)  # not as pale as the lines
    axes.grid(False)
    _tick_angles(axes, surface)
    return filled


def _room_for_labels(axes: Axes, filled: Artist, lines: ContourSet, shown: Any) -> list[tuple[float, float]]:
    """Where labels have most room on their contours, apart from the frame, lines and one another.

    Returns
    -------
    list of (x, y)
        In data coordinates; at most one for each connected part of a contour.
    """
    axes.autoscale_view()
    to_panel = axes.transData - axes.transAxes
    borders = [each for each in axes.collections if isinstance(each, ContourSet)]
    paths = [path for each in borders if each not in (filled, lines) for path in each.get_paths()]
    taken = [*(line.get_xydata() for line in axes.lines), *(path.vertices for path in paths)]
    beside = to_panel.transform(np.concatenate([np.empty((0, 2)), *taken]))
    beside = beside[np.isfinite(beside).all(axis=1)]
    names = [label.get_position() for label in axes.texts]
    placed = to_panel.transform(np.array(names).reshape(-1, 2))
    for path in itertools.compress(lines.get_paths(), np.isin(np.asarray(lines.levels), shown)):
        for part in _parts(path):
            at = to_panel.transform(part)
            if np.ptp(at, axis=0).max() < _SHORTEST:
                continue
            step = np.gradient(at, axis=0)
            bend = np.abs(np.angle(np.exp(1j * np.diff(np.arctan2(step[:, 1], step[:, 0])))))
            room = np.minimum(at, 1.0 - at).min(axis=1) / _INSIDE
            for others, apart in ((beside, _BESIDE), (placed, _APART)):
                near = np.abs(at[:, None] - others[None]) / np.array(apart)
                room = np.minimum(room, near.max(axis=2).min(axis=1, initial=np.inf))
            room[1:][bend > _BENT] = 0.0
            if room.max() >= 1.0:
                placed = np.vstack([placed, at[room.argmax()]])
    found = to_panel.inverted().transform(placed[len(names) :])
    return [(float(x), float(y)) for x, y in found]


def _parts(path: Path) -> list[FloatArray]:
    """The points of each connected part of a path, shapes (n, 2)."""
    if path.codes is None:
        return []
    parts = np.split(np.asarray(path.vertices), np.flatnonzero(path.codes == Path.MOVETO)[1:])
    return [part for part in parts if len(part) > 2]


def _ink(colours: ScalarMappable, level: float) -> str:
    """Black or white, whichever is read on the colours beside a level."""
    red, green, blue, _ = colours.to_rgba(level)  # type: ignore[arg-type]
    return "black" if 0.2126 * red**2.2 + 0.7152 * green**2.2 + 0.0722 * blue**2.2 > _DARK else "white"


def _leave_out_islands(contours: ContourSet, panel: BboxBase) -> None:
    """Remove what is too small to be labelled: between two points of a grid a level may come and go."""

    def island(part: NDArray[Any]) -> bool:
        low, high = part.min(axis=0), part.max(axis=0)
        inside = np.all((panel.min < low) & (high < panel.max))
        return bool(inside and np.all(high - low < _ISLAND * np.array([panel.width, panel.height])))

    kept = [[Path(part) for part in _parts(path) if not island(part)] for path in contours.get_paths()]
    contours.set_paths([Path.make_compound_path(*parts) for parts in kept])


def _draw_extrema(axes: Axes, surface: xr.DataArray) -> None:
    """Lines where the surface is least and greatest along x; with a gap where another extremum takes over."""
    vertical, x = map(str, surface.dims)
    at, heights = surface[x].values, surface[vertical].values
    dashes: Any = (0, (4, 2))
    width = 1.2 * rcParams["lines.linewidth"]
    for words, sign, look in (("least", 1.0, "-"), ("greatest", -1.0, dashes)):
        places = lowest(at, sign * surface.values, AXES[x].units == "rad")
        # A gap before each run; not clipped, since an extremum may lie on the frame.
        gaps = jumps(places, float(np.ptp(at)))
        path = np.insert(places, gaps, np.nan), np.insert(heights, gaps, np.nan)
        over: dict[str, Any] = {"marker": "", "clip_on": False, "zorder": 3}
        axes.plot(*path, color="white", linestyle="-", linewidth=2.0 * width, **over)
        label = f"{words} ${surface.name}$"
        axes.plot(*path, color="#B22222", linestyle=look, linewidth=width, label=label, **over)


def _tick_angles(axes: Axes, surface: xr.DataArray) -> None:
    for axis, name in zip((axes.yaxis, axes.xaxis), map(str, surface.dims), strict=True):
        if AXES[name].units == "rad":
            tick_in_pi(axis, float(surface[name].min()), float(surface[name].max()))


def draw_cells(axes: Axes, surface: xr.DataArray, look: dict[str, Any]) -> ScalarMappable:
    """Draw a cell for each point of a surface over (vertical, x), in the order of values; grey where NaN."""
    vertical, x = map(str, surface.dims)
    axes.set_facecolor("0.8")
    columns, rows = (np.arange(surface.sizes[name]) for name in (x, vertical))
    mesh = axes.pcolormesh(columns, rows, surface, shading="nearest", rasterized=True, **look)
    axes.grid(False)
    for axis, name, most in ((axes.xaxis, x, _TICKS_ACROSS), (axes.yaxis, vertical, _TICKS_UP)):
        words = (
            coordinate_words(name, value, surface[name].attrs) for value in surface[name].values.tolist()
        )
        tick_cells(axis, [as_text(each.replace("_", " ")) for each in words], most)
    axes.tick_params(axis="y", labelsize="small" if len(rows) <= _MANY_ROWS else "x-small")
    return mesh
