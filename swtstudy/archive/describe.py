"""An archive in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in, read_runs
from swtstudy.archive.outcome import outcome
from swtstudy.archive.recall import request_of
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import validity_lines
from swtstudy.points.values import index_at
from swtstudy.study.figure import FigureLayout
from swtstudy.units.life import FatigueConstants, Scatter, ShearConstants
from swtstudy.units.reading import read_contact
from swtstudy.units.results import is_uncounted, sequence_words
from swtstudy.units.rows import Units
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.parameters import CONTACT_AXES, LOOP_AMPLITUDE, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.variables import COMPUTED, CONTACT, FAILED, STATES, has_units
from swtstudy.vocabulary.wording import coordinate_words, listed, number_words, numbers_words, unit_words

#: How many values of an axis, or failed points, are listed one by one: a line of a terminal.
_LISTED = 8
#: Letters to the left of the words of a line.
INDENT = 17
#: What scales the columns of a loop: one of these each.
_COLUMNS = (
    ("normal_force_amplitude", "normal_amplitude"),
    ("tangential_force_amplitude", "tangential_amplitude"),
    ("bulk_stress_amplitude",),
)
#: Of an error that is rtol of s.
_ROUNDING = 1e-9


def describe(dataset: xr.Dataset) -> Iterator[str]:
    """Describe results line by line: their study and versions, how complete and how accurate they are.

    Those of `swtstudy.solve` have neither study nor versions.
    """
    yield str(dataset.attrs.get("title", "Results"))
    for line in outcome(dataset):
        yield f"  {line}"
    for label, words in facts(dataset):
        yield f"{f'  {label}':<{INDENT}}{words}"


def facts(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """The same as pairs of a label, which several may share, and what there is to say."""
    attributes = dataset.attrs
    if "source" in attributes:
        versions = f" ({attributes['versions']})" if "versions" in attributes else ""
        yield "made by", f"{attributes['source']}{versions}"
    for line in attributes.get("history", "").splitlines():
        yield "history", line
    yield from _parameters(dataset)
    yield from _contact(dataset)
    if "control" in dataset.coords:
        yield "prescribed", str(dataset.control.item())
    if "runs" in attributes:
        yield from _quantities(dataset)
    if "status" in dataset:
        yield "complete", completeness(dataset)
    if "rtol" in attributes:
        yield "asked for", f"rtol {attributes['rtol']:g}"
        yield "accurate", accuracy(dataset)
    yield "regimes", ", ".join(f"{count} {name}" for name, count in regime_counts(dataset).items())
    for line in validity_lines(dataset, inside=True):
        yield "validity", line
    if "runs" in attributes:
        yield from _runs(dataset)
    failed = [*failures(dataset)]
    yield from (("failed", f"{where}: {why}") for where, why in failed[:_LISTED])
    if len(failed) > _LISTED:
        yield "failed", f"{len(failed) - _LISTED} more"
    if "figure" in attributes:
        yield "figure", _figure_words(FigureLayout.from_json(attributes["figure"]))


def _parameters(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    for name in map(str, dataset.s.dims):
        if name == SAMPLE:
            yield "sample", _sample_words(dataset[SAMPLE])
        else:
            yield "axis", f"{name}: {_axis_words(dataset[name])}{_unit(dataset[name])}"
    for load, words in recorded_loads(dataset):
        yield "load", f"{load}: {words}"
    for name in (*PARAMETERS, *CONTACT_AXES):
        if name not in dataset.coords or name in dataset.dims or name in unsaid(dataset):
            continue
        values, unit = dataset[name].values, _unit(dataset[name])
        if not values.ndim:
            yield "fixed", f"{name}: {_words(dataset[name])}{unit}"
        elif dataset[name].dims == ("body",):
            yield "of each body", f"{name}: {_axis_words(dataset[name])}{unit}"
        else:
            yield "sampled", f"{name}: {_range_words(dataset[name])}{unit}"


def unsaid(dataset: xr.Dataset) -> set[str]:
    """Names of coordinates without a meaning: of loops the phase, of recorded loads the factors of 1."""
    loads = _loops(dataset)
    if not loads:
        return set()
    factors = {
        name
        for name in map(str, dataset.coords)
        if name.endswith("_amplitude") and np.all(dataset[name].values == LOOP_AMPLITUDE)
    }
    recorded = all(each.mean_normal is not None for each in loads)
    return {"frequency_ratio", "phase"} | (factors if recorded else set())


def _loops(dataset: xr.Dataset) -> list[Any]:
    """The loads of results if all of them are loops, else none."""
    known = defined_in(dataset.attrs).get("load", {})
    names = np.atleast_1d(dataset["load"].values).tolist() if "load" in dataset.coords else []
    return [known[name] for name in names] if {*names} <= {*known} else []


def recorded_loads(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Names of loads that were recorded, each with the ranges that its columns have in a cycle."""
    for load in _loops(dataset) if has_units(dataset) else ():
        if load.mean_normal is None:
            continue
        said = []
        for symbol, column, place in zip(("F_N", "F_x", "σ_B"), load.course().T, _COLUMNS, strict=False):
            name = next((each for each in place if each in dataset.coords), None)
            if name is None or dataset[name].ndim:
                continue
            mean = load.mean_normal if symbol == "F_N" else float(dataset.get("bulk_stress_mean", 0.0))
            mean = 0.0 if symbol == "F_x" else mean
            symbol = {"normal_amplitude": "δ", "tangential_amplitude": "u"}.get(name, symbol)
            ends = mean + float(dataset[name]) * np.array([column.min(), column.max()])
            low, high = (number_words(end).replace("-", "−") for end in ends)
            said.append(f"{symbol} {low} to {high}{_unit(dataset[name])}")
        yield str(load), ", ".join(said)


def _quantities(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    asked = request_of(dataset)
    if asked.names:
        yield "quantities", ", ".join(asked.names)
    if asked.distances:
        distances = ", ".join(f"{value:.4g}" for value in asked.distances)
        yield "distances", f"{distances}{_unit(dataset[DISTANCE])}"


def _figure_words(layout: FigureLayout) -> str:
    """Describe the figure of the study: "s over phase, a line for each normal_amplitude"."""
    parts = [f"{', '.join(layout.y)} over {layout.x}"]
    parts += [f"upwards {layout.vertical}"] * bool(layout.vertical)
    parts += [f"a line for each {layout.hue}"] * bool(layout.hue)
    parts += [f"a panel for each {layout.panels}"] * bool(layout.panels)
    return ("" if layout.kind == "lines" else f"{layout.kind}: ") + ", ".join(parts)


def regime_counts(dataset: xr.Dataset) -> dict[str, int]:
    """Count the computed points of each regime that there is."""
    meanings = dataset.regime.attrs["flag_meanings"].split()
    computed = (dataset.status == COMPUTED if "status" in dataset else dataset.regime.notnull()).values
    counts = np.bincount(dataset.regime.values[computed].astype(int).ravel(), minlength=len(meanings))
    return {meaning: int(n) for n, meaning in zip(counts, meanings, strict=False) if n}


def _runs(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    runs = read_runs(dataset.attrs["runs"])
    counted = np.bincount(dataset.run.values.astype(int).ravel() + 1, minlength=len(runs) + 1)[1:]
    for number, run in enumerate(runs):
        words = f"{counted[number]} points, rtol {run['rtol']:g}, solver version {run['solver_version']}, "
        yield f"run {number}", f"{words}{run['seconds']:.1f} s of computing, started {run['started']}"


def failures(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Say of each point that failed where it is, and why."""
    if "message" not in dataset:
        return
    for flat in np.flatnonzero(dataset.status.values == FAILED).tolist():
        point = dataset.isel(index_at(dataset.s, flat))
        names = [n for n in (*PARAMETERS, *CONTACT_AXES) if n in dataset.coords and dataset[n].ndim]
        where = ", ".join(f"{name}={_words(point[name])}" for name in names)
        yield where or "the point", str(point.message.item())


def _contact(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """List the facts of the contacts of a study with units, besides the values of parameters."""
    if has_units(dataset):
        given = read_contact(dataset.attrs[CONTACT])
        units = ", ".join(filter(None, vars(given.units).values()))
        if units:
            yield "units", units
        for material in dict.fromkeys(given.materials):
            yield "material", _constants(material)
        if given.scatter:
            yield "scatter", scatter_words(given.scatter)
        for torsion in dict.fromkeys(given.shear_materials):
            yield "in torsion", _constants(torsion)
        if given.yield_strengths:
            yield "yields at", _stresses(given.yield_strengths, given.units)
        if given.findley_limits:
            yield "Findley limit", _stresses(given.findley_limits, given.units)
        if given.materials or given.shear_materials:
            yield "lives", _counted_words(dataset)
        if sequence := sequence_words(dataset, given.blocks):
            yield "sequence", sequence


def scatter_words(scatter: Scatter) -> str:
    """The draws of constants: mean and standard deviation of each."""
    said = [
        f"{name} {number_words(float(np.mean(each)))} ± {number_words(float(np.std(each)), 2)}"
        for name, each in zip(scatter.names, scatter.draws, strict=True)
    ]
    return f"{len(scatter.draws[0])} draws: {', '.join(said)}"


def _constants(material: FatigueConstants | ShearConstants) -> str:
    return ", ".join(f"{name} {number_words(v, 6)}" for name, v in vars(material).items())


def _stresses(values: tuple[float, ...], units: Units) -> str:
    """The stresses of both bodies, once where they are alike."""
    return f"{', '.join(number_words(each, 6) for each in dict.fromkeys(values))} {units.stress}"


def _counted_words(dataset: xr.Dataset) -> str:
    if is_uncounted(dataset, "cycles"):
        return "uncounted: in load cycles, as if each had one strain cycle"
    several = (dataset.counted_number.sum("counted_cycle") > 1.0).any("counted_place")
    lacking = dataset.counted.isnull().all(["counted_place", "counted_cycle"]) & (dataset.s > 0.0)
    words = (
        f"in load cycles, of counted strain cycles: several in {int(several.sum())} of {several.size} points"
    )
    return words + f"; uncounted in {int(lacking.sum())}" * bool(lacking.any())


def _unit(coordinate: xr.DataArray) -> str:
    """The unit that a coordinate has in a study with units."""
    return unit_words(coordinate.attrs.get("units", ""))


def _words(value: xr.DataArray) -> str:
    return coordinate_words(str(value.name), value.item(), value.attrs)


def _axis_words(axis: xr.DataArray) -> str:
    return listed([_words(each) for each in axis], _LISTED)


def _sample_words(sample: xr.DataArray) -> str:
    design = sample.attrs.get("design")
    words = f" ({design.replace('_', ' ')} design, seed {sample.attrs.get('seed')})" if design else ""
    return f"{sample.size} points{words}"


def _range_words(axis: xr.DataArray) -> str:
    known = axis[np.sort(np.unique(axis.values, return_index=True)[1])]
    if axis.dtype.kind not in "fiu" or known.size <= 2:
        return _axis_words(known)
    ends = (known[int(find(known.values))] for find in (np.argmin, np.argmax))
    return "from {} to {}".format(*map(_words, ends))


def completeness(dataset: xr.Dataset) -> str:
    """Count the points that are computed, failed, missing."""
    counts = np.bincount(dataset.status.values.astype(int).ravel(), minlength=len(STATES))
    return ", ".join(f"{count} {state}" for count, state in zip(counts, STATES, strict=False) if count)


def relative_errors(dataset: xr.Dataset) -> FloatArray:
    """s_error over s wherever s is known, finite and positive, shape (n,)."""
    relative = (dataset.s_error / dataset.s).values
    return relative[np.isfinite(relative)]


def accuracy(dataset: xr.Dataset) -> str:
    """Say how large the estimated errors of s are."""
    relative = relative_errors(dataset)
    if not relative.size:
        return "s is 0 or unknown at all points"
    above = int((relative > dataset.attrs["rtol"] * (1.0 + _ROUNDING)).sum()) or "none"
    largest, median = numbers_words((relative.max(), np.median(relative)), 2)
    words = f"relative error of s estimated up to {largest}, median {median}"
    return f"{words}; {above} of {relative.size} points above rtol"
