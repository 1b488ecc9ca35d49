"""The content of an archive: the grid of its points, what was asked of them, their values; is it sound?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.points.chunk import Found, read_runs
from swtstudy.points.grid import SAMPLE, Distinct, Grid, complete
from swtstudy.points.reading import check_pairs
from swtstudy.points.rules import shapes_needed
from swtstudy.points.solve import turned
from swtstudy.points.values import NamedValues, Value, index_at, read_value
from swtstudy.study.figure import read_figure
from swtstudy.study.units.grid import PhysicalGrid
from swtstudy.study.units.reading import check_contacts, completed, read_contact
from swtstudy.study.units.results import without_units
from swtstudy.study.units.rows import MEAN_LOADS, rows, wrong_mean_load
from swtstudy.study.writing import defined_in
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.mistakes import ALLOWED_RTOL, Report, is_rtol, literal, plain_number
from swtstudy.vocabulary.parameters import PARAMETERS, Control, Parameter, replaced_by
from swtstudy.vocabulary.quantities import (
    ATTRIBUTES,
    COMPUTED,
    CONTACT,
    DISTANCE,
    EVERY_VARIABLE,
    NAMED,
    NONLOCAL,
    SOLVED,
    STATES,
    Request,
    attributes_of,
    has_units,
    require,
)


def grid_of(dataset: xr.Dataset, report: Report | None = None) -> Grid:
    """The grid of results from their coordinates; mistakes are added to a report, if there is one.

    Raises
    ------
    StudyError
        With every coordinate that no study can have; or if the results have been left without s.
    """
    require(dataset, "s")
    report, dims = Report() if report is None else report, [str(name) for name in dataset.s.dims]
    given = read_contact(dataset.attrs[CONTACT]) if has_units(dataset) else None
    table, pairs = (PARAMETERS, {}) if given is None else (rows(given.units), given.pairs)
    own = {n: row for n, row in table.items() if n in dataset.coords and n not in (*pairs, DISTANCE)}
    found = _read_coordinates(dataset, own, report)
    samples = {name: values for name, values in found.items() if dataset[name].dims == (SAMPLE,)}
    for name in (n for n in dims if n not in found.keys() - samples and not (n == SAMPLE and samples)):
        report(name, "a dimension without values of a parameter", ", ".join(table))
    there = {*found, *dims, *pairs}
    replaced = replaced_by(there)
    shape = shapes_needed([value for value in found.get("profile", ()) if isinstance(value, str)])
    for name, parameter in PARAMETERS.items():
        needed = parameter.default is not None and not parameter.optional and name not in replaced
        if (needed or name in shape) and name not in there:  # an archive may leave out optional ones
            report(name, "nothing", parameter.allowed)
    check_pairs(there, report)
    control = Control.given(there).name
    if dataset.get("control", control) != control:
        report("control", literal(dataset.control.values.tolist()), literal(control))
    report.refuse()
    fixed = {name: values[0] for name, values in found.items() if not dataset[name].dims}
    axes = {name: found[name] for name in dims if name != SAMPLE}
    grid = complete(fixed, axes, samples) if given is None else completed(fixed, axes, samples, given)
    for name in found:
        unit, expected = dataset[name].attrs.get("units"), grid.row(name).units
        if unit is not None and str(unit) != expected:
            report(f"attribute units of {name}", literal(unit), literal(expected))
    if isinstance(grid, PhysicalGrid):
        _check_physical(grid, report)
    report.refuse()
    return grid


def _check_physical(grid: PhysicalGrid, report: Report) -> None:
    """Report what real contacts lack, or cannot have."""
    for name in ("young_modulus", "poisson_ratio", "friction", "radius"):
        named = name != "radius" or any(isinstance(each, str) for each in grid.values("profile"))
        if named and name not in grid.pairs and not grid.values(name):
            report(name, "nothing", grid.row(name).allowed)
    if wrong := wrong_mean_load([name for name in MEAN_LOADS if grid.values(name)]):
        report.of(MEAN_LOADS, *wrong)
    if not report:
        check_contacts(grid, report)


def _read_coordinates(dataset: xr.Dataset, own: Mapping[str, Parameter], report: Report) -> NamedValues:
    """Values of parameters that are coordinates; the first wrong value of each is told."""
    known = defined_in(dataset.attrs)
    found: NamedValues = {}
    for name, row in own.items():
        dims = tuple(map(str, dataset[name].dims))
        if dims not in ((), (name,), (SAMPLE,)) or not {*dims} <= {*dataset.s.dims}:
            report(name, f"dimensions {dims}", "an axis of s, or a single value")
            continue
        values: list[Value] = []
        for raw in np.atleast_1d(dataset[name].values).tolist():
            try:
                values.append(read_value(row, raw, known.get(name, {})))
            except ValueError as error:
                report(name, f"{literal(raw)} ({error})", row.allowed)
                break
        found[name] = tuple(values)
    return found


def request_of(dataset: xr.Dataset) -> Request:
    """The quantities that results have beside s; of real contacts distances are lengths."""
    plain = without_units(dataset)
    names = tuple(str(name) for name in plain.data_vars if name in NAMED)
    distances = []
    if DISTANCE in dataset.coords and any(name in plain for name in NONLOCAL):
        distances = np.atleast_1d(dataset[DISTANCE].values).tolist()
    return Request(names, tuple(distances), DISTANCE in dataset.dims, "counted" in plain)


def found_in(dataset: xr.Dataset) -> Found:
    """The values in an archive, by distinct point."""
    grid, asked = grid_of(dataset), request_of(dataset)
    points = Distinct.of(grid, asked)
    plain = without_units(dataset)
    at = np.zeros(len(points.rows), np.int64)
    at[points.index] = np.arange(grid.size)

    def flat(name: str, own: Sequence[str] = ()) -> np.ndarray[Any, Any]:
        values = plain[name].transpose(*dataset.s.dims, *own).values
        return values.reshape(grid.size, *values.shape[len(dataset.s.dims) :])[at]

    arrays = {name: flat(name) for name in (*SOLVED, "status", "run")}
    arrays |= {name: flat(name, own) for name, own in asked.variables.items()}
    for row in () if asked.is_axis else NONLOCAL.values():
        arrays |= {name: arrays[name][:, None] for name in row.variables if name in arrays}
    arrays = turned(arrays, points.mirrored[at], grid, at, np.divide)
    arrays["message"] = flat("message").astype(object) if "message" in plain else np.full(at.size, "", object)
    arrays["run"] = arrays["run"].astype(np.int32)
    if asked.distances:
        lost = np.isnan(arrays["s_volume"]) & np.isfinite(arrays["s"])[:, None]
        arrays["distance"] = np.where(lost, np.nan, points.distances)
    runs = read_runs(dataset.attrs["runs"])
    each = [run.seconds / max((arrays["run"] == k).sum(), 1) for k, run in enumerate(runs)]
    arrays |= {"row": points.rows, "seconds": np.array([*each, 0.0])[arrays["run"]]}
    return Found(arrays, runs)


#: Parts that every archive must have: variables, and attributes that are texts or numbers.
_VARIABLES = ("s", "s_error", "regime", "status", "run")
_TEXTS = ("title", "source", "history", "versions", "study", "runs")


def lacking(dataset: xr.Dataset) -> list[str]:
    """Names of the variables and attributes that a Dataset lacks as an archive."""
    names = [name for name in _VARIABLES if name not in dataset.data_vars]
    names += [name for name in (*_TEXTS, "rtol", "control") if name not in {*dataset.attrs, *dataset.coords}]
    flags = (name for name in ("regime", "status") if name in dataset)
    return names + [f"flag_meanings of {n}" for n in flags if "flag_meanings" not in dataset[n].attrs]


def check_archive(dataset: xr.Dataset, source: str) -> None:
    """Raise a StudyError with everything that is wrong in an archive that lacks nothing."""
    # Each of these can be checked only if what it relies on, the one before it, is sound.
    report = Report(source)
    for check in (_check_attributes, _check_shapes, grid_of, _check_values):
        check(dataset, report)
        report.refuse()


def _check_attributes(dataset: xr.Dataset, report: Report) -> None:
    attributes = dataset.attrs
    seconds = attributes.get("wall_time_seconds", 0.0)
    wrong = {name: "a text" for name in _TEXTS if not isinstance(attributes[name], str)}
    if not is_rtol(attributes["rtol"]):
        wrong["rtol"] = ALLOWED_RTOL
    if not 0.0 <= plain_number(seconds) < np.inf:
        wrong["wall_time_seconds"] = "a number of seconds"
    for name, allowed in wrong.items():
        report(f"attribute {name}", literal(attributes[name]), allowed)
    others = [str(name) for name in dataset.data_vars] if has_units(dataset) else []
    readers: dict[str, Callable[[object], object]] = {
        "runs": read_runs,
        "definitions": lambda text: defined_in({"definitions": text}),
        "figure": partial(read_figure, others=others),
        CONTACT: read_contact,
    }
    for name in (name for name in readers if name in attributes and name not in wrong):
        try:
            readers[name](attributes[name])
        except ValueError as error:
            found = f"{literal(attributes[name])} ({error})"
            report(f"attribute {name}", found, "JSON as swtstudy writes it")
    plain = without_units(dataset)
    every = {name: attributes_of(name) for name in (*ATTRIBUTES, *EVERY_VARIABLE)}
    for name in (name for name in every if name in plain):
        for attribute in ("units", "flag_meanings"):
            expected = every[name].get(attribute)
            value = plain[name].attrs.get(attribute, expected)
            if str(value) != str(expected):
                report(f"attribute {attribute} of {name}", literal(value), literal(expected))


def _check_shapes(dataset: xr.Dataset, report: Report) -> None:
    plain = without_units(dataset)
    own: dict[str, tuple[str, ...]] = dict.fromkeys(("status", "run", *SOLVED), ())
    for name, more in (own | request_of(dataset).variables).items():
        if name not in plain:
            report(name, "nothing", "a variable that an archive of this version has")
            continue
        if {*plain[name].dims} != {*dataset.s.dims, *more}:
            besides = f" and {', '.join(more)}" * bool(more)
            report(name, f"dimensions {plain[name].dims}", f"those of s, {dataset.s.dims}{besides}")
        if plain[name].dtype.kind not in "fiu":
            report(name, f"values of type {plain[name].dtype}", "numbers")


def _check_values(dataset: xr.Dataset, report: Report) -> None:
    """Refuse values that no run computes, such as from a damaged file."""
    s, s_error, regime, status, run = (dataset[name].transpose(*dataset.s.dims).values for name in _VARIABLES)
    computed = status == COMPUTED
    unbounded = np.isin(regime, [REGIMES.index(name) for name in WITHOUT_S])
    runs = len(read_runs(dataset.attrs["runs"]))
    for name, wrong, allowed in (
        ("status", ~np.isin(status, range(len(STATES))), f"0 to {len(STATES) - 1}"),
        ("run", ~np.isin(run, range(-1, runs)), f"-1 to {runs - 1}"),
        ("regime", ~np.isin(regime, range(len(REGIMES))), f"0 to {len(REGIMES) - 1}"),
        ("s", computed & ~unbounded & ~(np.isfinite(s) & (s >= 0.0)), "a finite number, 0 or more"),
        ("s", computed & unbounded & (s < 0.0), "0 or more"),
        ("s_error", computed & (s_error < 0.0), "0 or more"),
    ):
        if count := int(wrong.sum()):
            index = index_at(dataset.s, int(wrong.argmax()))
            place = ", ".join(f"{dim}={dataset[dim].values[i]}" for dim, i in index.items())
            where = f" at {place}" * bool(place) + f" and {count - 1} more" * (count > 1)
            report(name, f"{dataset[name].isel(index).item()}{where}", allowed)
