"""The attributes of an archive: reading them, and the versions with which it was made.

Malformed ones raise a ValueError with the reason. Nothing here imports xarray, which workers need not wait
for.
"""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Collection, Hashable, Iterable, Mapping
from dataclasses import MISSING, asdict, fields
from importlib.metadata import PackageNotFoundError, version
from typing import Any, TypedDict

from swtstudy.points.records import Run
from swtstudy.study.figure import VARIABLES, FigureLayout, reference, wrong_layout
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import literal, plain_number
from swtstudy.vocabulary.quantities import EVERY_VARIABLE, is_item
from swtstudy.vocabulary.version import __version__


class Failure(TypedDict):
    """A failed point: its canonical row, its description, and why it failed."""

    row: list[float]
    point: str
    message: str


def read_runs(text: object) -> tuple[Run, ...]:
    """The runs that made the values."""
    return tuple(_run(raw) for raw in _json(text, list))


def read_failures(text: object) -> list[Failure]:
    """The points that failed."""
    failures = _json(text, list)
    for failure in failures:
        if not isinstance(failure, dict) or failure.keys() != Failure.__annotations__.keys():
            raise ValueError(f"not a failure: {literal(failure)}")
        row, words = failure["row"], (failure["point"], failure["message"])
        good = isinstance(row, list) and all(math.isfinite(plain_number(number)) for number in row)
        if not good or not all(isinstance(word, str) for word in words):
            raise ValueError(f"not a failure: {literal(failure)}")
    return failures


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


def _run(raw: object) -> Run:
    names = {item.name for item in fields(Run)}
    if not isinstance(raw, dict) or not raw.keys() <= names:
        raise ValueError(f"not a run: {literal(raw)}")
    for item in fields(Run):
        value = raw.get(item.name, item.default)
        if item.name == "quantities":
            good = isinstance(value, list | tuple) and all(map(is_item, value))
        else:
            good = isinstance(value, str) if item.type == "str" else 0.0 <= plain_number(value) < math.inf
        if not good:
            raise ValueError(f"{item.name} of a run: {'nothing' if value is MISSING else literal(value)}")
    return Run.from_json(raw)


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
