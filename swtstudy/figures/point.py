"""One parameter point in one figure: load, slip, springs, tractions, stress, swt and forces.

A colour is a state of the contact, or one of the numbered instants, which are the same in all panels.
"""

from __future__ import annotations

import math
from itertools import cycle
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from swtstudy.figures.sheet import Sheet, Width
from swtstudy.figures.style import DASHES, Style, arrow, dots, entitle, stroke
from swtstudy.figures.words import NO_LABELS, Labels, flag_words, show_units, tick_in_pi
from swtstudy.points.validity import validity_lines
from swtstudy.results.inspection import inspect_point
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, NORMAL_STRAIN, REGIMES, SHEAR_STRESS, SWT, family_of
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.wording import place_words

#: Size of a panel on a screen, and its least height in print, inches: there is much in each.
_PANEL, _LEAST_HEIGHT = (4.4, 3.8), 2.4
#: Grey of guide lines, and of the second of two curves.
_FAINT, _SECOND = "0.55", "0.4"
#: Colours of open contact, stick, forward and backward slip; in greyscale white, light, dark and medium.
STATE_COLOURS = ("#FFFFFF", "#D9D9D9", "#0072B2", "#E69F00")
#: Colours of the marked instants: not the colours of stick and slip.
_INSTANTS = ("#009E73", "#CC79A7", "#D55E00", "#56B4E9")
_DASHED, _DOTTED = (0, (4, 2)), (0, (1, 1.5))
#: Under words.
_BOX: dict[str, Any] = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
#: Words for the prescribed motion, by the coordinate ``control``.
_PRESCRIBED = {
    "displacements": "$u$ and $\\delta$",
    "forces": "$F_x$ and $F_N$",
    "normal_force+tangential_displacement": "$u$ and $F_N$",
    "normal_displacement+tangential_force": "$F_x$ and $\\delta$",
}
#: Symbols of the four components without their scales.
_PLAIN = {"displacement": "u", "depth": r"\delta", "tangential_force": "F_x", "normal_force": "F_N"}


def inspect(*, style: Style | None = None, width: Width | None = None, **parameters: object) -> Figure:
    """One figure of one parameter point: its load path, slip, tractions, stress cycle and swt.

    Parameters
    ----------
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each; the others are as in
        Table 1.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels; save it with its method ``savefig``. `swtstudy.inspect_point` returns the numbers shown.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or in the width.
    """
    return draw_inspection(inspect_point(**parameters), style, width)


def draw_inspection(
    dataset: xr.Dataset,
    style: Style | None = None,
    width: Width | None = None,
    labels: Labels = NO_LABELS,
    headlines: tuple[str, tuple[str, ...]] | None = None,
) -> Figure:
    """Draw a parameter point.

    Parameters
    ----------
    dataset
        The point, as from `swtstudy.inspect_point`.
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.
    labels
        Variables of a real contact in its units.
    headlines
        Given values of a real contact, and the lines of its validity.

    Returns
    -------
    matplotlib.figure.Figure
        Nine panels: the load path; stick and slip over the cycle; the memory diagram, that is the springs'
        tangential force; tractions; the stress cycle on the critical plane; swt along the surface; the plane
        of the forces; these over the cycle; the force–displacement loop. Stick and slip are coloured along
        all three loops, and the same numbered instants are marked in all panels but swt's. Plane
        contacts have no panels with displacements.
    """
    panels = _PANELS if "displacement" in dataset else _OF_STRIP
    sheet = Sheet(1, len(panels), width, _PANEL, least_height=_LEAST_HEIGHT, fold=False)
    with sheet.drawn(style) as (figure, (own,)):
        for axes, draw, letter in zip(own, panels, "ABCDEFGHI", strict=False):
            draw(axes, dataset, labels)
            entitle(axes, f"({letter})  {axes.get_title('left')}")
        figure.suptitle(_headline(dataset, labels, headlines))
    return figure


def _headline(dataset: xr.Dataset, labels: Labels, headlines: tuple[str, tuple[str, ...]] | None) -> str:
    if headlines is None:
        profile = str(dataset.profile.item())
        names = [*family_of(profile).shape, *(n for n, p in PARAMETERS.items() if p.part != "shape")]
        # A loop has neither a frequency nor a phase.
        lacking = ("frequency_ratio", "phase") if "load" in dataset.coords else ()
        names = ["profile", *(n for n in names if n in dataset.coords and n not in lacking)]
        words = (place_words(name, dataset[name].item()) for name in names)
        headlines = ",  ".join(words), validity_lines(dataset)
    given, validity = headlines
    regime = REGIMES[int(dataset.regime)].replace("_", " ")
    found = f"$s$ = {float(dataset.s):.4f},  {regime}"
    if "s_local" in labels:
        swt = labels["s_local"]
        found += f",  ${swt.symbol}$ = {swt.number(float(dataset.s))}"
    if not math.isfinite(float(dataset.s)):
        found = "$s$ is not finite: swt grows without bound towards the edge"
    return "\n".join([given, found, *validity])


def _is_finite(dataset: xr.Dataset) -> bool:
    """Return whether there is a critical point; otherwise the point shown has the largest swt sampled."""
    return math.isfinite(float(dataset.s))


def _thin() -> float:
    """Width of guide lines."""
    return 0.55 * float(rcParams["lines.linewidth"])


#: Share of their size by which values change that are drawn as constant, such as a measured load with noise.
SLIGHT = 5e-3


def limits(values: FloatArray, below: float, above: float, size: float = 0.0) -> tuple[float, float]:
    """Limits of an axis with room at both ends; values that hardly change get room relative to their size."""
    low, span = float(values.min()), float(np.ptp(values))
    size = max(size, float(np.abs(values).max()))
    if span <= SLIGHT * size:
        low, span = low + 0.5 * span - 0.05 * (size or 1.0), 0.1 * (size or 1.0)
    return low - below * span, low + (1.0 + above) * span


def _guide(axes: Axes, values: Any, upright: bool = False, **own: Any) -> list[Line2D]:
    """Thin lines across a panel at values."""
    look = {"color": _FAINT, "linewidth": _thin(), **own}
    return [(axes.axvline if upright else axes.axhline)(each, **look) for each in np.atleast_1d(values)]


def _mark(axes: Axes, marks: list[tuple[int, float, float]]) -> None:
    """Numbers of instants in discs; one disc for each place, for the later would hide the earlier."""
    near = 0.02 * np.array([np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())])
    discs: dict[tuple[float, float], list[int]] = {}
    for number, *place in marks:
        there = (other for other in discs if np.all(np.abs(np.subtract(other, place)) < near))
        discs.setdefault(next(there, (place[0], place[1])), []).append(number)
    for (x, y), numbers in discs.items():
        shape = "circle,pad=0.18" if len(numbers) == 1 else "round,pad=0.18,rounding_size=0.6"
        edge = _INSTANTS[(numbers[0] - 1) % len(_INSTANTS)]
        disc = {"boxstyle": shape, "facecolor": "white", "edgecolor": edge, "linewidth": 1.4}
        look: dict[str, Any] = {"fontsize": 0.75 * rcParams["font.size"], "bbox": disc, "zorder": 5}
        axes.text(x, y, ", ".join(map(str, numbers)), ha="center", va="center", **look)


def _mark_over_time(axes: Axes, dataset: xr.Dataset, height: float, alpha: float) -> None:
    """Lines at the instants, with their numbers at a height as a share of the panel's."""
    low, high = axes.get_ylim()
    _guide(axes, dataset.instant_time.values, True, color="black", alpha=alpha)
    at = zip(dataset.instant.values, dataset.instant_time.values, strict=True)
    _mark(axes, [(int(number), float(time), low + height * (high - low)) for number, time in at])


def _draw_loop(axes: Axes, dataset: xr.Dataset, across: str, up: str, labels: Labels) -> None:
    """A loop with its direction and the numbers of the instants; a wide band under it is stick or slip."""
    x, y = dataset[across].values, dataset[up].values
    path = np.stack([x, y], axis=1)
    colours = [STATE_COLOURS[each] for each in dataset.edge_state.values[:-1]]
    wide: dict[str, Any] = {"linewidths": 4.4 * rcParams["lines.linewidth"], "capstyle": "round", "zorder": 1}
    axes.add_collection(LineCollection(list(np.stack([path[:-1], path[1:]], axis=1)), colors=colours, **wide))
    axes.plot(x, y, **stroke())
    _guide(axes, 0.0, True, zorder=0)
    _guide(axes, 1.0 if up in ("normal_force", "depth") else 0.0, zorder=0)
    axes.set(xlim=limits(x, 0.14, 0.14, 1.0), ylim=limits(y, 0.14, 0.14, 1.0))
    axes.set(xlabel=_words(dataset, across), ylabel=_words(dataset, up))
    show_units(axes, (across, up), labels)
    time = dataset.time.values
    marked = [int(np.abs(time - t).argmin()) for t in dataset.instant_time.values]
    # The arrow is far from the marks.
    scaled = path.T / (max(np.ptp(x), np.ptp(y)) or 1.0)
    distance = np.linalg.norm(scaled[:, :, None] - scaled[:, None, marked], axis=0).min(axis=1)
    at = int(distance[1:-1].argmax()) + 1
    if distance[at] > 0.0:
        arrow(axes, path[at - 1], path[at + 1], mutation_scale=18, shrinkA=2.0, shrinkB=2.0)
    _mark(axes, [(int(n), x[k], y[k]) for n, k in zip(dataset.instant.values, marked, strict=True)])


def _words(dataset: xr.Dataset, name: str) -> str:
    scaled = dataset[name].attrs["symbol"]
    return f"${scaled}$" if scaled.startswith(_PLAIN[name]) else f"${_PLAIN[name]}$:  ${scaled}$"


def draw_load(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The path of the load in (u, δ), its direction, stick and slip."""
    _draw_loop(axes, dataset, "displacement", "depth", labels)
    if dataset.depth.min() < 0.0:
        axes.axhspan(axes.get_ylim()[0], 0.0, color="0.92", zorder=0)
        axes.text(0.02, 0.02, "no contact", transform=axes.transAxes, color="0.3")
    entitle(axes, f"load path, {_PRESCRIBED[str(dataset.control.item())]} prescribed")


def draw_time_axis(axes: Axes, time: xr.DataArray) -> None:
    """Set up the horizontal axis of a panel over time."""
    first, last = float(time.min()), float(time.max())
    axes.set_xlim(first, last)
    tick_in_pi(axes.xaxis, first, last)
    axes.set_xlabel(f"${time.attrs['symbol']}$")


def draw_slip_map(axes: Axes, dataset: xr.Dataset) -> list[Patch]:
    """Draw stick and slip over the distance from the axis and time.

    Parameters
    ----------
    axes
        Where to draw.
    dataset
        From `swtstudy.slip_map`.

    Returns
    -------
    handles
        For a legend of the states.
    """
    colours = ListedColormap(STATE_COLOURS)
    norm = BoundaryNorm(np.arange(len(STATE_COLOURS) + 1) - 0.5, colours.N)
    state = dataset.state.transpose("r", "time")
    # Borders of cells are half way between places. An image: a mesh of so many cells takes longer than all
    # else in the panel.
    edges = []
    for places in (state.time.values, state.r.values):
        middle = 0.5 * (places[1:] + places[:-1])
        edges.append(np.array([2.0 * places[0] - middle[0], *middle, 2.0 * places[-1] - middle[-1]]))
    axes.pcolorfast(*edges, state.values, cmap=colours, norm=norm, rasterized=True)
    both_sides = float(state.r[0]) < 0.0
    for sign in (1.0, -1.0) if both_sides else (1.0,):
        axes.plot(dataset.time, sign * dataset.contact_radius, **stroke(linewidth=1.2))
    draw_time_axis(axes, dataset.time)
    axes.set_ylabel("$x/a_H$" if both_sides else "$r/a_H$")
    return [
        Patch(facecolor=colour, edgecolor="black", label=words)
        for words, colour in zip(flag_words(state), STATE_COLOURS, strict=True)
    ]


def draw_slip(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Stick and slip over the cycle."""
    handles: list[Artist] = list(draw_slip_map(axes, dataset)[1:])
    axes.grid(False)
    axes.set_ylim(float(dataset.r[0]), float(dataset.r[-1]))
    both_sides, shown = float(dataset.r[0]) < 0.0, float(dataset.shown_x)
    if shown:
        words = "critical point" if _is_finite(dataset) else "largest sampled"
        place = shown if both_sides else abs(shown)
        handles += _guide(axes, place, label=words, linestyle=_DASHED, color="black")
    if float(dataset.permanent_stick_radius) > 0.0:
        ends = [float(dataset.stick_left)] * both_sides + [float(dataset.stick_right)]
        handles.append(_guide(axes, ends, label="always sticks", linestyle=_DOTTED, color="black")[-1])
    _mark_over_time(axes, dataset, 0.95, 0.6)
    _add_legend(axes, handles=handles, handlelength=1.4)
    show_units(axes, (None, "r"), labels)
    entitle(axes, "stick and slip over the cycle")


def _add_legend(axes: Axes, **own: Any) -> None:
    """Add a legend beneath the label of the horizontal axis, by its distance in letters."""
    below: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "borderaxespad": 4.4}
    look: dict[str, Any] = {"ncols": 3, "columnspacing": 1.0, "fontsize": "small", **own}
    axes.legend(**look, **below)


def _draw_bounded(axes: Axes, dataset: xr.Dataset, names: tuple[str, str], factor: float, words: str) -> None:
    """One line for each marked instant, between its bounds; in the corner, what faint lines are."""
    name, bound = names
    for number, colour, dashes in zip(dataset.instant.values, cycle(_INSTANTS), cycle(DASHES), strict=False):
        one = dataset.sel(instant=number)
        along = one[one[name].dims[0]]
        axes.plot(along, one[name], **stroke(colour, dashes, label=f"instant {number}"))
        bounds = np.outer(one[bound], (factor, -factor))
        axes.plot(along, bounds, **stroke(colour, linewidth=0.7, alpha=0.45))
    _guide(axes, 0.0, zorder=0)
    look: dict[str, Any] = {"color": "0.25", "fontsize": "small", "bbox": {**_BOX, "alpha": 0.8}}
    axes.text(0.02, 0.02, words, transform=axes.transAxes, **look)


def draw_springs(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The memory diagram: the tangential force of the springs between its bounds."""
    _draw_bounded(axes, dataset, ("force", "compression"), 1.0, r"thin: $\pm w$")
    _add_legend(axes, ncols=2)
    axes.margins(y=0.13)  # room for the words in the corner
    axes.set_xlim(0.0, 1.05 * float(dataset.largest_radius))
    axes.set(xlabel=r"$\xi/a_H$", ylabel=f"${dataset.force.attrs['symbol']}$")
    show_units(axes, ("r", None), labels)
    entitle(axes, r"memory diagram: springs, $|\tau| \leq w$")


def draw_tractions(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The traction between its bounds."""
    mu = float(dataset.friction)
    _draw_bounded(axes, dataset, ("traction", "pressure"), mu, r"thin: $\pm\mu p$;  dashed: $x$ of (E)")
    # The pressure is unbounded next to a sharp edge, which would set the scale.
    highest = 1.3 * mu * float(np.quantile(dataset.pressure, 0.995)) + 1e-3
    largest = 1.08 * float(dataset.largest_radius)
    axes.set(xlim=(-largest, largest), ylim=(-highest, highest))
    _guide(axes, float(dataset.shown_x), True, color="black", linestyle=_DASHED)
    axes.set(xlabel="$x/a_H$", ylabel=r"$q\,a_H/(E^* \delta_0)$")
    show_units(axes, ("x", "traction"), labels)
    entitle(axes, r"traction, $|q| \leq \mu p$")


def draw_stress(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """The cycle of σ_n and of what swings on the critical plane, ε_n or τ."""
    time, stress = dataset.time, dataset.normal_stress
    swing = next(dataset[each.name] for each in (NORMAL_STRAIN, SHEAR_STRESS) if each.name in dataset)
    symbol, is_strain = swing.attrs["symbol"], swing.name == NORMAL_STRAIN.name
    handles = axes.plot(time, stress, **stroke(label=r"$\sigma_n$"))
    other = axes.twinx() if is_strain else axes  # a shear stress has the axis of the normal one
    handles += other.plot(time, swing, **stroke(_SECOND, DASHES[1], label=f"${symbol}$"))
    peak = int(stress.values.argmax())
    axes.plot(time[peak], stress[peak], **dots("black", 1.75))
    last, high, low = float(time[-1]), float(swing.max()), float(swing.min())
    _guide(other, (high, low), color=_SECOND, alpha=0.7)
    arrow(other, (0.93 * last, low), (0.93 * last, high), "<->", _SECOND)
    words: dict[str, Any] = {"color": _SECOND, "ha": "right", "va": "center", "bbox": _BOX}
    other.text(0.915 * last, 0.5 * (high + low), rf"$\Delta{symbol}$", **words)
    draw_time_axis(axes, time)
    shown = stress.values
    if "bulk_stress" in dataset:
        handles += axes.plot(time, dataset.bulk_stress, **stroke(dashes=_DOTTED, label=r"$\sigma_B$"))
        shown = np.concatenate([shown, dataset.bulk_stress.values])
    _scale_stress(axes, other, shown, swing.values)
    unit = r"a_H/(E^* \delta_0)"
    axes.set_ylabel(rf"$\sigma_n\,{unit}$" if is_strain else rf"$\sigma_n\,{unit}$, $\tau\,{unit}$")
    axes.legend(handles=handles, loc="lower left", ncols=3, fontsize="small", handlelength=2.0)
    _mark_over_time(axes, dataset, 0.94, 0.35)
    show_units(axes, (None, "normal_stress"), labels)
    if is_strain:
        other.grid(False)
        other.set_ylabel(r"$\varepsilon_n\,a_H/\delta_0$", color=_SECOND)
        show_units(other, (None, str(swing.name)), labels)
    place = "on the critical plane at" if _is_finite(dataset) else "at the largest swt sampled,"
    x = float(dataset.shown_x)
    at_x = f"$x$ = {labels['x'].number(x)}" if "x" in labels else f"$x/a_H$ = ${x:.3f}$"
    entitle(axes, f"{place} {at_x}")


def _scale_stress(axes: Axes, other: Axes, stress: FloatArray, swing: FloatArray) -> None:
    """Limits with room for marks above and a legend below; on two axes the zeros are at one height."""
    if other is axes:
        axes.set_ylim(limits(np.concatenate([stress, swing]), 0.2, 0.22))
        return
    ends = np.array([limits(np.append(values, 0.0), 0.2, 0.22) for values in (stress, swing)])
    share = ends / np.ptp(ends, axis=1)[:, None]
    for one, span in zip((axes, other), np.ptp(ends, axis=1), strict=True):
        one.set_ylim(share[:, 0].min() * span, share[:, 1].max() * span)


def draw_swt(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """swt along the surface, and the critical plane."""
    finite, criterion = _is_finite(dataset), str(dataset.s.attrs.get("criterion", SWT))
    found = float(dataset.s) if finite else float(dataset.s_local.max())
    top, largest, least = found or 1.0, float(dataset.largest_radius), float(dataset.least_radius)
    small: dict[str, Any] = {"ha": "center", "fontsize": "small"}
    axes.plot(dataset.x, dataset.s_local, **stroke())
    if float(dataset.permanent_stick_radius) > 0.0:
        left, right = float(dataset.stick_left), float(dataset.stick_right)
        axes.axvspan(left, right, color="0.85", zorder=0)
        axes.text(0.5 * (left + right), 0.04 * top, "always\nsticks", va="bottom", color="0.25", **small)
    # The labels of close radii are at heights of their own, apart from the inset.
    lower = 1.24 if least > 0.5 * largest else 1.02
    ends = ((least, _DOTTED, r"$a_{\min}$", lower), (largest, "-", r"$a_{\max}$", 1.39))
    for radius, dashes, words, height in ends:
        _guide(axes, (-radius, radius), True, linestyle=dashes)
        if radius > 0.0:
            axes.text(radius, height * top, words, va="center", bbox={**_BOX, "pad": 0.5}, **small)
    axes.plot(float(dataset.shown_x), found, **dots("black", 1.75))
    axes.set(xlim=(-1.2 * largest, 1.2 * largest), ylim=(0.0, 1.45 * top), xlabel="$x/a_H$")
    over = r"\mathrm{swt}/\mathrm{SWT}_0" if criterion == SWT else CRITERIA[criterion].over_unit
    axes.set_ylabel(f"${over}$")
    show_units(axes, ("x", "s_local"), labels)
    what = "swt" if criterion == SWT else dataset.s_local.attrs["long_name"].replace("-", "–")
    entitle(axes, f"{what} along the surface{'' if finite else '; dot: largest sampled'}")
    _draw_plane(axes, float(dataset.shown_angle))


def _draw_plane(axes: Axes, degrees: float) -> None:
    """An inset with the critical plane in the half-space: the surface, the plane and its normal."""
    inset = axes.inset_axes((0.37, 0.74, 0.26, 0.24))
    angle = math.radians(degrees)
    normal = np.array([math.cos(angle), -math.sin(angle)])  # z points down
    plane = np.array([-normal[1], normal[0]])
    plane = plane if plane[1] < 0.0 else -plane
    inset.axhspan(-1.0, 0.0, color="0.9")
    inset.plot([-1.2, 1.2], [0, 0], **stroke(linewidth=_thin()))
    inset.plot(*np.outer(plane, (0.0, 0.85)), **stroke(linewidth=1.5 * rcParams["lines.linewidth"]))
    arrow(inset, 0.42 * plane, 0.42 * plane + 0.6 * normal)
    inset.text(-1.3, -0.5, f"{degrees:.1f}°".replace("-", "−"), ha="right", va="center", fontsize="small")
    inset.set(xlim=(-1.2, 1.2), ylim=(-1.0, 0.3), xticks=[], yticks=[], aspect="equal")
    inset.set_frame_on(False)
    inset.grid(False)


def draw_load_plane(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Tangential against normal force, with what friction carries, stick and slip coloured."""
    _draw_loop(axes, dataset, "tangential_force", "normal_force", labels)
    ends, highest = axes.axis(), axes.get_ylim()[1]
    axes.fill_betweenx([0.0, highest], [0.0, -highest], [0.0, highest], color="0.95", zorder=0)
    axes.plot([-highest, 0.0, highest], [highest, 0.0, highest], **stroke(_FAINT, linewidth=_thin()))
    axes.axis(ends)
    entitle(axes, r"load plane of forces, $|F_x| \leq \mu F_N$")


def draw_forces(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Both forces over the cycle, the tangential one between its bounds."""
    time, names = dataset.time, ("normal_force", "tangential_force")
    scale = [labels[n].scale if n in labels else 1.0 for n in names]
    words = [f"${labels[n].symbol}$" if n in labels else _words(dataset, n) for n in names]
    normal, tangential = (dataset[n] * each for n, each in zip(names, scale, strict=True))
    axes.plot(time, normal, **stroke(label=words[0]))
    axes.plot(time, tangential, **stroke(_SECOND, DASHES[1], label=words[1]))
    look = stroke(dashes=_DOTTED, linewidth=_thin(), label="" if labels else f"$-${words[0]}")
    for sign in (1.0, -1.0) if labels else (-1.0,):
        # The force that friction bears has the unit of the tangential force.
        axes.plot(time, sign * scale[1] * dataset.normal_force, **look)
    _guide(axes, 0.0, zorder=0)
    axes.set_ylim(limits(np.concatenate([normal.values, tangential.values]), 0.08, 0.24))
    draw_time_axis(axes, time)
    _mark_over_time(axes, dataset, 0.94, 0.35)
    _add_legend(axes)
    unit = labels[names[0]].unit.strip() if labels else ""
    axes.set_ylabel(f"force ({unit})" if unit else "")
    entitle(axes, "forces over the cycle" + (r", dotted: $\pm\mu F_N$" if labels else ""))


def draw_force_loop(axes: Axes, dataset: xr.Dataset, labels: Labels = NO_LABELS) -> None:
    """Tangential force over displacement: the area of the fretting loop is the work dissipated in a cycle."""
    _draw_loop(axes, dataset, "displacement", "tangential_force", labels)
    work = float(dataset.dissipation)
    axes.fill(dataset.displacement, dataset.tangential_force, color="0.9", linewidth=0, zorder=0)
    number = labels["dissipation"].number(work, 3) if labels else f"{work:.3g}"
    entitle(axes, f"fretting loop, {'' if labels else 'area = '}dissipation {number}")


#: The panels, and the panels of a plane contact, whose displacements are not known.
_OF_BOTH = (draw_slip, draw_springs, draw_tractions, draw_stress, draw_swt)
_PANELS = (draw_load, *_OF_BOTH, draw_load_plane, draw_forces, draw_force_loop)
_OF_STRIP = (draw_load_plane, *_OF_BOTH, draw_forces)
