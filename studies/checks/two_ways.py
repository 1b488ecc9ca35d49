"""Is a maximum overlooked? s by two ways through the solver, at many random points.

``python studies/checks/two_ways.py``, from the project folder, writes results/two_ways.md. With next to no
bulk stress the search goes over a wider range, with other positions, without the short cuts of symmetry:
where it finds another s than without, one of the two has overlooked a maximum. That costs a hundredth of a
dense look (``overlooked.py``), and misses what both ways overlook. ``--points`` draws fewer of each scene,
``--quick`` next to none.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))

from overlooked import CHUNK, NEXT_TO_NONE, SCENES

from swtstudy.solver.points import solve_points

NAMES = (
    "displacements",
    "forces",
    "mixed control",
    "rounded punch",
    "truncated paraboloid",
    "wavy paraboloid",
    "power law",
    "Walker's exponent",
    "phases next to 0 and π",
)
RTOL, SEED = 1e-4, 4


def differences(task: tuple[str, int]) -> tuple[str, NDArray[np.float64], list[str]]:
    """By how much s differs and by how much it may, relative, shape (n, 2), and where it differs by more."""
    name, chunk = task
    points = SCENES[name][0](np.random.default_rng([SEED, list(SCENES).index(name), chunk]))
    other = replace(points, bulk_stress_amplitude=np.full(len(points), NEXT_TO_NONE))
    first, second = solve_points(points, RTOL), solve_points(other, RTOL)
    some = np.flatnonzero(np.isfinite(first.s) & (first.s > 0.0))
    off = (second.s / first.s - 1.0)[some]
    allowed = ((first.s_error + second.s_error) / first.s)[some]
    words = [
        f"{name}: {first.s[k]:.9g} at {first.critical_x[k]:.6g}, "
        f"{second.s[k]:.9g} at {second.critical_x[k]:.6g}, {points[[k]]}"
        for k in some[np.abs(off) > allowed]
    ]
    return name, np.stack([off, allowed], axis=-1), words


def lines(found: dict[str, list[NDArray[np.float64]]]) -> Iterator[str]:
    """The report."""
    yield "# Is a maximum overlooked? Two ways through the solver"
    yield ""
    yield (
        "s of random points, small motions among them, without a bulk stress and with one of "
        f"{NEXT_TO_NONE:g} of the contact's own, at rtol {RTOL:g}: where they differ one of them has "
        "overlooked a maximum. `python studies/checks/two_ways.py`"
    )
    yield ""
    yield "| scene | points | s differs by more than s_error | largest difference |"
    yield "|---|---|---|---|"
    for name, parts in found.items():
        off, allowed = np.concatenate(parts).T
        differ = np.abs(off) > allowed
        yield f"| {name} | {off.size} | {differ.sum()} | {np.abs(off).max(initial=0.0):.1e} |"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--points", type=int, default=4000, help="points of each scene")
    arguments.add_argument(
        "--quick", action="store_true", help="few points of one scene, to see that it runs"
    )
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    names, count = (NAMES[:1], 1) if given.quick else (NAMES, max(given.points // CHUNK, 1))
    tasks = [(name, chunk) for name in names for chunk in range(count)]
    found: dict[str, list[NDArray[np.float64]]] = {name: [] for name in names}
    with ProcessPoolExecutor(2) as pool:
        for name, rows, words in pool.map(differences, tasks):
            found[name].append(rows)
            print("\n".join(words), end="\n" if words else "", flush=True)
    text = "\n".join(lines(found)) + "\n"
    (given.results / "two_ways.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
