"""An archive in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.attributes import defined_in, read_runs
from swtstudy.archive.outcome import outcome
from swtstudy.archive.recall import request_of
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import validity_lines
from swtstudy.points.values import index_at, unit_of
from swtstudy.study.figure import FigureLayout
from swtstudy.units.life import FatigueConstants, Scatter, ShearConstants
from swtstudy.units.reading import read_contact
from swtstudy.units.results import is_uncounted, sequence_words
from swtstudy.units.rows import Units
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.parameters import CONTACT_AXES, LOOP_AMPLITUDE, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING
from swtstudy.vocabulary.variables import COMPUTED, CONTACT, FAILED, STATES, has_units
from swtstudy.vocabulary.wording import coordinate_words, listed, number_of, number_words, numbers_words

#: How many values of an axis, or failed points, are listed one by one: a line of a terminal.
_LISTED = 8
#: Letters to the left of the words of a line.
INDENT = 17
#: Parameters that scale the columns of a loop, one of these each, and the symbol of the scaled column.
_COLUMNS = (
    {"normal_force_amplitude": "F_N", "normal_amplitude": "δ"},
    {"tangential_force_amplitude": "F_x", "tangential_amplitude": "u"},
    {"bulk_stress_amplitude": "σ_B"},
)
#: Relative rounding of an error that is rtol of s.
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
    yield from (("history", line) for line in attributes.get("history", "").splitlines())
    yield from _parameters(dataset)
    yield from _contact(dataset)
    if "control" in dataset.coords:
        yield "prescribed", str(dataset.control.item())
    asked = request_of(dataset) if "runs" in attributes else NOTHING
    if asked.names:
        yield "quantities", ", ".join(asked.names)
    if asked.distances:
        distances = ", ".join(f"{value:.4g}" for value in asked.distances)
        yield "distances", f"{distances}{unit_of(dataset[DISTANCE])}"
    if "status" in dataset:
        counts = _counted(dataset.status.values, STATES)
        yield "complete", ", ".join(f"{count} {state}" for state, count in counts.items())
    if "rtol" in attributes:
        yield "asked for", f"rtol {attributes['rtol']:g}"
        yield "accurate", accuracy(dataset)
    yield "regimes", ", ".join(f"{count} {name}" for name, count in regime_counts(dataset).items())
    yield from (("validity", line) for line in validity_lines(dataset, inside=True))
    for number, run in enumerate(read_runs(attributes.get("runs", "[]"))):
        words = number_of(int((dataset.run == number).sum()), "point")
        words += f", rtol {run.rtol:g}, solver version {run.solver_version}"
        yield f"run {number}", f"{words}, {run.seconds:.1f} s of computing, started {run.started}"
    failed = [f"{where}: {why}" for where, why in failures(dataset)]
    more = [f"{len(failed) - _LISTED} more"] if len(failed) > _LISTED else []
    yield from (("failed", words) for words in [*failed[:_LISTED], *more])
    if "figure" in attributes:
        yield "figure", _figure_words(FigureLayout.from_json(attributes["figure"]))


def _parameters(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    for name in map(str, dataset.s.dims):
        if name == SAMPLE:
            attributes, words = dataset[SAMPLE].attrs, number_of(dataset.sizes[SAMPLE], "point")
            if "design" in attributes:
                design = str(attributes["design"]).replace("_", " ")
                words += f" ({design} design, seed {attributes.get('seed')})"
            yield "sample", words
        else:
            yield "axis", f"{name}: {_axis_words(dataset[name])}{unit_of(dataset[name])}"
    for load, words in recorded_loads(dataset):
        yield "load", f"{load}: {words}"
    for name in (*PARAMETERS, *CONTACT_AXES):
        if name not in dataset.coords or name in dataset.dims or name in unsaid(dataset):
            continue
        dims = dataset[name].dims
        label = "fixed" if not dims else "of each body" if dims == ("body",) else "sampled"
        words = _range_words(dataset[name]) if label == "sampled" else _axis_words(dataset[name])
        yield label, f"{name}: {words}{unit_of(dataset[name])}"


def unsaid(dataset: xr.Dataset) -> set[str]:
    """Names of coordinates without a meaning: of loops the phase, of recorded loads the factors of 1."""
    loads, names = _loops(dataset), map(str, dataset.coords)
    factors = {n for n in names if n.endswith("_amplitude") and (dataset[n].values == LOOP_AMPLITUDE).all()}
    recorded = all(each.mean_normal is not None for each in loads)
    return {"frequency_ratio", "phase", *(factors if recorded else ())} if loads else set()


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
        means = load.mean_normal, 0.0, float(dataset.get("bulk_stress_mean", 0.0))
        said = []
        for column, mean, names in zip(load.course().T, means, _COLUMNS, strict=False):
            name = next((each for each in names if each in dataset.coords and not dataset[each].ndim), None)
            if name is not None:
                ends = mean + float(dataset[name]) * np.array([column.min(), column.max()])
                low, high = (number_words(end).replace("-", "−") for end in ends)
                said.append(f"{names[name]} {low} to {high}{unit_of(dataset[name])}")
        yield str(load), ", ".join(said)


def _figure_words(layout: FigureLayout) -> str:
    """Describe the figure of the study: "s over phase, a line for each normal_amplitude"."""
    parts = [f"{', '.join(layout.y)} over {layout.x}"]
    roles = {"upwards": layout.vertical, "a line for each": layout.hue, "a panel for each": layout.panels}
    parts += [f"{words} {name}" for words, name in roles.items() if name]
    return ("" if layout.kind == "lines" else f"{layout.kind}: ") + ", ".join(parts)


def regime_counts(dataset: xr.Dataset) -> dict[str, int]:
    """Count the computed points of each regime that there is."""
    computed = (dataset.status == COMPUTED if "status" in dataset else dataset.regime.notnull()).values
    return _counted(dataset.regime.values[computed], dataset.regime.attrs["flag_meanings"].split())


def _counted(flags: NDArray[Any], words: Sequence[str]) -> dict[str, int]:
    """Number of points with each flag that there is, by what it means."""
    counts = np.bincount(flags.astype(int).ravel(), minlength=len(words)).tolist()
    return {each: count for each, count in zip(words, counts, strict=False) if count}


def failures(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Say of each point that failed where it is, and why."""
    for flat in np.flatnonzero(dataset.status.values == FAILED).tolist() if "message" in dataset else ():
        point = dataset.isel(index_at(dataset.s, flat))
        names = [n for n in (*PARAMETERS, *CONTACT_AXES) if n in dataset.coords and dataset[n].ndim]
        where = ", ".join(f"{name}={_words(point[name])}" for name in names)
        yield where or "the point", str(point.message.item())


def _contact(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    """List the facts of the contacts of a study with units, besides the values of parameters."""
    if not has_units(dataset):
        return
    given = read_contact(dataset.attrs[CONTACT])
    lives = given.materials or given.shear_materials
    several: dict[str, Iterable[str]] = {
        "units": [", ".join(filter(None, vars(given.units).values()))],
        "material": map(_constants, dict.fromkeys(given.materials)),
        "scatter": [scatter_words(given.scatter)] if given.scatter else (),
        "in torsion": map(_constants, dict.fromkeys(given.shear_materials)),
        "yields at": [_stresses(given.yield_strengths, given.units)],
        "Findley limit": [_stresses(given.findley_limits, given.units)],
        "lives": [_counted_words(dataset)] if lives else (),
        "sequence": [sequence_words(dataset, given.blocks)],
    }
    yield from ((label, words) for label, lines in several.items() for words in lines if words)


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
    """The stresses of both bodies, once where they are alike; empty if there are none."""
    several = ", ".join(number_words(each, 6) for each in dict.fromkeys(values))
    return f"{several} {units.stress}" if several else ""


def _counted_words(dataset: xr.Dataset) -> str:
    if is_uncounted(dataset, "cycles"):
        return "uncounted: in load cycles, as if each had one strain cycle"
    several = (dataset.counted_number.sum("counted_cycle") > 1.0).any("counted_place")
    lacking = dataset.counted.isnull().all(["counted_place", "counted_cycle"]) & (dataset.s > 0.0)
    words = (
        f"in load cycles, of counted strain cycles: several in {int(several.sum())} of {several.size} points"
    )
    return words + f"; uncounted in {int(lacking.sum())}" * bool(lacking.any())


def _words(value: xr.DataArray) -> str:
    return coordinate_words(str(value.name), value.item(), value.attrs)


def _axis_words(axis: xr.DataArray) -> str:
    return listed([_words(each) for each in axis], _LISTED) if axis.ndim else _words(axis)


def _range_words(axis: xr.DataArray) -> str:
    known = axis[np.sort(np.unique(axis.values, return_index=True)[1])]
    if axis.dtype.kind not in "fiu" or known.size <= 2:
        return _axis_words(known)
    ends = int(known.values.argmin()), int(known.values.argmax())
    return f"from {_words(known[ends[0]])} to {_words(known[ends[1]])}"


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
