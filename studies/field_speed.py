"""How fast and how accurate the field beneath the contact is, beside other ways to it.

The stress of Table 1's cycle at ψ = 0 on the same points, in one process and one thread: this package;
Hamilton's closed form (ContactMechanics), once for each slope of each instant; and the periodic half-space of
tamaas (extra ``bench``), which solves a whole grid for each instant. The points are nodes of that grid.

Run from the project's folder: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python studies/field_speed.py
"""

import time
import warnings
from pathlib import Path

import numpy as np

from swtstudy.mechanics import solve_points, surface_circle
from swtstudy.mechanics.body import Body, nodes_at, scene_of
from swtstudy.mechanics.critical_plane_3d import highest_coarse_swt, swt_of_history
from swtstudy.mechanics.field import contact_states
from swtstudy.mechanics.hemisphere import hemisphere
from swtstudy.mechanics.points import Points

with warnings.catch_warnings():
    warnings.simplefilter("ignore", ImportWarning)
    from ContactMechanics.ReferenceSolutions import Hertz

FRICTION, POISSON = 0.3, 0.3
P0 = 2 / np.pi
PLAIN_PLANES, CELLS = 281, 200
INSTANTS, GRID, LAYERS, WIDTH, DEPTH = 64, 128, 32, 6.0, 1.5


def timed(call, repeats=3):
    """Result and shortest processor time of a call."""
    best = np.inf
    for _ in range(repeats):
        begin = time.process_time()
        result = call()
        best = min(best, time.process_time() - begin)
    return result, best


def table_1(instant):
    """Table 1 at the given instants, and its contact states: all slopes are −1, 0 or 1 at ψ = 0."""
    values = (np.array([v]) for v in (POISSON, FRICTION, 0.75))
    ratio = np.array([1]), np.array([1])
    scene = scene_of(Points("paraboloid", *values, *ratio, np.array([5 / 6]), np.array([0.0])))
    nodes = nodes_at(scene, instant)
    states = contact_states(scene.cycle, scene.profile, nodes.interval, nodes.instant, CELLS)
    return Body(scene, nodes, CELLS), states


def jumps(states, instant):
    """Radii and slope jumps of the pressure and of the tangential load at an instant."""
    for slope, factor, tangential in (
        (states.touching[instant], 1.0, False),
        (states.tangential_slope[instant, 0], -FRICTION, True),
    ):
        size = -np.diff(slope, append=0.0)
        for a, jump in zip(states.cells.radius[1:][size != 0.0], size[size != 0.0], strict=True):
            yield tangential, a, factor * jump


def by_hamilton(states, x, y, z):
    """Shape (points, instants, 6)."""
    stress = np.zeros((len(states.touching), 6, x.size))
    for instant in range(len(stress)):
        for tangential, a, factor in jumps(states, instant):
            solution = Hertz.stress_for_tangential_loading if tangential else Hertz.stress_Cartesian
            stress[instant] += factor * a * P0 * np.array(solution(x / a, y / a, z / a, POISSON))
    return np.moveaxis(stress, -1, 0)


class Tamaas:
    """A periodic half-space that is solved for one instant at a time."""

    def __init__(self):
        import tamaas

        tamaas.set_log_level(tamaas.LogLevel.error)
        size, shape = [DEPTH, WIDTH, WIDTH], [LAYERS, GRID, GRID]
        self.model = tamaas.Model(tamaas.model_type.volume_2d, size, shape)
        self.model.E, self.model.nu = 1.0 - POISSON**2, POISSON
        tamaas.ModelFactory.registerVolumeOperators(self.model)
        self.strain, self.stress = np.zeros([*shape, 6]), np.zeros([*shape, 6])
        self.axis = (np.arange(GRID) - GRID // 2) * WIDTH / GRID
        self.depth = np.linspace(0.0, DEPTH, LAYERS)

    def solve(self, states, instant):
        """Stress on the whole grid (z, x, y, 6), components as in this package."""
        r2 = self.axis[:, None] ** 2 + self.axis**2
        self.model.traction[...] = 0.0
        for tangential, a, factor in jumps(states, instant):
            traction = factor * P0 * np.sqrt(np.maximum(a * a - r2, 0.0))
            self.model.traction[..., 0 if tangential else 2] += traction
        self.model.operators["boussinesq_gradient"](self.model.traction, self.strain)
        self.model.operators["hooke"](self.strain, self.stress)
        # From xx, yy, zz and √2 times xy, xz, yz.
        return self.stress[..., [0, 1, 2, 5, 4, 3]] / np.array([1, 1, 1, 2**0.5, 2**0.5, 2**0.5])


def report():
    """The table, as lines of Markdown."""
    body, states = table_1(2.0 * np.pi * np.arange(INSTANTS) / INSTANTS)
    axis = (np.arange(GRID) - GRID // 2) * WIDTH / GRID
    inside = np.flatnonzero(np.abs(axis) < 1.5)
    layers = np.arange(1, LAYERS - 8, 3)
    grid = np.meshgrid(np.linspace(0.0, DEPTH, LAYERS)[layers], axis[inside], axis[inside], indexing="ij")
    z, x, y = (v.ravel() for v in grid)
    ours, our_time = timed(lambda: body.stress(x, y, z))
    hamilton, hamilton_time = timed(lambda: by_hamilton(states, x, y, z), repeats=1)
    values = ours.size // 6
    # Hamilton's formulas cancel next to the axis.
    off_axis = np.hypot(x, y) > 0.1
    lines = [
        f"{len(x)} points × {INSTANTS} instants of one cycle, one thread; largest difference from the field "
        "of this package in p0.",
        "",
        "| field | µs per point and instant | largest difference |",
        "|---|---|---|",
        f"| this package | {1e6 * our_time / values:.2f} | |",
        f"| Hamilton's closed form (ContactMechanics) | {1e6 * hamilton_time / values:.2f} | "
        f"{np.abs(hamilton - ours)[off_axis].max() / P0:.1e} |",
    ]
    try:
        half_space = Tamaas()
    except ImportError:
        return [*lines, "", "tamaas is not installed (extra `bench`)."]
    instant = INSTANTS // 4
    stress, tamaas_time = timed(lambda: half_space.solve(states, instant))
    away = np.abs(stress[np.ix_(layers, inside, inside)].reshape(-1, 6) - ours[:, instant]).max()
    return [
        *lines,
        f"| tamaas, periodic, {GRID}² × {LAYERS}, {1e3 * tamaas_time:.0f} ms a grid | "
        f"{1e6 * tamaas_time / stress[..., 0].size:.2f} | {away / P0:.1e} |",
    ]


def plain_search(stress, normals):
    """Largest swt over given planes: the straightforward way, E = 1 − ν²."""
    x, y, z = normals.T
    on_planes = stress @ np.stack([x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y])
    trace = stress[..., :3].sum(axis=-1)[..., None]
    strain = ((1.0 + POISSON) * on_planes - POISSON * trace) / (1.0 - POISSON**2)
    tension = np.maximum(on_planes.max(axis=1), 0.0)
    return (tension * 0.5 * (strain.max(axis=1) - strain.min(axis=1))).max(axis=1)


def planes():
    """Time of the search over all planes on the histories of the body, as lines of Markdown."""
    rng = np.random.default_rng(0)
    body, _ = table_1(2.0 * np.pi * np.arange(INSTANTS) / INSTANTS)
    x, y, z = *rng.uniform(-1.5, 1.5, (2, 2000)), rng.uniform(0.0, 0.3, 2000)
    stress = body.stress(x, y, z)
    found, full = timed(lambda: swt_of_history(stress, POISSON, 1.0 - POISSON**2))
    coarse, first = timed(lambda: highest_coarse_swt(stress, POISSON, 1.0 - POISSON**2))
    normals = hemisphere(PLAIN_PLANES)
    parts = np.array_split(stress, 20)
    simple, plain = timed(lambda: np.concatenate([plain_search(part, normals) for part in parts]))
    high = found.swt > 0.1 * found.swt.max()
    low, simply_low = (100 * (1.0 - swt[high] / found.swt[high]).max() for swt in (coarse, simple))
    return [
        "",
        f"swt over all plane orientations, {INSTANTS} instants: 256 planes take "
        f"{1e6 * first / len(x):.0f} µs a point (up to {low:.1f} % low where swt is above a tenth of "
        f"its maximum), refined to rounding {1e6 * full / len(x):.0f} µs a point. A plain vectorised search "
        f"of {PLAIN_PLANES} planes takes {1e6 * plain / len(x):.0f} µs (up to {simply_low:.1f} % low).",
    ]


def circle():
    """What the solver's look along the circle through the critical point costs, as lines of Markdown."""
    phase = np.linspace(0.0, np.pi, 200)
    one = np.ones(len(phase))
    ratio = one.astype(int)
    amplitudes = 0.75 * one, ratio, ratio, 5 / 6 * one
    points = Points("paraboloid", 0.45 * one, FRICTION * one, *amplitudes, phase)
    _, looking = timed(lambda: solve_points(points))
    safe, surface_circle.SAFE_POISSON_RATIO = surface_circle.SAFE_POISSON_RATIO, 0.5
    _, alone = timed(lambda: solve_points(points))
    surface_circle.SAFE_POISSON_RATIO = safe
    return [
        "",
        f"s at {len(phase)} phases and ν = 0.45: {1e3 * alone / len(phase):.2f} ms a value on the line, "
        f"{1e3 * looking / len(phase):.2f} ms with s_surface.",
    ]


if __name__ == "__main__":
    text = "\n".join([*report(), *planes(), *circle()]) + "\n"
    Path("results/field_speed.md").write_text(f"# The field beneath the contact\n\n{text}", encoding="utf-8")
    print(text, end="")
