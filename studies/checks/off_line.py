"""Is a maximum overlooked off the line? s_surface, the body's maximum and means against dense looks.

``python studies/checks/off_line.py``, from the project folder, writes results/off_line.md. The points are
those of ``overlooked.py``, of another seed: on circles with ν > 0.35, where s_surface is searched for, or a
bulk stress; the means are those over the half sphere about the critical point, with distances logarithmic
over 0.01–0.2 a_H, held against the same with many more places and instants, and where these differ, against
the plain mean over places that fill the half sphere evenly, if its halves agree. results/off_line.csv keeps
what is found of each kind and scene as soon as it is, so that ``--kinds mean`` looks at the means alone, and
``--scenes`` at some scenes. ``--points`` draws fewer of each scene, ``--quick`` next to none.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

sys.path.insert(0, str(Path(__file__).parents[1]))

from nonlocal_means import tight_means
from overlooked import CHUNK, SCENES

from swtstudy.kernel.circle import SAFE_POISSON_RATIO
from swtstudy.mechanics import Points, solve_points
from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.body.body_maximum import body_maximum
from swtstudy.mechanics.body.local_swt import Places
from swtstudy.mechanics.body.nonlocal_swt import Around, nonlocal_swt
from swtstudy.mechanics.load_cycle import LoadCycle
from swtstudy.mechanics.numerics.arrays import hemisphere
from swtstudy.mechanics.planes.all_planes import swt_on_planes
from swtstudy.mechanics.planes.criterion import criterion_of
from swtstudy.mechanics.planes.weights import tangent_basis
from swtstudy.mechanics.stress.scene import Scene, scene_of

Array = NDArray[np.float64]
#: By scene: points on circles, in bodies, and with means.
COUNTS = {
    "displacements": (200, 240, 200),
    "forces": (200, 240, 200),
    "rounded punch": (100, 80, 100),
    "truncated paraboloid": (100, 80, 100),
    "wavy paraboloid": (100, 80, 100),
    "power law": (100, 80, 100),
    "loops of 4 to 200 vertices": (50, 40, 50),
    "bulk stress": (100, 80, 100),
    "Walker's exponent": (100, 80, 100),
}
SEED = 3
#: What is looked at, its title, and the share by which a dense look may be higher: what is claimed.
KINDS = {
    "circle": ("s_surface", 1e-4),
    "body": ("The body's maximum", 1e-4),
    "mean": ("The mean of swt over a critical distance", 1e-2),
}
#: Largest distance of the means, and least over that.
DISTANCES = 0.2, 0.05
#: Binary logarithm of the number of places of a plain mean, and how many of them are looked at together.
PLACES, TOGETHER = 13, 2048
#: On a circle: angles, planes and instants of the first look, in rad how far the first closer one goes,
#: how often, and how it narrows.
ANGLES, PLANES, INSTANTS = np.linspace(0.0, np.pi, 65), 2000, 8
REACH, ROUNDS, NARROWER = 0.08, 6, 0.35
#: In the body, over the largest contact radius: radii and depths, and steps of the first closer look.
RADII, DEPTHS = np.linspace(0.05, 1.15, 23), np.array([0.0, 0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8])
STEPS = 0.03, 0.2, 0.004
CELLS = 48


def dense_circle(points: Points, r: float) -> float:
    """Largest swt on the circle of a radius, on all planes, of a batch of one point."""
    cycle = LoadCycle.of(points)
    planes = hemisphere(PLANES)
    values = _on_circle(cycle, r, ANGLES, planes, INSTANTS)
    tops = np.pad(values.max(axis=1), 1, constant_values=-1.0)
    highest = float(tops.max())
    is_peak = (tops[1:-1] >= tops[:-2]) & (tops[1:-1] >= tops[2:]) & (tops[1:-1] > 0.9 * highest)
    for k in np.flatnonzero(is_peak):
        angle, normal = ANGLES[k], planes[values[k].argmax()]
        step, turn, count = ANGLES[2], REACH, INSTANTS
        for _ in range(ROUNDS):
            angles, normals = angle + step * np.linspace(-1.0, 1.0, 9), _around(normal, turn)
            closer = _on_circle(cycle, r, angles, normals, count)
            best = np.unravel_index(closer.argmax(), closer.shape)
            highest = max(highest, float(closer[best]))
            angle, normal = angles[best[0]], normals[best[1]]
            step, turn, count = NARROWER * step, NARROWER * turn, min(2 * count, 192)
    return highest


def _on_circle(cycle: LoadCycle, r: float, angles: Array, normals: Array, count: int) -> Array:
    """The parameter swt at angles on planes, shape (angles, planes)."""
    ν = float(cycle.points.poisson_ratio[0])
    stress = _circle_stress(cycle, r, angles, count)
    return swt_on_planes(stress, normals, ν, 1.0 - ν**2, criterion_of(cycle.points))


def _circle_stress(cycle: LoadCycle, r: float, angles: Array, count: int) -> Array:
    """Stress at angles of a circle, shape (angles, instants, 6), components xx, yy, zz, yz, xz, xy.

    Pressure is axisymmetric. With c = cos θ, s = sin θ and the integrals T1 and T3 of the tangential springs
    shear makes

        σ_xx = (1 + ν) T1 c + σ,   σ_yy = −σ,   σ_xy = T1 s/2 + ν s (2 c² k − j),   σ = ν c (2 c² k − 3 j),

    j = T1 − T3 and k = (3/2) T1 − 2 T3, which follow from both ends of the line.
    """
    ν = float(cycle.points.poisson_ratio[0])
    states = cycle.states(cycle.instants(count, r))
    right, left = cycle.stress(r, states), cycle.stress(-r, states)
    radial, hoop = (0.5 * (right[name] + left[name]) for name in ("xx", "yy"))
    pull, third = (0.5 * (right[name] - left[name]) for name in ("xx", "yy"))  # the latter is ν T3
    radial = radial - right["bulk"]
    first = (pull + third) / (1.0 + ν)
    j, k = ν * first - third, 1.5 * ν * first - 2.0 * third
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    across = c * (2.0 * c * c * k - 3.0 * j)
    stress = np.zeros((len(angles), len(states), 6))
    stress[..., 0] = radial * c * c + hoop * s * s + (1.0 + ν) * first * c + across + right["bulk"]
    stress[..., 1] = radial * s * s + hoop * c * c - across
    stress[..., 2], stress[..., 4] = right["zz"], right["xz"]
    stress[..., 5] = (radial - hoop) * c * s + 0.5 * first * s + s * (2.0 * c * c * k - j)
    return stress


def _around(normal: Array, turn: float) -> Array:
    """Normals on a grid about one of them."""
    basis = tangent_basis(normal[None])[0]
    grid = np.stack(np.meshgrid(*(turn * np.linspace(-1.0, 1.0, 9),) * 2), axis=-1).reshape(-1, 2)
    normals = normal + grid @ basis
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def dense_body(points: Points, scene: Scene, x: float) -> float:
    """Largest swt on a lattice of the body and on closer ones, of one point; x is on one circle."""
    largest = float(scene.largest_radius[0])
    start = scene.cycle.memory.start
    cusps = scene.coordinate.radius(np.unique(start[np.isfinite(start)])[None])[0]
    known = cusps > 0.02 * largest
    if scene.profile.has_singular_edge:
        # At the edge of a face pressure has no bound: as the audit does, this leaves out what is next to it.
        known &= np.abs(cusps - scene.profile.flat_radius) > 1e-6 * largest
    radii = np.concatenate([[abs(x)], cusps[known], largest * RADII])
    angles, depths = np.linspace(0.0, np.pi, 9), largest * DEPTHS
    of_radii = [_highest(scene, r, angles, depths, 5) for r in np.unique(radii)]
    swt = np.pad([top for top, *_ in of_radii], 1)
    is_peak = (swt[1:-1] >= swt[:-2]) & (swt[1:-1] >= swt[2:]) & (swt[1:-1] >= 0.8 * swt.max())
    tops = sorted((of_radii[k] for k in np.flatnonzero(is_peak)), reverse=True)
    highest = 0.0
    for top, r, angle, depth in tops[:3]:
        steps = np.array([largest * STEPS[0], STEPS[1], max(0.5 * depth, largest * STEPS[2])])
        for _ in range(5):
            grids = [
                at + step * np.linspace(-1.0, 1.0, 5)
                for at, step in zip((r, angle, depth), steps, strict=True)
            ]
            below = np.maximum(grids[2], 0.0)
            found = max(_highest(scene, abs(own), grids[1], below, INSTANTS) for own in grids[0])
            if found[0] > top:
                top, r, angle, depth = found
            steps = 0.4 * steps
        # Beside a cusp of the surface the field of cells is up to 2e-3 off.
        highest = max(highest, dense_circle(points, r) if depth == 0.0 else top)
    return highest


def _highest(
    scene: Scene, r: float, angles: Array, depths: Array, count: int
) -> tuple[float, float, float, float]:
    """The highest swt at angles and depths of one radius, and that radius, its angle and its depth."""
    angle, depth = np.meshgrid(angles, depths, indexing="ij")
    body = Body(scene, time_nodes(scene, count, [r]), CELLS)
    swt = body.swt(r * np.cos(angle), r * np.sin(angle), depth).swt
    best = np.unravel_index(swt.argmax(), swt.shape)
    return float(swt[best]), float(r), float(angle[best]), float(depth[best])


def plain_mean(scene: Scene, x: Array, angle: Array, distance: Array) -> tuple[float, float]:
    """Mean of swt over places of a Sobol sequence in the half sphere, and by how much its halves differ."""
    share, cosine, turn = qmc.Sobol(3, seed=SEED).random_base2(PLACES).T
    away, about = float(distance[0]) * np.cbrt(share), 2.0 * np.pi * turn
    across = away * np.sqrt(1.0 - cosine**2)
    right, aside = float(x[0]) + across * np.cos(about), across * np.sin(about)
    places = Places(np.hypot(right, aside), away * cosine, np.abs(np.arctan2(aside, right)))
    # The directions are those of lines, which no one asks for.
    local = Around(scene, float(x[0]), np.array([[0.0, 1.0]]), distance).local
    parts = np.split(np.arange(len(share)), len(share) // TOGETHER)
    means = [local.swt(places.at(part), np.ones(TOGETHER, dtype=bool))[0].mean() for part in parts]
    first, second = (np.mean(half) for half in np.split(np.array(means), 2))
    return float(0.5 * (first + second)), float(abs(first - second))


def shortfalls(task: tuple[str, int, str]) -> tuple[str, str, Array]:
    """By how much what is looked at is below the dense look at some points, relative."""
    name, count, kind = task
    rng = np.random.default_rng([SEED, list(SCENES).index(name)])
    drawn = [SCENES[name][0](rng) for _ in range(-(-count // CHUNK))]
    low: list[float] = []
    for some in drawn:
        points = some.take(np.arange(min(count - len(low), len(some))))
        if kind == "circle" and not points.bulk_stress_amplitude.any():
            ν = rng.uniform(SAFE_POISSON_RATIO, 0.5, len(points))
            points = replace(points, poisson_ratio=ν)
        solved = solve_points(points, 1e-5)
        for k, surface in enumerate(solved.s_surface):
            one = np.array([k])
            x, angle = solved.critical_x[one], solved.critical_angle[one]
            if not (np.isfinite(x[0]) and surface > 0.0):
                low.append(np.nan)
                continue
            scene = scene_of(points.take(one))
            if solved.s[k] <= solved.s_error[k]:
                # s that is nothing but rounding has no place.
                x = scene.largest_radius
            with np.errstate(all="ignore"):
                if kind == "mean":
                    distance = DISTANCES[0] * DISTANCES[1] ** rng.uniform(size=1)
                    means = nonlocal_swt, tight_means
                    found, dense = (float(of(scene, x, angle, distance).volume[0, 0]) for of in means)
                    allowed = KINDS[kind][1]
                    if abs(1.0 - found / dense) > allowed:
                        plain, spread = plain_mean(scene, x, angle, distance)
                        # Where the mean is a thousandth of swt, few of the even places show any.
                        dense = plain if spread < allowed * plain else dense
                elif kind == "body":
                    found, dense = (
                        body_maximum(scene, float(x[0]))[0].swt,
                        dense_body(points.take(one), scene, float(x[0])),
                    )
                else:
                    found, dense = float(surface), dense_circle(points.take(one), abs(float(x[0])))
            low.append(1.0 - found / dense)
    return name, kind, np.array(low)


def lines(found: list[tuple[str, str, Array]], before: str = "") -> Iterator[str]:
    """The report; of kinds of which nothing is found with what it said before."""
    yield "# Is a maximum overlooked off the line?"
    yield ""
    yield (
        f"s_surface at ν > {SAFE_POISSON_RATIO} or with a bulk stress, the largest swt of the body that "
        "`swtstudy audit` finds, and means over half spheres, against dense looks at random points, small "
        "motions among them. `python studies/checks/off_line.py`"
    )
    for kind, (title, allowed) in KINDS.items():
        yield from ("", f"## {title}", "")
        if kind not in {own for _, own, _ in found}:
            yield from before.partition(f"## {title}\n\n")[2].partition("\n\n##")[0].splitlines()
            continue
        fault = "off" if kind == "mean" else "low"
        yield f"| scene | points | {fault} by more than {allowed:g} | most |"
        yield "|---|---|---|---|"
        for name, own, low in found:
            if own == kind:
                known = low[np.isfinite(low)]
                faults = np.abs(known) if kind == "mean" else known
                many, most = (faults > allowed).sum(), faults.max(initial=0.0)
                yield f"| {name} | {known.size} | {many} | {most:.1e} |"


def keep(file: Path, name: str, kind: str, low: Array) -> list[tuple[str, str, Array]]:
    """Put what is found in the place of what was known of its scene and kind, and return all, in order."""
    rows = {(name, kind): low.tolist()}
    if file.exists():
        with file.open(encoding="utf-8") as known:
            for row in csv.DictReader(known):
                key = row["scene"], row["kind"]
                if key != (name, kind):
                    rows.setdefault(key, []).append(float(row["low"]))
    every = [(*key, np.array(rows[key])) for key in itertools.product(COUNTS, KINDS) if key in rows]
    with file.open("w", encoding="utf-8", newline="") as all_rows:
        table = csv.writer(all_rows, lineterminator="\n")
        table.writerow(["scene", "kind", "low"])
        table.writerows([name, kind, f"{each:.3g}"] for name, kind, low in every for each in low)
    return every


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--points", type=int, help="points of each scene at most")
    arguments.add_argument(
        "--kinds", nargs="+", choices=KINDS, default=[*KINDS], help="others stay as they are"
    )
    arguments.add_argument("--scenes", nargs="+", choices=COUNTS, default=[*COUNTS], help="likewise")
    arguments.add_argument("--processes", type=int, default=2, help="at a time")
    arguments.add_argument("--quick", action="store_true", help="a point of one scene, to see that it runs")
    given = arguments.parse_args()
    most = 1 if given.quick else given.points or 10**6
    tasks = [
        (name, min(COUNTS[name][k], most), kind)
        for k, kind in enumerate(KINDS)
        if kind in given.kinds
        for name in given.scenes[: 1 if given.quick else None]
    ]
    with ProcessPoolExecutor(given.processes) as pool:
        for done in as_completed([pool.submit(shortfalls, task) for task in tasks]):
            every = keep(given.results / "off_line.csv", *done.result())
    report = given.results / "off_line.md"
    before = report.read_text(encoding="utf-8") if report.exists() else ""
    text = "\n".join(lines(every, before)) + "\n"
    report.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
