"""The profiles that a study defines as tables, in its text or in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
from swtstudy.study.columns import check_form, form_of, read_columns
from swtstudy.study.loops import place_of
from swtstudy.study.trace import read_trace
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.families import AXISYMMETRIC
from swtstudy.vocabulary.mistakes import Report, StudyError

#: Columns of the file of a profile.
COLUMNS = ("radius", "height")

_RADII = np.linspace(0.0, 1e3, 9)
_ANY = TabulatedProfile("any", _RADII, _RADII**2)


def table_from(path: Path, smoothing: float = 0.0) -> TabulatedProfile:
    """The profile in a CSV file, of the name of the file."""
    radius, height = read_columns(path, COLUMNS).T
    return TabulatedProfile(path.stem, radius, height, smoothing)


def _profile(name: str, table: Mapping[str, Any], folder: Path) -> TabulatedProfile:
    """A profile from its table."""
    geometry, smoothing = table.get("geometry", AXISYMMETRIC), table.get("smoothing")
    if table.get("two_sided") is True:
        form = {key: table[key] for key in ("columns", "separator", "decimal") if key in table}
        level = table.get("level") is not False
        given = {"level": level, "smoothing": smoothing, "geometry": geometry, **form}
        return read_trace(folder / str(table.get("file")), name=name, **given)
    smoothing = 0.0 if smoothing is None else smoothing
    if "file" not in table:
        return TabulatedProfile(name, table["radius"], table["height"], smoothing, geometry)
    check_form(table, COLUMNS, report := Report())
    report.refuse()
    radius, height = read_columns(folder / table["file"], COLUMNS, (), form_of(table)).T
    return TabulatedProfile(name, radius, height, smoothing, geometry)


def read_profiles(tables: Mapping[str, Any], folder: Path, report: Report) -> dict[str, Definition]:
    """The profiles of a study, by name; as `swtstudy.study.loops.read_loops` for loads."""
    # A wrong profile stands for any: that it is used is no mistake of its own.
    found: dict[str, Definition] = {name: _ANY for name in tables}
    for name, table in tables.items():
        key = f"profiles.{name}"
        given = [each for each in (*COLUMNS, "file") if table.get(each) is not None]
        if not isinstance(table.get("file", ""), str):
            continue  # reported with the structure
        if given not in (["file"], [*COLUMNS]):
            words = " and ".join(given) or "nothing"
            report(key, words, "radius and height, or file")
            continue
        try:
            found[name] = _profile(name, table, folder)
        except StudyError as error:
            for each in error.mistakes:
                report(key, f"{each.found}{place_of(each)}", each.allowed)
    return found
