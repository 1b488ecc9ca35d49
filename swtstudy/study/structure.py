"""Pydantic's errors about the structure of a study file, worded like the other mistakes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from swtstudy.study.tables import (
    Allowed,
    BlockTable,
    FigureTable,
    LoadTable,
    ProfileTable,
    RangeTable,
    SampleTable,
    StudyTable,
    Table,
)
from swtstudy.vocabulary.mistakes import Mistake, literal, nearest

#: The tables within a study: how many keys lead to one, and its keys.
_INNER: dict[str, tuple[int, type[Table]]] = {
    "axes": (2, RangeTable),
    "sample": (1, SampleTable),
    "loads": (2, LoadTable),
    "profiles": (2, ProfileTable),
    "blocks": (2, BlockTable),
    "figure": (1, FigureTable),
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
    allowed = _allowed(path) or detail["msg"]
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(key, found, allowed, source)


def _allowed(path: list[Any]) -> str:
    """Words for what a key or the place of a table may hold; empty where pydantic's message says it."""
    depth, table = _INNER.get(str(path[0]), (0, StudyTable))
    if len(path) == depth:
        return table.allowed
    if len(path) > depth + 1:
        return ""
    model, name = (table, path[depth]) if len(path) > depth else (StudyTable, path[0])
    metadata = model.model_fields[name].metadata if name in model.model_fields else []
    return next((each.words for each in metadata if isinstance(each, Allowed)), "")


def _known(path: list[Any]) -> list[str]:
    depth, table = _INNER.get(str(path[0]), (0, StudyTable))
    return list((table if len(path) > depth else StudyTable).model_fields)
