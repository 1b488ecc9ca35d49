"""New points for tests/data/truth, by the dense evaluation of `tests/oracles/line.py`, which shares no code.

``python tests/oracles/drawn_points.py --seed 1 --seconds 600``, from the project folder, draws points scene
by scene, some ten seconds of a core each, and writes tests/data/truth/line_drawn_1.csv.gz, with loops in
loads_drawn_1.json. It goes on after the last draw of that file. A point is refused if `solve` refuses its
parameters or finds no equilibrium. Where `solve` at rtol 1e-6 finds more than the dense evaluation, the
record is a lower bound. ``--solver solver-22``, in an environment with that version (CONTRIBUTING.md), does
without the dense evaluation, at a hundredth of the time: values of `solve` at rtol 1e-7, as lower bounds.
"""

import argparse
import csv
import gzip
import io
import json
import sys
import time
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from math import gcd, pi
from pathlib import Path
from typing import Any

import numpy as np

import swtstudy

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

import truth  # noqa: E402 – of the tests

from oracles.line import line_s  # noqa: E402

#: Largest numerator and denominator of ω2/ω1; the number of oscillations costs, so that short cycles prevail.
TERMS = 11
#: Relative error of the dense evaluation: differences from records at rtol 1e-6 in 99 of 100 cases.
ERROR = 3e-6
#: Digits of a loop's vertices after the point.
DIGITS = 5
COLUMNS = (
    "draw",
    "scene",
    "profile",
    "control",
    "poisson_ratio",
    "friction",
    "normal_amplitude",
    "normal_force_amplitude",
    "tangential_amplitude",
    "tangential_force_amplitude",
    "frequency_ratio",
    "phase",
    "load",
    "flat_radius",
    "flat_half_width",
    "waviness_amplitude",
    "wavelength",
    "exponent",
    "bulk_stress_amplitude",
    "bulk_stress_mean",
    "bulk_stress_phase",
    "criterion",
    "walker_exponent",
    "normal_sensitivity",
    "kind",
    "s",
    "error",
    "critical_x",
    "critical_angle",
    "source",
)
Arguments = dict[str, Any]
Row = dict[str, str]


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def base(rng: np.random.Generator, terms: int = 4, controls: int = 4) -> Arguments:
    """Two sines: amplitudes logarithmic from 1e-3 on, all controls."""
    pairs = [(p, q) for p in range(1, terms + 1) for q in range(1, terms + 1) if gcd(p, q) == 1]
    weights = np.array([1.0 / (p + q) for p, q in pairs])
    p, q = pairs[rng.choice(len(pairs), p=weights / weights.sum())]
    control = int(rng.integers(controls))  # displacements, forces, mixed ones
    normal = "normal_force_amplitude" if control & 1 else "normal_amplitude"
    tangential = "tangential_force_amplitude" if control in (1, 2) else "tangential_amplitude"
    return {
        "profile": "paraboloid",
        "poisson_ratio": float(rng.uniform(0.0, 0.5)),
        "friction": log_uniform(rng, 0.05, 1.0),
        normal: log_uniform(rng, 1e-3, 0.9),
        tangential: log_uniform(rng, 1e-3, 1.0),
        "frequency_ratio": f"{p}/{q}",
        "phase": float(rng.uniform(0.0, 2.0 * pi)),
    }


def ratios(rng: np.random.Generator) -> Arguments:
    return base(rng, TERMS)


def coincidences(rng: np.random.Generator) -> Arguments:
    """Phases at kπ/(2p), exactly or within 1e-11."""
    of = base(rng, TERMS)
    p = int(of["frequency_ratio"].partition("/")[0])
    of["phase"] = float(rng.integers(4 * p) * pi / (2 * p) + rng.integers(2) * rng.uniform(-1e-11, 1e-11))
    return of


def forces_of(of: Arguments) -> Arguments:
    """The same amplitudes as forces: plane contacts have no depth."""
    return {
        {
            "normal_amplitude": "normal_force_amplitude",
            "tangential_amplitude": "tangential_force_amplitude",
        }.get(name, name): value
        for name, value in of.items()
    }


def loops(rng: np.random.Generator) -> Arguments:
    """Polygons of 3 to 200 vertices: drawn ones of few, sampled sums of sines of many."""
    of = base(rng, 1, 1)
    if rng.integers(2):
        of = forces_of(of)
    del of["frequency_ratio"], of["phase"]
    count = round(log_uniform(rng, 3.0, 200.0))
    if count < 13:
        vertices = rng.uniform(-1.0, 1.0, (count, 2))
        if abs(np.sign(vertices[:, 0]).sum()) == count:
            # All on one side of the mean, which is refused.
            vertices[:, 0] -= vertices[:, 0].mean()
    else:
        turn, (a, b) = 2.0 * pi * np.arange(count) / count, rng.uniform(0.0, 6.0, 2)
        minor = rng.uniform(0.0, 0.4) * np.sin(rng.integers(2, 4) * turn + b)
        vertices = np.stack([np.sin(turn + a), np.sin(turn) + minor], axis=1)
    return of | {"load": vertices.round(DIGITS).tolist()}


def bulk(rng: np.random.Generator) -> Arguments:
    return base(rng) | {
        "bulk_stress_amplitude": log_uniform(rng, 1e-4, 0.5),
        "bulk_stress_mean": float(rng.uniform(-0.1, 0.3)),
        "bulk_stress_phase": float(rng.uniform(0.0, 2.0 * pi)),
    }


def criteria(rng: np.random.Generator) -> Arguments:
    """Shear criteria, and Walker's exponents."""
    of, kind = base(rng), int(rng.integers(3))
    if kind == 0:
        return of | {"walker_exponent": float(rng.uniform(0.1, 0.9))}
    name, most = (("fatemi_socie", 3.0), ("findley", 1.0))[kind - 1]
    return of | {"criterion": name, "normal_sensitivity": float(rng.uniform(0.0, most))}


def faces(rng: np.random.Generator) -> Arguments:
    """Flat faces up to 100 a_H."""
    name = ("rounded_punch", "truncated_paraboloid", "rounded_flat")[rng.integers(3)]
    of = base(rng) | {"profile": name}
    if name == "rounded_flat":
        return forces_of(of) | {"flat_half_width": log_uniform(rng, 0.05, 100.0)}
    return of | {"flat_radius": log_uniform(rng, 0.05, 100.0 if name == "rounded_punch" else 3.0)}


def powers(rng: np.random.Generator) -> Arguments:
    """Power laws up to 20."""
    name = ("power_law", "power_law_cylinder")[rng.integers(2)]
    of = base(rng)
    of = forces_of(of) if name == "power_law_cylinder" else of
    return of | {"profile": name, "exponent": log_uniform(rng, 1.1, 20.0)}


def waves(rng: np.random.Generator) -> Arguments:
    name = ("wavy_paraboloid", "wavy_cylinder")[rng.integers(2)]
    of = base(rng)
    of = forces_of(of) if name == "wavy_cylinder" else of
    return of | {
        "profile": name,
        "waviness_amplitude": log_uniform(rng, 1e-3, 0.1),
        "wavelength": float(rng.uniform(4.1, 10.0)),
    }


#: By scene: how a point is drawn, and its share of all.
SCENES = {
    "ratios to 11": (ratios, 0.2),
    "phases at kπ/(2p)": (coincidences, 0.25),
    "loops of 3 to 200 vertices": (loops, 0.15),
    "bulk stress, all controls": (bulk, 0.1),
    "criteria": (criteria, 0.1),
    "faces to 100": (faces, 0.08),
    "powers to 20": (powers, 0.08),
    "waves": (waves, 0.04),
}


def drawn(number: int, seed: int) -> tuple[str, Arguments]:
    """Scene and arguments of `solve` of a draw."""
    rng = np.random.default_rng([seed, number])
    shares = np.array([share for _, share in SCENES.values()])
    scene = [*SCENES][int(rng.choice(len(SCENES), p=shares / shares.sum()))]
    arguments = SCENES[scene][0](rng)
    if "load" in arguments:
        arguments["load"] = swtstudy.LoadPath(f"drawn {seed}.{number}", arguments["load"])
    return scene, arguments


def evaluated(number: int, seed: int) -> Row | None:
    """The row of a draw, by the dense evaluation; None if there is no such contact."""
    scene, arguments = drawn(number, seed)
    try:
        found = swtstudy.solve(**arguments, rtol=1e-6)
    except swtstudy.StudyError:
        return None
    own = float(found.s)
    if not own > 0.0:
        return None
    with np.errstate(all="ignore"):
        s, x, angle = line_s(arguments)
    kind = "at_least" if own > s * (1.0 + ERROR) + float(found.s_error) else "value"
    print(f"{scene}: {s:.11g}, solver {own:.11g} at {float(found.critical_x):.7g}", flush=True)
    return row_of(number, scene, arguments) | {
        "kind": kind,
        "s": f"{s:.11g}",
        "error": f"{ERROR * s:.1e}",
        "critical_x": "" if np.isnan(x) else f"{x:.9g}",
        "critical_angle": f"{angle:.6g}",
        "source": "independent dense evaluation",
    }


def by_solver(numbers: Iterable[int], seed: int, solver: str) -> Iterator[Row]:
    """The rows of draws, by the solver that is installed."""
    named = {number: drawn(number, seed) for number in numbers}
    points = [
        truth.Point(str(number), scene, arguments, "", np.nan, 0.0, np.nan, np.nan, "")
        for number, (scene, arguments) in named.items()
    ]
    found = truth.solved(points, 1e-7)
    columns = [found[name] for name in ("s", "s_error", "critical_x")]
    for number, s, error, x in zip(named, *columns, strict=True):
        if s > 0.0:
            yield row_of(number, *named[number]) | {
                "kind": "at_least",
                "s": f"{s:.11g}",
                "error": f"{error:.1e}",
                "critical_x": f"{x:.9g}",
                "source": f"{solver} at rtol 1e-7",
            }


def row_of(number: int, scene: str, arguments: Arguments) -> Row:
    """The columns of a draw that tell its parameters."""
    row = {name: value if isinstance(value, str) else repr(value) for name, value in arguments.items()}
    if "load" in row:
        path = arguments["load"]
        row |= {"load": path.name, "vertices": json.dumps(path.vertices.tolist())}
    kinds = [
        "force" if f"{way}_force_amplitude" in row else "displacement" for way in ("normal", "tangential")
    ]
    control = f"{kinds[0]}s" if kinds[0] == kinds[1] else f"normal_{kinds[0]}+tangential_{kinds[1]}"
    return row | {"draw": str(number), "scene": scene, "control": control}


def files(folder: Path, seed: int) -> tuple[Path, Path]:
    """The table of a seed, and the loops it names."""
    return folder / f"line_drawn_{seed}.csv.gz", folder / f"loads_drawn_{seed}.json"


def known(folder: Path, seed: int) -> list[Row]:
    """The rows that are there."""
    table, loads = files(folder, seed)
    if not table.exists():
        return []
    paths = json.loads(loads.read_text(encoding="utf-8"))
    with gzip.open(table, "rt", encoding="utf-8", newline="") as text:
        rows = list(csv.DictReader(text))
    return [row | {"vertices": json.dumps(paths[row["load"]])} if row["load"] else row for row in rows]


def save(folder: Path, seed: int, rows: list[Row]) -> None:
    """Write the rows, and the loops' vertices."""
    text = io.StringIO()
    table = csv.DictWriter(text, COLUMNS, extrasaction="ignore", lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    folder.mkdir(parents=True, exist_ok=True)
    own, loads = files(folder, seed)
    own.write_bytes(gzip.compress(text.getvalue().encode(), 9, mtime=0))
    paths = {row["load"]: json.loads(row["vertices"]) for row in rows if row.get("vertices")}
    loads.write_text(json.dumps(paths, separators=(",", ":")) + "\n", encoding="utf-8")


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--folder", type=Path, default=ROOT / "tests" / "data" / "truth")
    arguments.add_argument("--seed", type=int, required=True)
    arguments.add_argument("--seconds", type=float, default=600.0, help="no new points after so many seconds")
    arguments.add_argument("--points", type=int, default=5000, help="nor with so many in the table")
    arguments.add_argument("--solver", help="name of the installed version, whose values are recorded")
    arguments.add_argument("--processes", type=int, default=2)
    given = arguments.parse_args()
    begin, rows = time.monotonic(), known(given.folder, given.seed)
    number = 1 + max((int(row["draw"]) for row in rows), default=-1)
    together = 500 if given.solver else 4 * given.processes
    with ProcessPoolExecutor(given.processes) as pool:
        while time.monotonic() - begin < given.seconds and len(rows) < given.points:
            batch = range(number, number + together)
            if given.solver:
                rows += by_solver(batch, given.seed, given.solver)
            else:
                several = pool.map(partial(evaluated, seed=given.seed), batch)
                rows += [row for row in several if row is not None]
            number += together
            save(given.folder, given.seed, rows)
            print(f"{len(rows)} of {number} draws", flush=True)


if __name__ == "__main__":
    main()
