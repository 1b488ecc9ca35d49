"""The panels of forces and displacements in the figure of one parameter point."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.in_units import NO_LABELS, Labels
from swtstudy.figures.maps import draw_time_axis
from swtstudy.figures.panel_marks import (
    DOTTED,
    FAINT,
    SECOND,
    draw_direction,
    draw_edge_states,
    instants,
    limits,
    mark_along,
    mark_over_time,
    thin,
)
from swtstudy.figures.style import DASHES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Symbols of the four components without their scales.
_PLAIN = {"displacement": "u", "depth": r"\delta", "tangential_force": "F_x", "normal_force": "F_N"}


def draw_load_plane(axes: Axes, dataset: xr.Dataset) -> None:
    """Tangential against normal force, with what friction carries, stick and slip coloured."""
    force, normal = dataset.tangential_force.values, dataset.normal_force.values
    _draw_loop(axes, dataset, "tangential_force", "normal_force")
    highest = axes.get_ylim()[1]
    axes.fill_betweenx([0.0, highest], [0.0, -highest], [0.0, highest], color="0.95", zorder=0)
    for sign in (1.0, -1.0):
        look: dict[str, Any] = {"color": FAINT, "linewidth": thin(), "linestyle": "-", "marker": ""}
        axes.plot([0.0, sign * highest], [0.0, highest], **look)
    axes.set_xlim(limits(force, 0.14, 0.14, 1.0))
    axes.set_ylim(limits(normal, 0.14, 0.14, 1.0))
    axes.set_title(r"load plane of forces, $|F_x| \leq \mu F_N$", loc="left")


def draw_forces(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Both forces over the cycle, the tangential one between its bounds."""
    time, names = dataset.time, ("normal_force", "tangential_force")
    normal, tangential = (dataset[n] * (labels[n].scale if n in labels else 1.0) for n in names)
    words = [f"${labels[n].symbol}$" if n in labels else _words(dataset, n) for n in names]
    axes.plot(time, normal, color="black", linestyle="-", marker="", label=words[0])
    look: dict[str, Any] = {"color": SECOND, "linestyle": DASHES[1], "marker": ""}
    axes.plot(time, tangential, label=words[1], **look)
    # What friction bears is a force of the tangential one's unit.
    bound = dataset.normal_force * (labels[names[1]].scale if labels else 1.0)
    look = {"color": "black", "linestyle": DOTTED, "linewidth": thin(), "marker": ""}
    for sign in (1.0, -1.0) if labels else (-1.0,):
        axes.plot(time, sign * bound, label="" if labels else f"$-${words[0]}", **look)
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
    """Tangential force against displacement; the area of the loop is the work dissipated in a cycle."""
    _draw_loop(axes, dataset, "displacement", "tangential_force")
    work = float(dataset.dissipation)
    axes.fill(dataset.displacement, dataset.tangential_force, color="0.9", linewidth=0, zorder=0)
    words = f"force and displacement, area {work:.3g}"
    if labels:
        words = f"force loop, work {labels['dissipation'].number(work, 3)}"
    axes.set_title(words, loc="left")


def _draw_loop(axes: Axes, dataset: xr.Dataset, across: str, up: str) -> None:
    x, y = dataset[across].values, dataset[up].values
    look: dict[str, Any] = {"color": "black", "linestyle": "-", "marker": ""}
    draw_edge_states(axes, x, y, dataset.edge_state.values)
    axes.plot(x, y, **look)
    axes.axvline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.axhline(1.0 if up == "normal_force" else 0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.set_xlim(limits(x, 0.14, 0.14, 1.0))
    axes.set_ylim(limits(y, 0.14, 0.14, 1.0))
    draw_direction(axes, x, y, [index for _, index in instants(dataset)])
    mark_along(axes, dataset, x, y)
    axes.set_xlabel(_words(dataset, across))
    axes.set_ylabel(_words(dataset, up))


def _words(dataset: xr.Dataset, name: str) -> str:
    scaled = dataset[name].attrs["symbol"]
    return f"${scaled}$" if scaled.startswith(_PLAIN[name]) else f"${_PLAIN[name]}$:  ${scaled}$"
