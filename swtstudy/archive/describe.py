"""Results in words: their outcome in one line, and all that an archive says."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.recall import request_of
from swtstudy.points.chunk import read_runs
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside_words, point_words, validity_lines
from swtstudy.points.values import index_at, unit_of
from swtstudy.study.figure import FigureLayout
from swtstudy.study.units.grid import ContactDetails
from swtstudy.study.units.life import FatigueConstants, Scatter, ShearConstants
from swtstudy.study.units.reading import read_contact
from swtstudy.study.units.results import measures, sequence_words
from swtstudy.study.units.rows import Units
from swtstudy.study.writing import defined_in
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA
from swtstudy.vocabulary.derived import FAILED as FAILED_SHARE
from swtstudy.vocabulary.derived import LIFE, LIVES, PERCENTS, REPETITIONS
from swtstudy.vocabulary.parameters import CONTACT_AXES, LOOP_AMPLITUDE, PARAMETERS
from swtstudy.vocabulary.quantities import COMPUTED, CONTACT, DISTANCE, FAILED, NOTHING, STATES, has_units
from swtstudy.vocabulary.wording import line_words, listed, number_of, number_words, numbers_words

#: Sizes of contacts at rest that tell a wrong unit at a glance, and their kinds.
TOLD_AT_REST = {"normal_force": "force", "contact_radius": "length", "peak_pressure": "stress"}
#: Lives over more critical distances are a range.
_DISTANCES = 3
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

    Results of `swtstudy.solve` have neither study nor versions.
    """
    yield str(dataset.attrs.get("title", "Results"))
    yield from (f"  {line}" for line in outcome(dataset))
    yield from (f"{f'  {label}':<{INDENT}}{words}" for label, words in facts(dataset))


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
        yield "complete", completeness(dataset)
    if "rtol" in attributes:
        yield "asked for", f"rtol {attributes['rtol']:g}"
        yield "accurate", accuracy(dataset)
    yield "regimes", ", ".join(f"{count} {name}" for name, count in regime_counts(dataset).items())
    yield from (("validity", line) for line in validity_lines(dataset, inside=True))
    yield from (("told", line) for line in told(dataset))
    for number, run in enumerate(read_runs(attributes.get("runs", "[]"))):
        words = number_of(int((dataset.run == number).sum()), "point")
        words += f", rtol {run.rtol:g}, solver version {run.solver_version}"
        yield f"run {number}", f"{words}, {run.seconds:.1f} s of computing, started {run.started}"
    failed = [f"{where}: {why}" for where, why in failures(dataset)]
    more = [f"{len(failed) - _LISTED} more"] if len(failed) > _LISTED else []
    yield from (("failed", words) for words in [*failed[:_LISTED], *more])
    if "figure" in attributes:
        layout = FigureLayout.from_json(attributes["figure"])
        roles = {"upwards": layout.vertical, "a line for each": layout.hue, "a panel for each": layout.panels}
        drawn = [f"{', '.join(layout.y)} over {layout.x}"]
        drawn += [f"{role} {name}" for role, name in roles.items() if name]
        yield "figure", ("" if layout.kind == "lines" else f"{layout.kind}: ") + ", ".join(drawn)


def told(dataset: xr.Dataset) -> list[str]:
    """The warnings of the study of these results when it was read."""
    return str(dataset.attrs.get("told", "")).splitlines()


def _parameters(dataset: xr.Dataset) -> Iterator[tuple[str, str]]:
    for name in map(str, dataset.s.dims):
        if name == SAMPLE:
            attributes, words = dataset[SAMPLE].attrs, number_of(dataset.sizes[SAMPLE], "point")
            if "design" in attributes:
                design = str(attributes["design"]).replace("_", " ")
                words += f" ({design} design, seed {attributes.get('seed')})"
            yield "sample", words
        elif name in dataset.indexes and dataset.indexes[name].nlevels > 1:  # stacked, by xarray
            axes = ", ".join(map(str, dataset.indexes[name].names))
            yield "axis", f"{name}: {number_of(dataset.sizes[name], 'point')} of {axes}"
        else:
            yield "axis", f"{name}: {_axis_words(dataset[name])}{unit_of(dataset[name])}"
    for load, words in recorded_loads(dataset):
        yield "load", f"{load}: {words}"
    said = {*dataset.dims, *unsaid(dataset)}
    for name in (n for n in (*PARAMETERS, *CONTACT_AXES) if n in dataset.coords and n not in said):
        values, dims = dataset[name], dataset[name].dims
        label = "fixed" if not dims else "of each body" if dims == ("body",) else "sampled"
        words = _range_words(values) if label == "sampled" else _axis_words(values)
        yield label, f"{name}: {words}{unit_of(values)}"


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


def regime_counts(dataset: xr.Dataset) -> dict[str, int]:
    """Count the computed points of each regime that there is."""
    computed = dataset.status == COMPUTED if "status" in dataset else True
    return _counted(dataset.regime.where(computed).values, dataset.regime.attrs["flag_meanings"].split())


def _counted(flags: NDArray[Any], words: Sequence[str]) -> dict[str, int]:
    """Number of points with each flag that there is, by what it means; NaN, as of xarray's where, is none."""
    counts = np.bincount(flags[np.isfinite(flags)].astype(int), minlength=len(words)).tolist()
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
        "at rest": [rest_words(dataset)],
        "units": [", ".join(filter(None, vars(given.units).values()))],
        "bulk stress": [_carrier(dataset, given)],
        "material": map(_constants, dict.fromkeys(given.materials)),
        "scatter": [scatter_words(given.scatter)] if given.scatter else (),
        "in torsion": map(_constants, dict.fromkeys(given.shear_materials)),
        "yields at": [_stresses(given.yield_strengths, given.units)],
        "Findley limit": [_stresses(given.findley_limits, given.units)],
        "lives": [_counted_words(dataset)] if lives else (),
        "sequence": [sequence_words(dataset, given.blocks)],
    }
    yield from ((label, words) for label, lines in several.items() for words in lines if words)


def rest_words(sizes: Mapping[Any, xr.DataArray]) -> str:
    """Sizes of real contacts at rest, by name as in results, in words; empty without units."""
    said = []
    for name in TOLD_AT_REST if all(name in sizes for name in TOLD_AT_REST) else ():
        ends = numbers_words([float(sizes[name].min()), float(sizes[name].max())])
        said.append(f"{name} {' to '.join(dict.fromkeys(ends))}{unit_of(sizes[name])}")
    return ", ".join(said)


def _carrier(dataset: xr.Dataset, given: ContactDetails) -> str:
    """The body that carries the bulk stress; empty without one."""
    if not any(np.any(dataset.get(f"bulk_stress_{part}", 0.0)) for part in ("amplitude", "mean", "ratio")):
        return ""
    body = given.bulk_stress_body
    return f"in body {body + 1}" + (f", {given.body_names[body]}" if given.body_names else "")


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
    if "counted" not in dataset:
        return "uncounted: in load cycles, as if each had one strain cycle"
    several = (dataset.counted_number.sum("counted_cycle") > 1.0).any("counted_place")
    lacking = dataset.counted.isnull().all(["counted_place", "counted_cycle"]) & (dataset.s > 0.0)
    words = (
        f"in load cycles, of counted strain cycles: several in {int(several.sum())} of {several.size} points"
    )
    return words + f"; uncounted in {int(lacking.sum())}" * bool(lacking.any())


def _words(value: xr.DataArray) -> str:
    return line_words(str(value.name), value.item(), value.attrs)


def _axis_words(axis: xr.DataArray) -> str:
    words = [_words(each) for each in (axis if axis.ndim else [axis])]
    if words[-1].endswith(" rad"):  # once, behind the last
        words[:-1] = [each.removesuffix(" rad") for each in words[:-1]]
    return listed(words, _LISTED)


def _range_words(axis: xr.DataArray) -> str:
    _, first = np.unique(axis.values, return_index=True)
    if axis.dtype.kind not in "fiu" or len(first) <= 2:
        return _axis_words(axis[np.sort(first)])
    return f"from {_words(axis[first[0]])} to {_words(axis[first[-1]])}"


def completeness(dataset: xr.Dataset) -> str:
    """Count the points that are computed, failed, missing."""
    return ", ".join(f"{count} {state}" for state, count in _counted(dataset.status.values, STATES).items())


def relative_errors(dataset: xr.Dataset) -> FloatArray:
    """s_error over s wherever s is known, finite and positive, shape (n,)."""
    relative = (dataset.s_error / dataset.s).values
    return relative[np.isfinite(relative)]


def accuracy(dataset: xr.Dataset) -> str:
    """Say how large the estimated errors of s are."""
    relative = relative_errors(dataset)
    if not relative.size:
        return "s is 0 or unknown at all points"
    above = int((relative > dataset.attrs["rtol"] * (1.0 + _ROUNDING)).sum())
    largest, median = numbers_words((relative.max(), np.median(relative)), 2)
    words = "relative error of s estimated"
    if relative.size == 1:
        return f"{words} {largest}, {'above' if above else 'not above'} rtol"
    return f"{words} up to {largest}, median {median}; {above or 'none'} of {relative.size} points above rtol"


def outcome(dataset: xr.Dataset) -> Iterator[str]:
    """Say what was found, and then, if anything is, what is outside of the model.

    Parameters
    ----------
    dataset
        Results. Values are given with the place of the critical point; of several points the least and the
        greatest, with their parameters.

    Examples
    --------
    >>> import swtstudy
    >>> for line in outcome(swtstudy.solve(rtol=1e-3, friction=[0.2, 0.4])):
    ...     print(line)
    s = 0.08612 (friction = 0.2; x/a_H = −1.32) to 0.2443 (friction = 0.4; x/a_H = −1.32).
    """
    found = [_criterion_words(dataset, name) for name in measures(dataset)]
    if not found and "criterion" in dataset.dims:  # values by several criteria are not to be compared
        parts = {each: dataset.sel(criterion=each) for each in dataset.criterion.values}
        found = [f"{each}: {_criterion_words(part, 's')}" for each, part in parts.items()]
    found = found or [_criterion_words(dataset, "s")]
    yield f"{'; '.join([*found, *life_words(dataset)])}.".replace("= -", "= −")
    if words := outside_words(dataset):
        yield words


def _criterion_words(dataset: xr.Dataset, name: str) -> str:
    """The value of a criterion: one with its place, or the least and the greatest with their points."""
    values, unit = dataset[name].values.ravel(), unit_of(dataset[name])
    known = np.flatnonzero(np.isfinite(values))
    if not known.size:
        return f"{name} is finite at no point"
    ends = [int(known[values[known].argmin()]), int(known[values[known].argmax()])]
    least, most = numbers_words(values[ends])
    if least == most:
        place, alike = _position(dataset, ends[1]), f" at all {known.size} points" * (known.size > 1)
        return f"{name} = {most}{unit}{alike}{f' at {place}' * bool(place)}"
    places = ("; ".join(filter(None, (point_words(dataset, k), _position(dataset, k)))) for k in ends)
    several = (f"{each}{unit} ({where})" for each, where in zip((least, most), places, strict=True))
    return f"{name} = {' to '.join(several)}"


def _position(dataset: xr.Dataset, flat: int) -> str:
    """Position of the critical point of one of the flattened points; empty where none is critical."""
    for name, symbol in (("critical_position", "x"), ("critical_x", "x/a_H")):
        if name in dataset:
            x = float(dataset[name].isel(index_at(dataset.s, flat), missing_dims="ignore"))
            return f"{symbol} = {number_words(x, 3)}{unit_of(dataset[name])}" if math.isfinite(x) else ""
    return ""


def life_words(dataset: xr.Dataset) -> Iterator[str]:
    """The life by each criterion that has one, at the worst point and as a mean over critical distances."""
    if not has_units(dataset):
        return
    if sequence := sequence_words(dataset, read_contact(dataset.attrs[CONTACT]).blocks):
        yield f"sequence of blocks: {sequence}"
        for kind in CRITERIA.values():
            yield from _scatter(kind.life.replace(LIFE, REPETITIONS), dataset)
        return
    kinds = [kind for kind in CRITERIA.values() if kind.life and kind.life in dataset]
    for kind in kinds:
        said = [f"{_ends(dataset[kind.life].values)} load cycles (worst point)"]
        # Lives by means that the figure shows; without one the life by the mean over a volume.
        means = [name for name in LIVES if name in dataset and name.startswith(f"{kind.life}_")]
        shown = [y for y in shown_in(dataset) if y in (kind.life, *means)]
        means = [y for y in shown if y != kind.life] or [n for n in means if n == f"{kind.life}_volume"]
        for name in means:
            said += [f"{_ends(values)} (mean over {words})" for words, values in _over(dataset[name])]
        yield f"N{f' by {kind.name}' * (len(kinds) > 1)} = {', '.join(said)}"
        yield from _scatter([*shown, *means, kind.life][0], dataset)


def _scatter(life: str, dataset: xr.Dataset) -> Iterator[str]:
    """Percentiles of a life where it is shortest, and the largest probability of a crack before a target."""
    if f"{life}_{PERCENTS[0]}" in dataset:
        shortest = (float(dataset[f"{life}_{percent}"].min()) for percent in PERCENTS)
        words = (f"N{p} = {each}" for p, each in zip(PERCENTS, numbers_words(shortest, 2), strict=True))
        which = f" ({life})" * (life not in ("cycles", "FS_cycles"))
        yield f"scatter of the constants, shortest lives{which}: {', '.join(words)}"
    if LIFE in life and (name := life.replace(LIFE, FAILED_SHARE)) in dataset:
        most = float(dataset[name].max())
        yield f"{dataset[name].long_name}: {f'up to {number_words(most, 2)}' if most else '0 in all draws'}"


def shown_in(dataset: xr.Dataset) -> list[str]:
    """Data variables that the figure of the study shows; none without a figure."""
    text: Any = dataset.attrs.get("figure")
    return [y for y in FigureLayout.from_json(text).y if y in dataset.data_vars] if text else []


def _over(life: xr.DataArray) -> Iterator[tuple[str, FloatArray]]:
    """Critical distances in words, each with the lives over it; of many their range with all lives."""
    distances, unit = np.atleast_1d(life[DISTANCE].values), unit_of(life[DISTANCE])
    if distances.size > _DISTANCES:
        yield f"{' to '.join(map(number_words, (distances.min(), distances.max())))}{unit}", life.values
        return
    for k, distance in enumerate(distances):
        own = life.isel({DISTANCE: k}, missing_dims="ignore")
        yield f"{number_words(distance)}{unit}", own.values


def _ends(lives: FloatArray) -> str:
    """The longest life and the shortest: those of the least and of the greatest value of the criterion."""
    known = lives[~np.isnan(lives)]
    if not known.size:
        return "unknown"
    ends = dict.fromkeys(numbers_words((known.max(), known.min()), 2))
    return " to ".join("∞" if each == "inf" else each for each in ends)
