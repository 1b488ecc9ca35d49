"""An archive in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import read_failures, read_runs
from swtstudy.archive.recall import grid_of
from swtstudy.axes import AXES, CONTACT_AXES
from swtstudy.grid.grid import SAMPLE
from swtstudy.mechanics.points import FloatArray
from swtstudy.parameters import PARAMETERS
from swtstudy.quantities import DISTANCE
from swtstudy.records.records import COMPUTED, STATES, made_by
from swtstudy.records.requested import CONTACT, has_units, request_of
from swtstudy.units.reading import read_contact
from swtstudy.units.results import is_uncounted
from swtstudy.wording import value_words

#: How many values of an axis, or failed points, are listed one by one: a line of a terminal.
_LISTED = 8


def describe(dataset: xr.Dataset) -> Iterator[str]:
    """What an archive is: its study and versions, how complete and how accurate; line by line."""
    attributes = dataset.attrs
    yield f"{attributes['title']}"
    yield f"  made by        {attributes['source']} ({attributes['versions']})"
    for line in attributes["history"].splitlines():
        yield f"  history        {line}"
    yield from _parameters(dataset)
    yield from _contact(dataset)
    yield f"  prescribed     {grid_of(dataset).control.name}"
    yield from _quantities(dataset)
    yield f"  complete       {_completeness(dataset)}"
    yield f"  asked for      rtol {attributes['rtol']:g}"
    yield f"  accurate       {_accuracy(dataset)}"
    yield f"  regimes        {_regimes(dataset)}"
    yield from _runs(dataset)
    yield from _failures(dataset)
    yield f"  figure         {'yes' if 'figure' in attributes else 'no'}"


def _parameters(dataset: xr.Dataset) -> Iterator[str]:
    for name in map(str, dataset.s.dims):
        if name == SAMPLE:
            yield f"  sample         {_sample_words(dataset[SAMPLE])}"
        else:
            yield f"  axis           {name}: {_axis_words(name, dataset[name].values)}{_unit(dataset[name])}"
    for name in (*PARAMETERS, *CONTACT_AXES):
        if name not in dataset.coords or name in dataset.dims:
            continue
        values, unit = dataset[name].values, _unit(dataset[name])
        if not values.ndim:
            yield f"  fixed          {name}: {value_words(name, dataset[name].item())}{unit}"
        elif dataset[name].dims == ("body",):
            yield f"  of each body   {name}: {_axis_words(name, values)}{unit}"
        else:
            yield f"  sampled        {name}: {_range_words(name, values)}{unit}"


def _quantities(dataset: xr.Dataset) -> Iterator[str]:
    asked = request_of(dataset, made_by(read_runs(dataset.attrs["runs"])))
    if asked.names:
        yield f"  quantities     {', '.join(asked.names)}"
    if asked.distances:
        distances = ", ".join(f"{value:.4g}" for value in asked.distances)
        yield f"  distances      {distances}{_unit(dataset[DISTANCE])}"


def _regimes(dataset: xr.Dataset) -> str:
    meanings = dataset.regime.attrs["flag_meanings"].split()
    computed = dataset.status.values == COMPUTED
    counts = np.bincount(dataset.regime.values[computed].astype(int).ravel(), minlength=len(meanings))
    return ", ".join(f"{n} {meaning}" for n, meaning in zip(counts, meanings, strict=False) if n)


def _runs(dataset: xr.Dataset) -> Iterator[str]:
    runs = read_runs(dataset.attrs["runs"])
    counted = np.bincount(dataset.run.values.astype(int).ravel() + 1, minlength=len(runs) + 1)[1:]
    for number, run in enumerate(runs):
        yield (
            f"  run {number}          {counted[number]} points, rtol {run.rtol:g}, "
            f"solver version {run.solver_version}, {run.seconds:.1f} s of computing, "
            f"started {run.started}"
        )


def _failures(dataset: xr.Dataset) -> Iterator[str]:
    failures = read_failures(dataset.status.attrs["failures"])
    for failure in failures[:_LISTED]:
        yield f"  failed         {failure['point']}: {failure['message']}"
    if len(failures) > _LISTED:
        yield f"  failed         {len(failures) - _LISTED} more"


def _contact(dataset: xr.Dataset) -> Iterator[str]:
    """What the results of a study with units say of its contacts, beside the values of parameters."""
    if has_units(dataset):
        given, _ = read_contact(dataset.attrs[CONTACT])
        yield f"  units          {', '.join(vars(given.units).values())}"
        for material in dict.fromkeys(given.materials):
            yield f"  material       {', '.join(f'{name} {v:g}' for name, v in vars(material).items())}"
        if given.materials:
            yield f"  lives          {_counted_words(dataset)}"


def _counted_words(dataset: xr.Dataset) -> str:
    if is_uncounted(dataset, "cycles"):
        return "uncounted: in rounds, as if each had one strain cycle"
    several = (dataset.counted_number.sum("counted_cycle") > 1.0).any("counted_place")
    lacking = dataset.counted.isnull().all(["counted_place", "counted_cycle"]) & (dataset.s > 0.0)
    words = f"in rounds, of counted strain cycles: several in {int(several.sum())} of {several.size} points"
    return words + f"; uncounted in {int(lacking.sum())}" * bool(lacking.any())


def _unit(coordinate: xr.DataArray) -> str:
    """The unit that a coordinate has in a study with units."""
    units, own = coordinate.attrs.get("units", ""), AXES[str(coordinate.name)].units
    return f" {units}" if units not in ("", "1", own) else ""


def _axis_words(name: str, values: np.ndarray) -> str:
    words = [value_words(name, value) for value in values.tolist()]
    if len(words) <= _LISTED:
        return ", ".join(words)
    return f"{words[0]}, {words[1]} … {words[-1]} ({len(words)} values)"


def _sample_words(sample: xr.DataArray) -> str:
    design = sample.attrs.get("design")
    words = f" ({design.replace('_', ' ')} design, seed {sample.attrs.get('seed')})" if design else ""
    return f"{sample.size} points{words}"


def _range_words(name: str, values: np.ndarray) -> str:
    known = list(dict.fromkeys(values.tolist()))
    if isinstance(known[0], str) or len(known) <= 2:
        return _axis_words(name, np.array(known, dtype=object))
    return f"from {value_words(name, min(known))} to {value_words(name, max(known))}"


def _completeness(dataset: xr.Dataset) -> str:
    counts = np.bincount(dataset.status.values.astype(int).ravel(), minlength=len(STATES))
    return ", ".join(f"{count} {state}" for count, state in zip(counts, STATES, strict=False) if count)


def relative_errors(dataset: xr.Dataset) -> FloatArray:
    """s_error over s wherever s is known, finite and positive, shape (n,)."""
    relative = (dataset.s_error / dataset.s).values
    return relative[np.isfinite(relative)]


def _accuracy(dataset: xr.Dataset) -> str:
    relative = relative_errors(dataset)
    if not relative.size:
        return "no value of s"
    above = int((relative > dataset.attrs["rtol"]).sum())
    return (
        f"relative error of s estimated up to {relative.max():.1e}, median {np.median(relative):.1e}; "
        f"{above} of {relative.size} points above rtol"
    )
