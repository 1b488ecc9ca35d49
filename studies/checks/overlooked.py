"""Is a maximum overlooked? s of random points, small motions among them, against a dense look at the line.

``python studies/checks/overlooked.py``, from the project folder, writes results/overlooked.md: by scene, how
many points are lower than the dense look by more than s_error, and by how much the worst. ``--points 1000``
draws fewer of each 10,000; ``--quick`` next to none. results/dense_looks.csv has what dense looks have found,
a second or so a point, which does not change with the search; new ones go there, too. With ``--known`` only
the points of that file are solved: minutes.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from fractions import Fraction
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))

from accuracy import SHAPES
from nonlocal_means import worn

from swtstudy.paper.maxima import dense_maximum
from swtstudy.solver.at_rest import check_shape
from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.points import Points, Solution, solve_points
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]
#: Scene, seed and number of points that are drawn together.
Chunk = tuple[str, int, int]
#: Largest swt on the line, and signed x there, shape (2, n).
Dense = Array
RATIOS = [Fraction(text) for text in ("1", "2", "1/2", "3/2", "4/3", "3", "2/3")]
#: Ranges of the shapes of plane profiles.
PLANE = {"rounded_flat": {"flat_half_width": (0.05, 2.0)}, "power_law_cylinder": {"exponent": (1.2, 6.0)}}
#: The dense look: steps of each piece, but fewer where the loop has more than so many vertices, and planes.
STEPS, INTERVALS, PLANES = 64, 32, 32
#: Points that are drawn together, and chunks of a task of a process.
CHUNK, TOGETHER = 50, 20
RTOLS = 1e-4, 1e-6
#: Bulk stress over the contact's own by which the search takes its other way: it moves s by as much.
NEXT_TO_NONE = 1e-12
#: Relative accuracy of the dense look's own closest grids.
DENSE = 1e-7
#: Relative error of s where tension is nothing but rounding, as under a bulk stress that presses.
ROUNDING = 0.01


def law(rng: np.random.Generator, profile: str = "paraboloid") -> Points:
    """Displacements: both amplitudes logarithmic, over 0.01–0.9 and 0.001–1."""
    ratio = [RATIOS[k] for k in rng.integers(len(RATIOS), size=CHUNK)]
    depth = 10.0 ** rng.uniform(-2.0, np.log10(0.9), CHUNK)
    ranges = (SHAPES | PLANE).get(profile, {})
    shape = {name: rng.uniform(*ends, CHUNK) for name, ends in ranges.items()}
    for k in range(CHUNK) if shape else ():
        while check_shape(profile, {name: v[k] for name, v in shape.items()}, 1.0 + depth[k]) is not None:
            for name, ends in ranges.items():
                shape[name][k] = rng.uniform(*ends)
    return Points(
        profile,
        rng.uniform(0.0, 0.5, CHUNK),
        rng.uniform(0.05, 1.0, CHUNK),
        depth,
        np.array([each.numerator for each in ratio]),
        np.array([each.denominator for each in ratio]),
        10.0 ** rng.uniform(-3.0, 0.0, CHUNK),
        rng.uniform(0.0, 2.0 * np.pi, CHUNK),
        shape,
    )


def forces(rng: np.random.Generator, profile: str = "paraboloid") -> Points:
    """The same law for forces; where friction does not bear them there is no s."""
    return replace(law(rng, profile), control=Control(True, True))


def mixed(rng: np.random.Generator) -> Points:
    """One force and one displacement."""
    first = bool(rng.integers(2))
    return replace(law(rng), control=Control(first, not first))


def near_symmetry(rng: np.random.Generator) -> Points:
    """Phases next to 0 or π, where cusps nearly meet, logarithmic over 1e-6–0.1."""
    points = (law, forces, mixed)[rng.integers(3)](rng)
    side, beside = rng.integers(2, size=(2, CHUNK))
    away = (2 * beside - 1) * 10.0 ** rng.uniform(-6.0, -1.0, CHUNK)
    if rng.integers(2):
        one = np.ones(CHUNK, dtype=np.intp)
        points = replace(points, p=one, q=one)
    return replace(points, phase=np.pi * side + away)


def table(rng: np.random.Generator) -> Points:
    """A worn paraboloid."""
    return replace(law(rng), profile=worn())


def loops(rng: np.random.Generator) -> Points:
    """Polygons of 4 to 200 vertices: drawn ones of few, sampled sums of sines of many."""
    count = int(np.round(4.0 * 50.0 ** rng.uniform()))
    if count < 12:
        path = LoadPath("drawn", list(map(tuple, rng.uniform(-1.0, 1.0, (count, 2)))))
    else:
        turn, (a, b) = 2.0 * np.pi * np.arange(count) / count, rng.uniform(0.0, 6.0, 2)
        minor = rng.uniform(0.0, 0.4) * np.sin(rng.integers(2, 4) * turn + b)
        path = LoadPath("sampled", list(zip(np.sin(turn + a), np.sin(turn) + minor, strict=True)))
    return replace(law(rng), path=path)


def bulk_stress(rng: np.random.Generator, scale: float = 1.0) -> Points:
    """With bulk stresses from next to nothing up to the contact's own, in tension on the mean or pressing."""
    some = {
        "amplitude": scale * 10.0 ** rng.uniform(-4.0, -0.5, CHUNK),
        "mean": scale * rng.uniform(-0.1, 0.2, CHUNK),
        "phase": rng.uniform(0.0, 2.0 * np.pi, CHUNK),
    }
    return replace(law(rng), **{f"bulk_stress_{name}": values for name, values in some.items()})


def next_to_no_bulk_stress(rng: np.random.Generator) -> Points:
    """The other way through the solver, without its short cuts."""
    return bulk_stress(rng, NEXT_TO_NONE)


def walker(rng: np.random.Generator) -> Points:
    """Walker's exponents."""
    return replace(law(rng), walker_exponent=rng.uniform(0.1, 0.9, CHUNK))


#: By scene: how it is drawn, and how many points of 10,000.
SCENES = {
    "displacements": (law, 10_000),
    "forces": (forces, 10_000),
    "mixed control": (mixed, 1_000),
    **{
        name.replace("_", " "): (lambda rng, name=name: law(rng, name), 1_500)
        for name in ("rounded_punch", "truncated_paraboloid", "wavy_paraboloid", "power_law")
    },
    **{
        name.replace("_", " "): (lambda rng, name=name: forces(rng, name), 1_000)
        for name in ("cylinder", *PLANE)
    },
    "a table": (table, 500),
    "loops of 4 to 200 vertices": (loops, 400),
    "bulk stress": (bulk_stress, 1_000),
    "next to no bulk stress": (next_to_no_bulk_stress, 500),
    "Walker's exponent": (walker, 1_000),
    "phases next to 0 and π": (near_symmetry, 2_000),
}


def drawn(name: str, seed: int, chunk: int) -> Points:
    """A chunk of the points of a scene."""
    return SCENES[name][0](np.random.default_rng([seed, list(SCENES).index(name), chunk]))


#: A chunk, and what is known of it.
Task = tuple[Chunk, Dense | None]


def shortfall(tasks: list[Task]) -> list[tuple[Chunk, Dense, Array, list[str]]]:
    """By how much s is below the dense look, relative, and s_error, at each tolerance, shape (k, 2, rtols).

    Before that what the dense look finds, and after it the points at which that is more than s_error.
    """
    found = []
    several = [drawn(*chunk) for chunk, _ in tasks]
    solutions = [[solve_points(points, rtol) for points in several] for rtol in RTOLS]
    for (chunk, known), points, *solved in zip(tasks, several, *solutions, strict=True):
        some = np.isfinite(solved[0].s) & (solved[0].s > 0.0)
        look = known if known is not None else _dense(points, some)
        found.append((chunk, look, *_compared(chunk[0], points, solved, look)))
    return found


def _compared(name: str, points: Points, solved: list[Solution], look: Dense) -> tuple[Array, list[str]]:
    dense, x = look
    some = np.isfinite(dense)
    low, error = (
        np.array([values[some] for values in of_each])
        for of_each in ([1.0 - each.s / dense for each in solved], [each.s_error / dense for each in solved])
    )
    words = [
        f"{name}, {dense[k]:.10g} at {x[k]:.6g}, s {[float(each.s[k]) for each in solved]}: {points[[k]]}"
        for k in np.flatnonzero(some)[(low > error + DENSE).any(axis=0)]
    ]
    return np.stack([low, error]).transpose(2, 0, 1), words


def _dense(points: Points, some: NDArray[np.bool_]) -> Dense:
    """Value and place that the dense grid finds at some of the points; NaN at the others."""
    found = np.full((2, some.size), np.nan)
    longer = 1 if points.path is None else max(len(points.path.vertices) // INTERVALS, 1)
    for k in np.flatnonzero(some):
        found[:, k] = dense_maximum(points[[k]], STEPS // longer, PLANES)
    return found


def known_looks(file: Path) -> dict[Chunk, Dense]:
    """Values of dense grids, by chunk."""
    looks: dict[Chunk, list[tuple[float, float]]] = {}
    if file.exists():
        with file.open(encoding="utf-8") as rows:
            for row in csv.DictReader(rows):
                chunk = row["scene"], int(row["seed"]), int(row["chunk"])
                looks.setdefault(chunk, []).append((float(row["swt"]), float(row["x"])))
    return {chunk: np.transpose(each) for chunk, each in looks.items()}


def keep(file: Path, chunk: Chunk, look: Dense) -> None:
    """Add the values of a dense grid to the earlier ones."""
    new = not file.exists()
    with file.open("a", encoding="utf-8", newline="") as rows:
        table = csv.writer(rows, lineterminator="\n")
        if new:
            table.writerow(["scene", "seed", "chunk", "swt", "x"])
        table.writerows([*chunk, f"{swt:.11g}", f"{x:.8g}"] for swt, x in look.T)


def lines(found: dict[str, Array]) -> Iterator[str]:
    """The report."""
    yield "# Is a maximum overlooked?"
    yield ""
    yield (
        f"s of random points against a dense look at the line: {STEPS} cosine-spaced steps of each piece "
        f"between two cusps (fewer where the loop has more than {INTERVALS} vertices), {PLANES} planes, "
        "four times the instants, then the highest places on closer grids. Lowest are those whose s_error is "
        f"below {ROUNDING:.0%}: elsewhere tension is rounding. `studies/checks/overlooked.py`"
    )
    yield ""
    heads = [f"{what} at rtol {rtol:g}" for rtol in RTOLS for what in ("low by more than s_error", "lowest")]
    yield f"| scene | points | {' | '.join(heads)} |"
    yield "|" + "---|" * (2 + len(heads))
    for name, rows in found.items():
        cells = [name, f"{len(rows)}"]
        for low, error in np.moveaxis(rows, 0, -1).swapaxes(0, 1):
            bad = low > error + DENSE
            cells += [f"{bad.sum()}", f"{low[error < ROUNDING].max(initial=0.0):.1e}"]
        yield f"| {' | '.join(cells)} |"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument("--points", type=int, default=10_000, help="points instead of 10,000")
    arguments.add_argument("--seeds", type=int, nargs="+", default=[1, 2], help="half of the points each")
    arguments.add_argument("--scenes", nargs="+", default=list(SCENES), choices=list(SCENES))
    arguments.add_argument("--known", action="store_true", help="no new dense look")
    arguments.add_argument("--processes", type=int, default=2)
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    if given.quick:
        global CHUNK
        CHUNK, given.points, given.scenes = 1, 1, given.scenes[:1]
    file = given.results / "dense_looks.csv"
    known = known_looks(file)
    chunks = [
        (name, seed, chunk)
        for name in given.scenes
        for seed in given.seeds
        for chunk in range(max(SCENES[name][1] * given.points // (10_000 * CHUNK * len(given.seeds)), 1))
    ]
    # Dense looks are kept one by one.
    together = TOGETHER if given.known else 1
    tasks = [(chunk, known.get(chunk)) for chunk in ([*known] if given.known else chunks)]
    lists = [tasks[begin : begin + together] for begin in range(0, len(tasks), together)]
    found: dict[str, list[Array]] = {}
    with ProcessPoolExecutor(given.processes) as pool:
        done = map(shortfall, lists) if given.quick else pool.map(shortfall, lists)
        for chunk, look, rows, words in chain.from_iterable(done):
            if chunk not in known:
                keep(file, chunk, look)
            found.setdefault(chunk[0], []).append(rows)
            print("\n".join(words), end="\n" if words else "", flush=True)
    of_scenes = {name: np.concatenate(found[name]) for name in SCENES if name in found}
    text = "\n".join(lines(of_scenes)) + "\n"
    (given.results / "overlooked.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
