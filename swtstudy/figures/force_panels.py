"""The panels of forces and displacements in the figure of one parameter point.

Guide lines, limits and instants are marked as in its other panels.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from swtstudy.figures.maps import STATE_COLOURS, draw_time_axis
from swtstudy.figures.quantity_words import NO_LABELS, Labels
from swtstudy.figures.style import DASHES, stroke
from swtstudy.vocabulary.arrays import FloatArray

#: Grey of guide lines, and of the second of two curves. A colour is a state of the contact, or an instant.
FAINT, SECOND = "0.55", "0.4"
#: Of the marked instants: none of those of stick and slip.
_INSTANTS = ("#009E73", "#CC79A7", "#D55E00", "#56B4E9")
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


def instant_colour(number: int) -> str:
    """Colour of a marked instant, counted from 1."""
    return _INSTANTS[(int(number) - 1) % len(_INSTANTS)]


def bold() -> float:
    """Width of a curve."""
    return float(rcParams["lines.linewidth"])


def thin() -> float:
    """Width of guide lines."""
    return _GUIDE * bold()


def draw_edge_states(axes: Axes, x: FloatArray, y: FloatArray, state: NDArray[np.int8]) -> None:
    """A wide band under a loop: whether the contact sticks or slips, in the colours of the slip map."""
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
        edge = instant_colour(group[0][0])
        disc = {"boxstyle": shape, "facecolor": "white", "edgecolor": edge, "linewidth": 1.4}
        look: dict[str, Any] = {"fontsize": _NUMBER * rcParams["font.size"], "bbox": disc, "zorder": 5}
        axes.text(*group[0][1:], words, ha="center", va="center", **look)


#: Symbols of the four components without their scales.
_PLAIN = {"displacement": "u", "depth": r"\delta", "tangential_force": "F_x", "normal_force": "F_N"}


def draw_load_plane(axes: Axes, dataset: xr.Dataset) -> None:
    """Tangential against normal force, with what friction carries, stick and slip coloured."""
    force, normal = dataset.tangential_force.values, dataset.normal_force.values
    draw_loop(axes, dataset, "tangential_force", "normal_force")
    highest = axes.get_ylim()[1]
    axes.fill_betweenx([0.0, highest], [0.0, -highest], [0.0, highest], color="0.95", zorder=0)
    for sign in (1.0, -1.0):
        axes.plot([0.0, sign * highest], [0.0, highest], **stroke(FAINT, linewidth=thin()))
    axes.set_xlim(limits(force, 0.14, 0.14, 1.0))
    axes.set_ylim(limits(normal, 0.14, 0.14, 1.0))
    axes.set_title(r"load plane of forces, $|F_x| \leq \mu F_N$", loc="left")


def draw_forces(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Both forces over the cycle, the tangential one between its bounds."""
    time, names = dataset.time, ("normal_force", "tangential_force")
    normal, tangential = (dataset[n] * (labels[n].scale if n in labels else 1.0) for n in names)
    words = [f"${labels[n].symbol}$" if n in labels else _words(dataset, n) for n in names]
    axes.plot(time, normal, **stroke(label=words[0]))
    axes.plot(time, tangential, **stroke(SECOND, DASHES[1], label=words[1]))
    # What friction bears is a force of the tangential one's unit.
    bound = dataset.normal_force * (labels[names[1]].scale if labels else 1.0)
    look = stroke(dashes=DOTTED, linewidth=thin(), label="" if labels else f"$-${words[0]}")
    for sign in (1.0, -1.0) if labels else (-1.0,):
        axes.plot(time, sign * bound, **look)
    axes.axhline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.set_ylim(limits(np.concatenate([normal.values, tangential.values]), 0.08, 0.34))
    for when in dataset.instant_time.values:
        axes.axvline(when, color="black", linewidth=thin(), alpha=0.35)
    draw_time_axis(axes, time)
    mark_over_time(axes, dataset, 0.94)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.9), ncols=3, fontsize="small")
    unit = labels[names[0]].unit if labels else ""
    axes.set_ylabel(f"force ({unit.strip()})" if unit else "")
    axes.set_title("forces over the cycle" + (r", dotted: $\pm\mu F_N$" if labels else ""), loc="left")


def draw_force_loop(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Tangential force over displacement: the area of the fretting loop is the work dissipated in a cycle."""
    draw_loop(axes, dataset, "displacement", "tangential_force")
    work = float(dataset.dissipation)
    axes.fill(dataset.displacement, dataset.tangential_force, color="0.9", linewidth=0, zorder=0)
    words = f"fretting loop, area = dissipation {work:.3g}"
    if labels:
        words = f"fretting loop, dissipation {labels['dissipation'].number(work, 3)}"
    axes.set_title(words, loc="left")


def draw_loop(axes: Axes, dataset: xr.Dataset, across: str, up: str) -> None:
    x, y = dataset[across].values, dataset[up].values
    draw_edge_states(axes, x, y, dataset.edge_state.values)
    axes.plot(x, y, **stroke())
    axes.axvline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.axhline(1.0 if up in ("normal_force", "depth") else 0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.set_xlim(limits(x, 0.14, 0.14, 1.0))
    axes.set_ylim(limits(y, 0.14, 0.14, 1.0))
    draw_direction(axes, x, y, [index for _, index in instants(dataset)])
    mark_along(axes, dataset, x, y)
    axes.set_xlabel(_words(dataset, across))
    axes.set_ylabel(_words(dataset, up))


def _words(dataset: xr.Dataset, name: str) -> str:
    scaled = dataset[name].attrs["symbol"]
    return f"${scaled}$" if scaled.startswith(_PLAIN[name]) else f"${_PLAIN[name]}$:  ${scaled}$"
