"""Check that what was read from a file is a sound archive of a study."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import read_definitions, read_figure, read_runs
from swtstudy.archive.recall import grid_of, request_of
from swtstudy.points.values import index_at
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
from swtstudy.vocabulary.quantities import EVERY_VARIABLE, attributes_of
from swtstudy.vocabulary.variables import ATTRIBUTES, COMPUTED, CONTACT, SOLVED, STATES, has_units

#: What every archive must have: variables, and attributes that are texts or numbers.
_VARIABLES = ("s", "s_error", "regime", "status", "run")
_TEXTS = ("title", "source", "history", "versions", "study", "runs")


def lacking(dataset: xr.Dataset) -> list[str]:
    """Names of the variables and attributes that a Dataset lacks as an archive."""
    names = [name for name in _VARIABLES if name not in dataset.data_vars]
    names += [name for name in (*_TEXTS, "rtol", "control") if name not in {*dataset.attrs, *dataset.coords}]
    flags = (name for name in ("regime", "status") if name in dataset)
    return names + [f"flag_meanings of {n}" for n in flags if "flag_meanings" not in dataset[n].attrs]


def mistakes(dataset: xr.Dataset, source: str) -> list[Mistake]:
    """Everything that is wrong in an archive that lacks nothing."""
    # Each of these can be checked only if what it relies on, the one before it, is sound.
    found: list[tuple[str, str, str]] = []
    for check in (_attributes, _shapes, _coordinates, _values):
        found = found or [*check(dataset)]
    return [Mistake(*parts, source) for parts in found]


def _attributes(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    attributes, real = dataset.attrs, has_units(dataset)
    seconds = attributes.get("wall_time_seconds", 0.0)
    wrong = {name: "a text" for name in _TEXTS if not isinstance(attributes[name], str)}
    if not is_rtol(attributes["rtol"], SMALLEST_STORED_RTOL):
        wrong["rtol"] = ALLOWED_RTOL
    if not 0.0 <= plain_number(seconds) < np.inf:
        wrong["wall_time_seconds"] = "a number of seconds"
    for name, allowed in wrong.items():
        yield f"attribute {name}", _words(attributes[name]), allowed
    others = [str(name) for name in dataset.data_vars] if real else []
    readers: dict[str, Callable[[object], object]] = {
        "runs": read_runs,
        "definitions": read_definitions,
        "figure": partial(read_figure, others=others),
        CONTACT: read_contact,
    }
    for name in (name for name in readers if name in attributes and name not in wrong):
        try:
            readers[name](attributes[name])
        except ValueError as error:
            yield f"attribute {name}", f"{_words(attributes[name])} ({error})", "JSON as swtstudy writes it"
    plain = without_units(dataset) if real else dataset
    known = {} if real else {name: parameter.units for name, parameter in PARAMETERS.items()}
    known |= {name: entry["units"] for name, entry in ATTRIBUTES.items() if "units" in entry}
    known |= {name: attributes_of(name)["units"] for name in EVERY_VARIABLE}
    every = [("units", name, allowed) for name, allowed in known.items() if name in plain]
    every += [("flag_meanings", "regime", " ".join(REGIMES)), ("flag_meanings", "status", " ".join(STATES))]
    for attribute, name, allowed in every:
        found = plain[name].attrs.get(attribute, allowed)
        if str(found) != allowed:
            yield f"attribute {attribute} of {name}", _words(found), _words(allowed)


def _shapes(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    plain = without_units(dataset) if has_units(dataset) else dataset
    own: dict[str, tuple[str, ...]] = dict.fromkeys(("status", "run", *SOLVED), ())
    for name, more in (own | request_of(dataset).variables).items():
        if name not in plain:
            yield name, "nothing", "a variable that an archive of this version has"
            continue
        if {*plain[name].dims} != {*dataset.s.dims, *more}:
            besides = f" and {', '.join(more)}" * bool(more)
            yield name, f"dimensions {plain[name].dims}", f"those of s, {dataset.s.dims}{besides}"
        if plain[name].dtype.kind not in "fiu":
            yield name, f"values of type {plain[name].dtype}", "numbers"


def _coordinates(dataset: xr.Dataset) -> Iterator[tuple[str, str, str]]:
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
