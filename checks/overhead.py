"""What the runner costs for each point at the default chunking, beside a solver that takes 7 ms a point.

python checks/overhead.py > results/overhead.txt
"""

from __future__ import annotations

import sys
import tempfile
import time
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from cheap import busy, cheap

from swtstudy import Study, run

SECONDS = 0.007
STUDY = """
title = "Overhead"
rtol = 1e-2
[axes]
friction = {start = "0.01", stop = 1, num = %d}
phase = {start = 0, stop = 3, num = 64}
"""


def timed(count: int, solver) -> tuple[float, float, float]:
    """Wall time of a run of 64 `count` points, the computing time of its workers, the parent's CPU time."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        cpu = time.process_time()
        dataset = run(Study.from_text(STUDY % count), Path(folder) / "overhead.nc", solver=solver)
        wall, cpu = time.perf_counter() - begin, time.process_time() - cpu
        return wall, dataset.attrs["computing_time_seconds"], cpu


def main() -> None:
    timed(16, cheap)  # imports
    small, large = (timed(count, partial(busy, SECONDS)) for count in (16, 320))
    points = 64 * (320 - 16)
    # Differences of two runs: the start of the workers is in both.
    wall, computing, cpu = (b - a for a, b in zip(small, large, strict=True))
    print(f"{points} points more: {wall:.2f} s more on 2 workers, which compute for {computing:.2f} s")
    print(f"workers wait for   {1e6 * (wall - computing / 2) / points:4.0f} µs of wall time a point")
    print(f"the parent takes   {1e6 * cpu / points:4.0f} µs of a core a point")


if __name__ == "__main__":
    main()
