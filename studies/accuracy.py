"""How accurate s is, and whether s_error bounds the error: random points against the tightest tolerance.

Run as ``python studies/accuracy.py [points a profile]``; writes results/accuracy.md.
"""

from __future__ import annotations

import argparse
from fractions import Fraction
from math import gcd
from pathlib import Path

import numpy as np

from swtstudy.mechanics import Points, solve_points

RTOLS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
REFERENCE_RTOL = 1e-8
SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": (0.0, 2.0)},
    "truncated_paraboloid": {"flat_radius": (0.0, 2.0)},
    "wavy_paraboloid": {"waviness_amplitude": (0.003, 0.1), "wavelength": (4.5, 10.0)},
}
HEADER = (
    "| profile | rtol | median error | 99 % | largest | error > s_error | s_error > rtol·s |\n"
    "|---|---|---|---|---|---|---|\n"
)


def random_points(profile: str, count: int, seed: int) -> Points:
    """Points over the whole parameter box: ν 0–0.5, μ 0.05–1, δA/δ0 0–0.95, p, q ≤ 5, amplitude 0.05–1.2."""
    rng = np.random.default_rng(seed)
    ratios = [Fraction(p, q) for p in range(1, 6) for q in range(1, 6) if gcd(p, q) == 1]
    chosen = [ratios[i] for i in rng.integers(len(ratios), size=count)]
    return Points(
        profile,
        rng.uniform(0.0, 0.5, count),
        rng.uniform(0.05, 1.0, count),
        rng.uniform(0.0, 0.95, count),
        np.array([ratio.numerator for ratio in chosen]),
        np.array([ratio.denominator for ratio in chosen]),
        rng.uniform(0.05, 1.2, count),
        rng.uniform(0.0, 2.0 * np.pi, count),
        {name: rng.uniform(*bounds, count) for name, bounds in SHAPES[profile].items()},
    )


def rows(profile: str, count: int) -> list[str]:
    """The table's lines for one profile."""
    points = random_points(profile, count, seed=1)
    reference = solve_points(points, REFERENCE_RTOL).s
    regular = np.isfinite(reference)
    lines = []
    for rtol in RTOLS:
        solution = solve_points(points, rtol)
        s, error = solution.s[regular], np.abs(solution.s - reference)[regular]
        claimed = solution.s_error[regular]
        median, most, largest = np.quantile(error / s, [0.5, 0.99, 1.0])
        missed, wide = np.mean(error > claimed), np.mean(claimed > rtol * s)
        lines.append(
            f"| {profile} | {rtol:.0e} | {median:.1e} | {most:.1e} | {largest:.1e} "
            f"| {missed:.1%} | {wide:.1%} |"
        )
    return lines


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("points", nargs="?", type=int, default=100, help="points a profile")
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="one point a profile, to see that it runs")
    given = arguments.parse_args()
    count = 1 if given.quick else given.points
    table = [line for profile in SHAPES for line in rows(profile, count)]
    title = f"Relative errors at {count} random points a profile, against rtol = {REFERENCE_RTOL:.0e}.\n\n"
    text = title + HEADER + "\n".join(table) + "\n"
    given.results.mkdir(exist_ok=True)
    (given.results / "accuracy.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
