"""Recorded values of s that any solver has to reproduce (`tests/data/truth`), as arguments of `solve`.

Each row of ``line_*.csv.gz`` holds all parameters of a point under their public names, the value, its own
error and how it was obtained. ``loads.json`` and ``profiles.json`` hold the loops and tables that the columns
``load`` and ``profile`` name. A column is empty where a point does not use the parameter.
"""

from __future__ import annotations

import csv
import gzip
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import swtstudy

FOLDER = Path(__file__).parent / "data" / "truth"
#: Columns that describe a point and are no parameters of `solve`.
ABOUT = ("scene", "control", "kind", "s", "error", "critical_x", "critical_angle", "source")
#: Parameters that are text; all others are numbers.
TEXT = ("profile", "frequency_ratio", "load", "criterion")


@dataclass(frozen=True)
class Point:
    """A recorded point.

    Attributes
    ----------
    name
        Scene and number of the row in its scene: "forces 17".
    scene
        What the point was drawn from.
    arguments
        The arguments of `swtstudy.solve`, without those that have no meaning for the point.
    kind
        "value", "at_least" if the recorded value is a lower bound, or "no_equilibrium" without one.
    s, error
        The value and its absolute error, –; NaN without a value, error 0 if it is unknown.
    critical_x, critical_angle
        Position in a_H, and angle of the plane's normal to x in degrees; NaN if unknown.
    source
        How the value was obtained.
    """

    name: str
    scene: str
    arguments: dict[str, Any]
    kind: str
    s: float
    error: float
    critical_x: float
    critical_angle: float
    source: str


@cache
def points(pattern: str = "line_*") -> dict[str, tuple[Point, ...]]:
    """The recorded points by scene, of the files whose names match a pattern."""
    found: dict[str, list[Point]] = {}
    for file in sorted(FOLDER.glob(f"{pattern}.csv.gz")):
        for row in rows(file):
            scene = found.setdefault(row["scene"], [])
            scene.append(_point(row, f"{row['scene']} {len(scene)}"))
    return {scene: tuple(several) for scene, several in found.items()}


def rows(file: Path) -> Iterator[dict[str, str]]:
    """The rows of a compressed CSV file."""
    with gzip.open(file, "rt", encoding="utf-8", newline="") as text:
        yield from csv.DictReader(text)


def _point(row: dict[str, str], name: str) -> Point:
    arguments: dict[str, Any] = {
        key: value if key in TEXT else float(value)
        for key, value in row.items()
        if value and key not in ABOUT
    }
    if "load" in arguments:
        arguments["load"] = load(arguments["load"])
    arguments["profile"] = profile(arguments["profile"])
    s, x, angle = (float(row[key] or "nan") for key in ("s", "critical_x", "critical_angle"))
    error = float(row["error"] or 0.0)
    return Point(name, row["scene"], arguments, row["kind"], s, error, x, angle, row["source"])


@cache
def _defined(file: str) -> dict[str, Any]:
    return dict(json.loads((FOLDER / file).read_text(encoding="utf-8")))


@cache
def load(name: str) -> object:
    """The loop of a name: its vertices are the loads' deviations from the mean over the amplitudes."""
    return swtstudy.LoadPath(name, _defined("loads.json")[name])


@cache
def profile(name: str) -> object:
    """The table of a name, or the name itself if the profile is built in."""
    tables = _defined("profiles.json")
    return swtstudy.TabulatedProfile(name, **tables[name]) if name in tables else name
