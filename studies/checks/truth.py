"""How far is s from recorded values? All points of tests/data/truth, through `solve` and `run`.

``python studies/checks/truth.py``, from the project folder, writes results/truth.md: by scene, how many
points are low or high by more than s_error at two tolerances, the worst of them, and s_error over the error.
``--every 10`` takes every tenth point of each scene; ``--quick`` next to none. It ends with 1 if more values
are wrong than ``--missed`` says.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

RTOLS = 1e-4, 1e-6
Array = NDArray[np.float64]
#: What is found at the points of a scene at each tolerance: the columns of `truth.solved`.
Found = Mapping[str, tuple[Sequence[Any], list[dict[str, Array]]]]


def _records() -> Any:
    """The tests' module of the same name."""
    own = sys.path[:]
    sys.modules.pop("truth", None)
    sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
    try:
        return importlib.import_module("truth")
    finally:
        sys.path[:] = own


def cells_of(
    records: Any, points: Sequence[Any], s: NDArray[np.float64], error: NDArray[np.float64]
) -> list[str]:
    """The cells of a scene at a tolerance."""
    verdicts = [records.verdict(*each) for each in zip(points, s, error, strict=True)]
    recorded, own = (np.array([getattr(point, name) for point in points]) for name in ("s", "error"))
    is_value = np.array([point.kind == "value" for point in points])
    some = recorded > 0.0
    off = np.where(some, s / np.where(some, recorded, 1.0) - 1.0, 0.0)
    known = some & is_value & (np.abs(s - recorded) > own + records.ROUNDING * recorded) & (off != 0.0)
    ratios = error[known] / np.abs(s - recorded)[known]
    shares = [f"{each:.2g}" for each in np.percentile(ratios, [1, 50])] if ratios.size else ["–", "–"]
    worst = [f"{max(0.0, -off.min(initial=0.0)):.1e}", f"{off[is_value].max(initial=0.0):.1e}"]
    low, high = verdicts.count("low"), verdicts.count("high")
    return [f"{len(points)}", f"{low}", worst[0], f"{high}", worst[1], *shares]


def lines(records: Any, found: Found, every: int) -> Iterator[str]:
    """The page: a table for each tolerance, then the points that are wrong."""
    share = "All points" if every == 1 else f"One in {every} points"
    yield "# s against recorded values"
    yield ""
    yield (
        f"{share} of `tests/data/truth`. A point is low or high if s differs from the record by more than "
        "s_error and the record's own error; the lowest and the highest difference are relative. The last "
        "two columns are s_error over the difference, where the record is good enough to show one: 1st "
        "percentile and median. `python studies/checks/truth.py`"
    )
    wrong: list[str] = []
    for index, rtol in enumerate(RTOLS):
        yield from ("", f"## rtol {rtol:g}", "")
        yield "| scene | points | low | lowest | high | highest | s_error / difference, 1 % | 50 % |"
        yield "|" + "---|" * 8
        for scene, (points, columns) in found.items():
            s, error = columns[index]["s"], columns[index]["s_error"]
            yield f"| {' | '.join([scene, *cells_of(records, points, s, error)])} |"
            for point, value, own in zip(points, s, error, strict=True):
                word = records.verdict(point, value, own)
                if word != "right":
                    record = f"recorded {point.s:.9g} ± {point.error:.1e} ({point.kind})"
                    wrong.append(f"{point.name}, rtol {rtol:g}: {word}, {value:.9g} ± {own:.1e}; {record}")
    yield from ("", "## Wrong", "", *(f"* {each}" for each in wrong))


def main() -> int:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--every", type=int, default=1, help="take one point of so many")
    arguments.add_argument("--scenes", nargs="+", help="only these scenes")
    arguments.add_argument("--missed", type=int, default=0, help="how many values are known to be wrong")
    arguments.add_argument("--processes", type=int, default=2)
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    records = _records()
    scenes = {name: points for name, points in records.points().items() if name in (given.scenes or [name])}
    if given.quick:
        scenes, given.every, given.processes = dict([*scenes.items()][:1]), 1000, 1
    found = {}
    for name, every in scenes.items():
        points = every[:: given.every]
        found[name] = points, [records.solved(points, rtol, given.processes) for rtol in RTOLS]
        print(name, flush=True)
    text = "\n".join(lines(records, found, given.every)) + "\n"
    (given.results / "truth.md").write_text(text, encoding="utf-8")
    print(text)
    return int(sum(line.startswith("* ") for line in text.splitlines()) > given.missed)


if __name__ == "__main__":
    sys.exit(main())
