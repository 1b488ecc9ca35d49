"""The outcome of a run in one line: values with their places, lives, and what is outside of the model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.points.validity import outside_words, point_words
from swtstudy.points.values import index_at
from swtstudy.study.figure import FigureLayout
from swtstudy.units.reading import read_contact
from swtstudy.units.results import measures, sequence_words
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA
from swtstudy.vocabulary.derived import FAILED, LIFE, LIVES, PERCENTS
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.variables import CONTACT, has_units
from swtstudy.vocabulary.wording import number_words, numbers_words, unit_words

#: Lives over more critical distances are a range.
_DISTANCES = 3


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
    found = [_values(dataset, name) for name in measures(dataset)] or [*_of_criteria(dataset)]
    yield f"{'; '.join([*found, *life_words(dataset)])}.".replace("= -", "= −")
    if words := outside_words(dataset):
        yield words


def _of_criteria(dataset: xr.Dataset) -> Iterator[str]:
    """Values of s, by each criterion where there are several: these are not to be compared."""
    if "criterion" not in dataset.dims:
        yield _values(dataset, "s")
        return
    for each in dataset.criterion.values:
        yield f"{each}: {_values(dataset.sel(criterion=each), 's')}"


def _values(dataset: xr.Dataset, name: str) -> str:
    """The value of a criterion: one with its place, or the least and the greatest with their points."""
    values, unit = dataset[name].values.ravel(), _unit(dataset[name])
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


def _unit(values: xr.DataArray) -> str:
    return unit_words(str(values.attrs.get("units", "1")))


def _position(dataset: xr.Dataset, flat: int) -> str:
    """Position of the critical point of one of the flattened points; empty where none is critical."""
    for name, symbol in (("critical_position", "x"), ("critical_x", "x/a_H")):
        if name in dataset:
            x = float(dataset[name].isel(index_at(dataset.s, flat), missing_dims="ignore"))
            return f"{symbol} = {number_words(x, 3)}{_unit(dataset[name])}" if math.isfinite(x) else ""
    return ""


def life_words(dataset: xr.Dataset) -> Iterator[str]:
    """The life by each criterion that has one, at the worst point and as a mean over critical distances."""
    if not has_units(dataset):
        return
    if sequence := sequence_words(dataset, read_contact(dataset.attrs[CONTACT]).blocks):
        yield f"sequence of blocks: {sequence}"
        return
    kinds = [kind for kind in CRITERIA.values() if kind.life and kind.life in dataset]
    for kind in kinds:
        said = [f"{_ends(dataset[kind.life].values)} load cycles (worst point)"]
        for name in asked_means(dataset, kind.life):
            said += [f"{_ends(values)} (mean over {words})" for words, values in _over(dataset[name])]
        yield f"N{f' by {kind.name}' * (len(kinds) > 1)} = {', '.join(said)}"
        shown = [y for y in shown_in(dataset) if y in (kind.life, *asked_means(dataset, kind.life))]
        yield from _scatter([*shown, *asked_means(dataset, kind.life), kind.life][0], dataset)


def _scatter(life: str, dataset: xr.Dataset) -> Iterator[str]:
    """Percentiles of a life where it is shortest, and the largest probability of a crack before a target."""
    if f"{life}_{PERCENTS[0]}" in dataset:
        shortest = (float(dataset[f"{life}_{percent}"].min()) for percent in PERCENTS)
        words = (f"N{p} = {each}" for p, each in zip(PERCENTS, numbers_words(shortest, 2), strict=True))
        which = f" ({life})" * (life not in ("cycles", "FS_cycles"))
        yield f"scatter of the constants, shortest lives{which}: {', '.join(words)}"
    if (name := life.replace(LIFE, FAILED)) in dataset:
        yield f"{dataset[name].long_name}: up to {number_words(float(dataset[name].max()), 2)}"


def asked_means(dataset: xr.Dataset, life: str) -> list[str]:
    """Lives by nonlocal means that the study's figure shows; without one the life by the mean over a volume.

    Parameters
    ----------
    dataset
        Results.
    life
        Name of the life at the worst point; the names of nonlocal lives begin with it.
    """
    means = [name for name in LIVES if name in dataset and name.startswith(f"{life}_")]
    return [y for y in shown_in(dataset) if y in means] or [n for n in means if n == f"{life}_volume"]


def shown_in(dataset: xr.Dataset) -> list[str]:
    """Data variables that the figure of the study shows; none without a figure."""
    text: Any = dataset.attrs.get("figure")
    return [y for y in FigureLayout.from_json(text).y if y in dataset.data_vars] if text else []


def _over(life: xr.DataArray) -> Iterator[tuple[str, FloatArray]]:
    """Critical distances in words, each with the lives over it; of many their range with all lives."""
    distances, unit = np.atleast_1d(life[DISTANCE].values), unit_words(life[DISTANCE].attrs.get("units", ""))
    if distances.size > _DISTANCES:
        yield f"{' to '.join(map(number_words, (distances.min(), distances.max())))}{unit}", life.values
        return
    for k, distance in enumerate(distances):
        own = life.isel({DISTANCE: k}, missing_dims="ignore")
        yield f"{number_words(distance)}{unit}", own.values


def _ends(lives: FloatArray) -> str:
    """The longest and the shortest life: at the smallest and at the largest value of the criterion."""
    known = lives[~np.isnan(lives)]
    if not known.size:
        return "unknown"
    ends = dict.fromkeys(numbers_words((known.max(), known.min()), 2))
    return " to ".join("∞" if each == "inf" else each for each in ends)
