"""The panels of the figure of one parameter point."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from swtstudy.figures.force_panels import (
    DASHED,
    DOTTED,
    FAINT,
    SECOND,
    bold,
    dot,
    draw_loop,
    instant_colour,
    limits,
    mark_over_time,
    thin,
)
from swtstudy.figures.maps import draw_slip_map, draw_time_axis
from swtstudy.figures.quantity_words import NO_LABELS, Labels, show_units
from swtstudy.figures.style import DASHES, stroke
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, NORMAL_STRAIN, SHEAR_STRESS, SWT

#: Heights of the labels of radii, over the largest swt.
_LOWEST, _LOWER, _UPPER = 1.02, 1.24, 1.39
#: Room below and above the curves of the stress cycle, over their range.
_ROOM = (0.2, 0.22)
#: What is prescribed, by the coordinate ``control``.
_PRESCRIBED = {
    "displacements": "$u$ and $\\delta$",
    "forces": "$F_x$ and $F_N$",
    "normal_force+tangential_displacement": "$u$ and $F_N$",
    "normal_displacement+tangential_force": "$F_x$ and $\\delta$",
}


def draw_load(axes: Axes, dataset: xr.Dataset) -> None:
    """The path of the load in (u, δ), its direction, stick and slip."""
    draw_loop(axes, dataset, "displacement", "depth")
    if dataset.depth.min() < 0.0:
        axes.axhspan(axes.get_ylim()[0], 0.0, color="0.92", zorder=0)
        axes.text(0.02, 0.02, "no contact", transform=axes.transAxes, color="0.3")
    axes.set_ylabel(f"$\\delta$:  ${dataset.depth.attrs['symbol']}$")
    axes.set_title(f"load path, {_PRESCRIBED[str(dataset.control.item())]} prescribed", loc="left")


def draw_slip(axes: Axes, dataset: xr.Dataset) -> None:
    """Stick and slip over the cycle."""
    handles: list[Artist] = list(draw_slip_map(axes, dataset)[1:])
    axes.grid(False)
    axes.set_ylim(float(dataset.r[0]), float(dataset.r[-1]))
    both_sides = float(dataset.r[0]) < 0.0
    shown = float(dataset.shown_x)
    ends = [float(dataset.stick_left)] * both_sides + [float(dataset.stick_right)]
    look: dict[str, Any] = {"color": "black", "linewidth": thin()}
    words = "critical point" if _is_finite(dataset) else "largest sampled"
    if abs(shown) > 0.0:
        place = shown if both_sides else abs(shown)
        handles.append(axes.axhline(place, label=words, linestyle=DASHED, **look))
    if float(dataset.permanent_stick_radius) > 0.0:
        lines = [axes.axhline(end, label="always sticks", linestyle=DOTTED, **look) for end in ends]
        handles.append(lines[-1])
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
    _caption(axes, r"thin: $\pm w$")
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
    _caption(axes, r"thin: $\pm\mu p$;  dashed: $x$ of (E)")
    axes.set_xlabel("$x/a_H$")
    axes.set_ylabel(r"$q\,a_H/(E^* \delta_0)$")
    axes.set_title(r"traction, $|q| \leq \mu p$", loc="left")


def draw_stress(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The cycle of σ_n and of what swings on the critical plane, ε_n or τ."""
    time, stress = dataset.time, dataset.normal_stress
    swing = next(dataset[each.name] for each in (NORMAL_STRAIN, SHEAR_STRESS) if each.name in dataset)
    symbol, is_strain = swing.attrs["symbol"], swing.name == NORMAL_STRAIN.name
    (line,) = axes.plot(time, stress, **stroke(label=r"$\sigma_n$"))
    # A shear stress has the axis of the normal one.
    other = axes.twinx() if is_strain else axes
    (dashed,) = other.plot(time, swing, **stroke(SECOND, DASHES[1], label=f"${symbol}$"))
    peak = int(stress.values.argmax())
    axes.plot(time[peak], stress[peak], marker="o", markersize=dot(), color=line.get_color(), linestyle="")
    high, low = float(swing.max()), float(swing.min())
    for level in (high, low):
        other.axhline(level, color=SECOND, linewidth=thin(), alpha=0.7)
    at = 0.93 * float(time[-1])
    arrow = {"arrowstyle": "<->", "color": SECOND, "shrinkA": 0, "shrinkB": 0}
    other.annotate("", xy=(at, high), xytext=(at, low), arrowprops=arrow)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
    words: dict[str, Any] = {"color": SECOND, "ha": "right", "va": "center", "bbox": box}
    other.text(0.915 * float(time[-1]), 0.5 * (high + low), rf"$\Delta{symbol}$", **words)
    for when in dataset.instant_time.values:
        axes.axvline(when, color="black", linewidth=thin(), alpha=0.35)
    draw_time_axis(axes, dataset.time)
    handles, shown = [line, dashed], stress.values
    if "bulk_stress" in dataset:
        (dotted,) = axes.plot(time, dataset.bulk_stress, **stroke(dashes=DOTTED, label=r"$\sigma_B$"))
        handles.append(dotted)
        shown = np.concatenate([shown, dataset.bulk_stress.values])
    _scale_stress(axes, other, shown, swing.values)
    unit = r"a_H/(E^* \delta_0)"
    axes.set_ylabel(rf"$\sigma_n\,{unit}$" if is_strain else rf"$\sigma_n\,{unit}$, $\tau\,{unit}$")
    if is_strain:
        other.grid(False)
        other.set_ylabel(r"$\varepsilon_n\,a_H/\delta_0$", color=SECOND)
    axes.legend(handles=handles, loc="lower left", ncols=3, fontsize="small", handlelength=2.0)
    mark_over_time(axes, dataset, 0.94)
    place = "on the critical plane at" if _is_finite(dataset) else "at the largest swt sampled,"
    if is_strain:
        show_units(other, (None, str(swing.name)), labels)
    x = float(dataset.shown_x)
    at_x = f"$x$ = {labels['x'].number(x)}" if "x" in labels else f"$x/a_H$ = ${x:.3f}$"
    axes.set_title(f"{place} {at_x}", loc="left")


def _scale_stress(axes: Axes, other: Axes, stress: FloatArray, swing: FloatArray) -> None:
    """Limits with room for marks above and a legend below; on two axes the zeros are at one height."""
    if other is axes:
        axes.set_ylim(limits(np.concatenate([stress, swing]), *_ROOM))
        return
    ends = np.array([limits(np.append(values, 0.0), *_ROOM) for values in (stress, swing)])
    share = ends / np.ptp(ends, axis=1)[:, None]
    low, high = share[:, 0].min(), share[:, 1].max()
    for one, span in zip((axes, other), np.ptp(ends, axis=1), strict=True):
        one.set_ylim(low * span, high * span)


def draw_swt(axes: Axes, dataset: xr.Dataset) -> None:
    """swt along the surface, and the critical plane."""
    x, largest = float(dataset.shown_x), float(dataset.largest_radius)
    found = float(dataset.s) if _is_finite(dataset) else float(dataset.s_local.max())
    top = found or 1.0
    axes.plot(dataset.x, dataset.s_local, **stroke())
    stick, least = float(dataset.permanent_stick_radius), float(dataset.least_radius)
    if stick > 0.0:
        left, right = float(dataset.stick_left), float(dataset.stick_right)
        axes.axvspan(left, right, color="0.85", zorder=0)
        axes.text(
            0.5 * (left + right),
            0.04 * top,
            "always\nsticks",
            ha="center",
            va="bottom",
            color="0.25",
            fontsize="small",
        )
    # The label of the least radius is beneath that of the largest, or beneath the inset.
    lower = _LOWER if least > 0.5 * largest else _LOWEST
    ends = ((least, DOTTED, r"$a_{\min}$", lower), (largest, "-", r"$a_{\max}$", _UPPER))
    for radius, dashes, words, height in ends:
        for side in (-1.0, 1.0):
            axes.axvline(side * radius, color=FAINT, linewidth=thin(), linestyle=dashes)
        if radius > 0.0:
            box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
            axes.text(radius, height * top, words, ha="center", va="center", fontsize="small", bbox=box)
    axes.plot(x, found, marker="o", markersize=dot(), color="black", linestyle="", clip_on=False)
    axes.set_xlim(-1.2 * largest, 1.2 * largest)
    axes.set_ylim(0.0, 1.45 * top)
    axes.set_xlabel("$x/a_H$")
    criterion = str(dataset.s.attrs.get("criterion", SWT))
    axes.set_ylabel(
        r"$\mathrm{swt}/\mathrm{SWT}_0$" if criterion == SWT else f"${CRITERIA[criterion].over_unit}$"
    )
    words = "" if _is_finite(dataset) else "; dot: largest sampled"
    what = "swt" if criterion == SWT else dataset.s_local.attrs["long_name"].replace("-", "–")
    axes.set_title(f"{what} along the surface{words}", loc="left")
    _draw_plane(axes, dataset)


def _draw_plane(axes: Axes, dataset: xr.Dataset) -> None:
    """An inset with the critical plane in the half-space: the surface, the plane and its normal."""
    inset = axes.inset_axes((0.37, 0.74, 0.26, 0.24))
    angle = math.radians(float(dataset.shown_angle))
    normal = np.array([math.cos(angle), -math.sin(angle)])  # z points down
    plane = np.array([-normal[1], normal[0]])
    plane = plane if plane[1] < 0.0 else -plane
    inset.axhspan(-1.0, 0.0, color="0.9")
    inset.plot([-1.2, 1.2], [0, 0], **stroke(linewidth=thin()))
    inset.plot([0, 0.85 * plane[0]], [0, 0.85 * plane[1]], **stroke(linewidth=1.5 * bold()))
    start = 0.42 * plane
    arrow = {"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0}
    inset.annotate("", xy=tuple(start + 0.6 * normal), xytext=tuple(start), arrowprops=arrow)
    inset.text(
        -1.3,
        -0.5,
        f"{float(dataset.shown_angle):.1f}°".replace("-", "−"),
        ha="right",
        va="center",
        fontsize="small",
    )
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
        values = dataset[name].sel(instant=number)
        look = stroke(instant_colour(number), DASHES[(number - 1) % len(DASHES)], label=str(number))
        (line,) = axes.plot(dataset[along], values, **look)
        lines.append((int(number), line))
    axes.axhline(0.0, color=FAINT, linewidth=thin(), zorder=0)
    return lines


def _caption(axes: Axes, words: str) -> None:
    """Say in the lower left corner what faint lines are."""
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
    axes.text(0.02, 0.02, words, transform=axes.transAxes, color="0.25", fontsize="small", bbox=box)


def _bound(line: Line2D) -> dict[str, Any]:
    """Keywords that draw the bounds of a line."""
    return stroke(line.get_color(), linewidth=0.7, alpha=0.45)
