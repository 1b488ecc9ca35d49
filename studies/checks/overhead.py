"""Overhead of the runner per point with the default chunks, measured with solvers of known cost.

Two runs on 2 workers:

* the solver sleeps 7 ms per point: how long each worker is idle between its first and its last block, for
  whatever reason, and the CPU time of the parent;
* the solver keeps a core busy for 3 ms of CPU time per point: the CPU time of parent and workers beyond that,
  from the first result delivered to the last. Other load on the machine hardly matters here.

python studies/checks/overhead.py > results/overhead.txt
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import tempfile
import time
from functools import partial
from pathlib import Path

import numpy as np
from cheap import asleep, spinning

from swtstudy import Study, run
from swtstudy.runner import collector
from swtstudy.runner.chunk import Solver
from swtstudy.runner.collector import ProgressBar

WORKERS = 2

#: A longer wait for the next block, in seconds, is a stall of the machine; stalls are counted and reported.
STALL = 0.05

SLEEP, SPIN = 7e-3, 3e-3
#: Long cycles give small blocks, so that chunks are cut by time.
STUDY = """
title = "Overhead"
rtol = 1e-2
[fixed]
frequency_ratio = "1/15"
[axes]
friction = {start = "0.01", stop = 1, num = %d}
phase = {start = 0, stop = 3, num = 64}
"""


def cpu_of(process: int) -> float:
    """CPU time of a process, s."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Watched(ProgressBar):
    """Notes points, wall time, and the CPU time of parent and workers at the first and last delivery."""

    notes: list[tuple[float, ...]] = []  # noqa: RUF012
    chunks = 0

    def add(self, points: int) -> None:
        super().add(points)
        self.chunks += 1
        if self.chunks > 1 and self.done < self.total:
            return
        children = multiprocessing.active_children()
        workers = sum(cpu_of(child.pid) for child in children if child.pid)
        self.notes.append((self.chunks, self.done, time.perf_counter(), time.process_time(), workers))


def measured(count: int, solver: Solver) -> tuple[float, ...]:
    """Points, wall time, CPU time of the parent and of the workers, from the first delivery to the last."""
    Watched.notes.clear()
    with tempfile.TemporaryDirectory() as folder:
        run(Study.from_text(STUDY % count), Path(folder) / "overhead.nc", solver=solver, workers=WORKERS)
    chunks, *rest = np.diff(Watched.notes, axis=0)[0]
    print(f"  {chunks:.0f} chunks of {rest[0] / chunks:.0f} points on average")
    return tuple(rest)


def waits(log: Path) -> np.ndarray:
    """Seconds between the end of each block and the beginning of the same worker's next one."""
    table = np.loadtxt(log)
    of_worker = [table[table[:, 0] == worker] for worker in np.unique(table[:, 0])]
    return np.concatenate([rows[1:, 1] - rows[:-1, 2] for rows in of_worker])


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    quick = arguments.parse_args().quick
    collector.ProgressBar = Watched
    print(f"load of the {os.cpu_count()} cores before: {os.getloadavg()[0]:.1f}")
    print(f"a solver that sleeps {1e3 * SLEEP:g} ms a point:")
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log"
        points, wall, parent, _ = measured(3 if quick else 240, partial(asleep, SLEEP, str(log)))
        gaps = waits(log)
    stalls = gaps[gaps > STALL]
    print(f"  a worker waits {1e6 * gaps.sum() / points:4.0f} µs a point, so {WORKERS} take ", end="")
    print(f"{1e6 * gaps.sum() / WORKERS / points:.0f} µs of wall time more a point")
    print(f"    of this, {len(stalls)} stalls over {1e3 * STALL:g} ms: {stalls.sum():.2f} s in {wall:.0f} s")
    print(f"  the parent takes {1e6 * parent / points:.0f} µs of CPU time a point")
    print(f"a solver that keeps a core busy for {1e3 * SPIN:g} ms a point:")
    points, _, parent, workers = measured(3 if quick else 96, partial(spinning, SPIN))
    print(f"  the parent takes {1e6 * parent / points:.0f} µs of CPU time a point")
    print(
        f"  the workers take {1e6 * (workers / points - SPIN):.0f} µs of CPU time a point beside the solver"
    )


if __name__ == "__main__":
    main()
