"""Cost of a value of a cylinder, compared with a paraboloid under the same forces.

python studies/checks/plane_cost.py > results/plane_cost.txt
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace

import numpy as np

from swtstudy.solver.points import Points, solve_points
from swtstudy.vocabulary.parameters import Control

POINTS, ROUNDS, RTOLS = 100, 5, (1e-4, 1e-6)


def forces(count: int) -> Points:
    """Random forces that friction bears, whatever the phase."""
    rng = np.random.default_rng(1)
    normal, one = rng.uniform(0.0, 0.9, count), np.ones(count, dtype=int)
    return Points(
        "paraboloid",
        rng.uniform(0.0, 0.5, count),
        rng.uniform(0.05, 1.0, count),
        normal,
        one,
        rng.integers(1, 3, count),
        rng.uniform(0.05, 1.0, count) * (1.0 - normal),
        rng.uniform(0.0, 2.0 * np.pi, count),
        {},
        control=Control(True, True),
    )


def seconds(points: Points, rtol: float) -> float:
    """Processor time of one call."""
    begin = time.process_time()
    solve_points(points, rtol)
    return time.process_time() - begin


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    quick = arguments.parse_args().quick
    count, rounds = (4, 1) if quick else (POINTS, ROUNDS)
    disc = forces(count)
    print(f"processor time over that of the paraboloid, {count} points in a call, median of {rounds} pairs:")
    strip = replace(disc, profile="cylinder")
    seconds(strip, RTOLS[0])  # what is made once
    for rtol in RTOLS:
        pairs = [(seconds(strip, rtol), seconds(disc, rtol)) for _ in range(rounds)]
        ratio = float(np.median([one / other for one, other in pairs]))
        each = 1e3 * min(one for one, _ in pairs) / count
        print(f"cylinder      rtol {rtol:g}: {ratio:.2f}, {each:.2f} ms a value", flush=True)


if __name__ == "__main__":
    main()
