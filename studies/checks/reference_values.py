"""Values of s that the tests hold s and s_error against, at random points of the box and of the ranges' ends.

``python studies/checks/reference_values.py``, from the project's folder, writes results/reference_values.csv:
s at the tightest tolerance, or what a dense look (`swtstudy.paper.maxima`) finds, if that is more. Both
share the stress history, but neither the choice of instants, positions and planes nor how one is improved.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from accuracy import REFERENCE_RTOL, SHAPES, points_at_ends, random_points

from swtstudy.paper.maxima import dense_maximum
from swtstudy.solver.points import Points, solve_points

COUNT, SEED = 15, 7
NUMBERS = ("poisson_ratio", "friction", "normal_amplitude", "p", "q", "tangential_amplitude", "phase")
SHAPE_COLUMNS = ("flat_radius", "waviness_amplitude", "wavelength", "exponent")
#: Dense grid: steps of each piece between two cusps, and planes.
STEPS, PLANES = 100, 72


def rows(profile: str, points: Points) -> Iterator[list[str]]:
    """Lines of the table for the points of one profile at which s is positive."""
    tight = solve_points(points, REFERENCE_RTOL)
    for k in np.flatnonzero(tight.s > 0.0):
        one = points[[k]]
        dense, _ = dense_maximum(one, STEPS, PLANES)
        more = dense > tight.s[k] + 2.0 * tight.s_error[k]
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
    given.results.mkdir(parents=True, exist_ok=True)
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
