"""The loops of loads that a study defines, in its text or in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.mistakes import Mistake, StudyError
from swtstudy.named import Named
from swtstudy.study.columns import read_columns

#: Columns of the file of a loop, and one that it may have.
COLUMNS, BULK = ("normal", "tangential"), "bulk"

_ANY = LoadPath("any", [[0.0, 0.0], [0.0, 1.0]])


def read_loops(
    tables: Mapping[str, Any], folder: Path, source: str
) -> tuple[dict[str, Named], list[Mistake]]:
    """The loops of a study, by name, and all that is wrong with them.

    Parameters
    ----------
    tables
        What the study has under ``loads``, as far as its structure is sound.
    folder
        That of the study, to which the paths of files are relative.
    source
        The study, for messages.
    """
    # A wrong loop stands for any: that it is used is no mistake of its own.
    found: dict[str, Named] = {name: _ANY for name in tables}
    mistakes: list[Mistake] = []
    for name, table in tables.items():
        key = f"loads.{name}"
        if not isinstance(table.get("file", ""), str):
            continue  # reported with the structure
        keys = ("vertices", "file", *COLUMNS, BULK)
        given = [each for each in keys if table.get(each) is not None]
        if given not in (["vertices"], ["file"], [*COLUMNS], [*COLUMNS, BULK]):
            given_words = " and ".join(given) or "nothing"
            allowed = "vertices, file, or normal and tangential, with or without bulk"
            mistakes.append(Mistake(key, given_words, allowed, source))
            continue
        try:
            found[name] = _loop(name, table, given[0], folder)
        except StudyError as error:
            where = f"{key}.{given[0]}" if len(given) == 1 else key
            mistakes += [
                Mistake(where, f"{each.found}{place_of(each)}", each.allowed, source)
                for each in error.mistakes
            ]
    return found, mistakes


def _loop(name: str, table: Mapping[str, Any], kind: str, folder: Path) -> Named:
    if kind == "normal":
        return LoadPath.harmonic_sum(name, table["normal"], table["tangential"], table.get("bulk") or ())
    if kind == "vertices":
        return LoadPath(name, table["vertices"])
    return LoadPath(name, read_columns(folder / table["file"], COLUMNS, (BULK,)))


def place_of(mistake: Mistake) -> str:
    """Where in a file or a list the mistake is."""
    place = ": ".join(part for part in (mistake.source, mistake.key) if part)
    return f" ({place})" if place else ""
