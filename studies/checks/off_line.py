"""Is a maximum overlooked off the line? s_surface, the body's maximum and means against dense looks.

``python studies/checks/off_line.py``, from the project folder, writes results/off_line.md. The points are
as in ``overlooked.py``, with another seed: on circles with ν > 0.35, where s_surface is searched for, or a
bulk stress; the means are over the half sphere about the critical point, with distances logarithmic
over 0.01–0.2 a_H, held against a dense rule with places of its own, and where these differ, against the
plain mean over places that fill the half sphere evenly, if its halves agree. results/off_line.csv keeps
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

from nonlocal_means import dense_means
from overlooked import CHUNK, SCENES

from swtstudy.kernel.circle import SAFE_POISSON_RATIO
from swtstudy.kernel.field import Opened, criterion_at, largest_radius, mean_about, open_cycle, passed_radii
from swtstudy.kernel.mean import SPHERE
from swtstudy.paper.maxima import body_maximum
from swtstudy.solver.means import DOWN, RTOL
from swtstudy.solver.points import arguments_of, solve_points

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
#: Tested value, its title, and the share by which a dense grid may be higher: the claim.
KINDS = {
    "circle": ("s_surface", 1e-4),
    "body": ("The body's maximum", 1e-4),
    "mean": ("The mean of swt over a critical distance", 1e-2),
}
#: Largest distance of the means, and least over that.
DISTANCES = 0.2, 0.05
#: Binary logarithm of the number of places of a plain mean, and the tolerances of values there and elsewhere.
PLACES, OF_PLACES, TOLERANCE = 13, 1e-3, 1e-5
#: On a circle: angles of the first look, how often one goes closer, and how it narrows.
ANGLES, ROUNDS, NARROWER = np.linspace(0.0, np.pi, 65), 6, 0.35
#: In the body, over the largest contact radius: radii and depths, and steps of the first closer look.
RADII, DEPTHS = np.linspace(0.05, 1.15, 23), np.array([0.0, 0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8])
STEPS = 0.03, 0.2, 0.004
#: Radii at which edges and fronts turn at most.
MOST_CUSPS = 60


def dense_circle(opened: Opened, r: float) -> float:
    """Largest swt on the circle of a radius, on all planes, of one point."""
    values = _at(opened, r, ANGLES, np.zeros(1))[:, 0]
    tops = np.pad(values, 1, constant_values=-1.0)
    highest = float(tops.max())
    is_peak = (tops[1:-1] >= tops[:-2]) & (tops[1:-1] >= tops[2:]) & (tops[1:-1] > 0.9 * highest)
    for k in np.flatnonzero(is_peak):
        angle, step = ANGLES[k], ANGLES[2]
        for _ in range(ROUNDS):
            angles = angle + step * np.linspace(-1.0, 1.0, 9)
            closer = _at(opened, r, angles, np.zeros(1))[:, 0]
            highest, angle = max(highest, float(closer.max())), angles[closer.argmax()]
            step *= NARROWER
    return highest


def _at(opened: Opened, r: float, angles: Array, depths: Array, tolerance: float = TOLERANCE) -> Array:
    """The parameter swt at angles and depths of one radius, shape (angles, depths)."""
    angle, depth = np.meshgrid(angles, depths, indexing="ij")
    across = np.where(np.abs(np.sin(angle)) < 1e-12, 0.0, r * np.sin(angle))
    places = np.stack([(r * np.cos(angle)).ravel(), across.ravel(), depth.ravel()], axis=1)
    return np.asarray(criterion_at(opened, places, tolerance)[0].reshape(angle.shape))


def dense_body(opened: Opened, x: float) -> float:
    """Largest swt on a lattice of the body and on closer ones, of one point; x is on one circle."""
    largest, profile = largest_radius(opened), opened.point.profile
    cusps = passed_radii(opened, MOST_CUSPS)
    known = cusps > 0.02 * largest
    if profile["singular"]:
        # At the edge of a face pressure has no bound: as the audit does, this leaves out what is next to it.
        known &= np.abs(cusps - profile["flat_radius"]) > 1e-6 * largest
    radii = np.concatenate([[abs(x)], cusps[known], largest * RADII])
    angles, depths = np.linspace(0.0, np.pi, 9), largest * DEPTHS
    of_radii = [_highest(opened, r, angles, depths, 1e-3) for r in np.unique(radii)]
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
            found = max(_highest(opened, abs(own), grids[1], below, TOLERANCE) for own in grids[0])
            if found[0] > top:
                top, r, angle, depth = found
            steps = 0.4 * steps
        highest = max(highest, top)
    return highest


def _highest(
    opened: Opened, r: float, angles: Array, depths: Array, tolerance: float
) -> tuple[float, float, float, float]:
    """The highest swt at angles and depths of one radius, and that radius, its angle and its depth."""
    swt = _at(opened, r, angles, depths, tolerance)
    best = np.unravel_index(swt.argmax(), swt.shape)
    return float(swt[best]), float(r), float(angles[best[0]]), float(depths[best[1]])


def plain_mean(opened: Opened, x: Array, distance: Array) -> tuple[float, float]:
    """Mean of swt over places of a Sobol sequence in the half sphere, and by how much its halves differ."""
    share, cosine, turn = qmc.Sobol(3, seed=SEED).random_base2(PLACES).T
    away, about = float(distance[0]) * np.cbrt(share), 2.0 * np.pi * turn
    across = away * np.sqrt(1.0 - cosine**2)
    right, aside = float(x[0]) + across * np.cos(about), across * np.sin(about)
    places = np.stack([right, aside, away * cosine], axis=1)
    values = criterion_at(opened, places, OF_PLACES)[0]
    first, second = (float(half.mean()) for half in np.split(values, 2))
    return float(0.5 * (first + second)), float(abs(first - second))


def shortfalls(task: tuple[str, int, str]) -> tuple[str, str, Array]:
    """By how much what is looked at is below the dense look at some points, relative."""
    name, count, kind = task
    rng = np.random.default_rng([SEED, list(SCENES).index(name)])
    drawn = [SCENES[name][0](rng) for _ in range(-(-count // CHUNK))]
    low: list[float] = []
    for some in drawn:
        points = some[np.arange(min(count - len(low), len(some)))]
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
            own = points[one]
            opened = open_cycle(**arguments_of(own))
            if solved.s[k] <= solved.s_error[k]:
                # s that is nothing but rounding has no place.
                x = np.array([largest_radius(opened)])
            with np.errstate(all="ignore"):
                if kind == "mean":
                    distance = DISTANCES[0] * DISTANCES[1] ** rng.uniform(size=1)
                    found, _ = mean_about(opened, SPHERE, x[0], DOWN, distance[0], 0.0, RTOL)
                    about = float(x[0]), float(np.radians(2.0 * angle[0])), float(distance[0])
                    dense = float(dense_means(opened, *about, 1)[0])
                    allowed = KINDS[kind][1]
                    if abs(1.0 - found / dense) > allowed:
                        plain, spread = plain_mean(open_cycle(**arguments_of(own)), x, distance)
                        # If the mean is a thousandth of swt, few of the even places show any.
                        dense = plain if spread < allowed * plain else dense
                elif kind == "body":
                    found = body_maximum(own, float(x[0]))[0].swt
                    dense = dense_body(open_cycle(**arguments_of(own)), float(x[0]))
                else:
                    found, dense = float(surface), dense_circle(opened, abs(float(x[0])))
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
    """Replace the known values of a scene and kind by the new ones, and return all, in order."""
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
    given.results.mkdir(parents=True, exist_ok=True)
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
