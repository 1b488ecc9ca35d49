"""Findings in results: what the study asked for, which parameter changes it by how much, and where."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.outcome import life_words, outcome, shown_in
from swtstudy.archive.recall import grid_of
from swtstudy.figures.draw import layout_of
from swtstudy.figures.quantity_words import flag_words, is_life
from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import index_at
from swtstudy.reports.values import (
    is_number,
    place_html,
    symbol_html,
    symbol_of,
    unit_of,
    value_text,
    with_unit,
)
from swtstudy.results.evaluate import extrema
from swtstudy.results.sensitivity import sensitivity
from swtstudy.study.figure import FigureLayout
from swtstudy.units.results import LIVES, measures
from swtstudy.vocabulary.choices import FAMILIES, SWT, family_of
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import AXES, PARAMETERS
from swtstudy.vocabulary.variables import has_units
from swtstudy.vocabulary.wording import number_words, numbers_words

#: The parameter whose values have an s of another kind each.
CRITERION = "criterion"
#: A parameter that changes the quantity by less goes unmentioned in the sentences.
_CHANGES = 1.005
#: Beginnings of the names of quantities whose ratios say nothing: places and their planes.
_PLACES = "critical_"


@dataclass(frozen=True)
class Lever:
    """A dimension, and by how much it changes a quantity at most.

    Attributes
    ----------
    name
        The dimension.
    table
        Extrema of the quantity along it, as of `swtstudy.results.evaluate.extrema`.
    there
        The place along the other dimensions at which the ratio of the extrema is largest.
    """

    name: str
    table: xr.Dataset
    there: xr.Dataset

    @property
    def ratio(self) -> float:
        """Maximum over minimum."""
        return float(self.there.ratio)

    @property
    def chosen(self) -> bool:
        """True for a parameter of the load, of which there may be a better and a worse one."""
        return AXES[self.name].part == "load"


def measured(dataset: xr.Dataset) -> xr.DataArray:
    """The quantity that a study asks for.

    It is a life where the figure shows one, else the first number in the figure; without a figure a life over
    a critical distance, the life at the worst point, or the value of the criterion. Several criteria have
    values of their own units.
    """
    own = measures(dataset)
    if len(own) > 1:
        values = dataset[own[0]]
        for other in own[1:]:
            values = values.fillna(dataset[other])
        return values.drop_attrs(deep=False).assign_attrs(symbol=r"\text{value}", units="").rename("value")
    usual = [name for name in ("cycles_volume", *LIVES) if name in dataset]
    shown = [y for y in shown_in(dataset) if not y.startswith(_PLACES) and not flag_words(dataset[y])]
    lives = [y for y in shown if is_life(dataset[y].attrs)]
    return dataset[[*lives, *shown, *usual[: not shown], *own, "s"][0]]


def measured_at(dataset: xr.Dataset, place: xr.Dataset) -> xr.DataArray:
    """The quantity that the criterion of a place measures."""
    if CRITERION not in dataset.dims:
        return measured(dataset)
    part = dataset.sel({CRITERION: place[CRITERION].item()})
    return part[[*measures(part), "s"][0]]


def levers(dataset: xr.Dataset) -> list[Lever]:
    """Every dimension of more than one value: the figure's x first, then by ratio.

    Without a figure the phase is first, which costs nothing to choose. A sample has none, since its points
    differ in all that is sampled; nor has the criterion, whose values are not of one kind.
    """
    values = measured(dataset)
    first = layout_of(dataset).x if "figure" in dataset.attrs else "phase"
    found = []
    for name in map(str, values.dims):
        if values.sizes[name] < 2 or SAMPLE in values.dims or name not in AXES or name == CRITERION:
            continue
        table = extrema(dataset.assign(measured=values), name, "measured")
        ratio = table.ratio.where(np.isfinite(table.ratio))
        if not ratio.notnull().any():
            continue
        found.append(Lever(name, table, table.isel(index_at(ratio, int(np.nanargmax(ratio.values))))))
    return sorted(found, key=lambda lever: (lever.name != first, -lever.ratio))


def sentences(dataset: xr.Dataset, indices: xr.Dataset | StudyError | None = None) -> list[str]:
    """List the findings as HTML: the study's own message, then the answer to its question.

    The latter begins with the Sobol indices, as from `indices_of`, if these are given.
    """
    text = dataset.attrs.get("figure")
    own = FigureLayout.from_json(text).message if text else None
    said = [escape(own)] if own else []
    said += [_most_sensitive(indices)] if isinstance(indices, xr.Dataset) else []
    values = measured(dataset)
    if values.size == 1 and has_units(dataset):
        return [*said, escape(next(outcome(dataset)))]
    moved = [
        _sentence(lever, _symbol(measured_at(dataset, lever.there)))
        for lever in levers(dataset)
        if lever.ratio > _CHANGES
    ]
    said += moved
    if SAMPLE in values.dims or not moved:
        if CRITERION in dataset.dims:
            for k in range(dataset.sizes[CRITERION]):
                one = dataset.isel({CRITERION: k})
                words = _range(measured_at(dataset, one))
                said.append(f"{value_text(CRITERION, one.criterion.item(), {})}: {words}")
        else:
            said.append(_range(values))
    return [*said, *(f"{escape(words[0].upper() + words[1:])}." for words in life_words(dataset))]


def _most_sensitive(indices: xr.Dataset) -> str:
    """Say which sampled parameter has the largest Sobol index, and which the second largest."""
    total = indices.total.isel(quantity=0)
    mean = total.mean([dim for dim in total.dims if dim != "parameter"])
    said = []
    for k in np.argsort(-mean.values)[:2]:
        one = indices.isel(parameter=int(k), quantity=0)
        ends = dict.fromkeys(f"{float(end):.2f}" for end in (one.total.min(), one.total.max()))
        symbol, meaning = symbol_html(str(one.symbol.item())), AXES[str(one.parameter.item())].meaning
        said.append((f"he {escape(meaning)} {symbol}", " to ".join(ends)))
    (most, index), *others = said
    words = "".join(f"; next is t{name}, {lower}" for name, lower in others)
    return f"T{most} matters most, with a Sobol index of <b>{index}</b>{words}."


def indices_of(dataset: xr.Dataset) -> xr.Dataset | StudyError | None:
    """Sobol indices of what a study asks for; why there are none; None without the design for them."""
    if SAMPLE not in dataset.coords or dataset[SAMPLE].attrs.get("design") != "saltelli":
        return None
    try:
        return sensitivity(dataset, str(measured(dataset).name))
    except StudyError as error:
        return error


def _symbol(values: xr.DataArray) -> str:
    return "<i>s</i>" if values.name == "s" else symbol_of(values)


def _sentence(lever: Lever, symbol: str) -> str:
    there, life = lever.there, is_life(lever.table.minimum.attrs)
    where = place_words(there.drop_vars(["at_minimum", "at_maximum"]), lever.table)
    words = ("best", "worst") if lever.chosen else ("longest", "shortest") if life else ("lowest", "highest")
    ends = ("maximum", "minimum") if life else ("minimum", "maximum")
    first, second = (_at(lever.name, there[f"at_{end}"]) for end in ends)
    named = f"The {re.split('[,:]', AXES[lever.name].meaning)[0]}"
    if is_number(there.at_minimum):
        named += f" {symbol_of(there.at_minimum.rename(lever.name))}"
    factor = f"by a factor of <b>{number_words(lever.ratio, 3)}</b>"
    changed = f"{named} changes {'the life ' * life}{symbol} {factor}{where}"
    return f"{changed}: {words[0]} {first}, {words[1]} {second}."


def along(name: str, place: xr.DataArray) -> str:
    """A value of a dimension with its unit."""
    return with_unit(value_text(name, place.item(), place.attrs), place)


def _at(name: str, place: xr.DataArray) -> str:
    """At a number, or for something that has a name."""
    words = along(name, place)
    return f"at {words}" if is_number(place) else f"for {'the ' * (place.item() in FAMILIES)}{words}"


def place_words(one: xr.Dataset, of: xr.Dataset) -> str:
    """Where one place lies along the dimensions of a table of extrema, such as " for load L at μ = 1"."""
    places = [(str(name), one[name]) for name, size in of.ratio.sizes.items() if size > 1]
    names = [
        f"the {along(name, place)}" if place.item() in FAMILIES else f"{name} {along(name, place)}"
        for name, place in places
        if not is_number(place)
    ]
    numbers = [place_html(place) for _, place in places if is_number(place)]
    return f" for {' and '.join(names)}" * bool(names) + f" at {', '.join(numbers)}" * bool(numbers)


def _range(values: xr.DataArray) -> str:
    """From where to where the values of one criterion go."""
    swt = _symbol(values)
    known = values.values[np.isfinite(values.values)]
    if not known.size:
        return f"No point has a finite {swt}."
    unit = f" {escape(unit_of(values))}".rstrip()
    if known.size == 1:
        return f"{swt} is <b>{number_words(float(known[0]))}</b>{unit}{_alone(values)}."
    low, middle, high = numbers_words((known.min(), np.median(known), known.max()))
    if known.max() <= _CHANGES * known.min():
        return f"At all {known.size} points {swt} is {low}{unit}: nothing that was varied changes it."
    return f"Over {known.size} points {swt} goes from {low} to {high}, median {middle}{unit}."


def _alone(values: xr.DataArray) -> str:
    """That one of several points has a value."""
    return f" at one of {values.size} points; the others have none" if values.size > 1 else ""


def _badness(values: xr.DataArray) -> xr.DataArray:
    """The values, or the negative ones of a life: the larger, the worse."""
    return -values if is_life(values.attrs) else values


def worst_place(dataset: xr.Dataset) -> dict[str, int]:
    """Index of the worst value along each dimension; nothing if there is none."""
    values = _badness(measured(dataset))
    if not np.isfinite(values.values).any():
        return {}
    return index_at(values, int(np.nanargmax(values.where(np.isfinite(values)).values)))


def extreme_points(dataset: xr.Dataset) -> dict[str, xr.Dataset]:
    """The best and the worst point; one only where all are equal."""
    if CRITERION in dataset.dims:
        dataset = dataset.isel({CRITERION: 0})  # values of several are not to be compared
    values = _badness(measured(dataset))
    flat = values.where(np.isfinite(values)).values.ravel()
    if not np.isfinite(flat).any():
        return {}
    places = {"best": int(np.nanargmin(flat)), "worst": int(np.nanargmax(flat))}
    if flat[places["best"]] == flat[places["worst"]]:
        places.pop("best")
    return {word: dataset.isel(index_at(values, place)) for word, place in places.items()}


def parameters_of(one: xr.Dataset) -> dict[str, Any]:
    """The parameters without units that one point of results was solved with, for `swtstudy.inspect`."""
    grid = grid_of(one)
    lacking = {name for name, row in PARAMETERS.items() if row.part == "shape"} - {"profile"}
    lacking -= {*family_of(grid.fixed["profile"]).shape}
    if grid.fixed.get(CRITERION, SWT) == SWT:
        lacking.add("normal_sensitivity")
    return {
        name: each
        for name, each in grid.fixed.items()
        if name not in lacking and not grid.row(name).goes_without_saying(each)
    }
