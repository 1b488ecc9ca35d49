"""The panels of the figure of one parameter point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rcParams
from numpy.typing import NDArray

from swtstudy.figures.maps import STATE_COLOURS, draw_slip_map, draw_time_axis
from swtstudy.mechanics.points import FloatArray

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

#: Grey of guide lines.
_FAINT = "0.55"
#: Their dashes.
_DASHED, _DOTTED = (0, (4, 2)), (0, (1, 1.5))
#: Widths of guide lines, and of the band that shows stick and slip along a loop, over that of a curve.
_GUIDE, _WIDE = 0.55, 4.4
#: Sizes of a dot over that of a marker, and of the number of an instant over that of other letters.
_DOT, _NUMBER = 1.75, 0.75
#: What is prescribed, by the coordinate ``control``.
_PRESCRIBED = {
    "displacements": "$u$ and $\\delta$",
    "forces": "$F_x$ and $F_N$",
    "normal_force+tangential_displacement": "$u$ and $F_N$",
    "normal_displacement+tangential_force": "$F_x$ and $\\delta$",
}
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


def draw_load(axes: Axes, dataset: xr.Dataset) -> None:
    """The path of the load in (u, δ), its direction, stick and slip."""
    u, depth = dataset.displacement.values, dataset.depth.values
    draw_edge_states(axes, u, depth, dataset.edge_state.values)
    axes.plot(u, depth, color="black", linestyle="-", marker="")
    axes.axvline(0.0, color=_FAINT, linewidth=thin(), zorder=0)
    axes.axhline(1.0, color=_FAINT, linewidth=thin(), zorder=0)
    axes.set_xlim(_limits(u, 0.14, 0.14, 1.0))
    axes.set_ylim(_limits(depth, 0.14, 0.14, 1.0))
    if depth.min() < 0.0:
        axes.axhspan(axes.get_ylim()[0], 0.0, color="0.92", zorder=0)
        axes.text(0.02, 0.02, "no contact", transform=axes.transAxes, color="0.3")
    _draw_direction(axes, u, depth, [index for _, index in _instants(dataset)])
    _mark_along(axes, dataset, u, depth)
    axes.set_xlabel(f"$u$:  ${dataset.displacement.attrs['symbol']}$")
    axes.set_ylabel(f"$\\delta$:  ${dataset.depth.attrs['symbol']}$")
    axes.set_title(f"load path, {_PRESCRIBED[str(dataset.control.item())]} prescribed", loc="left")


def draw_edge_states(axes: Axes, x: FloatArray, y: FloatArray, state: NDArray[np.int8]) -> None:
    """A wide band under a loop: whether the contact sticks or slips, in the colours of the slip map."""
    from matplotlib.collections import LineCollection

    path = np.stack([x, y], axis=1)
    steps = np.stack([path[:-1], path[1:]], axis=1)
    colours = [STATE_COLOURS[each] for each in state[:-1]]
    look: dict[str, Any] = {"linewidths": _WIDE * bold(), "capstyle": "round", "zorder": 1}
    axes.add_collection(LineCollection(list(steps), colors=colours, **look))


def _draw_direction(axes: Axes, u: FloatArray, depth: FloatArray, marked: list[int]) -> None:
    """An arrow in the direction of the loop, far from the marks."""
    size = max(np.ptp(u), np.ptp(depth)) or 1.0
    path = np.stack([u / size, depth / size])
    distance = np.linalg.norm(path[:, :, None] - path[:, None, marked], axis=0).min(axis=1)
    at = int(distance[1:-1].argmax()) + 1
    if distance[at] > 0.0:
        ends: dict[str, Any] = {"xytext": (u[at - 1], depth[at - 1]), "xy": (u[at + 1], depth[at + 1])}
        axes.annotate("", **ends, arrowprops={"arrowstyle": "-|>", "color": "black", "mutation_scale": 18})


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
            _DASHED,
            "critical point" if _is_finite(dataset) else "largest sampled",
        ),
        (stick, _DOTTED, "always sticks"),
    ):
        if radius > 0.0:
            look: dict[str, Any] = {"color": "black", "linewidth": thin(), "linestyle": dashes}
            handles.append(axes.axhline(radius, label=words, **look))
    for time in dataset.instant_time.values:
        axes.axvline(time, color="black", linewidth=thin(), alpha=0.6)
    _mark_over_time(axes, dataset, 0.95)
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
    axes.axvline(float(dataset.shown_x), color="black", linewidth=thin(), linestyle=_DASHED)
    axes.set_xlabel("$x/a_H$")
    axes.set_ylabel(r"$q\,a_H/(E^* \delta_0)$")
    axes.set_title(r"traction, $|q| \leq \mu p$", loc="left")


def draw_stress(axes: Axes, dataset: xr.Dataset) -> None:
    """The cycle of stress and strain on the critical plane."""
    time, stress, strain = dataset.time, dataset.normal_stress, dataset.normal_strain
    (line,) = axes.plot(time, stress, label=r"$\sigma_n$")
    other = axes.twinx()
    other.plot([], [])  # advances the property cycle, for another colour
    (dashed,) = other.plot(time, strain, label=r"$\varepsilon_n$")
    other.grid(False)
    peak = int(stress.values.argmax())
    axes.plot(time[peak], stress[peak], marker="o", markersize=_dot(), color=line.get_color(), linestyle="")
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
        look: dict[str, Any] = {"color": line.get_color(), "linestyle": _DOTTED, "marker": ""}
        axes.plot(time, dataset.bulk_stress, **look, label=r"$\sigma_B$")
        axes.text(0.02, 0.03, r"dotted: $\sigma_B$", transform=axes.transAxes, color=line.get_color())
        shown = np.concatenate([shown, dataset.bulk_stress.values])
    for one, values in ((axes, shown), (other, strain.values)):
        one.set_ylim(_limits(values, 0.08, 0.22))
    _mark_over_time(axes, dataset, 0.94)
    place = "on the critical plane at" if _is_finite(dataset) else "at the largest swt sampled,"
    axes.set_title(f"{place} $x/a_H$ = ${float(dataset.shown_x):.3f}$", loc="left")


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
    for radius, dashes, words in ((least, _DOTTED, r"$a_{\min}$"), (largest, "-", r"$a_{\max}$")):
        for side in (-1.0, 1.0):
            axes.axvline(side * radius, color=_FAINT, linewidth=thin(), linestyle=dashes)
        if radius > 0.0:
            box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
            axes.text(radius, 1.39 * top, words, ha="center", va="center", fontsize="small", bbox=box)
    axes.plot(x, found, marker="o", markersize=_dot(), color="black", linestyle="", clip_on=False)
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
    """Whether there is a critical point; otherwise the point shown is that of the largest swt sampled."""
    return math.isfinite(float(dataset.s))


def _limits(values: FloatArray, below: float, above: float, size: float = 0.0) -> tuple[float, float]:
    """Limits of an axis with room at both ends; constant values get room relative to their size."""
    low, span = float(values.min()), float(np.ptp(values))
    size = max(size, float(np.abs(values).max()))
    if span <= _ROUNDING * size:
        low, span = low - 0.05 * (size or 1.0), 0.1 * (size or 1.0)
    return low - below * span, low + (1.0 + above) * span


def _instants(dataset: xr.Dataset) -> list[tuple[int, int]]:
    """Number, and index along time, of each marked instant."""
    times = dataset.instant_time.values
    return [
        (int(n), int(np.abs(dataset.time.values - t).argmin()))
        for n, t in zip(dataset.instant.values, times, strict=True)
    ]


def _lines(axes: Axes, dataset: xr.Dataset, name: str, along: str) -> list[tuple[int, Line2D]]:
    """One line for each marked instant, with its number."""
    lines = []
    for number in dataset.instant.values:
        (line,) = axes.plot(dataset[along], dataset[name].sel(instant=number), label=str(number))
        lines.append((int(number), line))
    axes.axhline(0.0, color=_FAINT, linewidth=thin(), zorder=0)
    return lines


def _bound(line: Line2D) -> dict[str, Any]:
    """Keywords that draw the bounds of a line."""
    colour = line.get_color()
    return {"color": colour, "linestyle": "-", "linewidth": 0.7, "alpha": 0.45, "marker": ""}


def _dot() -> float:
    """Size of a dot."""
    return float(_DOT * rcParams["lines.markersize"])


def _mark_along(axes: Axes, dataset: xr.Dataset, x: FloatArray, y: FloatArray) -> None:
    """The numbers of the instants along a loop."""
    _mark(axes, [(number, x[index], y[index]) for number, index in _instants(dataset)])


def _mark_over_time(axes: Axes, dataset: xr.Dataset, height: float) -> None:
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
