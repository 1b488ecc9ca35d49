"""What nonlocal means cost and how accurate they are.

``python studies/checks/nonlocal_means.py`` writes results/nonlocal_means.md:

* for scenes like Table 1 the processor time a point of one distance and of eleven, and the largest error
  claimed;
* for random points of all profiles, every fourth with bulk stress, what the means are off from the same
  means with many more places and instants, and from what they claim;
* for some of them the mean over the half sphere by another rule, in cylindrical coordinates about the axis,
  of a field that has many instants common to all places of a circle and all planes searched at each;
* how the means tend to s as ℓ falls.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from swtstudy.kernel.field import criterion_at, open_cycle
from swtstudy.profiles.table import TabulatedProfile
from swtstudy.solver import nonlocal_swt
from swtstudy.solver.points import Points
from swtstudy.solver.solve import arguments_of, solve_points

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
    "tabulated": {},
}
RATIOS = [(1, 1), (1, 2), (2, 1), (3, 2), (1, 3)]
SEED = 19
#: Runs that are timed: others on the machine make them longer, none shorter.
RUNS = 3
#: Means with so many places and instants are what the others are held against.
TIGHT = {
    "ONE": nonlocal_swt.ONE._replace(distances=19, inclinations=39, on_line=63),
    "OF_MANY": 0.02,
    "OF_SINGLE": 0.01,
    "FLOOR": 1e-4,
    "MANY": nonlocal_swt.SINGLE,
}
#: Places of the other rule: over the distance from the circle, the angle about the axis, and the depth.
OTHER = 9, 4, 13
#: Relative tolerance of its values.
OTHER_TOLERANCE = 1e-4
KINDS = "volume", "point", "line"


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
    """Single points all over the parameters, and a distance each; only those with a critical point."""
    rng = np.random.default_rng([SEED, list(SHAPES).index(profile)])
    while True:
        (p, q), u = RATIOS[rng.integers(len(RATIOS))], rng.uniform
        shape = {name: np.array([u(*ends)]) for name, ends in SHAPES[profile].items()}
        bounds = (0.0, 0.5), (0.05, 0.9), (0.0, 0.95), (0.05, 1.2), (0.0, 2.0 * np.pi)
        ν, μ, δ, U, ψ = (np.array([u(*ends)]) for ends in bounds)
        family = worn() if profile == "tabulated" else profile
        point = Points(family, ν, μ, δ, np.array([p]), np.array([q]), U, ψ, shape)
        bulk = {"mean": u(-0.1, 0.2), "amplitude": u(0.0, 0.2), "phase": u(0.0, 6.0)}
        if rng.integers(4) == 0:
            point = replace(point, **{f"bulk_stress_{name}": np.array([v]) for name, v in bulk.items()})
        distance = float(10.0 ** u(-2.0, -0.7))
        if np.isfinite(solve_points(point, 1e-4).critical_x[0]):
            yield point, distance


def place_of(point: Points) -> tuple[Points, FloatArray, FloatArray, FloatArray]:
    """The points, their critical x and angle, and s."""
    solution = solve_points(point, 1e-6)
    return point, solution.critical_x, solution.critical_angle, solution.s


def timed(points: Points, distance: FloatArray) -> tuple[nonlocal_swt.NonlocalSwt, float]:
    """Means, and the least processor time a point of some runs, ms."""
    at, spent = place_of(points)[:3], []
    for _ in range(RUNS):
        begin = time.process_time()
        found = nonlocal_swt.nonlocal_swt(*at, distance)
        spent.append(time.process_time() - begin)
    return found, 1e3 * min(spent) / len(points)


def times(scene: tuple[str, dict[str, float], float, tuple[int, int]], count: int) -> str:
    """Line of the table of times."""
    points = points_of(*scene, count)
    one, of_one = timed(points, DISTANCE)
    _, of_several = timed(points, SEVERAL)
    claimed = (one.volume_error / one.volume).max()
    name = f"{scene[0]}, δA/δ0 = {scene[2]:g}, ω2/ω1 = {scene[3][0]}/{scene[3][1]}"
    return f"| {name} | {of_one:.0f} ms | {of_several:.0f} ms | {claimed:.1e} |"


def tight_means(
    points: Points, x: FloatArray, angle: FloatArray, distance: FloatArray
) -> nonlocal_swt.NonlocalSwt:
    """Means with many more places and instants than they need."""
    with patch.multiple(nonlocal_swt, **TIGHT):
        return nonlocal_swt.nonlocal_swt(points, x, angle, distance)


def off_and_claimed(point: Points, distance: float) -> tuple[FloatArray, FloatArray]:
    """What the three kinds of means of one point are off from tight ones, and claim, over these, (3,)."""
    at = place_of(point)[:3]
    quick = nonlocal_swt.nonlocal_swt(*at, np.array([distance]))
    tight = tight_means(*at, np.array([distance]))
    off, claimed = np.zeros((2, len(KINDS)))
    for k, name in enumerate(KINDS):
        value, error, fine = getattr(quick, name), getattr(quick, f"{name}_error"), getattr(tight, name)
        worst = int((np.abs(value - fine) - error).argmax())
        size = max(float(fine.flat[worst]), 1e-300)
        off[k], claimed[k] = abs(value.flat[worst] - fine.flat[worst]) / size, error.flat[worst] / size
    return off, claimed


def sweep(profile: str, count: int) -> list[str]:
    """Lines of the table of random points."""
    found = [off_and_claimed(*case) for case in islice(random_points(profile), count)]
    off, claimed = (np.array(each) for each in zip(*found, strict=True))
    lines = []
    for k, name in enumerate(KINDS):
        more = int((off[:, k] > claimed[:, k]).sum())
        cells = (
            f"{np.median(off[:, k]):.0e} | {off[:, k].max():.0e} | {np.median(claimed[:, k]):.0e} | {more}"
        )
        lines.append(f"| {profile} | {name} | {count} | {cells} |")
    return lines


def gauss(count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss's rule on [0, 1]."""
    node, weight = np.polynomial.legendre.leggauss(count)
    return 0.5 + 0.5 * node, 0.5 * weight


def other_mean(point: Points, x: float, distance: float) -> float:
    """Mean over the half sphere in cylindrical coordinates about the axis."""
    opened = open_cycle(**arguments_of(point))
    total = volume = 0.0
    (u, of_u), (w, of_w), (v, of_v) = (gauss(count) for count in OTHER)
    # Depths end like a root where the circle leaves the sphere; y → −y is a symmetry.
    turn = 0.5 * np.pi * w[:, None]
    angle, of_angle = np.sin(turn), np.cos(turn) * of_w[:, None]
    for side in (-1, 1):
        # swt begins like a root at the circle through the centre, and in the depth.
        for share, weight in zip(u, of_u * 2 * u, strict=True):
            r = abs(x) + side * distance * share**2
            if r <= 0.0:
                raise ValueError("the half sphere holds the axis")
            most = np.arccos(1 - (distance**2 - (r - abs(x)) ** 2) / (2 * abs(x) * r))
            deepest = np.sqrt(distance**2 - r**2 - x**2 + 2 * r * abs(x) * np.cos(most * angle))
            z = deepest * v**2
            weights = weight * most * r * of_angle * deepest * 2 * v * of_v
            place = np.copysign(1.0, x) * r * np.cos(most * angle + 0 * v), r * np.sin(most * angle + 0 * v)
            places = np.stack([v.ravel() for v in (*place, z)], axis=1)
            swt = criterion_at(opened, places, OTHER_TOLERANCE)[0].reshape(z.shape)
            total, volume = total + (weights * swt).sum(), volume + weights.sum()
    return float(total / volume)


def against_other(profile: str, count: int) -> list[str]:
    """Lines of the table of the other rule."""
    lines = []
    for point, distance in islice(random_points(profile), count):
        _, x, angle, _ = place_of(point)
        distance = min(distance, 0.6 * abs(float(x[0])))
        found = nonlocal_swt.nonlocal_swt(point, x, angle, np.array([distance]))
        other = other_mean(point, float(x[0]), distance)
        value, error = float(found.volume[0, 0]), float(found.volume_error[0, 0])
        load = f"δA/δ0 = {point.normal_amplitude[0]:.2f}, U = {point.tangential_amplitude[0]:.2f}"
        load += ", bulk stress" if point.bulk_stress_amplitude[0] else ""
        cells = f"{value:.6f} | {other:.6f} | {value / other - 1.0:+.0e} | {error / value:.0e}"
        lines.append(f"| {profile}, {load} | {distance:.3f} | {cells} |")
    return lines


def falling(profile: str) -> str:
    """Line of the table of distances that fall."""
    point, _ = next(random_points(profile))
    *at, s = place_of(point)
    found = nonlocal_swt.nonlocal_swt(*at, np.array([1e-8, 1e-6, 1e-4, 1e-2]))
    return f"| {profile} | " + " | ".join(f"{v:.5f}" for v in found.volume[0] / s[0]) + " |"


def table(header: str, lines: list[str]) -> str:
    """A table in Markdown, printed."""
    columns = header.count("|") - 1
    text = "\n".join([header, "|" + "---|" * columns, *lines]) + "\n"
    print(text, flush=True)
    return text


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the tables")
    arguments.add_argument("--points", type=int, default=20, help="random points of each profile")
    arguments.add_argument("--quick", action="store_true", help="one point of the paraboloid")
    given = arguments.parse_args()
    scenes, phases, profiles = SCENES, len(PHASES), list(SHAPES)
    count, others = given.points, 2
    if given.quick:
        scenes, phases, profiles, count, others = SCENES[:1], 1, profiles[:1], 1, 1
    text = f"# Nonlocal means\n\nProcessor time a point, the least of {RUNS} runs, with all three means, "
    text += "ℓ = 0.1 a_H or eleven distances up to that, and the largest relative error claimed of the "
    text += "volume mean.\n\n"
    text += table(
        "| scene | one distance | eleven | error claimed |", [times(scene, phases) for scene in scenes]
    )
    text += "\nRandom points against the same with many more places and instants: what they are off, and how "
    text += "many are off more than they claim.\n\n"
    rows = [row for profile in profiles for row in sweep(profile, count)]
    text += table("| profile | mean | points | median off | largest | median claimed | more |", rows)
    text += "\nMeans over half spheres against another rule (" + " × ".join(map(str, OTHER)) + " places on "
    text += "either side), whose field has instants common to all places of a circle.\n\n"
    rows = [row for profile in profiles for row in against_other(profile, others)]
    text += table("| scene | ℓ/a_H | mean | other rule | off | claimed |", rows)
    text += "\nMean over the half sphere, over s, as ℓ falls; beside the edge of a truncated paraboloid's "
    text += "face, and where a plane that does not hold y is the critical one, the limit is another.\n\n"
    text += table("| profile | 1e-8 | 1e-6 | 1e-4 | 1e-2 |", [falling(profile) for profile in profiles])
    given.results.mkdir(exist_ok=True)
    (given.results / "nonlocal_means.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
