"""The attributes of an archive: reading them, and the versions with which it was made.

Malformed ones raise a ValueError with the reason. Nothing here imports xarray, which workers need not wait
for.
"""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Collection, Hashable, Iterable, Mapping
from dataclasses import asdict, fields
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from swtstudy.points.found import Run
from swtstudy.study.figure import VARIABLES, FigureLayout, reference, wrong_layout
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import literal, plain_number
from swtstudy.vocabulary.quantities import COUNTS, DISTANCE, EVERY_VARIABLE, NAMED
from swtstudy.vocabulary.version import __version__


def read_runs(text: object) -> list[dict[str, Any]]:
    """The runs that made the values, with their ``seconds`` of computing."""
    runs = _json(text, list)
    for raw in runs:
        if not isinstance(raw, dict) or not {*raw} <= {*(item.name for item in fields(Run)), "seconds"}:
            raise ValueError(f"not a run: {literal(raw)}")
        for name, kind in (("solver_version", str), ("rtol", float), ("study", str), ("versions", str)):
            if not isinstance(raw.get(name), kind):
                raise ValueError(f"{name} of a run: {literal(raw[name]) if name in raw else 'nothing'}")
        raw.setdefault("seconds", 0.0)
        names, seconds = raw.get("quantities", []), raw["seconds"]
        if not isinstance(names, list) or not {*map(str, names)} <= {*NAMED, COUNTS, DISTANCE}:
            raise ValueError(f"quantities of a run: {literal(names)}")
        if not 0.0 <= plain_number(seconds) < math.inf:
            raise ValueError(f"seconds of a run: {literal(seconds)}")
    return runs


def definitions_text(definitions: Iterable[Definition]) -> str:
    """Write the user's definitions as an attribute; see `read_definitions`."""
    return json.dumps(
        [
            {"parameter": each.parameter, "name": each.name, "content": each.content(), **each.notes()}
            for each in definitions
        ]
    )


def read_definitions(text: object) -> dict[str, dict[str, Definition]]:
    """Read the user's definitions, by parameter and name."""
    from swtstudy.loads.load_path import LoadPath
    from swtstudy.profiles.table import TabulatedProfile

    kinds: dict[str, type[Definition]] = {each.parameter: each for each in (LoadPath, TabulatedProfile)}
    found: dict[str, dict[str, Definition]] = {}
    for raw in _json(text, list):
        try:
            defined = kinds[raw["parameter"]].of_content(raw["name"], raw["content"])
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"not a definition: {literal(raw)} ({error})") from None
        found.setdefault(raw["parameter"], {})[raw["name"]] = defined
    return found


def defined_in(attributes: Mapping[Hashable, Any]) -> dict[str, dict[str, Definition]]:
    """Read the user's definitions, by parameter and name, from the attributes of a Dataset."""
    return read_definitions(attributes.get("definitions", "[]"))


def read_figure(text: object, others: Collection[str] = ()) -> FigureLayout:
    """The layout of the figure, which may show others than what every study may have."""
    raw = _json(text, dict)
    try:
        layout = FigureLayout.from_json(str(text))
    except (KeyError, TypeError):
        raise ValueError(f"not the layout of a figure: {literal(raw)}") from None
    texts = [layout.x, layout.kind, *layout.y]
    texts += [word for word in (layout.hue, layout.panels, layout.title, layout.vertical) if word is not None]
    marks = layout.regimes, layout.validity
    if not all(isinstance(word, str) for word in texts) or not all(isinstance(mark, bool) for mark in marks):
        raise ValueError(f"not the layout of a figure: {literal(asdict(layout))}")
    for key, found, allowed in wrong_layout(layout):
        raise ValueError(f"{key.removeprefix('figure.')}: found {found}; allowed: {allowed}")
    for y in layout.y:
        if reference(y) is None and y.strip() not in (*VARIABLES, *EVERY_VARIABLE, *others):
            raise ValueError(f"{literal(y)} is not a quantity")
    return layout


def _json(text: object, kind: type) -> Any:
    if not isinstance(text, str):
        raise ValueError("not a text")
    try:
        raw = json.loads(text)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    except ValueError as error:
        raise ValueError(f"not JSON: {error}") from None
    if not isinstance(raw, kind):
        raise ValueError("not a list" if kind is list else "not a table")
    return raw


#: Packages whose versions can affect the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")


def versions() -> str:
    """Versions of Python, of this package and of those that affect its numbers and files."""
    found = [f"python {platform.python_version()}", f"swtstudy {__version__}"]
    for name in _PACKAGES:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    return ", ".join(found)
