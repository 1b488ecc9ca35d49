"""The profiles that a study defines as tables, in its text or in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.families import AXISYMMETRIC
from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
from swtstudy.mistakes import Mistake, StudyError
from swtstudy.named import Named
from swtstudy.study.columns import read_columns
from swtstudy.study.loops import place_of

#: Columns of the file of a profile.
COLUMNS = ("radius", "height")

_RADII = np.linspace(0.0, 1e3, 9)
_ANY = TabulatedProfile("any", _RADII, _RADII**2)


def table_from(path: Path) -> TabulatedProfile:
    """The profile in a CSV file, of the name of the file."""
    return TabulatedProfile(path.stem, *read_columns(path, COLUMNS).T)


def read_profiles(
    tables: Mapping[str, Any], folder: Path, source: str
) -> tuple[dict[str, Named], list[Mistake]]:
    """The profiles of a study, by name, and all that is wrong with them; as `read_loops` for loads."""
    # A wrong profile stands for any: that it is used is no mistake of its own.
    found: dict[str, Named] = {name: _ANY for name in tables}
    mistakes: list[Mistake] = []
    for name, table in tables.items():
        key = f"profiles.{name}"
        given = [each for each in (*COLUMNS, "file") if table.get(each) is not None]
        if not isinstance(table.get("file", ""), str):
            continue  # reported with the structure
        if given not in (["file"], [*COLUMNS]):
            words = " and ".join(given) or "nothing"
            mistakes.append(Mistake(key, words, "radius and height, or file", source))
            continue
        try:
            if given == ["file"]:
                radius, height = read_columns(folder / table["file"], COLUMNS).T
            else:
                radius, height = table["radius"], table["height"]
            found[name] = TabulatedProfile(
                name, radius, height, table.get("smoothing", 0.0), table.get("geometry", AXISYMMETRIC)
            )
        except StudyError as error:
            mistakes += [
                Mistake(key, f"{each.found}{place_of(each)}", each.allowed, source) for each in error.mistakes
            ]
    return found, mistakes
