"""Marks that the panels of one parameter point share: guide lines, limits, instants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rcParams
from numpy.typing import NDArray

from swtstudy.figures.maps import STATE_COLOURS
from swtstudy.mechanics.points import FloatArray

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Grey of guide lines.
FAINT = "0.55"
#: Their dashes.
DASHED, DOTTED = (0, (4, 2)), (0, (1, 1.5))
#: Widths of guide lines, and of the band that shows stick and slip along a loop, over that of a curve.
_GUIDE, _WIDE = 0.55, 4.4
#: Sizes of a dot over that of a marker, and of the number of an instant over that of other letters.
_DOT, _NUMBER = 1.75, 0.75
#: Instants closer than this share of a panel in both directions have one mark.
_NEAR = 0.02
#: A curve whose range is a smaller fraction of its size is constant but for rounding.
_ROUNDING = 1e-13


def bold() -> float:
    """Width of a curve."""
    return float(rcParams["lines.linewidth"])


def thin() -> float:
    """Width of guide lines."""
    return _GUIDE * bold()


def draw_edge_states(axes: Axes, x: FloatArray, y: FloatArray, state: NDArray[np.int8]) -> None:
    """A wide band under a loop: whether the contact sticks or slips, in the colours of the slip map."""
    from matplotlib.collections import LineCollection

    path = np.stack([x, y], axis=1)
    steps = np.stack([path[:-1], path[1:]], axis=1)
    colours = [STATE_COLOURS[each] for each in state[:-1]]
    look: dict[str, Any] = {"linewidths": _WIDE * bold(), "capstyle": "round", "zorder": 1}
    axes.add_collection(LineCollection(list(steps), colors=colours, **look))


def draw_direction(axes: Axes, u: FloatArray, depth: FloatArray, marked: list[int]) -> None:
    """An arrow in the direction of the loop, far from the marks."""
    size = max(np.ptp(u), np.ptp(depth)) or 1.0
    path = np.stack([u / size, depth / size])
    distance = np.linalg.norm(path[:, :, None] - path[:, None, marked], axis=0).min(axis=1)
    at = int(distance[1:-1].argmax()) + 1
    if distance[at] > 0.0:
        ends: dict[str, Any] = {"xytext": (u[at - 1], depth[at - 1]), "xy": (u[at + 1], depth[at + 1])}
        axes.annotate("", **ends, arrowprops={"arrowstyle": "-|>", "color": "black", "mutation_scale": 18})


def limits(values: FloatArray, below: float, above: float, size: float = 0.0) -> tuple[float, float]:
    """Limits of an axis with room at both ends; constant values get room relative to their size."""
    low, span = float(values.min()), float(np.ptp(values))
    size = max(size, float(np.abs(values).max()))
    if span <= _ROUNDING * size:
        low, span = low - 0.05 * (size or 1.0), 0.1 * (size or 1.0)
    return low - below * span, low + (1.0 + above) * span


def instants(dataset: xr.Dataset) -> list[tuple[int, int]]:
    """Number, and index along time, of each marked instant."""
    times = dataset.instant_time.values
    return [
        (int(n), int(np.abs(dataset.time.values - t).argmin()))
        for n, t in zip(dataset.instant.values, times, strict=True)
    ]


def dot() -> float:
    """Size of a dot."""
    return float(_DOT * rcParams["lines.markersize"])


def mark_along(axes: Axes, dataset: xr.Dataset, x: FloatArray, y: FloatArray) -> None:
    """The numbers of the instants along a loop."""
    _mark(axes, [(number, x[index], y[index]) for number, index in instants(dataset)])


def mark_over_time(axes: Axes, dataset: xr.Dataset, height: float) -> None:
    """The numbers of the instants over time, at a height as a share of the panel's."""
    low, high = axes.get_ylim()
    at = zip(dataset.instant.values, dataset.instant_time.values, strict=True)
    _mark(axes, [(int(number), float(time), low + height * (high - low)) for number, time in at])


def _mark(axes: Axes, marks: list[tuple[int, float, float]]) -> None:
    """Numbers in discs; those of one place in one, for the later would hide the earlier."""
    near = _NEAR * np.array([np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())])
    groups: list[list[tuple[int, float, float]]] = []
    for mark in marks:
        apart = [np.abs(np.subtract(mark, group[0])[1:]) for group in groups]
        group = next((g for g, each in zip(groups, apart, strict=True) if np.all(each < near)), None)
        if group is None:
            groups.append([mark])
        else:
            group.append(mark)
    for group in groups:
        words = ", ".join(str(number) for number, _, _ in group)
        shape = "circle,pad=0.18" if len(group) == 1 else "round,pad=0.18,rounding_size=0.6"
        disc = {"boxstyle": shape, "facecolor": "white", "edgecolor": "black", "linewidth": 0.8}
        look: dict[str, Any] = {"fontsize": _NUMBER * rcParams["font.size"], "bbox": disc, "zorder": 5}
        axes.text(*group[0][1:], words, ha="center", va="center", **look)
