"""The methods that the chart compares: each gives a curve of (resolution, s, processor seconds per value)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from half_space import half_space_s
from plane_loop import plane_loop_s
from scenes import Scene
from textbook import textbook_s

from swtstudy.solver.points import solve_points

RTOLS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
#: Time steps of a textbook run; springs, positions and planes grow with them.
GRIDS = (30, 60, 120, 240, 480, 960)
#: Grid points of the half-space along each side, and plane steps in degrees.
SIDES, PLANE_STEPS = (32, 64, 128, 256, 512), (20, 10, 5, 2)
#: A curve ends with the first value that took longer, in seconds.
PATIENCE = 15.0
REPEATS = 3


class Sample(NamedTuple):
    """One marker of the chart."""

    resolution: str
    s: float
    seconds: float


def timed(call: Callable[[], float], values: int = 1) -> tuple[float, float]:
    """The result of a call, and its median processor time per value, s; slow calls are made once."""
    times: list[float] = []
    while len(times) < REPEATS and sum(times) < PATIENCE / REPEATS:
        begin = time.process_time()
        result = call()
        times.append(time.process_time() - begin)
    return result, float(np.median(times)) / values


def until_patience_ends(samples: Iterator[Sample]) -> list[Sample]:
    kept = []
    for sample in samples:
        kept.append(sample)
        if sample.seconds > PATIENCE:
            break
    return kept


def this_solver(scene: Scene) -> Iterator[Sample]:
    batch = scene.batch()
    for rtol in RTOLS:
        s, seconds = timed(lambda rtol=rtol: float(solve_points(batch, rtol).s[0]), len(batch))
        yield Sample(f"rtol {rtol:.0e}", s, seconds)


def this_solver_alone(scene: Scene) -> Iterator[Sample]:
    for rtol in RTOLS:
        yield Sample(
            f"rtol {rtol:.0e}", *timed(lambda rtol=rtol: float(solve_points(scene.point, rtol).s[0]))
        )


def _textbook(scene: Scene, aligned: bool) -> Iterator[Sample]:
    for n in GRIDS:
        grid = {"springs": 2 * n, "steps": n, "positions": n // 2, "planes": max(n // 2, 36)}
        s, seconds = timed(lambda grid=grid: textbook_s(scene.point, **grid, aligned=aligned).s)
        yield Sample(f"{n} instants", s, seconds)


def textbook(scene: Scene) -> Iterator[Sample]:
    return _textbook(scene, aligned=False)


def textbook_aligned(scene: Scene) -> Iterator[Sample]:
    return _textbook(scene, aligned=True)


def half_space(scene: Scene) -> Iterator[Sample]:
    for side in SIDES:
        s, seconds = timed(lambda side=side: half_space_s(scene.point, side))
        yield Sample(f"{side}² grid", s, seconds)


def plane_loop(scene: Scene) -> Iterator[Sample]:
    x = float(solve_points(scene.point, 1e-8).critical_x[0])
    for step in PLANE_STEPS:
        yield Sample(f"{step}° planes", *timed(lambda step=step: plane_loop_s(scene.point, x, step)))


METHODS: dict[str, Callable[[Scene], Iterator[Sample]]] = {
    "this solver, in batches of 64": this_solver,
    "this solver, one point alone": this_solver_alone,
    "textbook, fixed grids": textbook,
    "textbook, aligned instants": textbook_aligned,
    "FFT half-space (tamaas), same contact": half_space,
    "plane loop in Python, at the critical point": plane_loop,
}
