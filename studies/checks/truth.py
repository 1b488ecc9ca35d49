"""How far is s from recorded values? All points of tests/data/truth, through `solve` and `run`.

``python studies/checks/truth.py``, from the project folder, writes results/truth.md: by scene, how many
points are low or high by more than s_error at two tolerances, and the worst of them; and how s_error over the
error is distributed, which results/truth.png draws. ``--every 1 10`` takes all points at the first tolerance
and every tenth of each scene at the other, ``--scenes`` some scenes, ``--workers`` so many processes;
``--quick`` next to no points. ``--parts`` keeps what was found of each scene in a folder, and goes on from
it. ``--misses`` writes the points that are wrong, with all parameters, as CSV. It ends with 1 if more values
are wrong than ``--missed`` says.
"""

from __future__ import annotations

import argparse
import csv
import importlib
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

RTOLS = 1e-4, 1e-6
#: Percentages of points that have less of s_error over the error.
QUANTILES = 5.0, 25.0, 50.0, 75.0, 95.0, 99.9
Array = NDArray[np.float64]
#: Relative error of a record's digits.
DIGITS = 1e-11
#: Largest s_error over the record of which the lowest and the highest differences tell.
LARGEST_ERROR = 0.01
#: Least ratio that is drawn, –.
LEAST_DRAWN = 1e-2
#: The columns of `truth.solved`, and how many points are solved together.
COLUMNS, TOGETHER = ("s", "s_error", "critical_x"), 2500
#: At each tolerance, by scene: points and what is found there, the columns of `truth.solved`.
Found = Sequence[Mapping[str, tuple[Sequence[Any], dict[str, Array]]]]


def _records() -> Any:
    """The tests' module of the same name."""
    own = sys.path[:]
    sys.modules.pop("truth", None)
    sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
    try:
        return importlib.import_module("truth")
    finally:
        sys.path[:] = own


def ratios_of(points: Sequence[Any], s: Array, error: Array) -> Array:
    """s_error over the difference from the record, at points whose records are values, of an s > 0.

    A record shows no difference below its own error: that is the least difference. So ratios are lower bounds
    where s is as good as the record.
    """
    recorded, own = (np.array([getattr(point, name) for point in points]) for name in ("s", "error"))
    known = np.array([point.kind == "value" for point in points]) & (recorded > 0.0) & (s > 0.0)
    least = np.maximum(own, DIGITS * recorded)
    return np.asarray((error / np.maximum(np.abs(s - recorded), least))[known])


def cells_of(records: Any, points: Sequence[Any], s: Array, error: Array) -> list[str]:
    """The cells of a scene at a tolerance."""
    verdicts = [records.verdict(*each) for each in zip(points, s, error, strict=True)]
    recorded = np.array([point.s for point in points])
    is_value = np.array([point.kind == "value" for point in points])
    # Elsewhere s is rounding.
    some = (recorded > 0.0) & ~(error > LARGEST_ERROR * recorded)
    off = np.where(some, s / np.where(some, recorded, 1.0) - 1.0, 0.0)
    worst = [f"{max(0.0, -off.min(initial=0.0)):.1e}", f"{off[is_value].max(initial=0.0):.1e}"]
    low, high = verdicts.count("low"), verdicts.count("high")
    return [f"{len(points)}", f"{low}", worst[0], f"{high}", worst[1], *quantiles(points, s, error)]


def quantiles(points: Sequence[Any], s: Array, error: Array) -> list[str]:
    """The cells of s_error over the error."""
    ratios = ratios_of(points, s, error)
    return (
        [f"{each:.2g}" for each in np.percentile(ratios, QUANTILES)]
        if ratios.size
        else ["–"] * len(QUANTILES)
    )


def lines(records: Any, found: Found, every: Sequence[int]) -> Iterator[str]:
    """The page: a table for each tolerance, then the points that are wrong."""
    yield "# s against recorded values"
    yield ""
    yield (
        "Points of `tests/data/truth`. A point is low or high if s differs from the record by more than "
        "s_error and the record's own error; the lowest and the highest difference are relative. The other "
        "columns are percentiles of s_error over the difference, or over the record's own error where that "
        "is more, so that they are lower bounds where s is as good as its record. "
        "`python studies/checks/truth.py`"
    )
    wrong: list[str] = []
    for rtol, of, step in zip(RTOLS, found, every, strict=True):
        yield from ("", f"## rtol {rtol:g}", "")
        yield from ("All points." if step == 1 else f"One in {step} points.", "")
        shares = " | ".join(f"{each:g} %" for each in QUANTILES)
        yield f"| scene | points | low | lowest | high | highest | {shares} |"
        yield "|" + "---|" * (6 + len(QUANTILES))
        for scene, (points, columns) in of.items():
            s, error = columns["s"], columns["s_error"]
            yield f"| {' | '.join([scene, *cells_of(records, points, s, error)])} |"
            for point, value, own in zip(points, s, error, strict=True):
                word = records.verdict(point, value, own)
                if word != "right":
                    record = f"recorded {point.s:.9g} ± {point.error:.1e} ({point.kind})"
                    wrong.append(f"{point.name}, rtol {rtol:g}: {word}, {value:.9g} ± {own:.1e}; {record}")
        every_point, values = joined(of)
        yield f"| **all** | {' | '.join(cells_of(records, every_point, *values))} |"
    yield from ("", "## Wrong", "", *(f"* {each}" for each in wrong))


#: Value, record and what is allowed between them, with the record's name.
Other = tuple[str, float, float, float]


def other_values(records: Any, step: int) -> Iterator[tuple[str, list[Other]]]:
    """Other values than s, by kind, of one in so many records."""
    circles, bodies, means = (
        [point for several in records.points(name).values() for point in several][::step]
        for name in ("circle", "body", "mean")
    )
    found = records.solved(circles, RTOLS[0])["s_surface"]
    yield (
        "the largest swt on the circle: s_surface",
        [
            (point.name, value, point.s, 2.0 * RTOLS[0] * point.s)
            for point, value in zip(circles, found, strict=True)
        ],
    )
    places = [(point, [point.values[name] for name in "xyz" if name in point.values]) for point in bodies]
    yield (
        "swt where it is largest in the body: stress_field",
        [
            (point.name, records.swt_at(point, place), point.s, point.error + RTOLS[0] * point.s)
            for point, place in places
            if place
        ],
    )
    of_means = []
    for point in means:
        own = records.means(point)
        for name in own:
            if f"{name}_error" in own and not records.is_elsewhere(name, own, point.values):
                value = point.values[name]
                allowed = own[f"{name}_error"] + point.values[f"{name}_error"] + records.OF_MEANS * value
                of_means.append((f"{point.name} {name}", own[name], value, allowed))
    yield "means over a critical distance", of_means
    lives = [(contact, contact.found()) for contact in records.contacts()[::step]]
    # With more damage the package has found a worse place.
    yield (
        "damage of counted cycles, at least",
        [
            (
                f"contact {k * step}",
                1.0 / max(own.cycles, known.cycles),
                1.0 / known.cycles,
                0.01 / known.cycles,
            )
            for k, (known, own) in enumerate(lives)
        ],
    )


def other_lines(records: Any, step: int) -> Iterator[str]:
    """The table of other values, and the wrong ones among them."""
    yield from ("", "## Other values", "")
    yield (
        f"{'All' if step == 1 else f'One in {step}'}. Low or high are means and damage that differ by more "
        "than all errors and 1 %, s_surface by 2e-4, and stress fields whose swt differs by more than 1e-4 "
        "and the record's error."
    )
    yield ""
    yield from ("| value | records | low | lowest | high | highest |", "|" + "---|" * 6)
    wrong = []
    for words, rows in other_values(records, step):
        low = [row for row in rows if row[1] < row[2] - row[3]]
        high = [row for row in rows if row[1] > row[2] + row[3]]
        off = np.array([value / max(known, 1e-300) - 1.0 for _, value, known, _ in rows])
        worst = f"{max(0.0, -off.min(initial=0.0)):.1e}", f"{off.max(initial=0.0):.1e}"
        yield f"| {words} | {len(rows)} | {len(low)} | {worst[0]} | {len(high)} | {worst[1]} |"
        wrong += [
            f"* {words}, {name}: {value:.9g}; recorded {known:.9g}, allowed {allowed:.1e}"
            for name, value, known, allowed in (*low, *high)
        ]
    yield from ("", *wrong)


def joined(
    found: Mapping[str, tuple[Sequence[Any], dict[str, Array]]],
) -> tuple[list[Any], tuple[Array, Array]]:
    """The points of all scenes, and s and s_error there."""
    several = [point for points, _ in found.values() for point in points]
    s, error = (np.concatenate([columns[name] for _, columns in found.values()]) for name in ("s", "s_error"))
    return several, (s, error)


def chart(found: Found) -> Figure:
    """The share of points that have less than a ratio of s_error to the error."""
    figure = Figure(figsize=(3.35, 2.4), layout="constrained")
    axes = figure.subplots()
    for rtol, of, style in zip(RTOLS, found, ("k-", "k--"), strict=True):
        several, values = joined(of)
        ratios = np.sort(ratios_of(several, *values))
        share = (np.arange(ratios.size) + 1.0) / max(ratios.size, 1)
        axes.plot(np.maximum(ratios, LEAST_DRAWN), 100.0 * share, style, label=f"rtol {rtol:g}")
    axes.axvline(1.0, color="0.6", linewidth=0.8)
    axes.set(xscale="log", xlabel="s_error / |error|", ylabel="points with less / %", ylim=(0.0, 100.0))
    figure.legend(loc="outside upper center", ncols=2, frameon=False)
    return figure


def found_of(
    records: Any, scene: str, points: Sequence[Any], index: NDArray[np.intp], rtol: float, given: Any
) -> dict[str, Array]:
    """Values at some points of a scene: from the folder of parts, the others from the solver."""
    part = given.parts and given.parts / f"{scene.replace('/', '÷')} {rtol:g}.npz"
    values = {name: np.full(len(points), np.nan) for name in COLUMNS}
    is_known = np.zeros(len(points), dtype=bool)
    if part and part.exists():
        before = np.load(part)
        is_known[: len(before["is_known"])] = before["is_known"]
        for name in COLUMNS:
            values[name][: len(before[name])] = before[name]
    missing = index[~is_known[index]]
    for some in np.array_split(missing, -(-len(missing) // TOGETHER)) if len(missing) else ():
        new = records.solved([points[k] for k in some], rtol, given.workers)
        is_known[some] = True
        for name in COLUMNS:
            values[name][some] = new[name]
        if part:
            kept: Any = {"is_known": is_known, **values}
            np.savez(part, **kept)
    return {name: of[index] for name, of in values.items()}


def write_misses(records: Any, found: Found, file: Path) -> None:
    """The points that are wrong at any tolerance, with what is recorded and what is found."""
    rows: list[dict[str, Any]] = []
    for rtol, scenes in zip(RTOLS, found, strict=True):
        for points, of in scenes.values():
            for point, s, error, x in zip(points, of["s"], of["s_error"], of["critical_x"], strict=True):
                word = records.verdict(point, s, error)
                if word == "right":
                    continue
                row = {"point": point.name, "rtol": rtol, "verdict": word, "s": s, "s_error": error}
                row |= {"x": x, "recorded": point.s, "recorded_error": point.error, "kind": point.kind}
                row |= {"recorded_x": point.critical_x, "source": point.source}
                path = point.arguments.get("load")
                vertices = {} if path is None else {"vertices": json.dumps(path.vertices.tolist())}
                rows.append(row | point.arguments | vertices)
    with file.open("w", encoding="utf-8", newline="") as text:
        table = csv.DictWriter(text, list(dict.fromkeys(key for row in rows for key in row)))
        table.writeheader()
        table.writerows(rows)


def main() -> int:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the report")
    arguments.add_argument(
        "--every", type=int, nargs=2, default=[1, 1], help="take one point of so many at each tolerance"
    )
    arguments.add_argument("--other", type=int, default=1, help="take one of so many other values than s")
    arguments.add_argument("--scenes", nargs="+", help="only these scenes")
    arguments.add_argument("--missed", type=int, default=0, help="how many values are known to be wrong")
    arguments.add_argument("--workers", type=int, default=2)
    arguments.add_argument("--parts", type=Path, help="folder that keeps what was found of each scene")
    arguments.add_argument("--misses", type=Path, help="CSV file for the points that are wrong")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    records = _records()
    scenes = {name: points for name, points in records.points().items() if name in (given.scenes or [name])}
    if given.quick:
        scenes, given.every, given.workers = dict([*scenes.items()][:1]), [1000, 1000], 1
        given.other = 1000
    if given.parts:
        given.parts.mkdir(parents=True, exist_ok=True)
    found: list[dict[str, tuple[Sequence[Any], dict[str, Array]]]] = []
    for rtol, every in zip(RTOLS, given.every, strict=True):
        found.append({})
        for name, points in scenes.items():
            index = np.arange(0, len(points), every)
            found[-1][name] = [points[k] for k in index], found_of(records, name, points, index, rtol, given)
            print(f"{name}, rtol {rtol:g}", flush=True)
    page = [*lines(records, found, given.every), *other_lines(records, given.other)]
    text = "\n".join(page) + "\n"
    (given.results / "truth.md").write_text(text, encoding="utf-8")
    if given.misses:
        write_misses(records, found, given.misses)
    chart(found).savefig(given.results / "truth.png", dpi=200)
    print(text)
    return int(sum(line.startswith("* ") for line in text.splitlines()) > given.missed)


if __name__ == "__main__":
    sys.exit(main())
