"""Findings in results, from their extrema: which parameter moves swt by how much, and where."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.recall import grid_of
from swtstudy.contacts.contact import PhysicalContact
from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import index_at
from swtstudy.reports.values import is_number, place_html, symbol_of, unit_of, value_text, with_unit
from swtstudy.results.evaluate import extrema
from swtstudy.units.blocks import sequence_words
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.reading import read_contact
from swtstudy.units.results import measures
from swtstudy.units.variables import KINDS
from swtstudy.vocabulary.choices import FAMILIES, SWT, family_of
from swtstudy.vocabulary.parameters import AXES, PARAMETERS
from swtstudy.vocabulary.variables import CONTACT, has_units
from swtstudy.vocabulary.wording import number_words, numbers_words

#: The parameter whose values have an s of another kind each.
CRITERION = "criterion"
#: A parameter that changes swt by less goes unmentioned in the sentences.
_MOVES = 1.005


@dataclass(frozen=True)
class Lever:
    """A dimension, and what it does where it does most.

    Attributes
    ----------
    name
        The dimension.
    table
        Its extrema, as of `swtstudy.results.evaluate.extrema`, of swt where results have units.
    there
        The place along the other dimensions at which the ratio of the extrema is largest.
    """

    name: str
    table: xr.Dataset
    there: xr.Dataset

    @property
    def ratio(self) -> float:
        """Greatest over least."""
        return float(self.there.ratio)

    @property
    def chosen(self) -> bool:
        """True if it is a parameter of the load, of which there may be a better and a worse one."""
        return AXES[self.name].part == "load"


def measured(dataset: xr.Dataset) -> xr.DataArray:
    """s; of real contacts the value of the criterion, since the unit of s differs from contact to contact.

    Of several criteria each has its own unit.
    """
    own = [dataset[name] for name in measures(dataset)]
    if len(own) < 2:
        return own[0] if own else dataset.s
    values = own[0]
    for other in own[1:]:
        values = values.fillna(other)
    return values.drop_attrs(deep=False).assign_attrs(symbol=r"\text{value}", units="").rename("value")


def measured_at(dataset: xr.Dataset, place: xr.Dataset) -> xr.DataArray:
    """The quantity that the criterion of a place measures."""
    own = {CRITERION: place[CRITERION].item()} if CRITERION in dataset.dims else {}
    return measured(dataset.sel(own))


def levers(dataset: xr.Dataset) -> list[Lever]:
    """Every dimension of more than one value: the phase first, which costs nothing to choose, then by ratio.

    None of a sample, whose points differ in all that is sampled; nor the criterion, whose values are not of
    one kind.
    """
    swt = measured(dataset)
    found = []
    for name in map(str, swt.dims):
        if swt.sizes[name] < 2 or SAMPLE in swt.dims or name == CRITERION:
            continue
        table = extrema(dataset.assign(s=swt), name)
        ratio = table.ratio.where(np.isfinite(table.ratio))
        if not ratio.notnull().any():
            continue
        found.append(Lever(name, table, table.isel(index_at(ratio, int(np.nanargmax(ratio.values))))))
    return sorted(found, key=lambda lever: (lever.name != "phase", -lever.ratio))


def sentences(dataset: xr.Dataset) -> list[str]:
    """List the findings as HTML; the most important sentence first."""
    said = [
        _sentence(lever, _symbol(measured_at(dataset, lever.there), dataset))
        for lever in levers(dataset)
        if lever.ratio > _MOVES
    ]
    if SAMPLE in dataset.s.dims or not said:
        if CRITERION in dataset.dims:
            parts = [dataset.isel({CRITERION: k}) for k in range(dataset.sizes[CRITERION])]
            said += [f"{value_text(CRITERION, p.criterion.item(), {})}: {_range(p)}" for p in parts]
        else:
            said.append(_range(dataset))
    return [*said, *_lives(dataset)]


def _symbol(values: xr.DataArray, dataset: xr.Dataset) -> str:
    return symbol_of(values) if has_units(dataset) else "<i>s</i>"


def _sentence(lever: Lever, swt: str) -> str:
    there = lever.there
    where = place_words(there.drop_vars(["at_minimum", "at_maximum"]), lever.table)
    words = ("best", "worst") if lever.chosen else ("least", "greatest")
    least, greatest = (_at(lever.name, there[f"at_{end}"]) for end in ("minimum", "maximum"))
    named = f"The {re.split('[,:]', AXES[lever.name].meaning)[0]}"
    if is_number(there.at_minimum):
        named += f" {symbol_of(there.at_minimum.rename(lever.name))}"
    moves = f"{named} moves {swt} by <b>{number_words(lever.ratio, 3)} times</b>"
    return f"{moves}{where}: {words[0]} {least}, {words[1]} {greatest}."


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


def _range(dataset: xr.Dataset) -> str:
    """From where to where the values of one criterion go."""
    values = measured(dataset)
    swt = _symbol(values, dataset)
    known = values.values[np.isfinite(values.values)]
    if not known.size:
        return f"No point has a finite {swt}."
    unit = f" {escape(unit_of(values))}".rstrip()
    if known.size == 1:
        return f"{swt} is <b>{number_words(float(known[0]))}</b>{unit}{_alone(values)}."
    low, middle, high = numbers_words((known.min(), np.median(known), known.max()))
    if known.max() <= _MOVES * known.min():
        return f"At all {known.size} points {swt} is {low}{unit}: nothing that was varied moves it."
    return f"Over {known.size} points {swt} goes from {low} to {high}, median {middle}{unit}."


def _lives(dataset: xr.Dataset) -> Iterator[str]:
    """The lives to a crack, by each criterion that has a life."""
    blocks = read_contact(dataset.attrs[CONTACT]).blocks if has_units(dataset) else ()
    if sequence := sequence_words(dataset, blocks):
        yield f"The sequence of blocks: {escape(sequence)}."
        return
    names = {kind.life: kind.name for kind in KINDS.values() if kind.life in dataset}
    for name, criterion in names.items():
        lives = dataset[name].values[np.isfinite(dataset[name].values)]
        if lives.size:
            rounds = " to ".join(dict.fromkeys(numbers_words((lives.min(), lives.max()), 2)))
            by = f" by {criterion}" if len(names) > 1 else ""
            yield f"A crack starts after {rounds} rounds of the load{by}, at the worst place."


def _alone(values: xr.DataArray) -> str:
    """That one of several points has a value."""
    return f" at one of {values.size} points; the others have none" if values.size > 1 else ""


def worst_place(dataset: xr.Dataset) -> dict[str, int]:
    """Index of the greatest swt along each dimension; nothing if there is none."""
    values = measured(dataset)
    if not np.isfinite(values.values).any():
        return {}
    return index_at(values, int(np.nanargmax(values.values)))


def extreme_points(dataset: xr.Dataset) -> dict[str, xr.Dataset]:
    """The point with the least and that with the greatest swt; one only where all are equal."""
    if CRITERION in dataset.dims:
        dataset = dataset.isel({CRITERION: 0})  # values of several are not to be compared
    values = measured(dataset)
    flat = values.values.ravel()
    if not np.isfinite(flat).any():
        return {}
    places = {"best": int(np.nanargmin(flat)), "worst": int(np.nanargmax(flat))}
    if flat[places["best"]] == flat[places["worst"]]:
        places.pop("best")
    return {word: dataset.isel(index_at(values, place)) for word, place in places.items()}


def parameters_of(one: xr.Dataset) -> dict[str, Any]:
    """The parameters without units that one point of results was solved with, for `swtstudy.inspect`."""
    grid = grid_of(one)
    if isinstance(grid, PhysicalGrid):
        body = int(one.body) if "body" in one.coords and not one.body.ndim else 1
        return PhysicalContact(grid).parameters(body)
    lacking = {name for name, row in PARAMETERS.items() if row.part == "shape"} - {"profile"}
    lacking -= {*family_of(grid.fixed["profile"]).shape}
    if grid.fixed.get(CRITERION, SWT) == SWT:
        lacking.add("normal_sensitivity")
    return {
        name: each
        for name, each in grid.fixed.items()
        if name not in lacking and not grid.row(name).goes_without_saying(each)
    }
