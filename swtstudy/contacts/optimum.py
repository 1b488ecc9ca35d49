"""The best and the worst of real contacts, in the user's units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr

from swtstudy.results.objective import Box, read_ranges
from swtstudy.results.optimise import check_asked, optimum_in
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.reading import read_contacts
from swtstudy.units.rows import ONE_OF, SIMILAR_KEY
from swtstudy.units.variables import variables
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, StudyError
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
    with report:
        box = _box(grid, over)
    check_asked(report, minimise, rtol, seed, [name for name in known if not name.endswith("_error")])
    if asked.is_axis:
        report(DISTANCE, "several", "one: what is made least is one value")
    report.refuse()
    return optimum_in(box, minimise, rtol, int(seed), asked)


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
