"""How fast and how accurate the field beneath the contact is, compared with other methods.

The stress of Table 1's cycle at ψ = 0 at the same points, in one process and one thread: by this package; by
Hamilton's closed form (ContactMechanics), for each slope of each instant; and by the periodic half-space of
tamaas (extra ``bench``), which solves a whole grid for each instant. The points are nodes of that grid.

Run from the project's folder: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python studies/field_speed.py
"""

import argparse
import time
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from swtstudy import swt_of_history
from swtstudy.kernel import batch
from swtstudy.kernel.contact import NONE
from swtstudy.kernel.field import instants_of, open_cycle, stress_at
from swtstudy.kernel.growth import find_stretch, solved_places
from swtstudy.solver.points import Points, arguments_of, solve_points

with warnings.catch_warnings():
    warnings.simplefilter("ignore", ImportWarning)
    from ContactMechanics.ReferenceSolutions import Hertz

FRICTION, POISSON = 0.3, 0.3
P0 = 2 / np.pi
PLAIN_PLANES = 281
WIDTH, DEPTH = 6.0, 1.5


class Size(NamedTuple):
    """Instants of the cycle, grid of the half-space, points of the search, phases at the circle."""

    instants: int
    grid: int
    layers: int
    points: int
    phases: int


FULL, QUICK = Size(64, 128, 32, 2000, 200), Size(8, 16, 12, 20, 4)


def timed(call, repeats=3):
    """Result of a call, and its shortest processor time, s."""
    best = np.inf
    for _ in range(repeats):
        begin = time.process_time()
        result = call()
        best = min(best, time.process_time() - begin)
    return result, best


def table_1(instants):
    """Table 1's cycle, uniform instants, and its contact states: all slopes are −1, 0 or 1 at ψ = 0."""
    values = (np.array([v]) for v in (POISSON, FRICTION, 0.75))
    ratio = np.array([1]), np.array([1])
    opened = open_cycle(
        **arguments_of(Points("paraboloid", *values, *ratio, np.array([5 / 6]), np.array([0.0])))
    )
    angle = 2.0 * np.pi * np.arange(instants) / instants
    return opened, angle, [jumps(opened, float(t)) for t in instants_of(opened, angle)]


def jumps(opened, instant):
    """Radii and slope jumps of the pressure and of the tangential load at an instant."""
    L, P, _, C, *_ = opened.point
    k, t, sign = find_stretch(C, L, instant)
    edge, front = solved_places(C, P, L, k, t)
    slope, radius, piece = float(C["push"][k]), edge, int(C["piece"][k])
    found, outer = [(False, edge, 1.0)], 0.0
    while True:
        if slope != outer and radius > 0.0:
            found.append((True, radius, sign * FRICTION * (slope - outer)))
        if piece == NONE:
            return found
        outer, slope, radius = slope, float(C["slope"][piece]), front
        front, piece = float(C["start_s"][piece]), int(C["beneath"][piece])
        if piece == NONE and front > 0.0:
            raise ValueError("the lowest piece begins at the axis")


def by_hamilton(states, x, y, z):
    """Shape (points, instants, 6)."""
    stress = np.zeros((len(states), 6, x.size))
    for instant in range(len(stress)):
        for tangential, a, factor in states[instant]:
            solution = Hertz.stress_for_tangential_loading if tangential else Hertz.stress_Cartesian
            stress[instant] += factor * a * P0 * np.array(solution(x / a, y / a, z / a, POISSON))
    return np.moveaxis(stress, -1, 0)


class Tamaas:
    """A periodic half-space, solved for one instant at a time."""

    def __init__(self, grid, layers):
        import tamaas

        tamaas.set_log_level(tamaas.LogLevel.error)
        size, shape = [DEPTH, WIDTH, WIDTH], [layers, grid, grid]
        self.model = tamaas.Model(tamaas.model_type.volume_2d, size, shape)
        self.model.E, self.model.nu = 1.0 - POISSON**2, POISSON
        tamaas.ModelFactory.registerVolumeOperators(self.model)
        self.strain, self.stress = np.zeros([*shape, 6]), np.zeros([*shape, 6])
        self.axis = (np.arange(grid) - grid // 2) * WIDTH / grid

    def solve(self, states, instant):
        """Stress on the whole grid (z, x, y, 6), components as in this package."""
        r2 = self.axis[:, None] ** 2 + self.axis**2
        self.model.traction[...] = 0.0
        for tangential, a, factor in states[instant]:
            traction = factor * P0 * np.sqrt(np.maximum(a * a - r2, 0.0))
            self.model.traction[..., 0 if tangential else 2] += traction
        self.model.operators["boussinesq_gradient"](self.model.traction, self.strain)
        self.model.operators["hooke"](self.strain, self.stress)
        # From xx, yy, zz and √2 times xy, xz, yz.
        return self.stress[..., [0, 1, 2, 5, 4, 3]] / np.array([1, 1, 1, 2**0.5, 2**0.5, 2**0.5])


def report(size):
    """The table, as lines of Markdown."""
    opened, angle, states = table_1(size.instants)
    axis = (np.arange(size.grid) - size.grid // 2) * WIDTH / size.grid
    inside = np.flatnonzero(np.abs(axis) < 1.5)
    layers = np.arange(1, size.layers - 8, 3)
    grid = np.meshgrid(
        np.linspace(0.0, DEPTH, size.layers)[layers], axis[inside], axis[inside], indexing="ij"
    )
    z, x, y = (v.ravel() for v in grid)
    ours, our_time = timed(lambda: stress_at(opened, np.stack([x, y, z], axis=1), angle))
    hamilton, hamilton_time = timed(lambda: by_hamilton(states, x, y, z), repeats=1)
    values = ours.size // 6
    # Hamilton's formulas cancel next to the axis.
    off_axis = np.hypot(x, y) > 0.1
    lines = [
        f"{len(x)} points × {size.instants} instants of one cycle, one thread; largest difference from the "
        "field of this package in p0.",
        "",
        "| field | µs per point and instant | largest difference |",
        "|---|---|---|",
        f"| this package | {1e6 * our_time / values:.2f} | |",
        f"| Hamilton's closed form (ContactMechanics) | {1e6 * hamilton_time / values:.2f} | "
        f"{np.abs(hamilton - ours)[off_axis].max() / P0:.1e} |",
    ]
    try:
        half_space = Tamaas(size.grid, size.layers)
    except ImportError:
        return [*lines, "", "tamaas is not installed (extra `bench`)."]
    instant = size.instants // 4
    stress, tamaas_time = timed(lambda: half_space.solve(states, instant))
    away = np.abs(stress[np.ix_(layers, inside, inside)].reshape(-1, 6) - ours[:, instant]).max()
    return [
        *lines,
        f"| tamaas, periodic, {size.grid}² × {size.layers}, {1e3 * tamaas_time:.0f} ms a grid | "
        f"{1e6 * tamaas_time / stress[..., 0].size:.2f} | {away / P0:.1e} |",
    ]


def plain_search(stress, normals):
    """Largest swt over given planes in the straightforward way, with E = 1 − ν²."""
    x, y, z = normals.T
    on_planes = stress @ np.stack([x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y])
    trace = stress[..., :3].sum(axis=-1)[..., None]
    strain = ((1.0 + POISSON) * on_planes - POISSON * trace) / (1.0 - POISSON**2)
    tension = np.maximum(on_planes.max(axis=1), 0.0)
    return (tension * 0.5 * (strain.max(axis=1) - strain.min(axis=1))).max(axis=1)


def hemisphere(count):
    """Unit normals that cover a half sphere evenly, shape (count, 3)."""
    k = np.arange(count) + 0.5
    z, turn = 1.0 - k / count, np.pi * (3.0 - np.sqrt(5.0)) * k
    root = np.sqrt(1.0 - z * z)
    return np.stack([root * np.cos(turn), root * np.sin(turn), z], axis=-1)


def planes(size):
    """Time of the search over all planes on the histories of the body, as lines of Markdown."""
    rng = np.random.default_rng(0)
    opened, angle, _ = table_1(size.instants)
    x, y, z = *rng.uniform(-1.5, 1.5, (2, size.points)), rng.uniform(0.0, 0.3, size.points)
    stress = stress_at(opened, np.stack([x, y, z], axis=1), angle)
    found, full = timed(lambda: swt_of_history(stress, POISSON, 1.0 - POISSON**2))
    normals = hemisphere(PLAIN_PLANES)
    parts = np.array_split(stress, 20)
    simple, plain = timed(lambda: np.concatenate([plain_search(part, normals) for part in parts]))
    high = found.swt > 0.1 * found.swt.max()
    low = 100 * (1.0 - simple[high] / found.swt[high]).max()
    return [
        "",
        f"swt over all plane orientations, {size.instants} instants: to rounding "
        f"{1e6 * full / len(x):.0f} µs a point. A plain vectorised search of {PLAIN_PLANES} planes takes "
        f"{1e6 * plain / len(x):.0f} µs (up to {low:.1f} % low where swt is above a tenth of its maximum).",
    ]


def circle(size):
    """Cost of the solver's search along the circle through the critical point, as lines of Markdown."""
    phase = np.linspace(0.0, np.pi, size.phases)
    one = np.ones(len(phase))
    ratio = one.astype(int)
    amplitudes = 0.75 * one, ratio, ratio, 5 / 6 * one
    points = Points("paraboloid", 0.45 * one, FRICTION * one, *amplitudes, phase)
    _, looking = timed(lambda: solve_points(points))
    search, batch.search_circles = batch.search_circles, lambda *records: None
    _, alone = timed(lambda: solve_points(points))
    batch.search_circles = search
    return [
        "",
        f"s at {len(phase)} phases and ν = 0.45: {1e3 * alone / len(phase):.2f} ms a value on the line, "
        f"{1e3 * looking / len(phase):.2f} ms with s_surface.",
    ]


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    size = QUICK if given.quick else FULL
    text = "\n".join([*report(size), *planes(size), *circle(size)]) + "\n"
    table = given.results / "field_speed.md"
    table.write_text(f"# The field beneath the contact\n\n{text}", encoding="utf-8")
    print(text, end="")


if __name__ == "__main__":
    main()
