"""Does the compiled kernel pass its gate? Values, times, compilation and size, in one table.

``python studies/checks/kernel_gate.py [--every K] [--quick] [--results FOLDER]`` writes kernel_gate.md: the
recorded values of ``tests/data/truth`` in the kernel's scope, or each K-th of them, and Figures 3 to 8 of the
paper by both solvers in one process. With ``--quick`` a few values and Figure 3 alone.
"""

from __future__ import annotations

import argparse
import io
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import redirect_stdout
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from house import counts

import swtstudy
from swtstudy.kernel.batch import solve_batch
from swtstudy.mechanics import solve_points
from swtstudy.mechanics.points import Points
from swtstudy.points.unique import unique_points

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import truth  # noqa: E402

PROFILES = ("paraboloid", "rounded_punch", "truncated_paraboloid", "wavy_paraboloid")
SHAPES = ("flat_radius", "waviness_amplitude", "wavelength")
FIGURES = tuple(f"figure{k}" for k in range(3, 9))
FIRST_VALUE = (
    "from swtstudy.kernel.batch import solve_batch;"
    "solve_batch('paraboloid', [0.3], [0.3], [0.75], [5 / 6], [1], [0.0])"
)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--every", type=int, default=1, help="each K-th recorded value")
    arguments.add_argument("--quick", action="store_true", help="few values, and Figure 3 alone")
    arguments.add_argument("--results", type=Path, default=ROOT / "results")
    given = arguments.parse_args()
    every = 2000 if given.quick else given.every
    report = io.StringIO()
    with redirect_stdout(report):
        print("# The gate of the compiled kernel\n\n`studies/checks/kernel_gate.py`", end="")
        print(f" with `--every {every}`\n" if every > 1 else "\n")
        values(every)
        times(FIGURES[:1] if given.quick else FIGURES)
        compilation()
    (given.results / "kernel_gate.md").write_text(report.getvalue(), encoding="utf-8")
    print(report.getvalue(), end="")


def head(*columns: str) -> None:
    """Print the head of a table."""
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")


def values(every: int) -> None:
    """Print how many recorded values are missed by more than s_error."""
    head("recorded values", "points", "low at 1e-4", "high at 1e-4", "low at 1e-6", "high at 1e-6")
    for scene, points in truth.points().items():
        known = [point for point in points if in_scope(point)][::every]
        if known:
            misses = [f"{low} | {high}" for low, high in (missed(known, rtol) for rtol in (1e-4, 1e-6))]
            print(f"| {scene} | {len(known)} | {misses[0]} | {misses[1]} |", flush=True)
    print()


def in_scope(point: truth.Point) -> bool:
    """Whether the kernel knows the load, the profile and the criterion of a recorded point."""
    given = point.arguments
    forces = "tangential_force_amplitude" in given
    same_kind = forces == ("normal_force_amplitude" in given)
    others = {"bulk_stress_amplitude", "bulk_stress_mean", "walker_exponent", "criterion"} & set(given)
    known = given.get("profile", "paraboloid") in PROFILES and np.isfinite(point.s)
    return bool(known and same_kind and not others and point.s > 0.0 and point.error < 0.01 * point.s)


def missed(points: list[truth.Point], rtol: float) -> tuple[int, int]:
    """Number of points whose s is below and above the recorded value by more than both errors."""
    low = high = 0
    for point in points:
        found = solve_one(point, rtol)
        allowed = found["s_error"] + point.error
        low += bool(found["s"] < point.s - allowed)
        high += bool(found["s"] > point.s + allowed) and point.kind == "value"
    return low, high


def solve_one(point: truth.Point, rtol: float) -> np.void:
    """The kernel's result at a recorded point."""
    given = point.arguments
    forces = "tangential_force_amplitude" in given
    kind = "_force" if forces else ""
    normal, tangential = (given[f"{which}{kind}_amplitude"] for which in ("normal", "tangential"))
    load: dict[str, object] = {"normal_amplitude": [normal], "tangential_amplitude": [tangential]}
    if "load" in given:
        load["loops"] = [given["load"]]
    else:
        load |= {"frequency_ratio": [given.get("frequency_ratio", 1)], "phase": [given.get("phase", 0.0)]}
    shape = {name: [given[name]] for name in SHAPES if name in given}
    body = given["poisson_ratio"], given["friction"]
    name = given.get("profile", "paraboloid")
    control = forces, forces
    return solve_batch(name, *([x] for x in body), shape=shape, control=control, rtol=rtol, **load)[0]


def times(figures: tuple[str, ...]) -> None:
    """Print process times of both solvers, and of the dearest point."""
    head("processor time", "points", "solver 22, s", "kernel, s", "share", "largest deviation")
    swtstudy.solve()
    kernel_batch(next(batches("figure3")))
    whole = np.zeros(2)
    dearest = 0.0
    for figure in figures:
        several = list(batches(figure))
        begin = process_time()
        old = [solve_points(points, 1e-4).s for points in several]
        middle = process_time()
        new = [kernel_batch(points)["s"] for points in several]
        taken = np.array([middle - begin, process_time() - middle])
        whole += taken
        deviation = max(float(np.abs(b / a - 1.0).max()) for a, b in zip(old, new, strict=True))
        count = sum(len(points) for points in several)
        share = f"{taken[0]:.2f} | {taken[1]:.2f} | {taken[1] / taken[0]:.2f}"
        print(f"| {figure} | {count} | {share} | {deviation:.0e} |", flush=True)
        some = (points.take([k]) for points in several for k in range(0, len(points), 8))
        dearest = max(dearest, *map(one_point, some))
    print(f"| together | | {whole[0]:.2f} | {whole[1]:.2f} | {whole[1] / whole[0]:.2f} | |\n")
    table_1 = one_point(next(batches("figure3")).take([0]))
    head("a point alone, profile data included", "ms")
    print(f"| Table 1 at ψ = 0 | {1e3 * table_1:.2f} |")
    print(f"| dearest of each eighth point of the figures | {1e3 * dearest:.1f} |\n")


def batches(figure: str) -> Iterator[Points]:
    """The points behind a figure, as today's solver gets them."""
    study = swtstudy.Study.from_toml(ROOT / "studies" / f"{figure}.toml")
    yield from unique_points(study.grid).batches


def kernel_batch(points: Points) -> np.ndarray:
    """The kernel's results at a batch of today's solver."""
    ratio = [f"{p}/{q}" for p, q in zip(points.p, points.q, strict=True)]
    load = points.normal_amplitude, points.tangential_amplitude, ratio, points.phase
    return solve_batch(str(points.profile), points.poisson_ratio, points.friction, *load, shape=points.shape)


def one_point(points: Points) -> float:
    """Shortest of three wall times of a point alone."""
    taken = []
    for _ in range(3):
        begin = perf_counter()
        kernel_batch(points)
        taken.append(perf_counter() - begin)
    return min(taken)


def compilation() -> None:
    """Print processor time of the first value with an empty cache and with a warm one, and the code lines."""
    with tempfile.TemporaryDirectory() as cache:
        environment = os.environ | {"NUMBA_CACHE_DIR": cache}
        cold, warm = (first_value(environment) for _ in range(2))
    lines = sum((counts(path)["code lines"] for path in (ROOT / "swtstudy" / "kernel").glob("*.py")), 0)
    head("first value of a process", "processor time, s")
    print(f"| with an empty cache | {cold:.1f} |\n| with a warm one | {warm:.1f} |\n")
    print(f"Code lines of the kernel: {lines:,}")


def first_value(environment: dict[str, str]) -> float:
    """Processor time of a process that computes one value, s."""
    before = os.times()
    subprocess.run([sys.executable, "-c", FIRST_VALUE], check=True, cwd=ROOT, env=environment)
    after = os.times()
    return (after.children_user - before.children_user) + (after.children_system - before.children_system)


if __name__ == "__main__":
    main()
