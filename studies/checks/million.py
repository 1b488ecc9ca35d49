"""Memory and overhead of the runner for a study of 10⁶ distinct points, with a solver that costs nothing.

python studies/checks/million.py > results/million.txt
"""

from __future__ import annotations

import argparse
import resource
import tempfile
import time
from pathlib import Path

from cheap import cheap

from swtstudy import Study, run

STUDY = """
title = "A million points"
rtol = 1e-2
[axes]
poisson_ratio = {start = 0, stop = 0.5, num = %d}
normal_amplitude = {start = "0.1", stop = 1, num = 10}
friction = {start = "0.01", stop = 1, num = 100}
phase = {start = 0, stop = 3, num = 100}
"""


def megabytes() -> float:
    """Largest resident memory of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="10⁴ points alone, to see that it runs")
    quick = arguments.parse_args().quick
    print("points      wall   per point   parent at most   archive")
    for count in (0.1,) if quick else (1, 3, 10, 30):
        study = Study.from_text(STUDY.replace("num = %d", f"num = {count}") if count > 1 else one(count))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "million.nc"
            begin = time.perf_counter()
            dataset = run(study, path, solver=cheap)
            seconds = time.perf_counter() - begin
            assert not dataset.s.isnull().any()
            print(
                f"{dataset.s.size:<9} {seconds:5.1f} s {1e6 * seconds / dataset.s.size:8.1f} µs"
                f" {megabytes():11.0f} MB"
                f" {path.stat().st_size / 2**20:9.1f} MB",
                flush=True,
            )


def one(share: float) -> str:
    """A study with a single Poisson ratio, and with a share of the phases."""
    text = STUDY.replace("poisson_ratio = {start = 0, stop = 0.5, num = %d}", "poisson_ratio = [0.3]")
    return text.replace("stop = 3, num = 100", f"stop = 3, num = {round(100 * share)}")


if __name__ == "__main__":
    main()
