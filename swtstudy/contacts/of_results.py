"""The contacts of results and of studies with units."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.archive.recall import grid_of
from swtstudy.contacts.contact import PhysicalContact
from swtstudy.study.definition import study_from
from swtstudy.units.grid import PhysicalGrid
from swtstudy.vocabulary.files import parse_toml, read_text
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.prescribed import PAIRS

if TYPE_CHECKING:
    import xarray as xr


def contact_of(dataset: xr.Dataset) -> PhysicalContact:
    """The contacts of results.

    Raises
    ------
    StudyError
        If they have no units, or what a contact needs has been dropped.
    """
    grid = grid_of(dataset)
    if not isinstance(grid, PhysicalGrid):
        raise StudyError([Mistake("units", "results without units", "those of a study with [units]")])
    return PhysicalContact(grid)


def contact_of_study(path: str, values: Mapping[str, object]) -> PhysicalContact:
    """The one contact of a study file, with other values of some parameters, or values along its axes.

    Raises
    ------
    StudyError
        With every mistake; also if the study has no units, or an axis of it has no value here.
    """
    try:
        raw = parse_toml(read_text(Path(path)))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise StudyError([Mistake("", reason, "a readable study file (TOML)", path)]) from None
    replaced = {*values}.union(*({*pair} for pair in PAIRS.items() if {*pair} & values.keys()))
    fixed, axes = (raw.get(key) or {} for key in ("fixed", "axes"))
    open_axes = [name for name in axes if name not in replaced and name != "critical_distance"]
    if open_axes:
        found = f"several values of {', '.join(open_axes)}"
        raise StudyError([Mistake("", found, "one of each, such as " + _option(open_axes[0]), path)])
    kept = {key: table for key, table in raw.items() if key not in ("axes", "sample", "figure")}
    kept["fixed"] = {name: value for name, value in fixed.items() if name not in replaced} | dict(values)
    grid = study_from(kept, "", path, Path(path).parent).grid
    if not isinstance(grid, PhysicalGrid):
        raise StudyError([Mistake("units", "a study without units", "one with [units]", path)])
    return PhysicalContact(grid)


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')} VALUE"
