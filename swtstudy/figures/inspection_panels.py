"""The panels of the figure of one parameter point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.in_units import NO_LABELS, Labels, show_units
from swtstudy.figures.maps import draw_slip_map, draw_time_axis
from swtstudy.figures.panel_marks import (
    DASHED,
    DOTTED,
    FAINT,
    bold,
    dot,
    draw_direction,
    draw_edge_states,
    instants,
    limits,
    mark_along,
    mark_over_time,
    thin,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

#: What is prescribed, by the coordinate ``control``.
_PRESCRIBED = {
    "displacements": "$u$ and $\\delta$",
    "forces": "$F_x$ and $F_N$",
    "normal_force+tangential_displacement": "$u$ and $F_N$",
    "normal_displacement+tangential_force": "$F_x$ and $\\delta$",
}


def draw_load(axes: Axes, dataset: xr.Dataset) -> None:
    """The path of the load in (u, δ), its direction, stick and slip."""
    u, depth = dataset.displacement.values, dataset.depth.values
    draw_edge_states(axes, u, depth, dataset.edge_state.values)
    axes.plot(u, depth, color="black", linestyle="-", marker="")
    axes.axvline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.axhline(1.0, color=FAINT, linewidth=thin(), zorder=0)
    axes.set_xlim(limits(u, 0.14, 0.14, 1.0))
    axes.set_ylim(limits(depth, 0.14, 0.14, 1.0))
    if depth.min() < 0.0:
        axes.axhspan(axes.get_ylim()[0], 0.0, color="0.92", zorder=0)
        axes.text(0.02, 0.02, "no contact", transform=axes.transAxes, color="0.3")
    draw_direction(axes, u, depth, [index for _, index in instants(dataset)])
    mark_along(axes, dataset, u, depth)
    axes.set_xlabel(f"$u$:  ${dataset.displacement.attrs['symbol']}$")
    axes.set_ylabel(f"$\\delta$:  ${dataset.depth.attrs['symbol']}$")
    axes.set_title(f"load path, {_PRESCRIBED[str(dataset.control.item())]} prescribed", loc="left")


def draw_slip(axes: Axes, dataset: xr.Dataset) -> None:
    """Stick and slip over the cycle."""
    handles: list[Artist] = list(draw_slip_map(axes, dataset)[1:])
    axes.grid(False)
    top = float(dataset.r[-1])
    axes.set_ylim(0.0, top)
    stick = float(dataset.permanent_stick_radius)
    for radius, dashes, words in (
        (
            abs(float(dataset.shown_x)),
            DASHED,
            "critical point" if _is_finite(dataset) else "largest sampled",
        ),
        (stick, DOTTED, "always sticks"),
    ):
        if radius > 0.0:
            look: dict[str, Any] = {"color": "black", "linewidth": thin(), "linestyle": dashes}
            handles.append(axes.axhline(radius, label=words, **look))
    for time in dataset.instant_time.values:
        axes.axvline(time, color="black", linewidth=thin(), alpha=0.6)
    mark_over_time(axes, dataset, 0.95)
    # Beneath the axis with its label, by its distance in letters.
    below: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "borderaxespad": 4.4}
    axes.legend(handles=handles, ncols=3, handlelength=1.4, columnspacing=1.0, fontsize="small", **below)
    axes.set_title("stick and slip over the cycle", loc="left")


def draw_springs(axes: Axes, dataset: xr.Dataset) -> None:
    """The memory diagram: the tangential force of the springs between its bounds."""
    for number, line in _lines(axes, dataset, "force", "r"):
        w = dataset.compression.sel(instant=number)
        for sign in (1.0, -1.0):
            axes.plot(dataset.r, sign * w, **_bound(line))
    axes.legend(
        title="instant", handlelength=2.0, fontsize="small", title_fontsize="small", loc="upper right"
    )
    axes.set_xlim(0.0, 1.05 * float(dataset.largest_radius))
    axes.set_xlabel(r"$\xi/a_H$")
    axes.set_ylabel(f"${dataset.force.attrs['symbol']}$")
    axes.set_title(r"memory diagram: springs, $|\tau| \leq w$", loc="left")


def draw_tractions(axes: Axes, dataset: xr.Dataset) -> None:
    """The traction between its bounds."""
    mu = float(dataset.friction)
    for number, line in _lines(axes, dataset, "traction", "x"):
        p = dataset.pressure.sel(instant=number)
        for sign in (1.0, -1.0):
            axes.plot(dataset.x, sign * mu * p, **_bound(line))
    # The pressure is unbounded next to a sharp edge, which would set the scale.
    highest = mu * float(np.quantile(dataset.pressure, 0.995))
    axes.set_ylim(-1.2 * highest - 1e-3, 1.2 * highest + 1e-3)
    largest = 1.08 * float(dataset.largest_radius)
    axes.set_xlim(-largest, largest)
    axes.axvline(float(dataset.shown_x), color="black", linewidth=thin(), linestyle=DASHED)
    axes.set_xlabel("$x/a_H$")
    axes.set_ylabel(r"$q\,a_H/(E^* \delta_0)$")
    axes.set_title(r"traction, $|q| \leq \mu p$", loc="left")


def draw_stress(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The cycle of stress and strain on the critical plane."""
    time, stress, strain = dataset.time, dataset.normal_stress, dataset.normal_strain
    (line,) = axes.plot(time, stress, label=r"$\sigma_n$")
    other = axes.twinx()
    other.plot([], [])  # advances the property cycle, for another colour
    (dashed,) = other.plot(time, strain, label=r"$\varepsilon_n$")
    other.grid(False)
    peak = int(stress.values.argmax())
    axes.plot(time[peak], stress[peak], marker="o", markersize=dot(), color=line.get_color(), linestyle="")
    high, low = float(strain.max()), float(strain.min())
    for level in (high, low):
        other.axhline(level, color=dashed.get_color(), linewidth=thin(), alpha=0.7)
    at = 0.93 * float(time[-1])
    arrow = {"arrowstyle": "<->", "color": dashed.get_color(), "shrinkA": 0, "shrinkB": 0}
    other.annotate("", xy=(at, high), xytext=(at, low), arrowprops=arrow)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
    words: dict[str, Any] = {"color": dashed.get_color(), "ha": "right", "va": "center", "bbox": box}
    other.text(0.915 * float(time[-1]), 0.5 * (high + low), r"$\Delta\varepsilon_n$", **words)
    for when in dataset.instant_time.values:
        axes.axvline(when, color="black", linewidth=thin(), alpha=0.35)
    draw_time_axis(axes, dataset.time)
    axes.set_ylabel(r"$\sigma_n\,a_H/(E^* \delta_0)$", color=line.get_color())
    other.set_ylabel(r"$\varepsilon_n\,a_H/\delta_0$", color=dashed.get_color())
    shown = stress.values
    if "bulk_stress" in dataset:
        look: dict[str, Any] = {"color": line.get_color(), "linestyle": DOTTED, "marker": ""}
        axes.plot(time, dataset.bulk_stress, **look, label=r"$\sigma_B$")
        axes.text(0.02, 0.03, r"dotted: $\sigma_B$", transform=axes.transAxes, color=line.get_color())
        shown = np.concatenate([shown, dataset.bulk_stress.values])
    for one, values in ((axes, shown), (other, strain.values)):
        one.set_ylim(limits(values, 0.08, 0.22))
    mark_over_time(axes, dataset, 0.94)
    place = "on the critical plane at" if _is_finite(dataset) else "at the largest swt sampled,"
    show_units(other, (None, "normal_strain"), labels)
    x = float(dataset.shown_x)
    at_x = f"$x$ = {labels['x'].number(x)}" if "x" in labels else f"$x/a_H$ = ${x:.3f}$"
    axes.set_title(f"{place} {at_x}", loc="left")


def draw_swt(axes: Axes, dataset: xr.Dataset) -> None:
    """swt along the surface, and the critical plane."""
    x, largest = float(dataset.shown_x), float(dataset.largest_radius)
    found = float(dataset.s) if _is_finite(dataset) else float(dataset.s_local.max())
    top = found or 1.0
    (line,) = axes.plot(dataset.x, dataset.s_local)
    axes.fill_between(dataset.x, 0.0, dataset.s_local, color=line.get_color(), alpha=0.12, linewidth=0)
    stick, least = float(dataset.permanent_stick_radius), float(dataset.least_radius)
    if stick > 0.0:
        axes.axvspan(-stick, stick, color="0.85", zorder=0)
        axes.text(0.0, 0.04 * top, "always\nsticks", ha="center", va="bottom", color="0.25", fontsize="small")
    for radius, dashes, words in ((least, DOTTED, r"$a_{\min}$"), (largest, "-", r"$a_{\max}$")):
        for side in (-1.0, 1.0):
            axes.axvline(side * radius, color=FAINT, linewidth=thin(), linestyle=dashes)
        if radius > 0.0:
            box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
            axes.text(radius, 1.39 * top, words, ha="center", va="center", fontsize="small", bbox=box)
    axes.plot(x, found, marker="o", markersize=dot(), color="black", linestyle="", clip_on=False)
    axes.set_xlim(-1.2 * largest, 1.2 * largest)
    axes.set_ylim(0.0, 1.45 * top)
    axes.set_xlabel("$x/a_H$")
    axes.set_ylabel(r"$\mathrm{swt}/\mathrm{SWT}_0$")
    words = "" if _is_finite(dataset) else "; dot: largest sampled"
    axes.set_title(f"swt along the surface{words}", loc="left")
    _draw_plane(axes, dataset)


def _draw_plane(axes: Axes, dataset: xr.Dataset) -> None:
    """An inset with the critical plane in the half-space: the surface, the plane and its normal."""
    inset = axes.inset_axes((0.37, 0.74, 0.26, 0.24))
    angle = math.radians(float(dataset.shown_angle))
    normal = np.array([math.cos(angle), -math.sin(angle)])  # z points down
    plane = np.array([-normal[1], normal[0]])
    plane = plane if plane[1] < 0.0 else -plane
    inset.axhspan(-1.0, 0.0, color="0.9")
    inset.plot([-1.2, 1.2], [0, 0], color="black", linestyle="-", linewidth=thin(), marker="")
    inset.plot(
        [0, 0.85 * plane[0]],
        [0, 0.85 * plane[1]],
        color="black",
        linestyle="-",
        linewidth=1.5 * bold(),
        marker="",
    )
    start = 0.42 * plane
    arrow = {"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0}
    inset.annotate("", xy=tuple(start + 0.6 * normal), xytext=tuple(start), arrowprops=arrow)
    inset.text(-1.3, -0.5, f"{float(dataset.shown_angle):.1f}°", ha="right", va="center", fontsize="small")
    inset.set(xlim=(-1.2, 1.2), ylim=(-1.0, 0.3), xticks=[], yticks=[], aspect="equal")
    inset.set_frame_on(False)
    inset.grid(False)


def _is_finite(dataset: xr.Dataset) -> bool:
    """Return whether there is a critical point; otherwise the point shown has the largest swt sampled."""
    return math.isfinite(float(dataset.s))


def _lines(axes: Axes, dataset: xr.Dataset, name: str, along: str) -> list[tuple[int, Line2D]]:
    """One line for each marked instant, with its number."""
    lines = []
    for number in dataset.instant.values:
        (line,) = axes.plot(dataset[along], dataset[name].sel(instant=number), label=str(number))
        lines.append((int(number), line))
    axes.axhline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    return lines


def _bound(line: Line2D) -> dict[str, Any]:
    """Keywords that draw the bounds of a line."""
    colour = line.get_color()
    return {"color": colour, "linestyle": "-", "linewidth": 0.7, "alpha": 0.45, "marker": ""}
