"""How accurate s is, and whether s_error bounds the error: random points against the tightest tolerance.

The points at which it does not are listed with their parameters.

Run as ``python studies/accuracy.py [points a profile] [--ends] [--seed n]``; writes results/accuracy.md,
or, with ``--ends``, results/accuracy_ends.md: there the points crowd at the ends of the allowed ranges.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from fractions import Fraction
from math import gcd
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.solver.at_rest import check_shape
from swtstudy.solver.points import Points, solve_points

RTOLS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
REFERENCE_RTOL = 1e-8
SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": (0.0, 2.0)},
    "truncated_paraboloid": {"flat_radius": (0.0, 2.0)},
    "wavy_paraboloid": {"waviness_amplitude": (0.003, 0.1), "wavelength": (4.5, 10.0)},
    "power_law": {"exponent": (1.1, 6.0)},
}
HEADER = (
    "| profile | rtol | median error | 99 % | largest | error > s_error | and the reference's "
    "| s_error > rtol·s |\n"
    "|---|---|---|---|---|---|---|---|\n"
)
MISSING_HEADER = (
    "| profile | rtol | error | s_error | and the reference's | s | parameters |\n"
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


def points_at_ends(profile: str, count: int, seed: int, largest_term: int = 8) -> Points:
    """Points that crowd at the ends of what `swtstudy.vocabulary.parameters` allows, q and p up to
    ``largest_term``."""
    rng = np.random.default_rng(seed)

    def logarithmic(low: float, high: float) -> NDArray[np.float64]:
        return np.asarray(10.0 ** rng.uniform(np.log10(low), np.log10(high), count))

    def one_of(*kinds: ArrayLike) -> NDArray[np.float64]:
        chosen = rng.integers(len(kinds), size=count)
        return np.choose(chosen, [np.broadcast_to(kind, count) for kind in kinds])

    def uniform(high: float) -> NDArray[np.float64]:
        return rng.uniform(0.0, high, count)

    poisson_ratio = one_of(0.0, 0.5, uniform(0.5), 0.5 - logarithmic(1e-6, 0.1))
    friction = one_of(*[logarithmic(1e-3, 10.0)] * 9, 0.0)
    near_lift_off = 1.0 - logarithmic(1e-6, 1.0)
    normal = one_of(uniform(10.0), uniform(1.0), near_lift_off, logarithmic(1e-5, 1.0), 0.0)
    tangential = one_of(*[logarithmic(1e-5, 100.0)] * 9, 0.0)
    p, q = (np.floor(logarithmic(1.0, largest_term + 1.0)).astype(int) for _ in range(2))
    common = np.gcd(p, q)
    phase = one_of(uniform(2.0 * np.pi), np.pi / 12.0 * rng.integers(24, size=count))
    shape = {}
    if "flat_radius" in SHAPES[profile]:
        shape = {"flat_radius": one_of(*[logarithmic(1e-6, 20.0)] * 9, 20.0)}
    if "exponent" in SHAPES[profile]:
        shape = {"exponent": 1.0 + logarithmic(0.1, 19.0)}
    if "wavelength" in SHAPES[profile]:
        shape = {"waviness_amplitude": logarithmic(1e-6, 10.0), "wavelength": logarithmic(3.3, 1e3)}
        for k in range(count):
            while check_shape(profile, {n: v[k] for n, v in shape.items()}, 1.0 + normal[k]) is not None:
                shape["waviness_amplitude"][k] = 10.0 ** rng.uniform(-6.0, 1.0)
                shape["wavelength"][k] = 10.0 ** rng.uniform(np.log10(3.3), 3.0)
    loads = p // common, q // common, tangential, phase
    return Points(profile, poisson_ratio, friction, normal, *loads, shape)


def rows(points: Points) -> tuple[list[str], list[str]]:
    """Lines of the table for the points of one profile, and of the table of points that miss s_error."""
    tight = solve_points(points, REFERENCE_RTOL)
    regular = np.flatnonzero(tight.s > 0.0)
    reference, of_reference = tight.s[regular], tight.s_error[regular]
    lines, missing = [], []
    for rtol in RTOLS:
        solution = solve_points(points, rtol)
        s, claimed = solution.s[regular], solution.s_error[regular]
        error = np.abs(s - reference)
        median, most, largest = np.quantile(error / s, [0.5, 0.99, 1.0])
        missed, wide = np.mean(error > claimed), np.mean(claimed > rtol * s)
        beyond = np.mean(error > claimed + of_reference)
        lines.append(
            f"| {points.profile} | {rtol:.0e} | {median:.1e} | {most:.1e} | {largest:.1e} "
            f"| {missed:.1%} | {beyond:.1%} | {wide:.1%} |"
        )
        for k in np.flatnonzero(error > claimed):
            relative = np.array([error[k], claimed[k], of_reference[k]]) / reference[k]
            numbers = " | ".join(f"{value:.1e}" for value in relative)
            words = described(points, int(regular[k]))
            missing.append(f"| {points.profile} | {rtol:.0e} | {numbers} | {reference[k]:.3g} | {words} |")
    return lines, missing


def described(points: Points, k: int) -> str:
    """The parameters of a point, as many digits as find it again."""
    values = {
        "ν": points.poisson_ratio,
        "μ": points.friction,
        "δA/δ0": points.normal_amplitude,
        "uA": points.tangential_amplitude,
        "ψ": points.phase,
        **points.shape,
    }
    words = [f"{name} {float(value[k])!r}" for name, value in values.items()]
    return ", ".join([*words, f"ω2/ω1 {points.p[k]}/{points.q[k]}"])


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("points", nargs="?", type=int, default=100, help="points a profile")
    arguments.add_argument("--ends", action="store_true", help="points at the ends of the allowed ranges")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument(
        "--quick", action="store_true", help="one point of one profile, to see that it runs"
    )
    given = arguments.parse_args()
    count = 1 if given.quick else given.points
    draw: Callable[[str, int, int], Points] = points_at_ends if given.ends else random_points
    profiles = [*SHAPES][: 1 if given.quick else None]
    found = [rows(draw(profile, count, given.seed)) for profile in profiles]
    table, missing = ([line for lines in both for line in lines] for both in zip(*found, strict=True))
    where = "at the ends of the allowed ranges, " if given.ends else ""
    title = f"Relative errors at {count} random points a profile, {where}"
    title += f"against rtol = {REFERENCE_RTOL:.0e} (seed {given.seed}).\n\n"
    text = title + HEADER + "\n".join(table) + "\n"
    if missing:
        text += "\nWhere the error exceeds s_error, over s:\n\n" + MISSING_HEADER + "\n".join(missing) + "\n"
    given.results.mkdir(exist_ok=True)
    name = "accuracy_ends.md" if given.ends else "accuracy.md"
    (given.results / name).write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
