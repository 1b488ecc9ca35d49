"""Processor time that the runner takes for a point beside the solver, on two threads.

The solver costs nothing: all that is measured, from the first chunk to the archive, is the runner's own.

python studies/checks/overhead.py > results/overhead.txt
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from pathlib import Path

from cheap import cheap

from swtstudy import Study, run

STUDY = """
title = "Overhead"
rtol = 1e-2
[axes]
friction = {start = "0.01", stop = 1, num = %d}
phase = {start = 0, stop = 3, num = 100}
"""


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    count = 10 if arguments.parse_args().quick else 1000
    print(f"load of the {os.cpu_count()} cores before: {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as folder:
        run(Study.from_text(STUDY % 2), Path(folder) / "first.nc", solver=cheap)  # imports
        begin, used = time.perf_counter(), time.process_time()
        dataset = run(Study.from_text(STUDY % count), Path(folder) / "overhead.nc", solver=cheap)
        wall, used, points = time.perf_counter() - begin, time.process_time() - used, dataset.s.size
    print(f"{points} points with a solver that costs nothing, on 2 threads:")
    print(f"  the runner takes {1e6 * used / points:.0f} µs of processor time a point")
    print(f"  and {1e6 * wall / points:.0f} µs of wall time, writing of the archive included")


if __name__ == "__main__":
    main()
