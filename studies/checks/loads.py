"""How s of a sampled cycle approaches s of the harmonic cycle, and what other loads cost.

``python studies/checks/loads.py`` writes results/loads.png: s of polygons of 16 to 512 vertices on the
harmonic cycle over s of the cycle itself, with 1/k, at Table 1 and at random amplitudes and frictions; and
results/loads.md: the same as numbers, and processor times of prescribed forces, mixed control and polygons
over the time of two harmonic displacements, in batches: medians of paired ratios. s of the polygon converges
like 1/k at some points, to either side, with where the vertices are beside the turning points of the cycle:
what is lost of an amplitude is like 1/k², and stress is like the root of the distance from an edge.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swtstudy.figures.sheet import Sheet, add_legend
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, stroke, styled
from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.points import Points, solve_points
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]

COUNTS = (16, 32, 64, 128, 256, 512)
#: Profiles and their shapes, ω2/ω1 as (p, q), and ψ of the cycles that are sampled.
SHAPES: dict[str, dict[str, float]] = {"paraboloid": {}, "rounded_punch": {"flat_radius": 0.5}}
RATIOS, PHASES = ((1, 1), (1, 2)), (0.0, 0.7, 2.5)
#: Points of each, and relative tolerance of the convergence.
POINTS, RTOL = 3, 1e-6
#: Points of a batch that is timed, at the amplitudes 0.4 and 0.35, and pairs of runs.
BATCH, PAIRS = 24, 3
SIDES = (8, 200)
SEED = 3


def cycles(profile: str, ratio: tuple[int, int], phase: float, count: int) -> Points:
    """Random amplitudes and frictions; no two have the same load."""
    rng = np.random.default_rng(SEED)
    normal, tangential, friction = rng.uniform([[0.1], [0.1], [0.1]], [[0.9], [1.0], [0.9]], (3, count))
    whole, one = np.ones(count, dtype=int), np.ones(count)
    shape = {name: value * one for name, value in SHAPES[profile].items()}
    p, q = ratio
    return Points(profile, 0.3 * one, friction, normal, p * whole, q * whole, tangential, phase * one, shape)


def sampled(points: Points, vertices: int) -> Points:
    """The same points, of one phase and frequency ratio, on polygons inscribed in their cycles."""
    p, q, phase = int(points.p[0]), int(points.q[0]), float(points.phase[0])
    # The offset keeps vertices off the turning points, which are what counts most.
    angle = 2.0 * np.pi * (np.arange(vertices) + 0.3) / vertices
    path = LoadPath("sampled", np.stack([np.sin(q * angle + phase), np.sin(p * angle)], axis=1))
    one = np.ones_like(points.p)
    return Points(**{**vars(points), "p": one, "q": one, "phase": 0.0 * points.phase, "path": path})


def convergence(counts: tuple[int, ...], phases: tuple[float, ...], size: int) -> dict[str, Array]:
    """Relative differences of s by profile and ratio, shape (counts, points)."""
    table_1 = [cycles("paraboloid", (1, 1), phase, 1) for phase in phases]
    for points in table_1:
        points.normal_amplitude[:], points.tangential_amplitude[:], points.friction[:] = 0.75, 5 / 6, 0.3
    found = {"Table 1": np.concatenate([differences(points, counts) for points in table_1], axis=1)}
    for profile in SHAPES:
        for ratio in RATIOS:
            columns = [differences(cycles(profile, ratio, phase, size), counts) for phase in phases]
            name = f"{profile.replace('_', ' ')}, ω2/ω1 = {ratio[0]}/{ratio[1]}"
            found[name] = np.concatenate(columns, axis=1)
    return found


def differences(points: Points, counts: tuple[int, ...]) -> Array:
    """Relative differences of s on polygons with so many vertices, shape (counts, points)."""
    exact = solve_points(points, RTOL).s
    return np.abs([solve_points(sampled(points, k), RTOL).s / exact - 1.0 for k in counts])


def paired(call: Callable[[], object], base: Callable[[], object], pairs: int) -> tuple[float, float]:
    """Median of the processor time over the time of the base, and the median time, s."""
    times = np.array([[_seconds(each) for each in (call, base)] for _ in range(pairs)])
    return float(np.median(times[:, 0] / times[:, 1])), float(np.median(times[:, 0]))


def _seconds(call: Callable[[], object]) -> float:
    begin = time.process_time()
    call()
    return time.process_time() - begin


def costs(batch: int, pairs: int) -> list[str]:
    """Lines of the table of costs."""
    points = cycles("paraboloid", (1, 1), 0.7, batch)
    rng = np.random.default_rng(SEED)
    own = {"phase": rng.uniform(0.0, np.pi, batch), "normal_amplitude": np.full(batch, 0.4)}
    phases = Points(**{**vars(points), **own, "tangential_amplitude": np.full(batch, 0.35)})

    def controlled(control: Control) -> Points:
        return Points(**{**vars(phases), "control": control})

    cases = {
        "both forces": (controlled(Control(True, True)), phases),
        "normal force, tangential displacement": (controlled(Control(True, False)), phases),
        "normal displacement, tangential force": (controlled(Control(False, True)), phases),
        **{f"polygon of {sides} vertices": (sampled(points, sides), points) for sides in SIDES},
    }
    lines = []
    for name, (case, base) in cases.items():
        ratio, seconds = paired(lambda: solve_points(case), lambda: solve_points(base), pairs)  # noqa: B023
        lines.append(f"| {name} | {ratio:.2f} | {1e3 * seconds / batch:.1f} ms |")
        print(lines[-1], flush=True)
    return lines


def draw(found: dict[str, Array], counts: tuple[int, ...], path: Path) -> None:
    """Median and largest differences over the number of vertices, a panel for each."""
    k = np.array(counts)
    with styled(width="page"):
        sheet = Sheet(1, 2, "page", least_height=3.0)
        figure = sheet.figure()
        panels = sheet.panels(figure)
        for axes, title, of in zip(
            panels[0], ("(A)  median", "(B)  largest"), (np.median, np.max), strict=True
        ):
            for color, marker, (name, off) in zip(COLOURS, MARKERS[1:], found.items(), strict=False):
                label = name.replace("ω2/ω1", r"$\omega_2/\omega_1$")
                axes.loglog(k, of(off, axis=1), color=color, marker=marker, linestyle="-", label=label)
            axes.loglog(k, 1.0 / k, **stroke("0.4", "--"), label="$1/k$")
            axes.loglog(k, 1.0 / k**2, **stroke("0.4", ":"), label="$1/k^2$")
            axes.set(xlabel="vertices $k$ of the polygon", title=title)
            axes.set_xticks(counts, map(str, counts))
            axes.minorticks_off()
        panels[0, 0].set_ylabel("relative difference of $s$")
        add_legend(figure)
    save_figure(figure, path)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for table and chart")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    counts, phases, size = (COUNTS[:2], PHASES[1:2], 2) if given.quick else (COUNTS, PHASES, POINTS)
    found = convergence(counts, phases, size)
    lines = [
        f"| {name} | "
        + " | ".join(f"{k * k * worst:.1f}" for k, worst in zip(counts, off, strict=True))
        + " |"
        for name, off in ((name, off.max(axis=1)) for name, off in found.items())
    ]
    print("\n".join(lines), flush=True)
    heads = " | ".join(f"k = {k}" for k in counts)
    first = f"| cycle | {heads} |\n|{'---|' * (len(counts) + 1)}\n" + "\n".join(lines)
    second = "| prescribed | time | of a value |\n|---|---|---|\n" + "\n".join(
        costs(*((2, 1) if given.quick else (BATCH, PAIRS)))
    )
    text = (
        "# Loads\n\nLargest relative difference between s of a polygon of k vertices on the harmonic cycle "
        f"and s of the cycle, times k²:\n\n{first}\n\nProcessor time over that of two harmonic displacements "
        f"with ω2 = ω1, and that of a value, in batches of {BATCH}:\n\n{second}\n"
    )
    given.results.mkdir(exist_ok=True)
    (given.results / "loads.md").write_text(text, encoding="utf-8")
    draw(found, counts, given.results / "loads.png")


if __name__ == "__main__":
    main()
