"""The content of an archive: the grid of its points, what was asked of them, and their values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in, read_runs
from swtstudy.points.canonical import Distinct
from swtstudy.points.found import Found, Run
from swtstudy.points.grid import SAMPLE, Grid, complete
from swtstudy.points.labelled import turned
from swtstudy.points.reading import given_twice
from swtstudy.points.shapes import shapes_needed
from swtstudy.points.values import NamedValues, Value, read_value
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.reading import check_contacts, completed, read_contact
from swtstudy.units.results import without_units
from swtstudy.units.rows import MEAN_LOADS, rows, wrong_mean_load
from swtstudy.vocabulary.choices import NONE
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS, SHIFT, Control, replaced_by
from swtstudy.vocabulary.quantities import DISTANCE, NAMED, NONLOCAL, Request
from swtstudy.vocabulary.variables import CONTACT, SOLVED, has_units, require


def grid_of(dataset: xr.Dataset) -> Grid:
    """The grid of an archive, from its coordinates.

    Raises
    ------
    StudyError
        With every coordinate that no study can have; or if the results have been left without s.
    """
    require(dataset, "s")
    report, dims = Report(), [str(name) for name in dataset.s.dims]
    given = read_contact(dataset.attrs[CONTACT]) if has_units(dataset) else None
    table, pairs = (PARAMETERS, {}) if given is None else (rows(given.units), given.pairs)
    known = defined_in(dataset.attrs)
    values: NamedValues = {}
    for name, parameter in table.items():
        if name not in dataset.coords or name in pairs or name == DISTANCE:
            continue
        if dataset[name].dims not in ((), (name,), (SAMPLE,)) or not {*dataset[name].dims} <= {*dims}:
            report(name, f"dimensions {dataset[name].dims}", "an axis of s, or a single value")
            continue
        raw = np.atleast_1d(dataset[name].values).tolist()
        values[name] = tuple(_values(parameter, raw, known.get(name, {}), report))
    if SHIFT not in values and any(values.get("bulk_stress_amplitude", ())):
        values[SHIFT] = (NONE,)  # archives from before there was a choice
    along = {
        name: str(dataset[name].dims[0]) for name in values if name in dataset.coords and dataset[name].dims
    }
    for name in (name for name in dims if name not in along.values()):
        report(name, "a dimension without values of a parameter", ", ".join(table))
    profiles = [value for value in values.get("profile", ()) if isinstance(value, str)]
    _check_complete({*values, *dims, *pairs}, shapes_needed(profiles), report)
    for twice in given_twice({*values, *dims}):
        report.of(*twice)
    control = Control.given({*values, *dims}).name
    if dataset.get("control", control) != control:
        report("control", literal(dataset.control.values.tolist()), literal(control))
    report.refuse()
    fixed = {name: value[0] for name, value in values.items() if name not in along}
    samples = {name: values[name] for name, dim in along.items() if dim == SAMPLE}
    axes = {name: values[name] for name in dims if name != SAMPLE}
    if given is None:
        return complete(fixed, axes, samples)
    return _of_contacts(completed(fixed, axes, samples, given))


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


def request_of(dataset: xr.Dataset) -> Request:
    """The quantities that results have beside s; of real contacts distances are lengths."""
    plain = without_units(dataset) if has_units(dataset) else dataset
    names = tuple(str(name) for name in plain.data_vars if name in NAMED)
    distances = []
    if DISTANCE in dataset.coords and any(name in plain for name in NONLOCAL):
        distances = np.atleast_1d(dataset[DISTANCE].values).tolist()
    return Request(names, tuple(distances), DISTANCE in dataset.dims, "counted" in plain)


def found_in(dataset: xr.Dataset) -> Found:
    """The values in an archive, by distinct point."""
    grid, asked = grid_of(dataset), request_of(dataset)
    points = Distinct.of(grid, asked)
    plain = without_units(dataset) if has_units(dataset) else dataset
    at = np.zeros(len(points.rows), np.int64)
    at[points.index] = np.arange(grid.size)

    def flat(name: str, own: Sequence[str] = ()) -> np.ndarray[Any, Any]:
        values = plain[name].transpose(*dataset.s.dims, *own).values
        return values.reshape(grid.size, *values.shape[len(dataset.s.dims) :])[at]

    arrays = {name: flat(name) for name in (*SOLVED, "status", "run")}
    arrays |= {name: flat(name, own) for name, own in asked.variables.items()}
    for row in () if asked.is_axis else NONLOCAL.values():
        arrays |= {name: arrays[name][:, None] for name in row.variables if name in arrays}
    arrays = turned(arrays, points.mirrored[at], grid.cycles(at), np.divide)
    arrays["message"] = flat("message").astype(object) if "message" in plain else np.full(at.size, "", object)
    arrays["run"] = arrays["run"].astype(np.int32)
    if asked.distances:
        lost = np.isnan(arrays["s_volume"]) & np.isfinite(arrays["s"])[:, None]
        arrays["distance"] = np.where(lost, np.nan, points.distances)
    runs = read_runs(dataset.attrs["runs"])
    each = [run["seconds"] / max((arrays["run"] == k).sum(), 1) for k, run in enumerate(runs)]
    arrays |= {"row": points.rows, "seconds": np.array([*each, 0.0])[arrays["run"]]}
    return Found(arrays, tuple(map(Run.from_json, runs)))
