"""Time of a value, and memory, of a study of 10⁵ samples: a Latin hypercube over three parameters.

python studies/checks/sampled.py > results/samples.txt
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import tempfile
from pathlib import Path

import numpy as np

from swtstudy import Study, run

STUDY = """
title = "Samples of a cheap scene"
rtol = 1e-2
[fixed]
normal_amplitude = 0.5
[sample]
design = "latin_hypercube"
size = {size}
seed = 1
[sample.ranges]
friction = [0.1, 0.5]
poisson_ratio = [0.2, 0.4]
tangential_amplitude = [0.1, 1]
"""
#: A spawned process and this one, each by itself.
WORKERS, PARENT = resource.RUSAGE_CHILDREN, resource.RUSAGE_SELF


def processor_time(whose: int) -> float:
    """Processor time so far, s."""
    used = resource.getrusage(whose)
    return used.ru_utime + used.ru_stime


def megabytes(whose: int) -> float:
    """Largest resident memory of one process so far."""
    return resource.getrusage(whose).ru_maxrss / 1024


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="few samples, to see that it runs")
    quick = arguments.parse_args().quick
    print("samples   processor time of a value: workers       parent   a worker at most   parent  archive")
    for size in (200,) if quick else (10_000, 100_000):
        before = processor_time(WORKERS), processor_time(PARENT)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "samples.nc"
            dataset = run(Study.from_text(STUDY.format(size=size)), path)
            for worker in multiprocessing.active_children():
                worker.join()
            assert np.isfinite(dataset.s).all()
            assert dataset.s.size == size
            spent = [
                1e6 * (processor_time(w) - b) / size for w, b in zip((WORKERS, PARENT), before, strict=True)
            ]
            print(
                f"{size:<9} {spent[0]:35.0f} µs {spent[1]:12.0f} µs {megabytes(WORKERS):15.0f} MB"
                f" {megabytes(PARENT):5.0f} MB {path.stat().st_size / 2**20:6.1f} MB",
                flush=True,
            )


if __name__ == "__main__":
    main()
