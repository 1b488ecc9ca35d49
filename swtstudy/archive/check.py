"""Check that what was read from a file is a sound archive of a study."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import fields
from functools import partial

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import read_definitions, read_failures, read_figure, read_runs
from swtstudy.archive.recall import grid_of
from swtstudy.points.labelled import ATTRIBUTES
from swtstudy.points.records import COMPUTED, STATES, made_by
from swtstudy.points.requested import CONTACT, has_units, request_of
from swtstudy.points.values import index_at
from swtstudy.solver.points import Solution
from swtstudy.units.reading import read_contact
from swtstudy.units.results import without_units
from swtstudy.vocabulary.arrays import BoolArray
from swtstudy.vocabulary.choices import REGIMES, WITHOUT_S
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    SMALLEST_STORED_RTOL,
    Mistake,
    StudyError,
    is_rtol,
    literal,
    plain_number,
)
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.quantities import (
    DISTANCE,
    EVERY_VARIABLE,
    NONLOCAL,
    NOTHING,
    Request,
    attributes_of,
    item_of,
)

#: What every archive must have: variables, and attributes that are texts or numbers.
_VARIABLES = ("s", "s_error", "regime", "status", "run")
_TEXTS = ("title", "source", "history", "versions", "study", "runs")
_NUMBERS = ("rtol", "wall_time_seconds")


def lacking(dataset: xr.Dataset) -> list[str]:
    """Names of the variables and attributes that a Dataset lacks as an archive."""
    names = [name for name in _VARIABLES if name not in dataset.data_vars]
    names += [name for name in (*_TEXTS, *_NUMBERS) if name not in dataset.attrs]
    own = {"regime": ("flag_meanings",), "status": ("flag_meanings", "failures")}
    return names + [
        f"attribute {attribute} of {name}"
        for name, attributes in own.items()
        for attribute in attributes
        if name in dataset and attribute not in dataset[name].attrs
    ]


def mistakes(dataset: xr.Dataset, source: str) -> list[Mistake]:
    """Everything that is wrong in an archive that lacks nothing."""
    found = [*_attributes(dataset), *_shapes(dataset)]
    # Coordinates and values can be checked only if the attributes and shapes that they rely on are sound.
    return [Mistake(*parts, source) for parts in found or [*_coordinates(dataset), *_values(dataset)]]


def _attributes(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    attributes = dataset.attrs
    for name in _TEXTS:
        if not isinstance(attributes[name], str):
            yield f"attribute {name}", _words(attributes[name]), "a text"
    if not is_rtol(attributes["rtol"], SMALLEST_STORED_RTOL):
        yield "attribute rtol", _words(attributes["rtol"]), ALLOWED_RTOL
    if not 0.0 <= plain_number(attributes["wall_time_seconds"]) < math.inf:
        yield "attribute wall_time_seconds", _words(attributes["wall_time_seconds"]), "a number of seconds"
    if isinstance(attributes["runs"], str):
        yield from _unread("runs", attributes["runs"], read_runs)
    if "definitions" in attributes:
        yield from _unread("definitions", attributes["definitions"], read_definitions)
    if "figure" in attributes:
        others = [str(name) for name in dataset.data_vars] if has_units(dataset) else []
        yield from _unread("figure", attributes["figure"], partial(read_figure, others=others))
    yield from _unread("failures of status", dataset.status.attrs["failures"], read_failures)
    for name, words in (("regime", REGIMES), ("status", STATES)):
        meanings = dataset[name].attrs["flag_meanings"]
        # An older archive may not know the last of them.
        if not isinstance(meanings, str) or tuple(meanings.split()) != words[: len(meanings.split())]:
            yield f"attribute flag_meanings of {name}", _words(meanings), " ".join(words)
    real = has_units(dataset)
    if real:
        yield from _unread(CONTACT, attributes[CONTACT], read_contact)
    expected = {} if real else {name: parameter.units for name, parameter in PARAMETERS.items()}
    expected |= {name: entry["units"] for name, entry in ATTRIBUTES.items() if "units" in entry}
    expected |= {name: attributes_of(name)["units"] for name in EVERY_VARIABLE}
    dataset = without_units(dataset) if real else dataset
    for name, units in expected.items():
        found = dataset[name].attrs.get("units", units) if name in dataset else units
        if str(found) != units:
            yield f"attribute units of {name}", _words(found), _words(units)


def _unread(name: str, text: object, read: Callable[[object], object]) -> Iterator[tuple[str, str, str]]:
    try:
        read(text)
    except ValueError as error:
        yield f"attribute {name}", f"{_words(text)} ({error})", "JSON as swtstudy writes it"


def _shapes(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    asked = _asked(dataset)
    dataset = without_units(dataset) if has_units(dataset) else dataset
    for name in asked.variables:
        if name not in dataset and not (name in NONLOCAL and NONLOCAL[name].is_place):
            yield name, "nothing", "a quantity that the attribute runs says is there"
    own = dict.fromkeys(["status", "run", *(item.name for item in fields(Solution))], ())
    for name, more in (own | asked.variables).items():
        if name not in dataset:
            continue
        variable = dataset[name]
        if {*variable.dims} != {*dataset.s.dims, *more}:
            besides = f" and {', '.join(more)}" * bool(more)
            yield name, f"dimensions {variable.dims}", f"those of s, {dataset.s.dims}{besides}"
        if variable.dtype.kind not in "fiu":
            yield name, f"values of type {variable.dtype}", "numbers"


def _asked(dataset: xr.Dataset) -> Request:
    """The quantities that runs have computed; none if the runs cannot be read."""
    try:
        return request_of(dataset, made_by(read_runs(dataset.attrs["runs"])))
    except ValueError:
        return NOTHING  # reported with the attributes


def _coordinates(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    known = {item_of(value) for value in np.atleast_1d(dataset.get(DISTANCE, [])).tolist()}
    lacking = [item for item in map(item_of, _asked(dataset).distances) if item not in known]
    if lacking:
        yield DISTANCE, f"no {', '.join(lacking)}", "those that the attribute runs says are there"
    try:
        grid_of(dataset)
    except StudyError as error:
        yield from ((mistake.key, mistake.found, mistake.allowed) for mistake in error.mistakes)


def _values(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    """Values that no run computes, such as from a damaged file."""
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
        if wrong.any():
            yield name, _first(dataset, name, wrong), allowed


def _words(value: object) -> str:
    return literal(value.tolist() if isinstance(value, np.generic | np.ndarray) else value)


def _first(dataset: xr.Dataset, name: str, wrong: BoolArray) -> str:
    """The first wrong value, where it is, and how many more there are."""
    index = index_at(dataset.s, int(wrong.argmax()))
    place = ", ".join(f"{dim}={dataset[dim].values[i]}" for dim, i in index.items())
    where = f" at {place}" if place else ""
    more = f" and {int(wrong.sum()) - 1} more" if wrong.sum() > 1 else ""
    return f"{dataset[name].isel(index).item()}{where}{more}"
