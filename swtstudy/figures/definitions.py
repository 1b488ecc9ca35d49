"""A load or a profile of a study by itself.

A load: its course, its path, and how near friction comes to its end. A profile: what it looks like, how deep
its springs are, and its pressure.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swtstudy.figures.sheet import Sheet, Width, add_legend
from swtstudy.figures.style import DASHES, Style, arrow, entitle, stroke
from swtstudy.figures.words import NO_LABELS, Labels, show_units
from swtstudy.points.reading import read_grid
from swtstudy.points.values import as_number
from swtstudy.solver.at_rest import AtRest
from swtstudy.solver.load_path import Loop
from swtstudy.solver.table import TabulatedProfile
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import family_of
from swtstudy.vocabulary.families import MEAN_LOAD
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest, refused
from swtstudy.vocabulary.parameters import PARAMETERS, Control
from swtstudy.vocabulary.wording import as_text, place_words

if TYPE_CHECKING:
    from swtstudy.study.definition import Study
    from swtstudy.study.signal import Signal


def draw_load(
    study: Study,
    name: str,
    signal: Signal | None = None,
    *,
    style: Style | None = None,
    width: Width | None = None,
) -> Figure:
    """A picture of a loop of a study: both loads and the bulk stress over a cycle, the path, the friction.

    Parameters
    ----------
    study
        The study; other parameters that vary have their first values.
    name
        Name of the loop.
    signal
        The record of the loop, whose cycles are drawn beneath.
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.

    Returns
    -------
    matplotlib.figure.Figure
        The loads as the contact has them, in the units of the study, and where both are forces the friction
        margin ``|Q|/(μP)``, which must not exceed 1.

    Raises
    ------
    StudyError
        A ValueError, if the study has no such loop.
    """
    loops = {str(load): load for load in study.grid.loops}
    if name not in loops:
        raise refused("load", literal(name), nearest(name, loops, {}) if loops else "a loop")
    grid = study.grid
    # Loads are drawn as forces or displacements; one that rests is what its mean is given as.
    moves = any(map(as_number, grid.values(grid.control.given_for("normal_amplitude"))))
    rests_as_force = not moves and bool(grid.values("normal_force"))
    control = grid.control._replace(normal_force=True) if rests_as_force else grid.control
    names = (control.given_for("normal_amplitude"), control.given_for("tangential_amplitude"))
    labels = (grid.row(each).units for each in (*names, "bulk_stress_amplitude"))
    units = ["" if label in ("", "1") else f" ({as_text(label)})" for label in labels]
    loads = _loads(study, loops[name], "normal_force" if control.normal_force else "depth")
    record = signal if signal is not None and signal.is_absolute else None
    if record is not None:
        # A polygon begins at another vertex than its record: it is turned to the begin of a mean cycle.
        span = np.ptp(loads, axis=0)
        distance = (loads[:-1] - record.mean_cycle[0]) / np.where(span > 0.0, span, 1.0)
        rolled = np.roll(loads[:-1], -int((distance**2).sum(axis=1).argmin()), axis=0)
        loads = np.concatenate([rolled, rolled[:1]])
    phase, forces = np.linspace(0.0, 1.0, len(loads)), control == Control(True, True)
    # Tangential over normal load where friction ends: μ; 1 where loads are over μ F0 and F0.
    slope = _first(study, "friction", 1.0) if any(units) else 1.0
    with Sheet(1, 3 if forces else 2, width).drawn(style) as (figure, ((course, path, *margin),)):
        for column, cycles in enumerate([] if record is None else np.moveaxis(record.cycles, 2, 0)):
            share = np.arange(cycles.shape[1]) / cycles.shape[1]
            course.plot(share, cycles.T, **stroke(f"C{column}", linewidth=0.5, alpha=0.25))
        for column, each in enumerate(("normal", "tangential", "bulk stress")[: loads.shape[1]]):
            look = stroke(f"C{column}", DASHES[column], label=each + units[column])
            course.plot(phase, loads[:, column], **look)
        course.set(xlabel="share of a cycle", ylabel="loads")
        entitle(course, "course")
        path.plot(loads[:, 0], loads[:, 1], **stroke("C0"))
        path.set(xlabel=f"normal load{units[0]}", ylabel=f"tangential load{units[1]}")
        entitle(path, "path")
        if forces:
            end = 1.05 * loads[:, 0].max()
            limit = [-slope * end, 0.0, slope * end]
            path.plot([end, 0.0, end], limit, **stroke("0.5", "--", linewidth=0.8))
            with np.errstate(divide="ignore", invalid="ignore"):
                share = np.abs(loads[:, 1]) / (slope * loads[:, 0])
            margin[0].plot(phase, share, **stroke("C3"))
            margin[0].axhline(1.0, color="0.5", lw=0.8, ls="--")
            margin[0].set(xlabel="share of a cycle", ylabel="$|Q|/(\\mu P)$")
            which = f" at $\\mu$ = {slope:g}" * any(units)
            entitle(margin[0], f"friction, at most {np.nanmax(share):.2f}{which}")
        figure.suptitle(as_text(f"{name}: {signal.words}" if signal else name))
        add_legend(figure)
    return figure


def _first(study: Study, name: str, otherwise: float) -> float:
    values = study.grid.values(name)
    return as_number(values[0]) if values else otherwise


def _loads(study: Study, loop: Loop, mean_name: str) -> FloatArray:
    """Both loads and the bulk stress over a cycle, the first instant again at the end, shape (k, 2 or 3)."""
    grid, course = study.grid, loop.course()
    # The mean normal load that a study has with a loop; 1 where nothing has units.
    means = grid.values(mean_name)
    along = len(means) > 1 and grid.dimension(mean_name) == "load"
    mean = as_number(means[list(grid.values("load")).index(loop) if along else 0]) if means else 1.0
    names = [grid.control.given_for(f"{each}_amplitude") for each in ("normal", "tangential")]
    factors = [_first(study, each, 1.0) for each in (*names, "bulk_stress_amplitude")]
    shift = np.array([mean, 0.0, _first(study, "bulk_stress_mean", 0.0)])
    columns = 2 if loop.bulk_ends is None else 3
    return np.asarray(shift[:columns] + np.array(factors)[:columns] * course[:, :columns])


#: Radii of the curves, over the contact radius at δ0.
_RADII, _REACH = 1201, 1.45


def draw_profile(*, style: Style | None = None, width: Width | None = None, **parameters: object) -> Figure:
    """A picture of a profile: its shape f with the coordinates and the two loads, g, and the pressure at δ0.

    Parameters
    ----------
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.
    **parameters
        profile, a name or a `TabulatedProfile`, and its shape parameters, as for `swtstudy.solve`.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels: f in δ0 over x in a_H, pressed by δ0, with the half-space beneath; g, or of a plane
        contact N, and the pressure. A table has its points, and its title the largest deviation of the fit
        from them.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or in the width.
    """
    wrong = [name for name in parameters if name in PARAMETERS and PARAMETERS[name].part != "shape"]
    if wrong:
        raise StudyError(Mistake(name, "a parameter of the load or the bodies", "a shape") for name in wrong)
    return draw_shape(parameters, style, width)


def draw_shape(
    parameters: Mapping[str, object],
    style: Style | None = None,
    width: Width | None = None,
    labels: Labels = NO_LABELS,
    given: str = "",
) -> Figure:
    """`draw_profile`, of a real contact with units.

    Parameters
    ----------
    parameters
        Without units, the shape alone.
    style, width
        As for `swtstudy.faces.accessor.SwtAccessor.figure`.
    labels
        Lengths and stresses of a real contact in its units.
    given
        Given values of it, for the title.
    """
    still = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.0}
    grid, mistakes = read_grid({**still, **parameters}, {})
    if grid is None:
        raise StudyError(mistakes)
    pressed: Any = grid.fixed["profile"]
    shape = {name: as_number(grid.fixed[name]) for name in family_of(pressed).shape}
    profile = AtRest(pressed, {name: np.array([value]) for name, value in shape.items()})
    edge = float(profile.radius(np.ones((1, 1)))[0, 0])
    with Sheet(1, 2, width, (4.8, 4.0)).drawn(style) as (figure, ((sketch, springs),)):
        _draw_sketch(sketch, profile, _REACH * edge)
        _draw_lengths(sketch, profile, shape, labels)
        _draw_springs(springs, profile, edge, labels)
        show_units(sketch, ("x", "height"), labels)
        numbers = (place_words(name, value) for name, value in shape.items())
        words = [given] if given else [place_words("profile", str(pressed)), *numbers]
        if isinstance(pressed, TabulatedProfile):
            sketch.plot(pressed.radius, pressed.height - 1.0, ".", ms=3, color="C1", label="table")
            sketch.legend(loc="lower right")
            off = pressed.deviation
            missed = labels["height"].number(off, 2) if labels else f"{off:.1e} $\\delta_0$"
            words.append(f"{pressed.radius.size} points, missed by {missed} at most")
        figure.suptitle(("\n" if labels else ",  ").join(words))
    return figure


def _draw_sketch(axes: Axes, profile: AtRest, reach: float) -> None:
    """The indenter at δ0 over the undeformed half-space, the coordinates and the loads."""
    r = np.linspace(0.0, reach, _RADII)
    height = _height(profile, r) - 1.0
    x, lower = np.concatenate([-r[::-1], r]), np.concatenate([height[::-1], height])
    top = max(0.9, float(height.max()))
    axes.fill_between(x, lower, top, color="0.8", lw=0.0)
    axes.plot(x, lower, color="0.2")
    axes.axhline(0.0, color="C0", lw=1.0)
    axes.fill_between(x, -1.35, 0.0, color="C0", alpha=0.12, lw=0.0)
    for end, word, offset in (((0.45 * reach, 0.0), "$x$", (3, 4)), ((0.0, -1.3), "$z$", (5, 0))):
        arrow(axes, (0.0, 0.0), end, lw=1.4)
        axes.annotate(word, end, offset, textcoords="offset points")
    plane = profile.plane
    normal, tangential = ("line load $P$", "$Q$") if plane else ("$\\delta$ or force", "$u$ or force")
    loads = (
        ((0.0, 0.5), (0.0, 1.0), (0.04, 0.8), f"normal: {normal}"),
        ((-0.45, 0.3), (-0.85, 0.3), (-0.97, 0.38), f"tangential: {tangential}"),
    )
    for *places, words in loads:
        end, start, at = ((reach * x, top * y) for x, y in places)
        arrow(axes, start, end, lw=2.0)
        axes.annotate(words, at, fontsize="small")
    axes.annotate("$\\delta_0$", (-0.12 * reach, -0.6), color="0.3")
    axes.set(xlim=(-reach, reach), ylim=(-1.35, top), xlabel="$x/a_H$", ylabel="$-z/\\delta_0$")
    entitle(axes, rf"$f$, undeformed, {'sunk by' if plane else 'at the indentation'} $\delta_0$")


def _draw_lengths(axes: Axes, profile: AtRest, shape: Mapping[str, float], labels: Labels) -> None:
    """The radius of the face, or the length of a wave and its height, above the lower end of the indenter."""
    right = axes.get_xlim()[1]
    face = shape.get("flat_radius", shape.get("flat_half_width", 0.0))
    if face:
        end = min(face, right)
        arrow(axes, (0.0, -0.8), (end, -0.8), "<|-|>", lw=0.8, mutation_scale=8.0)
        axes.plot([face, face], [-1.0, -0.72], **stroke(linewidth=0.6))
        axes.annotate("$b$", (0.5 * end, -0.77), ha="center", va="bottom")
    height = shape.get("waviness_amplitude", 0.0)
    length = shape.get("wavelength", 0.0) * height**0.5
    if length:
        # The waves are −h cos kx about the paraboloid: crests half a wave from the axis.
        first = length * (0.5 + math.floor(0.5 * right / length))
        level = float(_height(profile, np.array([first, first + length])).max()) - 1.0 + 0.12
        arrow(axes, (first, level), (first + length, level), "<|-|>", lw=0.8, mutation_scale=6.0)
        tall = labels["height"].number(2.0 * height, 3) if labels else f"{2.0 * height:.3g} $\\delta_0$"
        words = f"$\\lambda$, height $2h$ = {tall}"
        at = first + 0.5 * length, level + 0.03
        axes.annotate(words, at, ha="center", va="bottom", fontsize="small")


def _draw_springs(axes: Axes, profile: AtRest, edge: float, labels: Labels) -> None:
    """g, or N, and the pressure."""
    r = np.linspace(1e-6, _REACH * edge, _RADII)[None]
    springs = "$N/P_0$" if profile.plane else "$g$" if labels else "$g/\\delta_0$"
    axes.plot(r[0], profile.depth(r)[0], color="C0", label=springs)
    axes.axvline(edge, color="0.6", lw=0.8, ls=":")
    axes.axhline(1.0, color="0.6", lw=0.8, ls=":")
    inside = r[:, r[0] < edge]
    pressure = profile.pressure(inside, np.array([[edge]]))
    axes.plot(inside[0], pressure[0], color="C3", label="$p$" if labels else "$p\\,a_H/(E^*\\delta_0)$")
    axes.set(xlim=(0.0, r.max()), ylim=(0.0, 2.2))
    axes.set_xlabel("half-width$/a_H$" if profile.plane else "radius$/a_H$")
    if labels:
        show_units(axes, ("r", None if profile.plane else "spring_depth"), labels)
        other = axes.twinx()
        other.set_ylim(axes.get_ylim())
        other.grid(False)
        show_units(other, (None, "pressure"), labels)
    plain = "line load, and pressure at its mean"
    entitle(axes, plain if profile.plane else r"springs, and pressure at $\delta_0$")
    axes.legend(frameon=False, loc="upper left")


def _height(profile: AtRest, radius: FloatArray) -> FloatArray:
    """f from g: f(r) = (2/π) ∫ g dξ/√(r² − ξ²), with ξ = r sin θ; in the plane N r/ξ replaces g."""
    node, weight = np.polynomial.legendre.leggauss(200)
    θ = 0.25 * np.pi * (1.0 + node)
    g = profile.depth((radius[:, None] * np.sin(θ)).reshape(1, -1)).reshape(radius.size, -1)
    if profile.plane:
        weight = MEAN_LOAD * weight / np.sin(θ)
    return np.asarray((g @ weight) * 0.5)
