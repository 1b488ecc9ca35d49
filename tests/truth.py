"""Recorded values of s that any solver has to reproduce (`tests/data/truth`), as arguments of `solve`.

Each row of a table holds all parameters of a point under their public names, the value, its own error and how
it was obtained. Values with a bulk stress are those of a stick zone in place. ``loads*.json`` and
``profiles*.json`` hold the loops and tables that the columns ``load`` and ``profile`` name. A column is empty
where a point does not use the parameter. ``cycles.json`` holds contacts with units, and their counted strain
cycles.
"""

from __future__ import annotations

import csv
import gzip
import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

import swtstudy

FOLDER = Path(__file__).parent / "data" / "truth"
#: Columns that describe a point and are no parameters of `solve`.
ABOUT = ("draw", "scene", "control", "kind", "s", "error", "critical_x", "critical_angle", "source")
#: Columns with more values of a point, or their places.
VALUES = (
    *("x", "y", "z", "s_volume", "s_volume_error", "volume_x"),
    *(
        name
        for of in ("point", "line")
        for way in ("depth", "critical_plane")
        for name in (f"s_{of}_{way}", f"s_{of}_{way}_error", f"{of}_x_{way}")
    ),
)
#: Parameters that are text; all others are numbers.
TEXT = ("profile", "frequency_ratio", "load", "criterion")
#: Parameters that are one in a study of `solved`.
FIXED = ("profile", "criterion", "stick_zone_shift")


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
        "value", "at_least" if the recorded value is a lower bound, "no_equilibrium" or "not_finite" without
        one.
    s, error
        The value and its absolute error, –; NaN without a value, error 0 if it is unknown.
    critical_x, critical_angle
        Position in a_H, and angle of the plane's normal to x in degrees; NaN if unknown.
    source
        How the value was obtained.
    values
        Other values of the point by their column.
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
    values: dict[str, float] = field(default_factory=dict)


class Scene(Sequence[Point]):
    """The recorded points of a scene; each is read from its row when it is asked for."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._rows: list[tuple[list[str], list[str]]] = []

    def add(self, columns: list[str], row: list[str]) -> None:
        """Add a row of a table."""
        self._rows.append((columns, row))

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Point: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Point]: ...

    def __getitem__(self, index: int | slice) -> Point | Sequence[Point]:
        numbers = range(len(self))[index]
        if isinstance(numbers, range):
            return [self._point(number) for number in numbers]
        return self._point(numbers)

    def _point(self, number: int) -> Point:
        return _point(dict(zip(*self._rows[number], strict=True)), f"{self.name} {number}")


@cache
def points(pattern: str = "line_*") -> dict[str, Scene]:
    """The recorded points by scene, of the files whose names match a pattern."""
    found: dict[str, Scene] = {}
    for file in sorted(FOLDER.glob(f"{pattern}.csv.gz")):
        with gzip.open(file, "rt", encoding="utf-8", newline="") as text:
            columns, *several = csv.reader(text)
        place = columns.index("scene")
        for row in several:
            found.setdefault(row[place], Scene(row[place])).add(columns, row)
    return found


def _point(row: dict[str, str], name: str) -> Point:
    arguments: dict[str, Any] = {
        key: value if key in TEXT else float(value)
        for key, value in row.items()
        if value and key not in ABOUT and key not in VALUES
    }
    if "load" in arguments:
        arguments["load"] = load(arguments["load"])
    arguments["profile"] = profile(arguments["profile"])
    if arguments.get("bulk_stress_amplitude"):
        arguments["stick_zone_shift"] = "none"
    s, x, angle = (float(row[key] or "nan") for key in ("s", "critical_x", "critical_angle"))
    error = float(row["error"] or 0.0)
    values = {key: float(row[key]) for key in VALUES if row.get(key)}
    return Point(name, row["scene"], arguments, row["kind"], s, error, x, angle, row["source"], values)


@cache
def _defined(pattern: str) -> dict[str, Any]:
    files = sorted(FOLDER.glob(pattern))
    return {name: of for file in files for name, of in json.loads(file.read_text(encoding="utf-8")).items()}


@cache
def load(name: str) -> object:
    """The loop of a name: its vertices are the loads' deviations from the mean over the amplitudes."""
    return swtstudy.LoadPath(name, _defined("loads*.json")[name])


@cache
def profile(name: str) -> object:
    """The table of a name, or the name itself if the profile is built in."""
    tables = _defined("profiles*.json")
    return swtstudy.TabulatedProfile(name, **tables[name]) if name in tables else name


#: What `solved` tells of each point.
FOUND = ("s", "s_error", "critical_x", "s_surface")


def solved(several: Sequence[Point], rtol: float, workers: int = 1) -> dict[str, NDArray[np.float64]]:
    """What the solver finds at points, in their order: the values `FOUND` of each; NaN without an s.

    Points with the same parameters are run as the sample of one study, at a tenth of the cost of `solve`.
    """
    found = {name: np.full(len(several), np.nan) for name in FOUND}
    groups: dict[tuple[str, ...], list[int]] = {}
    for k, point in enumerate(several):
        of = point.arguments
        kind = (_name(of["profile"]), of.get("criterion", ""), "load" if "load" in of else "", *of)
        groups.setdefault(kind, []).append(k)
    with TemporaryDirectory() as folder:
        for number, group in enumerate(groups.values()):
            study = swtstudy.Study.from_text(_study([several[k].arguments for k in group], rtol))
            result = swtstudy.run(study, Path(folder) / f"{number}.nc", workers=workers)
            for name, values in found.items():
                values[group] = result[name].values
    return found


def _study(several: Sequence[dict[str, Any]], rtol: float) -> str:
    """The text of a study whose sample is the points; JSON's numbers, texts and lists are those of TOML."""
    columns = {name: [arguments[name] for arguments in several] for name in several[0]}
    fixed: dict[str, Any] = {name: columns.pop(name)[0] for name in FIXED if name in columns}
    lines = ['title = "Recorded points"', f"rtol = {rtol!r}"]
    for path in dict.fromkeys(columns.get("load", [])):
        lines += [f"[loads.{json.dumps(path.name)}]", *_keys({"vertices": path.vertices.tolist()})]
    if not isinstance(fixed["profile"], str):
        name = fixed["profile"].name
        lines += [f"[profiles.{json.dumps(name)}]", *_keys(_defined("profiles*.json")[name])]
    lines += ["[fixed]", *_keys(fixed), "[sample.points]", *_keys(columns)]
    return "\n".join(lines)


def _keys(table: dict[str, Any]) -> list[str]:
    return [f"{name} = {json.dumps(value, default=_name)}" for name, value in table.items()]


def _name(of: Any) -> str:
    return str(getattr(of, "name", of))


def swt_at(point: Point, place: tuple[float, float, float]) -> float:
    """swt at a place over all planes, of its history of stress at the instants that matter there."""
    given = {name: value for name, value in point.arguments.items() if name != "critical_distance"}
    field = swtstudy.stress_field(*place, **given)
    history = np.stack([field[f"sigma_{name}"].values for name in COMPONENTS], axis=-1)
    ν, exponent = given["poisson_ratio"], given.get("walker_exponent", 0.5)
    return float(swtstudy.swt_of_history(history, ν, 1.0 - ν * ν, exponent).swt)


#: Of stress, in the order of `swtstudy.swt_of_history`.
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")


def largest_in_body(point: Point) -> float:
    """The largest swt of the body, as an audit finds it."""
    study = swtstudy.Study.from_text(_study([point.arguments], 1e-4))
    with TemporaryDirectory() as folder:
        audit = swtstudy.audit_study(study, Path(folder) / "audit.nc", points=1, workers=1)
    return float(audit.s_body.values[0])


def means(point: Point, rtol: float = 1e-4) -> dict[str, float]:
    """Means at a critical distance, as records have them."""
    found = swtstudy.solve(**point.arguments, rtol=rtol)
    values = {name: float(found[name]) for name in ("s_volume", "s_volume_error", "volume_x")}
    for of in ("point", "line"):
        for way in found.direction.values:
            one = found.sel(direction=way)
            values |= {f"s_{of}_{way}": float(one[f"s_{of}"]), f"{of}_x_{way}": float(one[f"{of}_x"])}
            values[f"s_{of}_{way}_error"] = float(one[f"s_{of}_error"])
    return values


@dataclass(frozen=True)
class Counted:
    """A contact with units (N, mm), and its strain cycles.

    Attributes
    ----------
    arguments
        Those of `swtstudy.physical`.
    s, cycles
        s, and the rounds of the load by `ALUMINIUM`.
    shares
        SWT of the strain cycles at the critical place over the largest SWT, descending.
    """

    arguments: dict[str, Any]
    s: float
    cycles: float
    shares: NDArray[np.float64]

    def found(self) -> Counted:
        """The same by the package, without the smallest cycles."""
        result = swtstudy.physical(**self.arguments).solve(rtol=1e-4, constants=ALUMINIUM)
        result = result.isel(body=0) if "body" in result.dims else result
        shares = result.counted.values.reshape(-1, result.sizes["counted_cycle"])[0]
        return Counted(self.arguments, float(result.s), float(result.cycles), _large(shares))


#: Constants of an alloy, MPa.
ALUMINIUM = swtstudy.FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
#: Smaller shares make next to no damage.
SMALL = 0.05


def _large(shares: NDArray[np.float64]) -> NDArray[np.float64]:
    return shares[shares > SMALL]


def contacts() -> list[Counted]:
    """The contacts of ``cycles.json``."""
    found = []
    for each in json.loads((FOLDER / "cycles.json").read_text(encoding="utf-8")):
        given = each["contact"]
        if "bulk_stress_amplitude" in given:
            given["stick_zone_shift"] = "none"
        if "load" in given:
            given["load"] = swtstudy.LoadPath("counted", given["load"])
        shares = np.array(each["counted"][0], dtype=float)
        found.append(Counted(given, each["s"], each["cycles"], _large(shares)))
    return found


#: Relative share of a mean that counts as equal beside the errors: 3 of 944 were off by 1e-2.
OF_MEANS = 1e-2


def is_elsewhere(name: str, found: dict[str, float], recorded: dict[str, float]) -> bool:
    """Whether a larger mean was found about another place than the recorded one."""
    kind, _, way = name.removeprefix("s_").partition("_")
    place = f"{kind}_x_{way}" if way else f"{kind}_x"
    return found[name] > recorded[name] and abs(found[place] - recorded[place]) > 1e-3


def off_means(point: Point, rtol: float = 1e-4) -> dict[str, tuple[float, float]]:
    """The means that differ from the record by more than all errors: found and recorded."""
    found, recorded = means(point, rtol), point.values
    return {
        name: (value, recorded[name])
        for name, value in found.items()
        if f"{name}_error" in recorded
        and abs(value - recorded[name])
        > found[f"{name}_error"] + recorded[f"{name}_error"] + OF_MEANS * recorded[name]
        and not is_elsewhere(name, found, recorded)
    }


#: Relative share of s that counts as equal: records have 11 digits.
ROUNDING = 1e-7


def verdict(point: Point, s: float, s_error: float) -> str:
    """Compare a solver's s with the record: "right", "low" or "high" beyond both errors."""
    if point.kind in ("no_equilibrium", "not_finite"):
        return "right" if s != s else "high"
    allowed = s_error + point.error + ROUNDING * point.s
    if not s >= point.s - allowed:
        return "low"
    return "high" if point.kind == "value" and s > point.s + allowed else "right"
