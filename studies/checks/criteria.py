"""Criteria of shear against plain loops over the positions, planes and instants of the surface line.

``python studies/checks/criteria.py``, from the project folder, writes results/criteria.md: by profile and
criterion, how far s is below what the loops find, and above. ``--points 2`` takes fewer of each, ``--quick``
one of two profiles.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))

from scenes import random_plane_points, random_points

from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points, solve_points
from swtstudy.vocabulary.arrays import FloatArray

#: Profiles of revolution, and plane ones.
PROFILES = ("paraboloid", "rounded_punch", "wavy_paraboloid", "power_law"), ("cylinder", "rounded_flat")
#: Largest sensitivities.
SENSITIVITIES = {"fatemi_socie": 2.0, "findley": 0.6}
SEED = 500
#: Steps between two cusps of the line, and between two events of the cycle; planes; rounds of closer looks.
STEPS, INSTANTS, PLANES, ROUNDS = 60, 4, 90, 4


def value_of(criterion: str, sensitivity: float, normal: FloatArray, shear: FloatArray) -> FloatArray:
    """The criteria's definitions, from σ_n and τ of planes over time, (..., T)."""
    amplitude, tension = 0.5 * np.ptp(shear, axis=-1), normal.max(axis=-1)
    if criterion == "findley":
        return amplitude + sensitivity * tension
    return amplitude * (1.0 + sensitivity * np.maximum(tension, 0.0))


def highest_at(
    cycle: LoadCycle, own: tuple[str, float], x: FloatArray, angles: FloatArray, steps: int
) -> tuple:
    """Largest value over the planes whose normals are at angles from x, and that angle, at each place."""
    best, plane = np.empty(x.size), np.empty(x.size)
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    for k, place in enumerate(x.tolist()):
        stress = cycle.stress(place, cycle.states(cycle.instants(steps, place)))
        xx, zz, xz = stress["xx"], stress["zz"], stress["xz"]
        normal = c * c * xx + s * s * zz + 2.0 * s * c * xz
        value = value_of(*own, normal, s * c * (zz - xx) + (c * c - s * s) * xz)
        best[k], plane[k] = value.max(), angles[value.argmax()]
    return best, plane


def brute(points: Points, criterion: str, sensitivity: float, steps: int = STEPS) -> tuple[float, float]:
    """The largest value on the line y = 0 of a batch of one point, and x there."""
    cycle, own = LoadCycle(points), (criterion, sensitivity)
    ends = cycle.radius(cycle.cusps())
    share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps))
    r = np.append((ends[:-1, None] + np.diff(ends)[:, None] * share).ravel(), ends[-1])
    best, place = -np.inf, np.nan
    step = np.pi / PLANES
    for side in (1.0, -1.0):
        value, plane = highest_at(cycle, own, side * r, step * np.arange(PLANES), INSTANTS)
        framed = np.pad(value, 1, constant_values=-np.inf)
        peaks = np.flatnonzero((value >= framed[:-2]) & (value >= framed[2:]) & (value > 0.9 * value.max()))
        for k in sorted(peaks, key=lambda k: -value[k])[:4]:
            low, high, angle, turn = r[max(k - 1, 0)], r[min(k + 1, r.size - 1)], plane[k], step
            for _ in range(ROUNDS):
                x: NDArray = np.unique(np.append(np.linspace(low, high, 17), r[k]))
                found, planes = highest_at(cycle, own, side * x, angle + turn * np.linspace(-1, 1, 17), 12)
                top = int(found.argmax())
                if found[top] > best:
                    best, place = float(found[top]), float(side * x[top])
                low, high = x[max(top - 1, 0)], x[min(top + 1, x.size - 1)]
                angle, turn = planes[top], 0.2 * turn
    return best, place


def drawn(profile: str, criterion: str, count: int, seed: int) -> Points:
    """Random points, every other one or so with a bulk stress."""
    rng = np.random.default_rng(seed)
    if profile in PROFILES[1]:
        batch = random_plane_points(seed, count, profile)
    else:
        batch = random_points(seed, count, profile, largest_term=2)
        batch = replace(
            batch,
            poisson_ratio=rng.uniform(0.0, 0.5, count),
            friction=rng.uniform(0.05, 1.2, count),
            bulk_stress_amplitude=rng.choice([0.0, 0.0, 0.1, 0.3], count),
            bulk_stress_mean=rng.choice([0.0, 0.0, 0.2], count),
        )
    sensitivity = rng.uniform(0.1, SENSITIVITIES[criterion], count)
    return replace(batch, criterion=criterion, normal_sensitivity=sensitivity)


def shortfalls(profile: str, criterion: str, count: int, seed: int) -> Iterator[tuple[float, float]]:
    """By how much s is below the loops' value, relative, and its relative error, of each point with an s."""
    batch = drawn(profile, criterion, count, seed)
    found = solve_points(batch, 1e-4)
    for k in np.flatnonzero(found.s > 0.0):
        own = batch[[k]]
        value, _ = brute(own, criterion, float(batch.normal_sensitivity[k]))
        yield 1.0 - found.s[k] / value, found.s_error[k] / value


def lines(profiles: list[str], count: int) -> Iterator[str]:
    """The report of so many points of each profile and criterion."""
    yield "# Criteria of shear against plain loops"
    yield ""
    yield (
        f"s at rtol 1e-4 of random points, against every plane of {PLANES} at every one of {STEPS} positions "
        f"between two cusps, with {INSTANTS} steps between two events, and closer grids around the highest. "
        "`python studies/checks/criteria.py`"
    )
    yield ""
    yield "| profile | criterion | points | lower than the loops by more than s_error | lowest | highest |"
    yield "|---|---|---|---|---|---|"
    for number, profile in enumerate(profiles):
        for criterion in SENSITIVITIES:
            rows = np.array([*shortfalls(profile, criterion, count, SEED + number)]).reshape(-1, 2)
            low, error = rows.T
            bad = int((low > error + 1e-7).sum())
            most = f"{max(low.max(initial=0.0), 0.0):.1e} | {max(-low.min(initial=0.0), 0.0):.1e}"
            yield f"| {profile} | {criterion} | {len(rows)} | {bad} | {most} |"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--points", type=int, default=17, help="points of each profile and criterion")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    count, profiles = given.points, [*PROFILES[0], *PROFILES[1]]
    if given.quick:
        count, profiles = 1, [own[0] for own in PROFILES]
    with np.errstate(all="ignore"):
        text = "\n".join(lines(profiles, count)) + "\n"
    (given.results / "criteria.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
