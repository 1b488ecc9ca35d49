"""The records in an archive, by canonical point: the way back from labelled results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in, read_failures, read_runs
from swtstudy.archive.paths import ArchiveError
from swtstudy.points.grid import SAMPLE, Grid, complete
from swtstudy.points.labelled import arrays_of
from swtstudy.points.reading import given_twice
from swtstudy.points.records import FAILED, Records, made_by
from swtstudy.points.requested import CONTACT, columns_from, has_units, request_of, require
from swtstudy.points.shapes import shapes_needed
from swtstudy.points.unique import columns_back, unique_points
from swtstudy.points.values import NamedValues, Value, read_value
from swtstudy.solver.points import Solution
from swtstudy.units.contacts_at_rest import check_contacts
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.reading import completed, read_contact
from swtstudy.units.results import without_units
from swtstudy.units.rows import MEAN_LOADS, rows, wrong_mean_load
from swtstudy.vocabulary.choices import NONE
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS, SHIFT, Control, replaced_by
from swtstudy.vocabulary.quantities import DISTANCE, Request


def grid_of(dataset: xr.Dataset) -> Grid:
    """The grid of an archive, from its coordinates.

    Raises
    ------
    StudyError
        With every coordinate that no study can have; or if the results have been left without s.
    """
    require(dataset, "s")
    values: NamedValues = {}
    report = Report()
    axes: list[str] = []
    sampled: list[str] = []
    dims = [str(name) for name in dataset.s.dims]
    given = read_contact(dataset.attrs[CONTACT]) if has_units(dataset) else None
    table, pairs = (PARAMETERS, {}) if given is None else (rows(given.units), given.pairs)
    for name in dims:
        if name != SAMPLE and (name not in table or name not in dataset.coords):
            report(name, "a dimension without values of a parameter", ", ".join(table))
    known = defined_in(dataset.attrs)
    for name, parameter in table.items():
        if name not in dataset.coords or name in pairs or name == DISTANCE:
            continue
        coordinate = dataset[name]
        if name in dims and coordinate.dims == (name,):
            axes.append(name)
        elif SAMPLE in dims and coordinate.dims == (SAMPLE,):
            sampled.append(name)
        elif name in dims or coordinate.dims:
            report(name, f"dimensions {coordinate.dims}", "an axis of s, or a single value")
            continue
        raw = np.atleast_1d(coordinate.values).tolist()
        values[name] = tuple(_values(parameter, raw, known.get(name, {}), report))
    if SHIFT not in values and any(values.get("bulk_stress_amplitude", ())):
        values[SHIFT] = (NONE,)  # archives from before there was a choice
    profiles = [value for value in values.get("profile", ()) if isinstance(value, str)]
    _check_complete({*values, *dims, *pairs}, shapes_needed(profiles), report)
    _check_control(dataset, {*values, *dims}, report)
    if SAMPLE in dims and not sampled:
        report(SAMPLE, "a dimension without values of a parameter", ", ".join(table))
    report.refuse()
    fixed = {name: value[0] for name, value in values.items() if name not in (*axes, *sampled)}
    samples = {name: values[name] for name in sampled}
    along = {name: values[name] for name in dims if name != SAMPLE}
    if given is None:
        return complete(fixed, along, samples)
    return _of_contacts(completed(fixed, along, samples, given))


def _of_contacts(grid: PhysicalGrid) -> PhysicalGrid:
    """A grid of contacts that can be."""
    report = Report()
    named = any(isinstance(profile, str) for profile in grid.values("profile"))
    for name in ("young_modulus", "poisson_ratio", "friction", *("radius",) * named):
        if name not in grid.pairs and not grid.values(name):
            report(name, "nothing", grid.row(name).allowed)
    if wrong := wrong_mean_load([name for name in MEAN_LOADS if grid.values(name)]):
        report.of(MEAN_LOADS, *wrong)
    if not report:
        check_contacts(grid, report)
    report.refuse()
    return grid


def _check_complete(given: set[str], shape: Sequence[str], report: Report) -> None:
    """Parameters without a value; an archive may leave out optional ones."""
    replaced = replaced_by(given)
    for name, parameter in PARAMETERS.items():
        needed = parameter.default is not None and not parameter.optional and name not in replaced
        if (needed or name in shape) and name not in given:
            report(name, "nothing", parameter.allowed)


def _check_control(dataset: xr.Dataset, given: set[str], report: Report) -> None:
    """Two parameters that take each other's place, or a coordinate that contradicts them."""
    for twice in given_twice(given):
        report.of(*twice)
    own = Control.given(given).name
    # Archives from before there was a choice do not say it.
    found = dataset.control.values.tolist() if "control" in dataset.coords else own
    if found != own:
        report("control", literal(found), literal(own))


def _values(
    parameter: Parameter, raw: list[object], known: Mapping[str, Definition], report: Report
) -> Iterator[Value]:
    """Values of a coordinate, up to the first invalid one, which is a mistake."""
    for value in raw:
        try:
            yield read_value(parameter, value, known)
        except ValueError as error:
            report(parameter.name, f"{literal(value)} ({error})", parameter.allowed)
            return


def records_of(dataset: xr.Dataset, source: object = "archive") -> Records:
    """The results in an archive, by canonical point; `source` names it in messages.

    Raises
    ------
    ArchiveError
        If a variable of an archive is missing.
    """
    lacking = [item.name for item in fields(Solution) if item.name not in dataset]
    if lacking:
        raise ArchiveError(
            f"{source}: an archive of another version of swtstudy, without {', '.join(lacking)}"
        )
    grid = grid_of(dataset)
    points = unique_points(grid)
    dataset = without_units(dataset) if has_units(dataset) else dataset
    at = np.zeros(len(points.table), np.int64)
    at[points.index] = np.arange(len(points.index))
    flat = {
        name: dataset[name].transpose(*dataset.s.dims).values.reshape(-1)[at]
        for name in (*(item.name for item in fields(Solution)), "status", "run")
    }
    status, run = flat.pop("status").astype(np.int8), flat.pop("run").astype(np.int32)
    runs = read_runs(dataset.attrs["runs"])
    asked = request_of(dataset, made_by(runs))
    if not asked.variables.keys() <= {*dataset.data_vars}:
        asked = Request(asked.names, counts=asked.counts)  # means of before, about critical points alone
    quantities = columns_back(grid, asked, points, columns_from(dataset, asked.items))
    # Mirroring a second time gives the canonical point back.
    solution = Solution(**arrays_of(Solution(**flat), points.mirrored[at]))
    failures = read_failures(dataset.status.attrs["failures"])
    reason = {tuple(failure["row"]): failure["message"] for failure in failures}
    failed = np.flatnonzero(status == FAILED)
    message = np.full(len(status), "", object)
    message[failed] = [reason.get(row, "") for row in points.table[failed].tolist()]
    found = Records(points.table, solution, status, run, message, runs, quantities)
    return found.without_unknown()
