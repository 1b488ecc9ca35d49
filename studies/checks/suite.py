"""Time of the paper's suite: Figures 3 to 8 at rtol 1e-4 on 2 workers, with archives, without figures.

python studies/checks/suite.py > results/suite.txt
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import tempfile
import time
from pathlib import Path

import xarray as xr

from swtstudy import Study
from swtstudy.archive.run import run_several

FOLDER, FIGURES = Path(__file__).parent.parent, range(3, 9)


def processor_time() -> float:
    """Processor time so far of this process and of ended ones, s."""
    both = (resource.getrusage(whose) for whose in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(used.ru_utime + used.ru_stime for used in both)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="Figure 3 alone, to see that it runs")
    figures = FIGURES[: 1 if arguments.parse_args().quick else None]
    sizes: list[int] = []
    begin = time.perf_counter()

    def finished(study: Study, path: Path, dataset: xr.Dataset) -> None:
        sizes.append(dataset.s.size)
        words = f"{path.stem}: {dataset.s.size:5d} values, archive after"
        print(f"{words} {time.perf_counter() - begin:5.1f} s", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        studies = [f"figure{number}" for number in figures]
        run_several(
            [(Study.from_toml(FOLDER / f"{n}.toml"), Path(folder) / f"{n}.nc") for n in studies], finished
        )
    seconds, values = time.perf_counter() - begin, sum(sizes)
    for worker in multiprocessing.active_children():
        worker.join()
    used = processor_time()
    print(f"all:     {values:5d} values in {seconds:5.1f} s")
    print(f"processor time: {used:.1f} s, {1e3 * used / values:.1f} ms a value, imports included")


if __name__ == "__main__":
    main()
