"""How s of a table approaches s of the closed form, against the number of its points and over its noise.

A rounded punch, a wavy paraboloid, and in the plane a flat with rounded edges and a cylinder, as tables of 25
to 2,000 points, each at points all over the box of parameters; plane ones by forces. Rounded punches with
noisy heights that are smoothed by as much, over the share of their rise within the contact. Run from the
project's folder: ``python studies/table_convergence.py``; writes results/table_convergence.png.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from accuracy import random_points
from matplotlib.figure import Figure
from numpy.typing import NDArray

from swtstudy.figures.sheet import Sheet, add_legend
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, stroke, styled
from swtstudy.solver.points import Points, solve_points
from swtstudy.solver.table import TabulatedProfile
from swtstudy.vocabulary.choices import FAMILIES, is_plane
from swtstudy.vocabulary.parameters import Control

COUNTS = (25, 50, 100, 200, 500, 1000, 2000)
NOISE = (1e-5, 1e-4, 1e-3, 1e-2)
#: Radii of the faces of noisy tables; 0 is a paraboloid.
FACES = (0.0, 0.5, 1.0)
#: Points of a noisy table, tables of one noise, largest radius of all, points of the box and tolerance.
NOISY, DRAWS, LARGEST, POINTS, RTOL = 400, 4, 2.5, 12, 1e-7
H, WAVELENGTH, FACE = 0.05, 5.0, 0.5
#: Errors below this are rounding; they are drawn here.
SMALLEST = 1e-12
SHAPES: dict[str, dict[str, float]] = {
    "rounded_punch": {"flat_radius": FACE},
    "wavy_paraboloid": {"waviness_amplitude": H, "wavelength": WAVELENGTH},
    "rounded_flat": {"flat_half_width": FACE},
    "wavy_cylinder": {"waviness_amplitude": H, "wavelength": WAVELENGTH},
    "cylinder": {},
}

Array = NDArray[np.float64]
#: Abscissae, median and largest errors.
Curve = tuple[Array, Array, Array]


def height(name: str, r: Array) -> Array:
    """f over δ0 (eqs. 3, 4, 6)."""
    if name in ("rounded_punch", "rounded_flat"):
        return np.where(r > FACE, 0.5 * (r - FACE) ** 2, 0.0)
    waves = H * (1.0 - np.cos(2.0 * np.pi / (WAVELENGTH * np.sqrt(H)) * r))
    return 0.5 * r * r + (waves if name.startswith("wavy") else 0.0)


def in_forces(box: Points) -> Points:
    """The points of the box by forces that friction bears, whatever the phase."""
    pull = np.minimum(box.tangential_amplitude, 1.0) * (1.0 - box.normal_amplitude)
    return replace(box, tangential_amplitude=pull, control=Control(True, True))


def of_profile(box: Points, profile: str | TabulatedProfile, shape: dict[str, float], rtol: float) -> Array:
    """s at the points of the box on another profile."""
    columns = vars(in_forces(box) if is_plane(profile) else box) | {
        "profile": profile,
        "shape": {n: np.full(len(box), v) for n, v in shape.items()},
    }
    return solve_points(Points(**columns), rtol).s


def noisy(face: float, amount: float, seed: int) -> TabulatedProfile:
    """A rounded punch with noise of this root mean square beside its face, smoothed by that or as needed."""
    r = np.linspace(0.0, LARGEST, NOISY)
    beside = r > face
    noise = amount * np.random.default_rng(seed).standard_normal(NOISY)
    heights = np.where(beside, 0.5 * (r - face) ** 2 + noise, 0.0)
    table = TabulatedProfile("noisy", r, np.maximum(heights, 0.0) if face else heights, amount)
    if table.compact_radius < 0.9 * LARGEST and (least := table.least_smoothing(0.9 * LARGEST)):
        return TabulatedProfile("noisy", r, table.height, least)
    return table


def of_noise(box: Points, face: float, amounts: tuple[float, ...], rtol: float) -> tuple[Array, list[Array]]:
    """Mean share of the rise by which tables of each noise are smoothed, and the errors of s."""
    shape = {"flat_radius": face} if face else {}
    exact = of_profile(box, "rounded_punch" if face else "paraboloid", shape, rtol)
    shares, errors = [], []
    for amount in amounts:
        tables = [noisy(face, amount, seed) for seed in range(DRAWS)]
        shares.append(float(np.mean([table.smoothed_share(1.0) for table in tables])))
        errors.append(np.abs([of_profile(box, table, {}, rtol) / exact - 1.0 for table in tables]).ravel())
    return np.array(shares), errors


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the chart")
    arguments.add_argument(
        "--quick", action="store_true", help="one point, and not as accurate, to see that it runs"
    )
    given = arguments.parse_args()
    box = random_points("paraboloid", 1 if given.quick else POINTS, seed=1)
    counts, amounts, rtol = (COUNTS[:2], NOISE[:2], 1e-2) if given.quick else (COUNTS, NOISE, RTOL)
    curves: list[tuple[str, Curve]] = []
    for name, shape in SHAPES.items():
        exact, errors = of_profile(box, name, shape, rtol), []
        for count in counts:
            r = np.linspace(0.0, LARGEST, count)
            geometry = FAMILIES[name].geometry
            table = TabulatedProfile(f"{name} of {count}", r, height(name, r), geometry=geometry)
            errors.append(np.abs(of_profile(box, table, {}, rtol) / exact - 1.0))
        curves.append((name.replace("_", " "), found(name, counts, errors)))
    noisy_ones: list[tuple[str, Curve]] = []
    for face in FACES:
        name = f"face {face:g}" if face else "paraboloid"
        noisy_ones.append((name, found(f"noisy, {name}", *of_noise(box, face, amounts, rtol))))
    save_figure(chart(curves, noisy_ones), given.results / "table_convergence.png")


def found(name: str, at: Sequence[float] | Array, errors: list[Array]) -> Curve:
    """Abscissae, median and largest errors, which are printed."""
    median, largest = (np.array([of(error) for error in errors]) for of in (np.median, np.max))
    for where, middle, most in zip(at, median, largest, strict=True):
        print(f"{name}, {where:g}: median {middle:.1e}, largest {most:.1e}")
    return np.array(at), median, largest


def chart(curves: list[tuple[str, Curve]], noisy_ones: list[tuple[str, Curve]]) -> Figure:
    """Median and largest errors over the number of points, and both over the noise."""
    with styled(width="page"):
        sheet = Sheet(1, 3, "page", least_height=2.8)
        figure = sheet.figure()
        panels = sheet.panels(figure, share_x="none")
        for (label, (at, median, largest)), color, marker in zip(curves, COLOURS, MARKERS[1:], strict=False):
            look = {"color": color, "marker": marker, "linestyle": "-", "label": label}
            panels[0, 0].loglog(at, np.maximum(median, SMALLEST), **look)
            panels[0, 1].loglog(at, np.maximum(largest, SMALLEST), **look)
        for (label, (at, median, largest)), color in zip(noisy_ones, ("0.1", "0.4", "0.65"), strict=True):
            panels[0, 2].loglog(at, median, **stroke(color, marker="o", label=f"noisy, {label}: median"))
            own = stroke(color, "--", marker="o", mfc="none", label=f"noisy, {label}: largest")
            panels[0, 2].loglog(at, largest, **own)
        for axes, title in zip(panels[0], ("(A)  median", "(B)  largest", "(C)  with noise"), strict=True):
            axes.set(xlabel="points of the table", title=title, ylim=(0.5 * SMALLEST, 0.3))
        panels[0, 2].set_xlabel("smoothing over the rise in contact")
        panels[0, 0].set_ylabel("relative error of $s$")
        add_legend(figure)
    return figure


if __name__ == "__main__":
    main()
