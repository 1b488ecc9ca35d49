"""A profile by itself: what it looks like, how deep its springs are, and its pressure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swtstudy.figures.sheet import Sheet, Width, wrap_texts
from swtstudy.figures.style import Style, stroke, styled
from swtstudy.figures.words import NO_LABELS, Labels, show_units
from swtstudy.points.reading import read_grid
from swtstudy.points.values import as_number
from swtstudy.profiles.at_rest import AtRest
from swtstudy.profiles.families import MEAN_LOAD
from swtstudy.profiles.table import TabulatedProfile
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import family_of
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.wording import place_words

#: Radii of the curves, over the contact radius at δ0.
_RADII, _REACH = 1201, 1.45


def draw_profile(*, style: Style | None = None, width: Width | None = None, **parameters: object) -> Figure:
    """A picture of a profile: its shape f with the coordinates and the two loads, g, and the pressure at δ0.

    Parameters
    ----------
    style, width
        As for `swtstudy.accessor.SwtAccessor.figure`.
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
        As for `swtstudy.accessor.SwtAccessor.figure`.
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
    with styled(style, width):
        sheet = Sheet(1, 2, width, (4.8, 4.0))
        figure = sheet.figure()
        sketch, springs = sheet.panels(figure, share_x="none", share_y="none")[0]
        _draw_sketch(sketch, profile, _REACH * edge)
        _draw_lengths(sketch, profile, shape, labels)
        _draw_springs(springs, profile, edge, labels)
        show_units(sketch, ("x", "height"), labels)
        numbers = (place_words(name, value) for name, value in shape.items())
        words = [given] if given else [place_words("profile", str(pressed)), *numbers]
        if isinstance(pressed, TabulatedProfile):
            sketch.plot(pressed.radius, pressed.height - 1.0, ".", ms=3, color="C1", label="table")
            off = pressed.deviation
            missed = labels["height"].number(off, 2) if labels else f"{off:.1e} δ0"
            words.append(f"{pressed.radius.size} points, missed by {missed} at most")
        figure.suptitle(("\n" if labels else ",  ").join(words))
        wrap_texts(figure)
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
    arrow = {"arrowstyle": "-|>", "color": "k", "lw": 1.4, "shrinkA": 0.0, "shrinkB": 0.0}
    for end, word, offset in (((0.45 * reach, 0.0), "$x$", (3, 4)), ((0.0, -1.3), "$z$", (5, 0))):
        axes.annotate("", end, (0.0, 0.0), arrowprops=arrow)
        axes.annotate(word, end, offset, textcoords="offset points")
    plane = profile.plane
    normal, tangential = ("line load $P$", "$Q$") if plane else ("depth $\\delta$, force", "$u$, force")
    loads = (
        ((0.0, 0.5), (0.0, 1.0), (0.04, 0.8), f"normal load: {normal}"),
        ((-0.45, 0.3), (-0.85, 0.3), (-0.97, 0.38), f"tangential: {tangential}"),
    )
    for *places, words in loads:
        end, start, at = ((reach * x, top * y) for x, y in places)
        axes.annotate("", end, start, arrowprops={**arrow, "color": "C3", "lw": 2.0})
        axes.annotate(words, at, color="C3", fontsize="small")
    axes.annotate("$\\delta_0$", (-0.12 * reach, -0.6), color="0.3")
    axes.set(xlim=(-reach, reach), ylim=(-1.35, top), xlabel="$x/a_H$", ylabel="$-z/\\delta_0$")
    axes.set_title(f"f, undeformed, {'sunk by δ0' if plane else 'at the depth δ0'}", loc="left")


def _draw_lengths(axes: Axes, profile: AtRest, shape: Mapping[str, float], labels: Labels) -> None:
    """The radius of the face, or the length of a wave and its height, above the lower end of the indenter."""
    look: dict[str, Any] = {"arrowstyle": "<|-|>", "color": "k", "lw": 0.8, "shrinkA": 0.0, "shrinkB": 0.0}
    right = axes.get_xlim()[1]
    face = shape.get("flat_radius", shape.get("flat_half_width", 0.0))
    if face:
        end = min(face, right)
        axes.annotate("", (end, -0.8), (0.0, -0.8), arrowprops={**look, "mutation_scale": 8.0})
        axes.plot([face, face], [-1.0, -0.72], **stroke(linewidth=0.6))
        axes.annotate("$b$", (0.5 * end, -0.77), ha="center", va="bottom")
    height = shape.get("waviness_amplitude", 0.0)
    length = shape.get("wavelength", 0.0) * height**0.5
    if length:
        # The waves are −h cos kx about the paraboloid: crests half a wave from the axis.
        first = length * (0.5 + math.floor(0.5 * right / length))
        level = float(_height(profile, np.array([first, first + length])).max()) - 1.0 + 0.12
        axes.annotate("", (first + length, level), (first, level), arrowprops={**look, "mutation_scale": 6.0})
        tall = labels["height"].number(2.0 * height, 3) if labels else f"{2.0 * height:.3g} $\\delta_0$"
        words = f"$\\lambda$, height $2h$ = {tall}"
        axes.annotate(words, (first, level + 0.03), ha="center", va="bottom", fontsize="small")


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
    what = "line load, and pressure at its mean" if profile.plane else "springs, and pressure at δ0"
    axes.set_title(what, loc="left")
    axes.legend(frameon=False, loc="upper left")


def _height(profile: AtRest, radius: FloatArray) -> FloatArray:
    """f from g: f(r) = (2/π) ∫ g dξ/√(r² − ξ²), with ξ = r sin θ; in the plane N r/ξ replaces g."""
    node, weight = np.polynomial.legendre.leggauss(200)
    θ = 0.25 * np.pi * (1.0 + node)
    g = profile.depth((radius[:, None] * np.sin(θ)).reshape(1, -1)).reshape(radius.size, -1)
    if profile.plane:
        weight = MEAN_LOAD * weight / np.sin(θ)
    return np.asarray((g @ weight) * 0.5)
