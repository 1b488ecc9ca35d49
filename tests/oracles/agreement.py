"""Do recorded values agree with the oracles? A random sample of each kind of record.

``python tests/oracles/agreement.py --kinds line drawn circle body point --count 200``, from the project
folder, takes some seconds of a core for each record. results/oracles.csv keeps what was found, so that it
goes on where it was, and results/oracles.md says by kind how far records and oracles are apart.
"""

import argparse
import csv
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

import truth  # noqa: E402 – of the tests

from oracles.body import body_s  # noqa: E402
from oracles.circle import circle_s  # noqa: E402
from oracles.line import line_s  # noqa: E402

#: By kind: the files of the records, and what is compared.
KINDS = {
    "line": ("line_*", "s by all oracles of the line, other records than drawn ones"),
    "drawn": ("line_drawn_*", "s of drawn points"),
    "circle": ("circle", "the largest swt on the circle"),
    "body": ("body", "swt where it is largest in the body"),
    "point": ("mean", "swt at half the critical distance, into the depth"),
}
#: Loops with more vertices take minutes.
VERTICES = 60
COLUMNS = ("kind", "point", "recorded", "error", "oracle", "seconds")
#: Differences that are counted, relative.
BOUNDS = 1e-6, 1e-5, 1e-4


def records(kind: str) -> list[truth.Point]:
    """The records of a kind that an oracle can say something of."""
    scenes = truth.points(KINDS[kind][0])
    drawn = set(truth.points("line_drawn_*")) if kind == "line" else set()
    return [
        point
        for scene, several in scenes.items()
        for point in several
        if scene not in drawn and point.s > 0.0 and _is_short(point)
    ]


def _is_short(point: truth.Point) -> bool:
    load: Any = point.arguments.get("load")
    return load is None or len(load.vertices) <= VERTICES


def compared(kind: str, point: truth.Point) -> tuple[float, float, float]:
    """A recorded value, its error, and the oracle's."""
    with np.errstate(all="ignore"):
        if kind == "circle":
            return point.s, point.error, circle_s(point.arguments, point.critical_x)[0]
        if kind == "body":
            place = point.values["x"], point.values["y"], point.values["z"]
            return point.s, point.error, body_s(point.arguments, place)
        if kind == "point":
            given = dict(point.arguments)
            place = point.values["point_x_depth"], 0.0, 0.5 * given.pop("critical_distance")
            value, error = point.values["s_point_depth"], point.values["s_point_depth_error"]
            return value, error, body_s(given, place)
        return point.s, point.error, line_s(point.arguments)[0]


def lines(rows: list[dict[str, str]]) -> Iterator[str]:
    """The page."""
    yield "# Recorded values and the oracles"
    yield ""
    yield (
        "Random records of `tests/data/truth` against evaluations that share no code with the package "
        "(`tests/oracles`). Differences are relative to the record. `python tests/oracles/agreement.py`"
    )
    yield ""
    yield f"| what | records | {' | '.join(f'within {bound:g}' for bound in BOUNDS)} | lowest | highest |"
    yield "|" + "---|" * (4 + len(BOUNDS))
    far = []
    for kind, (_, words) in KINDS.items():
        own = [row for row in rows if row["kind"] == kind]
        if own:
            recorded, oracle = (
                np.array([float(row[name]) for row in own]) for name in ("recorded", "oracle")
            )
            off = (oracle - recorded) / np.where(recorded > 0.0, recorded, 1.0)
            within = [f"{(np.abs(off) <= bound).sum()}" for bound in BOUNDS]
            yield f"| {words} | {len(own)} | {' | '.join(within)} | {off.min():.1e} | {off.max():.1e} |"
            far += [
                f"* {words}, {row['point']}: recorded {row['recorded']} ± {row['error']}, "
                f"oracle {row['oracle']} ({each:+.1e})"
                for row, each in zip(own, off, strict=True)
                if abs(each) > BOUNDS[-1]
            ]
    yield from ("", f"Further apart than {BOUNDS[-1]:g}:", "", *(far or ["none."]))


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=ROOT / "results", help="folder for the files")
    arguments.add_argument("--kinds", nargs="+", choices=KINDS, default=[*KINDS])
    arguments.add_argument("--count", type=int, default=200, help="records of each kind")
    arguments.add_argument("--seconds", type=float, default=np.inf, help="no new record after so many")
    arguments.add_argument("--seed", type=int, default=0)
    given = arguments.parse_args()
    file, begin = given.results / "oracles.csv", time.monotonic()
    rows: list[dict[str, str]] = []
    if file.exists():
        with file.open(encoding="utf-8") as text:
            rows = list(csv.DictReader(text))
    known = {(row["kind"], row["point"]) for row in rows}
    draws = {}
    for kind in given.kinds:
        every = records(kind)
        order = np.random.default_rng(given.seed).permutation(len(every))[: given.count]
        draws[kind] = [every[k] for k in order]
    # In turns, so that a run that is stopped has some of each kind.
    for number in range(given.count):
        for kind, several in draws.items():
            if number >= len(several) or (kind, several[number].name) in known:
                continue
            if time.monotonic() - begin > given.seconds:
                break
            point, start = several[number], time.process_time()
            values = [f"{value:.9g}" for value in compared(kind, point)]
            row = [kind, point.name, *values, f"{time.process_time() - start:.1f}"]
            rows.append(dict(zip(COLUMNS, row, strict=True)))
            print(*row, flush=True)
            with file.open("w", encoding="utf-8", newline="") as text:
                table = csv.DictWriter(text, COLUMNS, lineterminator="\n")
                table.writeheader()
                table.writerows(rows)
    (given.results / "oracles.md").write_text("\n".join(lines(rows)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
