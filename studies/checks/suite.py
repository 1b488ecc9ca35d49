"""Time of the paper's suite: Figures 3 to 8 at rtol 1e-4 on 2 workers, with archives, without figures.

python studies/checks/suite.py > results/suite.txt
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

from swtstudy import Study, run

FOLDER, FIGURES = Path(__file__).parent.parent, range(3, 9)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="Figure 3 alone, to see that it runs")
    quick = arguments.parse_args().quick
    total_points, total = 0, 0.0
    with tempfile.TemporaryDirectory() as folder:
        for number in FIGURES[: 1 if quick else None]:
            study = Study.from_toml(FOLDER / f"figure{number}.toml")
            begin = time.perf_counter()
            dataset = run(study, Path(folder) / f"figure{number}.nc")
            seconds = time.perf_counter() - begin
            total_points, total = total_points + dataset.s.size, total + seconds
            print(f"figure {number}: {dataset.s.size:5d} values in {seconds:5.1f} s", flush=True)
    print(
        f"all:      {total_points:5d} values in {total:5.1f} s, {1e3 * total / total_points:.1f} ms a value"
    )


if __name__ == "__main__":
    main()
