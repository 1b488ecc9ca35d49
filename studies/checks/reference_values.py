"""Values of s that the tests hold s and s_error against, at random points of the box and of the ranges' ends.

``python studies/checks/reference_values.py``, from the project's folder, writes results/reference_values.csv:
s at the tightest tolerance, or what a dense search over x and all planes finds, if that is more. Both share
the stress history, but neither the choice of instants, positions and planes nor how one is improved.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))

from accuracy import REFERENCE_RTOL, SHAPES, points_at_ends, random_points

from swtstudy.mechanics import Points, solve_points
from swtstudy.mechanics.line.look import Look, lifted
from swtstudy.mechanics.line.positions import cusps
from swtstudy.mechanics.planes.criterion import curves, of_maxima
from swtstudy.mechanics.stress.scene import Scene, scene_of

COUNT, SEED = 15, 7
NUMBERS = ("poisson_ratio", "friction", "normal_amplitude", "p", "q", "tangential_amplitude", "phase")
SHAPE_COLUMNS = ("flat_radius", "waviness_amplitude", "wavelength", "exponent")
DIGITS = 10.0
#: Steps of a stretch, positions and planes of the first look; how many of its maxima are looked at closer.
STEPS, POSITIONS, PLANES, KEPT = 6, 240, 72, 6
CLOSER_STEPS, CLOSER, ROUNDS = 32, 9, 10

Array = NDArray[np.float64]


def swt(scene: Scene, r: Array, side: float, double_angle: Array, steps: int) -> Array:
    """swt at r (X,) on all planes (A,), shape (A, X)."""
    look = Look.at(scene, r[None], steps, DIGITS)
    planes = scene.planes(look.history, side)
    table = []
    for angle in double_angle:
        of_swt = curves(*planes.on_plane(np.full((1, r.size), angle)))
        table.append(of_maxima(*(lifted(curve, look.inside).max(axis=-1) for curve in of_swt))[0])
    return np.array(table)


def dense_search(scene: Scene) -> float:
    """The largest swt of a dense search over x and 2θ."""
    ends = np.unique(cusps(scene.cycle, scene.coordinate)[0])
    ends = ends[np.append(True, np.diff(ends) > 1e-13)]
    count = max(POSITIONS // (ends.size - 1), 12)
    share = 0.5 - 0.5 * np.cos(np.pi * np.arange(count + 1) / count)
    r = np.unique(np.append(ends[:-1, None] + np.diff(ends)[:, None] * share, ends))
    angle = 2.0 * np.pi * np.arange(PLANES) / PLANES
    found = []
    for side in (1.0, -1.0):
        table = np.hstack(
            [swt(scene, part, side, angle, STEPS) for part in np.array_split(r, r.size // 60 + 1)]
        )
        framed = np.pad(np.vstack([table[-1:], table, table[:1]]), ((0, 0), (1, 1)), constant_values=-1.0)
        around = np.lib.stride_tricks.sliding_window_view(framed, (3, 3)).max(axis=(2, 3))
        found += [(table[at], side, *at) for at in zip(*np.nonzero(table >= around), strict=True)]
    found.sort(reverse=True)
    close = [one for one in found if one[0] >= 0.98 * found[0][0]][:KEPT]
    return max(_closer(scene, r, side, angle[plane], column) for _, side, plane, column in close)


def _closer(scene: Scene, r: Array, side: float, angle: float, column: int) -> float:
    """The largest swt near a position and a plane, on ever smaller grids."""
    best, centre, turn = 0.0, r[column], 2.0 * np.pi / PLANES
    widths = np.array([r[max(column - 1, 0)], r[min(column + 1, r.size - 1)]]) - centre
    for _ in range(ROUNDS):
        steps = np.linspace(0.0, 1.0, CLOSER // 2 + 1)
        places = np.unique(np.clip(centre + np.outer(widths, steps), r[0], r[-1]))
        angles = angle + turn * np.linspace(-1.0, 1.0, CLOSER)
        table = swt(scene, places, side, angles, CLOSER_STEPS)
        plane, place = np.unravel_index(table.argmax(), table.shape)
        best, centre, angle = max(best, table.max()), places[place], angles[plane]
        widths = widths * (1.0 if place in (0, places.size - 1) else 0.35)
        turn *= 0.35 if 0 < plane < CLOSER - 1 else 1.0
    return float(best)


def rows(profile: str, points: Points) -> Iterator[list[str]]:
    """Lines of the table for the points of one profile at which s is positive."""
    tight = solve_points(points, REFERENCE_RTOL)
    for k in np.flatnonzero(tight.s > 0.0):
        one = points.take(np.array([k]))
        dense = dense_search(scene_of(one).split_at_breakpoints())
        # The parabolas of the dense search overshoot by 3e-6.
        more = dense > tight.s[k] * (1.0 + 5e-6) + 2.0 * tight.s_error[k]
        if more or dense < tight.s[k] * (1.0 - 1e-4):
            print(f"{profile} {k}: {tight.s[k]:.10g} at the tightest, {dense / tight.s[k] - 1.0:+.1e}")
        shape = [repr(one.shape[name].item()) if name in one.shape else "" for name in SHAPE_COLUMNS]
        values = [repr(getattr(one, name).item()) for name in NUMBERS]
        s = dense if more else float(tight.s[k])
        yield [profile, *values, *shape, f"{s:.12g}", f"{tight.s_error[k]:.1e}"]


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="one point, to see that it runs")
    given = arguments.parse_args()
    count, profiles = (1, [*SHAPES][:1]) if given.quick else (COUNT, [*SHAPES])
    draws = [random_points, lambda *of: points_at_ends(*of, largest_term=4)][: 1 if given.quick else None]
    with (given.results / "reference_values.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["profile", *NUMBERS, *SHAPE_COLUMNS, "s", "s_error"])
        for profile in profiles:
            for draw in draws:
                table.writerows(rows(profile, draw(profile, count, SEED)))


if __name__ == "__main__":
    main()
