"""One point of a study file, for commands that look at one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.grid import Grid
from swtstudy.study.contacts import rows_of
from swtstudy.study.definition import sample_of, study_from, tables_of, with_loads
from swtstudy.study.shipped import find_study
from swtstudy.study.tables import read_structure
from swtstudy.units.material import STRENGTH
from swtstudy.units.rows import ONE_OF, REST_DEPENDS_ON, read_units
from swtstudy.vocabulary.choices import SWT, families_with
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal
from swtstudy.vocabulary.quantities import DISTANCE

#: What a study has that is nothing of one contact.
_OF_STUDIES = ("axes", "sample", "figure", "blocks", "quantities")


def one_of_study(
    path: str, values: Mapping[str, object], smoothing: float | None = None, at_rest: bool = False
) -> Grid:
    """The one point of a study file, with other values of some parameters, or values along its axes.

    Parameters
    ----------
    path
        The study file, or the name of a study of the paper.
    values
        Its parameters, over those of the study; the profile may be a CSV file.
    smoothing
        Of a profile that is a table, over that of the study.
    at_rest
        Whether only the contact at rest counts: then axes that do not change it need no value.

    Returns
    -------
    Grid
        Of one value of each parameter: a `PhysicalGrid`, but for both bodies, if the study has units.

    Raises
    ------
    StudyError
        With every mistake; also if an axis of the study, or what it samples, has no value here.
    """
    path = str(find_study(path))
    raw = tables_of(path)
    if mistakes := read_structure(raw, path)[1]:
        raise StudyError(mistakes)
    replaced = {*values}.union(*(pair for pair in ONE_OF if {*pair} & values.keys()))
    loads = [block["load"] for block in raw.get("blocks", ())]
    fixed, axes = with_loads(raw.get("fixed", {}), raw.get("axes", {}), loads)
    profiles, name = dict(raw.get("profiles", {})), str(values.get("profile", fixed.get("profile")))
    if Path(name).suffix == ".csv":
        profiles[Path(name).stem] = {"file": str(Path(name).resolve())}
        name = Path(name).stem
        values = {**values, "profile": name}
    if smoothing is not None:
        if not isinstance(profiles.get(name), dict):
            raise StudyError([Mistake("smoothing", f"{smoothing:g} of {literal(name)}", "for a table alone")])
        profiles[name] = {**profiles[name], "smoothing": smoothing}
    if values.get("profile") in profiles and "radius" not in values:
        replaced |= {"radius"}  # a table has lengths of its own
    if "profile" in values:  # what the profile does not have
        replaced |= {name for name in SHAPE_COLUMNS if values["profile"] not in families_with(name)}
    if "criterion" in values:
        replaced |= {"normal_sensitivity" if values["criterion"] == SWT else "walker_exponent"}
    firsts = {name: _first(axis) for name, axis in axes.items() if name not in (DISTANCE, "body")}
    units = read_units(raw["units"], Report()) if isinstance(raw.get("units"), dict) else None
    sample, sampled = sample_of(raw, Path(path).parent, {}, Report(), rows_of(units))
    firsts |= {name: sample.values[name][0] if sample else None for name in sampled}
    several = {name: first for name, first in firsts.items() if name not in replaced}
    if at_rest:
        # Any of its values will do for what the contact at rest does not depend on.
        needed = REST_DEPENDS_ON if "units" in raw else ("profile", *SHAPE_COLUMNS)
        moving = {name: first for name, first in several.items() if name not in needed}
        several = {name: first for name, first in several.items() if name not in moving}
        values = {**moving, **values}
    if several:
        found = f"several values of {', '.join(several)}"
        option = f"--{next(iter(several)).replace('_', '-')} VALUE"
        raise StudyError([Mistake("", found, f"one of each, such as {option}", path)])
    kept = {key: table for key, table in raw.items() if key not in _OF_STUDIES}
    kept |= {"profiles": profiles} if profiles else {}
    if "criterion" in values and "material" in kept:
        own = {key: value for key, value in kept.pop("material").items() if key == STRENGTH}
        kept |= {"material": own} if own else {}
    others = {name: value for name, value in fixed.items() if name not in replaced and name != DISTANCE}
    kept["fixed"] = others | dict(values)
    return study_from(kept, "", path, Path(path).parent).grid


def _first(axis: object) -> object:
    """The first value of an axis as a study has it: a list, or a range."""
    if isinstance(axis, dict):
        return axis.get("start")
    return axis[0] if isinstance(axis, list) and axis else axis
