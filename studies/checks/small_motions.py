"""Are means over a critical distance the largest ones, where the motion is small?

``python studies/checks/small_motions.py`` writes results/small_motions.md: at random points of the
paraboloid, with amplitudes from 1e-3 on, by how much means about places along the whole line, many of them
next to the highest peaks of the surface, exceed the means that the solver says are the largest.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from nonlocal_means import MEANS, about, largest_of
from numpy.typing import NDArray

from swtstudy.kernel.field import largest_radius, open_cycle, surface_above
from swtstudy.solver.means import GROWTH
from swtstudy.solver.points import Points, arguments_of, solve_points

FloatArray = NDArray[np.float64]

RATIOS = [(1, 1), (1, 2), (2, 1), (2, 3), (3, 2), (1, 3)]
SEED = 7
#: Evenly spaced places, peaks, distances from each over the smaller one of ℓ and the radius; accuracy there.
EVEN, PEAKS, BESIDE, RTOL = 41, 3, np.geomspace(1e-4, 1.0, 14), 1e-2
#: Excess that counts, beyond what the means at the places may miss.
COUNTS = 0.015


def random_points() -> Iterator[tuple[Points, float]]:
    """Single points with small motions, and a distance each; only points with a critical point."""
    rng = np.random.default_rng(SEED)
    while True:
        (p, q), u = RATIOS[rng.integers(len(RATIOS))], rng.uniform
        ν, μ, ψ = (np.array([u(*ends)]) for ends in ((0.0, 0.5), (0.05, 0.95), (0.0, 2.0 * np.pi)))
        δ, U = (np.array([0.95 * 10.0 ** u(-3.0, 0.0)]) for _ in range(2))
        point = Points("paraboloid", ν, μ, δ, np.array([p]), np.array([q]), U, ψ)
        distance = float(10.0 ** u(-2.5, -0.3))
        if np.isfinite(solve_points(point, 1e-4).critical_x[0]):
            yield point, distance


def excess(point: Points, distance: float) -> FloatArray:
    """By how much means about many places exceed the largest, relative, (5,)."""
    solution = solve_points(point, 1e-4)
    known = largest_of(point, solution, distance)
    opened = open_cycle(GROWTH, **arguments_of(point))
    radius, s = largest_radius(opened), float(solution.s[0])
    place, value = surface_above(opened, 0.02 * s, s)
    tops = 1 + np.flatnonzero(value[1:-1] >= np.maximum(value[:-2], value[2:]))
    peaks = place[tops[np.argsort(-value[tops])][:PEAKS]]
    beside = np.concatenate([-BESIDE, [0.0], BESIDE]) * min(distance, radius)
    even = np.linspace(-radius - distance, radius + distance, EVEN)
    places = np.unique(np.concatenate([even, (peaks[:, None] + beside).ravel()]))
    found = np.max([about(opened, x, distance, RTOL, known)[0] for x in places], axis=0)
    return found / known - 1.0


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--points", type=int, default=60, help="random points")
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="one point, to see that it runs")
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    count, points = 1 if given.quick else given.points, random_points()
    found = np.array([excess(*next(points)) for _ in range(count)])
    lines = [
        "# The largest means, where the motion is small",
        "",
        f"{count} random points. The columns tell at how many a mean about one of many places exceeds the "
        f"one that the solver found by more than {100.0 * COUNTS:g} %, and the largest excess. "
        "`python studies/checks/small_motions.py`",
        "",
        "| mean | points | most |",
        "|---|---|---|",
    ]
    for name, of_mean in zip(MEANS, found.T, strict=True):
        lines.append(f"| {name} | {(of_mean > COUNTS).sum()} | {max(float(of_mean.max()), 0.0):.1%} |")
    (given.results / "small_motions.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
