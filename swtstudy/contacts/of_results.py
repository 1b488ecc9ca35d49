"""The contacts of results and of studies with units."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.archive.recall import grid_of
from swtstudy.contacts.contact import PhysicalContact
from swtstudy.study.definition import study_from, tables_of
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.rows import REST_DEPENDS_ON
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal
from swtstudy.vocabulary.parameters import PAIRS

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


def contact_of_study(
    path: str, values: Mapping[str, object], smoothing: float | None = None, at_rest: bool = False
) -> PhysicalContact:
    """The one contact of a study file, with other values of some parameters, or values along its axes.

    Parameters
    ----------
    path
        The study file.
    values
        Its parameters, over those of the study; the profile may be a CSV file.
    smoothing
        Of a profile that is a table, over that of the study.
    at_rest
        Whether only the contact at rest counts: then axes that do not change it need no value.

    Raises
    ------
    StudyError
        With every mistake; also if the study has no units, or an axis of it has no value here.
    """
    raw = tables_of(path)
    replaced = {*values}.union(*({*pair} for pair in PAIRS.items() if {*pair} & values.keys()))
    fixed, axes = (raw.get(key) or {} for key in ("fixed", "axes"))
    values, profiles = _with_profile(values, fixed, raw.get("profiles") or {}, smoothing)
    if values.get("profile") in profiles and "radius" not in values:
        replaced |= {"radius"}  # a table has lengths of its own
    open_axes = {name: axes[name] for name in axes if name not in replaced and name != "critical_distance"}
    if at_rest:
        # Any of its values will do for what the contact at rest does not depend on.
        moving = {name: _first(value) for name, value in open_axes.items() if name not in REST_DEPENDS_ON}
        open_axes = {name: value for name, value in open_axes.items() if name not in moving}
        values = {**moving, **values}
    if open_axes:
        found = f"several values of {', '.join(open_axes)}"
        option = f"--{next(iter(open_axes)).replace('_', '-')} VALUE"
        raise StudyError([Mistake("", found, f"one of each, such as {option}", path)])
    kept = {key: table for key, table in raw.items() if key not in ("axes", "sample", "figure")}
    kept |= {"profiles": profiles} if profiles else {}
    kept["fixed"] = {name: value for name, value in fixed.items() if name not in replaced} | dict(values)
    grid = study_from(kept, "", path, Path(path).parent).grid
    if not isinstance(grid, PhysicalGrid):
        raise StudyError([Mistake("units", "a study without units", "one with [units]", path)])
    return PhysicalContact(grid)


def _with_profile(
    values: Mapping[str, object], fixed: Mapping[str, Any], tables: Mapping[str, Any], smoothing: float | None
) -> tuple[Mapping[str, object], dict[str, Any]]:
    """The values with the name of the profile, and the study's tables of profiles with that of a file."""
    profiles = dict(tables)
    name = values.get("profile", fixed.get("profile"))
    if Path(str(name)).suffix == ".csv":
        path = Path(str(name))
        name = path.stem
        profiles[name] = {"file": str(path.resolve())}
        values = {**values, "profile": name}
    if smoothing is None:
        return values, profiles
    if not isinstance(profiles.get(str(name)), dict):
        raise StudyError([Mistake("smoothing", f"{smoothing:g} of {literal(name)}", "for a table alone")])
    profiles[str(name)] = {**profiles[str(name)], "smoothing": smoothing}
    return values, profiles


def _first(axis: object) -> object:
    """The first value of an axis as a study has it: a list, or a range."""
    if isinstance(axis, dict):
        return axis.get("start")
    return axis[0] if isinstance(axis, list) and axis else axis
