"""Cost of nonlocal means, and whether they are within their claimed errors.

``python studies/checks/nonlocal_means.py`` writes results/nonlocal_means.md:

* for scenes like Table 1 the processor time of a point with one distance and with eleven;
* for random points of all profiles, every fourth with bulk stress, the differences of all means from dense
  quadrature, over the claimed errors. The dense rule has Gauss's points on even panels of root-graded
  coordinates, and values that are each found alone; where it differs by more than is claimed it is made
  denser until it changes by less than that;
* for the same points means about places along the whole line, each ℓ/8 from the next: by how much one is
  larger than the one that the solver says is the largest;
* how the means tend to s as ℓ falls.

Points that are done are kept in results/nonlocal_means.csv: a run that was stopped goes on.
"""

from __future__ import annotations

import argparse
import csv
import time
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swtstudy.kernel.field import criterion_at, direction_at, largest_radius, mean_about, open_cycle
from swtstudy.kernel.mean import LINE, POINT, SPHERE
from swtstudy.solver.means import DOWN, GROWTH, RTOL, worst_means
from swtstudy.solver.points import Points, Solution, arguments_of, solve_points
from swtstudy.solver.table import TabulatedProfile
from swtstudy.vocabulary.choices import is_plane
from swtstudy.vocabulary.parameters import Control

FloatArray = NDArray[np.float64]

PHASES = np.array([0.0, 0.7, 1.6, 2.5, 4.0])
DISTANCE, SEVERAL = np.array([0.1]), np.geomspace(0.01, 0.1, 11)
#: Profile, its shape, δA/δ0 and ω2/ω1 of each scene.
SCENES = [
    ("paraboloid", {}, 0.25, (1, 1)),
    ("paraboloid", {}, 0.75, (1, 1)),
    ("paraboloid", {}, 0.75, (1, 2)),
    ("rounded_punch", {"flat_radius": 0.5}, 0.75, (1, 1)),
    ("truncated_paraboloid", {"flat_radius": 0.5}, 0.75, (1, 1)),
    ("wavy_paraboloid", {"waviness_amplitude": 0.02, "wavelength": 5.0}, 0.75, (1, 1)),
]
#: Shape parameters of random points, from and to.
SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": (0.05, 1.5)},
    "truncated_paraboloid": {"flat_radius": (0.05, 1.0)},
    "wavy_paraboloid": {"waviness_amplitude": (0.001, 0.05), "wavelength": (5.0, 10.0)},
    "power_law": {"exponent": (1.3, 5.0)},
    "cylinder": {},
    "rounded_flat": {"flat_half_width": (0.05, 1.5)},
    "tabulated": {},
}
RATIOS = [(1, 1), (1, 2), (2, 1), (3, 2), (1, 3)]
SEED = 19
#: Runs that are timed: others on the machine make them longer, none shorter.
RUNS = 3
#: The means, as the kernel knows them, and whether they go along the critical plane.
MEANS = {
    "volume": (SPHERE, False),
    "point, depth": (POINT, False),
    "point, plane": (POINT, True),
    "line, depth": (LINE, False),
    "line, plane": (LINE, True),
}
#: No mean is known.
NOTHING = np.zeros(len(MEANS))
#: Places of the line in a distance ℓ, and most of them; accuracy of means there.
PLACES, MOST, OF_PLACES = 8, 400, 1e-2
#: Panels of the dense rule in the distance, in the inclination, along an arc and on a line at first, Gauss's
#: points on each, and how often it is made twice as dense.
PANELS, GAUSS, TWICE = (2, 3, 1, 4), 4, 3
#: Accuracy of its values.
OF_VALUES = 3e-5


def points_of(
    profile: str, shape: dict[str, float], amplitude: float, ratio: tuple[int, int], count: int
) -> Points:
    """Table 1 at some phases, with another amplitude and frequency ratio."""
    one = np.ones(count)
    p, q = (np.full(count, each) for each in ratio)
    columns = {name: value * one for name, value in shape.items()}
    return Points(profile, 0.3 * one, 0.3 * one, amplitude * one, p, q, 5 / 6 * one, PHASES[:count], columns)


def worn() -> TabulatedProfile:
    """A paraboloid with a flat face of 0.4 a_H and a blend."""
    r = np.unique(np.concatenate([np.linspace(0.0, 2.0, 81), 0.4 + 0.1 * np.linspace(0.0, 1.5, 31)]))
    slope = np.interp(r, [0.0, 0.4, 0.5, 2.0], [0.0, 0.0, 0.5, 2.0])
    height = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(r))])
    return TabulatedProfile("worn", r, height)


def random_points(profile: str) -> Iterator[tuple[Points, float]]:
    """Single points all over the parameters, with a distance each; only points with a critical point."""
    rng = np.random.default_rng([SEED, list(SHAPES).index(profile)])
    while True:
        (p, q), u = RATIOS[rng.integers(len(RATIOS))], rng.uniform
        shape = {name: np.array([u(*ends)]) for name, ends in SHAPES[profile].items()}
        bounds = (0.0, 0.5), (0.05, 0.9), (0.0, 0.95), (0.05, 1.2), (0.0, 2.0 * np.pi)
        ν, μ, δ, U, ψ = (np.array([u(*ends)]) for ends in bounds)
        family = worn() if profile == "tabulated" else profile
        point = Points(family, ν, μ, δ, np.array([p]), np.array([q]), U, ψ, shape)
        if is_plane(family):
            # Friction has to bear the force at every instant.
            point = replace(point, tangential_amplitude=U * (1.0 - δ) / 1.3, control=Control(True, True))
        bulk = {"mean": u(-0.1, 0.2), "amplitude": u(0.0, 0.2), "phase": u(0.0, 6.0)}
        if rng.integers(4) == 0:
            point = replace(point, **{f"bulk_stress_{name}": np.array([v]) for name, v in bulk.items()})
        distance = float(10.0 ** u(-2.0, -0.7))
        if np.isfinite(solve_points(point, 1e-4).critical_x[0]):
            yield point, distance


def gauss(panels: int) -> tuple[FloatArray, FloatArray]:
    """Gauss's rule on even panels of [0, 1]."""
    node, weight = np.polynomial.legendre.leggauss(GAUSS)
    begin = np.arange(panels)[:, None]
    return ((begin + 0.5 + 0.5 * node) / panels).ravel(), np.tile(0.5 * weight / panels, panels)


def dense_means(opened, x: float, double_angle: float, distance: float, twice: int) -> FloatArray:
    """All means about x by places that have nothing in common with the solver's, (5,)."""
    of_distance, of_inclination, along, on_line = (
        gauss(count * 2**twice) for count in (*PANELS[:2], PANELS[2], PANELS[3])
    )
    plane, centre, side = bool(opened.point.profile["plane"]), abs(x), 1.0 if x >= 0.0 else -1.0

    def swt(*places: FloatArray) -> FloatArray:
        at = np.stack([each.ravel() for each in np.broadcast_arrays(*places)], axis=1)
        found = criterion_at(opened, np.ascontiguousarray(at), OF_VALUES)[0]
        return found.reshape(np.broadcast_shapes(*(each.shape for each in places)))

    # d like a square at the centre and at the pole of the sphere, where arcs end like a root.
    u, weight = of_distance
    d, of_d = distance * u * u * (3.0 - 2.0 * u), distance * 6.0 * u * (1.0 - u) * weight
    w, weight = of_inclination
    d, of_d = d[:, None], of_d[:, None]
    most = np.full_like(d, np.pi) if plane else np.arccos(-centre / np.maximum(d, centre))
    phi, of_phi = most * np.sin(0.5 * np.pi * w) ** 2, most * 0.5 * np.pi * np.sin(np.pi * w) * weight
    r, z = centre + d * np.cos(phi), d * np.sin(phi)
    if plane:
        area = d * of_d * of_phi
        volume = float((area * swt(side * r, 0.0 * r, z)).sum() / area.sum())
    else:
        r = np.maximum(r, 0.0)
        chord = np.sqrt((distance - d) * (distance + d))
        arc = 2.0 * np.arcsin(np.minimum(chord / np.maximum(2.0 * np.sqrt(centre * r), 1e-150), 1.0))
        theta = arc[..., None] * along[0]
        parts = (d * of_d * of_phi * r * arc)[..., None] * along[1]
        places = side * r[..., None] * np.cos(theta), r[..., None] * np.sin(theta), z[..., None] + 0.0 * theta
        volume = float((parts * swt(*places)).sum() / parts.sum())
    found = [volume]
    ways = [(0.0, 1.0), (-np.sin(0.5 * double_angle), np.cos(0.5 * double_angle))]
    ways[1] = ways[1] if ways[1][1] >= 0.0 else (-ways[1][0], -ways[1][1])
    found += [float(swt(*(np.array([each]) for each in _on(x, 0.5 * distance, way)))[0]) for way in ways]
    t, weight = on_line
    for way in ways:
        places = _on(x, 2.0 * distance * t * t, way)
        found.append(float((2.0 * t * weight * swt(*places)).sum()))
    return np.array(found)


def _on(x: float, away, way):
    """Places along a direction."""
    return x + away * way[0], 0.0 * away, away * way[1]


def about(opened, x: float, distance: float, rtol: float, known: FloatArray = NOTHING) -> FloatArray:
    """All means about x, and what they claim, (2, 5); those far below what is known are told roughly."""
    ways, each = (DOWN, direction_at(opened, x)), zip(MEANS.values(), known, strict=True)
    return np.array(
        [mean_about(opened, kind, x, ways[along], distance, least, rtol) for (kind, along), least in each]
    ).T


def largest_of(point: Points, solution: Solution, distance: float) -> FloatArray:
    """The largest means as the solver finds them, (5,)."""
    found = worst_means(point, solution, np.array([distance]))
    return np.concatenate([found[name].ravel() for name in ("s_volume", "s_point", "s_line")])


def excess(point: Points, distance: float) -> FloatArray:
    """By how much means about places along the whole line are larger than the largest, relative, (5,)."""
    known = largest_of(point, solve_points(point, 1e-4), distance)
    opened = open_cycle(GROWTH, **arguments_of(point))
    end = largest_radius(opened) + distance
    places = np.linspace(-end, end, min(int(2.0 * end * PLACES / distance), MOST))
    return np.max([about(opened, x, distance, OF_PLACES)[0] for x in places], axis=0) / known - 1.0


def ratios(point: Points, distance: float) -> FloatArray:
    """Values, claimed errors, differences from the dense rule, and the excess of other places, (4, 5)."""
    solution = solve_points(point, 1e-6)
    x, double_angle = float(solution.critical_x[0]), np.radians(2.0 * float(solution.critical_angle[0]))
    value, claimed = about(open_cycle(GROWTH, **arguments_of(point)), x, distance, RTOL)
    opened, before = open_cycle(**arguments_of(point)), np.full(len(MEANS), np.inf)
    for twice in range(TWICE):
        known = dense_means(opened, x, double_angle, distance, twice)
        off = np.abs(value - known)
        if (off <= claimed).all() or (twice and (np.abs(known - before) <= 0.1 * claimed).all()):
            break
        before = known
    return np.stack([value, claimed, off, excess(point, distance)])


def times(scene: tuple[str, dict[str, float], float, tuple[int, int]], count: int) -> str:
    """Line of the table of times: the least of some runs."""
    points, cells = points_of(*scene, count), []
    for distance in (DISTANCE, SEVERAL):
        spent, claimed = [], 0.0
        for _ in range(RUNS):
            begin = time.process_time()
            for k in range(count):
                found = worst_means(points[[k]], solve_points(points[[k]], 1e-6), distance)
                claimed = max(claimed, float((found["s_volume_error"] / found["s_volume"]).max()))
            spent.append(time.process_time() - begin)
        cells.append(f"{1e3 * min(spent) / count:.1f} ms")
    name = f"{scene[0]}, δA/δ0 = {scene[2]:g}, ω2/ω1 = {scene[3][0]}/{scene[3][1]}"
    return f"| {name} | {' | '.join(cells)} | {claimed:.1e} |"


def sweep(file: Path, profiles: list[str], count: int) -> FloatArray:
    """Ratios at so many points of each profile, (profiles, count, 4, 5); points in the file are done."""
    done: dict[tuple[str, int], FloatArray] = {}
    if file.exists():
        with open(file, encoding="utf-8", newline="") as text:
            for row in csv.reader(text):
                done[row[0], int(row[1])] = np.array(row[2:], float).reshape(4, -1)
    with open(file, "a", encoding="utf-8", newline="") as text:
        rows = csv.writer(text)
        for profile in profiles:
            for k, case in enumerate(islice(random_points(profile), count)):
                if (profile, k) not in done:
                    done[profile, k] = ratios(*case)
                    rows.writerow([profile, k, *(f"{v:.6g}" for v in done[profile, k].ravel())])
                    text.flush()
    return np.array([[done[profile, k] for k in range(count)] for profile in profiles])


def limits(profile: str, sizes: FloatArray) -> str:
    """Line of the table of small distances."""
    point, _ = next(random_points(profile))
    solution = solve_points(point, 1e-6)
    opened, x = open_cycle(GROWTH, **arguments_of(point)), float(solution.critical_x[0])
    found = np.array([mean_about(opened, SPHERE, x, DOWN, size, 0.0, RTOL)[0] for size in sizes])
    return f"| {profile} | " + " | ".join(f"{v:.5f}" for v in found / solution.s[0]) + " |"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--points", type=int, default=128, help="random points of each profile")
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="a point of one profile, to see that it runs")
    given = arguments.parse_args()
    count, profiles, scenes = given.points, [*SHAPES], SCENES
    if given.quick:
        count, profiles, scenes = 1, profiles[:1], scenes[:1]
    given.results.mkdir(exist_ok=True)
    found = sweep(given.results / "nonlocal_means.csv", profiles, count)
    lines = [
        "# Nonlocal means",
        "",
        "Processor time of a point, the least of 3 runs, with s and the largest of all three means, ",
    ]
    lines[-1] += "ℓ = 0.1 a_H or eleven distances up to that, and the largest relative error claimed."
    lines += ["", "| scene | one distance | eleven | error claimed |", "|---|---|---|---|"]
    lines += [times(scene, 1 if given.quick else len(PHASES)) for scene in scenes]
    value, claimed, off, higher = np.moveaxis(found, 2, 0)
    within = (off <= claimed).all(axis=-1)
    lines += ["", f"At {within.sum()} of {within.size} random points all means are within their claimed "]
    lines[-1] += (
        "errors of dense quadrature. The last column tells by how much a mean about another place of "
    )
    lines[-1] += f"the line, known to {OF_PLACES:g}, exceeds the largest one."
    lines += ["", "| profile | mean | median off | largest | median claimed | off over claimed | elsewhere |"]
    lines += ["|---|---|---|---|---|---|---|"]
    for row, profile in enumerate(profiles):
        for k, name in enumerate(MEANS):
            size = np.maximum(value[row, :, k], 1e-300)
            share, own = off[row, :, k] / size, claimed[row, :, k] / size
            worst = (off[row, :, k] / np.maximum(claimed[row, :, k], 1e-300)).max()
            cells = f"{np.median(share):.0e} | {share.max():.0e} | {np.median(own):.0e} | {worst:.2f} | "
            cells += f"{max(float(higher[row, :, k].max()), 0.0):.0e}"
            lines.append(f"| {profile} | {name} | {cells} |")
    sizes = np.array([1e-8, 1e-6, 1e-4, 1e-2])
    lines += ["", "Mean over the half sphere, over s, as ℓ falls; beside the edge of a truncated "]
    lines[-1] += (
        "paraboloid's face, and where a plane that does not hold y is the critical one, the limit is "
    )
    lines[-1] += "another."
    lines += ["", "| profile | " + " | ".join(f"{v:.0e}" for v in sizes) + " |", "|---|---|---|---|---|"]
    lines += [limits(profile, sizes) for profile in profiles]
    (given.results / "nonlocal_means.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
