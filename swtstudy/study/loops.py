"""The loops of loads that a study defines, in its text or in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.mistakes import Mistake, StudyError
from swtstudy.named import Named
from swtstudy.study.columns import read_columns

#: Columns of the file of a loop.
COLUMNS = ("normal", "tangential")

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
        given = [each for each in ("vertices", "file") if table.get(each) is not None]
        if not isinstance(table.get("file", ""), str):
            continue  # reported with the structure
        if len(given) != 1:
            mistakes.append(Mistake(key, "both" if given else "neither", "vertices or file", source))
            continue
        try:
            vertices = (
                table["vertices"] if given == ["vertices"] else read_columns(folder / table["file"], COLUMNS)
            )
            found[name] = LoadPath(name, vertices)
        except StudyError as error:
            mistakes += [
                Mistake(f"{key}.{given[0]}", f"{each.found}{_place(each)}", each.allowed, source)
                for each in error.mistakes
            ]
    return found, mistakes


def _place(mistake: Mistake) -> str:
    """Where in a file or a list the mistake is."""
    place = ": ".join(part for part in (mistake.source, mistake.key) if part)
    return f" ({place})" if place else ""
