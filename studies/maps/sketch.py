"""A sketch of the contact: bodies, loads, coordinates, stick and slip, the critical point and its plane.

The surface is from Hertz's contact, its depth drawn larger. Run from the project's folder: python
studies/maps/sketch.py
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from cycler import cycler
from matplotlib.axes import Axes

from swtstudy.figures.sheet import WIDTHS, new_figure
from swtstudy.figures.style import COLOURS, save_figure, styled

#: Depth of the indenter, and radius of the zone that sticks, over the contact radius.
DEPTH, STICK = 0.36, 0.55
#: Half the width of the body, where it ends below, and where the indenter ends above.
SIDE, BOTTOM, TOP = 2.15, -1.6, 0.82
#: Angle of the critical plane against the z axis, degrees: its normal is that far from the x axis.
ANGLE = 8.0
INK = "0.15"


def surface(x: np.ndarray) -> np.ndarray:
    """Height of the half-space under a paraboloid: its own shape in the contact, Hertz's sag outside."""
    r = np.maximum(np.abs(x), 1e-9)
    inverse = np.minimum(1.0 / r, 1.0)
    outside = ((2.0 - r**2) * np.arcsin(inverse) + r * np.sqrt(1.0 - inverse**2)) / np.pi
    return -DEPTH * np.where(r < 1.0, 1.0 - 0.5 * r**2, outside)


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], **look: Any) -> None:
    """An arrow, by default thick: a load."""
    style = {"arrowstyle": "-|>", "color": COLOURS[1], "linewidth": 2.2, "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", end, start, arrowprops={**style, "mutation_scale": 9.0, **look}, zorder=5)


def draw_bodies(axes: Axes, points: int) -> None:
    """The half-space, the indenter, and how they meet."""
    x = np.linspace(-SIDE, SIDE, points)
    ground = surface(x)
    axes.fill_between(x, ground, BOTTOM, color="#DCE6EE", linewidth=0)
    indenter = 0.5 * DEPTH * x**2 - DEPTH
    axes.fill_between(x, indenter, TOP, where=indenter < TOP, color="0.8", linewidth=0)
    axes.plot(x, indenter, color=INK, linewidth=0.8)
    axes.plot(x, ground, color=INK, linewidth=1.2)
    for sign in (-1.0, 1.0):
        slip = sign * np.linspace(STICK, 1.0, 60)
        axes.plot(slip, surface(slip), color=COLOURS[1], linewidth=3.2, solid_capstyle="butt")
    stick = np.linspace(-STICK, STICK, 60)
    axes.plot(stick, surface(stick), color=COLOURS[0], linewidth=3.2, solid_capstyle="butt")
    axes.text(0.08, -DEPTH + 0.06, "stick", color=COLOURS[0], fontsize="small", va="bottom")
    axes.text(1.02, -0.5 * DEPTH - 0.2, "slip", color=COLOURS[1], fontsize="small", ha="left", va="bottom")


def draw_loads(axes: Axes) -> None:
    """Both loads of the indenter, and the bulk stress of the half-space."""
    arrow(axes, (0.0, TOP + 0.3), (0.0, TOP - 0.32))
    axes.text(0.1, TOP + 0.12, r"$F_N$ (depth $\delta$)", va="center")
    arrow(axes, (0.55, 0.3), (1.2, 0.3))
    axes.text(0.55, 0.37, r"$F_x$ (shift $u$)", va="bottom")
    for sign in (-1.0, 1.0):
        for height in (-0.8, -1.05, -1.3):
            arrow(axes, (sign * SIDE, height), (sign * (SIDE + 0.32), height), linewidth=1.2)
    axes.text(SIDE - 0.05, -1.05, r"$\sigma_B$", ha="right", va="center")


def draw_lengths(axes: Axes) -> None:
    """The coordinates, the radii of contact and stick, and the critical point with its plane."""
    thin = {"color": INK, "linewidth": 0.8, "mutation_scale": 7.0}
    arrow(axes, (0.0, 0.0), (SIDE + 0.3, 0.0), **thin)
    axes.text(SIDE + 0.3, 0.05, "$x$", ha="right", va="bottom")
    arrow(axes, (0.0, 0.0), (0.0, BOTTOM + 0.12), **thin)
    axes.text(-0.06, BOTTOM + 0.18, "$z$", ha="right")
    for radius, height, words in ((STICK, -0.72, "$c$"), (1.0, -1.02, "$a$")):
        axes.plot([radius] * 2, [float(surface(np.array(radius))), height - 0.05], color=INK, linewidth=0.5)
        arrow(axes, (0.0, height), (radius, height), **{**thin, "arrowstyle": "<|-|>"})
        axes.text(0.5 * radius, height + 0.03, words, ha="center", va="bottom")
    point = np.array([-1.0, float(surface(np.array(1.0)))])
    along = np.array([np.sin(np.radians(ANGLE)), -np.cos(np.radians(ANGLE))])
    plane = np.stack([point, point + 0.75 * along])
    axes.plot(*plane.T, color="black", linewidth=2.2, solid_capstyle="butt")
    normal = np.array([-along[1], along[0]])
    begin = plane.mean(axis=0)
    arrow(axes, tuple(begin), tuple(begin + 0.42 * normal), **{**thin, "color": "black"})
    axes.text(*(begin + 0.46 * normal), "$n$", va="center")
    axes.plot(*point, "o", color="white", markeredgecolor="black", markersize=5.0, zorder=6)
    axes.text(-1.12, -0.52, "critical\npoint", ha="right", va="center", linespacing=1.0)
    axes.annotate("", point - [0.05, 0.05], (-1.22, -0.38), arrowprops={"arrowstyle": "-", "linewidth": 0.6})
    axes.text(plane[1, 0], plane[1, 1] - 0.06, "critical plane", ha="center", va="top")


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="from few points, to see that it runs")
    given = arguments.parse_args()
    with styled({"axes.prop_cycle": cycler(color=[INK], linestyle=["-"], marker=[""])}, "column"):
        figure = new_figure((WIDTHS["column"], 0.62 * WIDTHS["column"]), "column")
        axes = figure.subplots()
        draw_bodies(axes, 161 if given.quick else 1601)
        draw_loads(axes)
        draw_lengths(axes)
        axes.text(-SIDE + 0.06, BOTTOM + 0.06, "half-space", va="bottom", color="0.35")
        axes.text(-1.3, 0.55, "indenter", ha="center", va="center", color="0.35")
        axes.set(xlim=(-2.52, 2.52), ylim=(BOTTOM, TOP + 0.34), aspect="equal")
        axes.set_axis_off()
    save_figure(figure, given.results / "sketch.png")


if __name__ == "__main__":
    main()
