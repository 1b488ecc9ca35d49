"""Pydantic's errors about the structure of a study file, worded like the other mistakes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ValidationError

from swtstudy.study.tables import (
    BlockTable,
    FigureTable,
    LoadTable,
    ProfileTable,
    RangeTable,
    SampleTable,
    StudyTable,
)
from swtstudy.vocabulary.accuracy import ALLOWED_RTOL
from swtstudy.vocabulary.mistakes import Mistake, literal, nearest

#: What is allowed at a key, where pydantic's own message would not say it.
_ALLOWED = {
    "title": "a text that is not empty",
    "rtol": ALLOWED_RTOL,
    "fixed": "a table of single values",
    "axes": "a table of axes",
    "sample": "a table with design, size and ranges, or with file",
    "sample.design": '"sobol", "latin_hypercube", "random" or "saltelli"',
    "sample.size": "a whole number",
    "sample.seed": "a whole number",
    "sample.ranges": "a table of ranges",
    "sample.file": "the path of a CSV file",
    "sample.points": "a table of lists of values",
    "units": "a table with length, force and stress",
    "material": "a table of fatigue constants",
    "loads": "a table of loops, [loads.NAME]",
    "profiles": "a table of profiles, [profiles.NAME]",
    "figure": "a table with x and, optionally, kind, vertical, hue, panels, y, title, regimes and validity",
    "figure.kind": '"lines", "life", "contour", "heatmap", "scatter" or "histogram"',
    "figure.vertical": "the name of an axis",
    "figure.x": "the name of an axis",
    "figure.hue": "the name of an axis",
    "figure.panels": "the name of an axis",
    "figure.y": 'a text, or a list of texts, such as "s" or "s/s(flat_radius=0)"',
    "figure.title": "a text",
    "figure.regimes": "true or false",
    "figure.validity": "true or false",
}


def read_structure(raw: Mapping[str, Any], source: str) -> tuple[StudyTable | None, list[Mistake]]:
    """The tables of a study file, or all that is wrong with their structure."""
    try:
        return StudyTable.model_validate(raw), []
    except ValidationError as error:
        found = {_mistake(detail, source) for detail in error.errors(include_url=False)}
        return None, sorted(found, key=lambda mistake: mistake.key)


def _mistake(detail: Any, source: str) -> Mistake:
    path = list(detail["loc"])
    if path[0] == "axes" and path[2:3] in (["list"], ["range"]):
        del path[2]  # pydantic's tag, not a key
    if path[:2] == ["figure", "y"]:
        path = path[:2]  # both members of the union report it: one mistake is enough
    key = ".".join(map(str, path))
    if detail["type"] == "extra_forbidden":
        return Mistake(key, f"unknown key {literal(path[-1])}", nearest(str(path[-1]), _known(path)), source)
    if path[0] == "axes" and len(path) == 2:
        allowed = "a list of values or {start, stop, num}"
    elif path[0] == "loads" and len(path) == 2:
        allowed = "a table with vertices or file"
    elif path[0] == "profiles" and len(path) == 2:
        allowed = "a table with radius and height, or file"
    elif path[0] == "blocks":
        allowed = "the name of a load" if path[-1] == "load" else "[[blocks]] with load and rounds"
    elif path[-1] in ("keep_cycles", "two_sided", "level"):
        allowed = "true or false"
    elif path[0] in ("loads", "profiles") and path[-1] == "file":
        allowed = "the path of a CSV file"
    elif path[0] == "axes" and path[-1] == "spacing":
        allowed = '"linear" or "log"'
    elif path[0] == "axes" and path[-1] == "also":
        allowed = "a list of values"
    elif path[0] == "axes" and path[-1] == "num":
        allowed = "a whole number"
    else:
        allowed = _ALLOWED.get(key, detail["msg"])
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(key, found, allowed, source)


def _known(path: list[Any]) -> list[str]:
    inner: dict[str, type[BaseModel]] = {
        "axes": RangeTable,
        "sample": SampleTable,
        "loads": LoadTable,
        "profiles": ProfileTable,
        "blocks": BlockTable,
        "figure": FigureTable,
    }
    model = inner.get(str(path[0]), StudyTable) if len(path) > 1 else StudyTable
    return list(model.model_fields)
