"""How far is s from recorded values? All points of tests/data/truth through `solve`.

``python studies/checks/truth.py``, from the project folder, writes results/truth.md: by scene, how many
points are low or high by more than s_error at two tolerances, the worst of them, and s_error over the error.
``--every 10`` takes every tenth point of each scene; ``--quick`` next to none. It ends with 1 if a point is
wrong that is not given by ``--missed``.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from types import ModuleType

import numpy as np

import swtstudy

RTOLS = 1e-4, 1e-6


def _records() -> ModuleType:
    """The reader of the tests, which has this file's name."""
    file = Path(__file__).parents[2] / "tests" / "truth.py"
    spec = importlib.util.spec_from_file_location("recorded_truth", file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["recorded_truth"] = module
    spec.loader.exec_module(module)
    return module


records = _records()


def solved(task: tuple[str, int]) -> list[tuple[float, float]]:
    """s and s_error of a point, given by scene and number, at each tolerance."""
    scene, number = task
    arguments = records.points()[scene][number].arguments
    found = [swtstudy.solve(**arguments, rtol=rtol) for rtol in RTOLS]
    return [(float(each.s), float(each.s_error)) for each in found]


def report(found: dict[str, list[tuple[object, list[tuple[float, float]]]]], every: int) -> Iterator[str]:
    """The page: a table for each tolerance, then the points that are wrong."""
    share = "all points" if every == 1 else f"one in {every} points"
    yield "# s against recorded values"
    yield ""
    yield (
        f"{share.capitalize()} of tests/data/truth. A point is low or high if s differs from the record by more "
        "than s_error and the record's own error. The worst differences are relative. Ratios are s_error over the "
        "difference: the 1st and the 50th percentile of points whose difference exceeds the record's error. "
        "`python studies/checks/truth.py`"
    )
    wrong: list[str] = []
    for index, rtol in enumerate(RTOLS):
        yield from ("", f"## rtol {rtol:g}", "")
        yield "| scene | points | low | lowest | high | highest | s_error / difference, 1 % | 50 % |"
        yield "|" + "---|" * 8
        for scene, rows in found.items():
            verdicts = [(p, *values[index]) for p, values in rows]
            said = [records.verdict(*each) for each in verdicts]
            valued = [(p, s, e) for p, s, e in verdicts if p.s > 0.0]
            bounded = [s / p.s - 1.0 for p, s, _ in valued]
            high = [s / p.s - 1.0 for p, s, _ in valued if p.kind == "value"]
            compared = [(e, abs(s - p.s)) for p, s, e in valued if p.kind == "value" and p.error > 0.0]
            beyond = [e / d for (e, d), (p, *_) in zip(compared, valued, strict=False) if d > p.error]
            ratios = np.percentile(beyond, [1, 50]) if beyond else (np.nan, np.nan)
            cells = [
                scene,
                f"{len(rows)}",
                f"{said.count('low')}",
                f"{-min([0.0, *bounded]):.1e}",
                f"{said.count('high')}",
                f"{max([0.0, *high]):.1e}",
                *(f"{ratio:.2g}" for ratio in ratios),
            ]
            yield f"| {' | '.join(cells)} |"
            wrong += [
                f"{p.name}, rtol {rtol:g}: {word}, {s:.9g} ± {e:.1e}; recorded {p.s:.9g} ({p.kind})"
                for (p, s, e), word in zip(verdicts, said, strict=True)
                if word != "right"
            ]
    yield from ("", "## Wrong", "", *(f"* {each}" for each in wrong or ["none"]))


def main() -> int:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--every", type=int, default=1, help="take every so manieth point of a scene")
    arguments.add_argument("--scenes", nargs="+", default=None, help="only these scenes")
    arguments.add_argument("--missed", type=int, default=0, help="how many wrong values are known")
    arguments.add_argument("--processes", type=int, default=2)
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    scenes = {n: p for n, p in records.points().items() if given.scenes is None or n in given.scenes}
    if given.quick:
        scenes, given.every = dict([*scenes.items()][:1]), 10_000
    tasks = [(name, k) for name, points in scenes.items() for k in range(0, len(points), given.every)]
    with ProcessPoolExecutor(given.processes) as pool:
        done = [*map(solved, tasks)] if given.quick else [*pool.map(solved, tasks, chunksize=8)]
    found: dict[str, list[tuple[object, list[tuple[float, float]]]]] = {}
    for (name, k), values in zip(tasks, done, strict=True):
        found.setdefault(name, []).append((scenes[name][k], values))
    text = "\n".join(report(found, given.every)) + "\n"
    (given.results / "truth.md").write_text(text, encoding="utf-8")
    print(text)
    return int(sum(line.startswith("* ") and line != "* none" for line in text.splitlines()) > given.missed)


if __name__ == "__main__":
    sys.exit(main())
