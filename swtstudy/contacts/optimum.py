"""The best and the worst of real contacts, in the user's units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import xarray as xr

from swtstudy.results.objective import Box, read_ranges
from swtstudy.results.optimise import check_asked, optimum_in
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.life import FatigueConstants
from swtstudy.units.reading import read_contacts
from swtstudy.units.rows import ONE_OF, SIMILAR_KEY
from swtstudy.units.variables import NAMES, variables
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal
from swtstudy.vocabulary.quantities import DISTANCE, Request


def optimum(
    grid: PhysicalGrid, over: object, minimise: str, rtol: float, seed: int, asked: Request
) -> xr.Dataset:
    """The best and the worst contacts in ranges around one contact; see `PhysicalContact.optimise`.

    Parameters
    ----------
    grid
        The contact, of both bodies or one.
    over, minimise, rtol, seed
        As of `PhysicalContact.optimise`.
    asked
        What is asked beside s.
    """
    found = (each.name for each in variables(grid, asked) if each.of)
    known = dict.fromkeys(("s", "s_surface", *found, *grid.margins))
    report = Report()
    if minimise not in known and (lacking := _lacking(grid, minimise, asked)):
        raise StudyError([Mistake("minimise", literal(minimise), f"with {' and '.join(lacking)}")])
    with report:
        box = _box(grid, over)
    check_asked(report, minimise, rtol, seed, [name for name in known if not name.endswith("_error")])
    if asked.is_axis:
        report(DISTANCE, "several", "one: what is made least is one value")
    report.refuse()
    return optimum_in(box, minimise, rtol, int(seed), asked)


def _lacking(grid: PhysicalGrid, minimise: str, asked: Request) -> list[str]:
    """The arguments without which a data variable is not there."""
    constants = ", ".join(field.name for field in fields(FatigueConstants))
    needs = {
        f"constants (swtstudy.FatigueConstants of {constants})": "cycles" in minimise and not grid.materials,
        f"a {DISTANCE}": minimise.endswith(("_volume", "_point", "_line")) and not asked.distances,
        "a yield_strength": minimise in ("yield_ratio", "von_mises") and not grid.yield_strengths,
        'the criterion "fatemi_socie"': minimise.startswith("FS")
        and "fatemi_socie" not in grid.values("criterion"),
        'the criterion "findley"': minimise.startswith("findley")
        and "findley" not in grid.values("criterion"),
    }
    return [words for words, lacks in needs.items() if minimise in NAMES and lacks]


def _box(grid: PhysicalGrid, over: object) -> Box:
    """The box of ranges in units around one contact."""
    numeric = [
        name for name, row in grid.rows.items() if row.kind == "number" and name not in (DISTANCE, "body")
    ]
    ranges, report = read_ranges(over, numeric)
    report.refuse()
    replaced = {*ranges}.union(*(pair for pair in ONE_OF if {*pair} & {*ranges}))
    fixed: dict[str, Any] = {name: value for name, value in grid.fixed.items() if name not in replaced}
    fixed |= {name: [*two] for name, two in grid.pairs.items() if name not in replaced}
    bodies = {name: [*values] for name, values in grid.axes.items() if name == "body"}
    known: dict[str, dict[str, Definition]] = {}
    for each in grid.given:
        known.setdefault(each.parameter, {})[each.name] = each
    corners, found = read_contacts(
        {**fixed, SIMILAR_KEY: grid.similar},
        {**ranges, **bodies},
        grid.about,
        lambda name: f"over.{name}" if name in ranges else name,
        known=known,
    )
    if corners is None:
        raise StudyError(found)
    assert isinstance(over, Mapping)
    return Box.of(corners, over)
