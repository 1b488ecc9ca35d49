"""Findings in results: what the study asked for, which parameter changes it by how much, and where."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from markupsafe import Markup

from swtstudy.archive.describe import life_words, outcome, shown_in
from swtstudy.archive.recall import grid_of
from swtstudy.faces.html import rendered, symbol_html, value_text
from swtstudy.figures.draw import layout_of
from swtstudy.figures.words import flag_words, is_life
from swtstudy.points.grid import SAMPLE, SHAPE_COLUMNS
from swtstudy.points.validity import KNOWN_LIVES
from swtstudy.points.values import index_at
from swtstudy.results.evaluate import extrema
from swtstudy.results.sensitivity import sensitivity
from swtstudy.study.figure import FigureLayout
from swtstudy.study.units.results import measures, usual_measure
from swtstudy.vocabulary.choices import FAMILIES, SWT, family_of
from swtstudy.vocabulary.derived import LIVES
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import has_units
from swtstudy.vocabulary.wording import numbers_words

#: A parameter that changes the quantity by less goes unmentioned in the sentences.
_CHANGES = 1.005


class Lever(NamedTuple):
    """A dimension, and by how much it changes a quantity at most.

    Attributes
    ----------
    name
        The dimension.
    table
        Extrema of the quantity along it, as of `swtstudy.results.evaluate.extrema`.
    there
        The place along the other dimensions at which the ratio of the extrema is largest.
    ratio
        Maximum over minimum there.
    """

    name: str
    table: xr.Dataset
    there: xr.Dataset
    ratio: float


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
    # Ratios of places and of their planes say nothing.
    shown = [y for y in shown_in(dataset) if not y.startswith("critical_") and not flag_words(dataset[y])]
    lives = [y for y in shown if is_life(dataset[y].attrs)]
    return dataset[[*lives, *shown, *usual[: not shown], *own, "s"][0]]


def measured_at(dataset: xr.Dataset, place: xr.Dataset) -> xr.DataArray:
    """The quantity that the criterion of a place measures."""
    if "criterion" not in dataset.dims:
        return measured(dataset)
    part = dataset.sel(criterion=place["criterion"].item())
    return part[usual_measure(part)]


def levers(dataset: xr.Dataset) -> list[Lever]:
    """Every dimension of more than one value: the figure's x first, then by ratio.

    Without a figure the phase is first, which costs nothing to choose. A sample has none, since its points
    differ in all that is sampled; nor has the criterion, whose values are not of one kind, nor have lives the
    frequency ratio, on which the length of a load cycle depends.
    """
    values = measured(dataset)
    others = {"criterion"} | ({"frequency_ratio"} if is_life(values.attrs) else set())
    first = layout_of(dataset).x if "figure" in dataset.attrs else "phase"
    if is_life(values.attrs) and "body" in values.dims:  # the body that has a crack first
        weakest = values.min([dim for dim in values.dims if dim != "body"]).idxmin("body")
    found = []
    for name in map(str, values.dims):
        if values.sizes[name] < 2 or SAMPLE in values.dims or name not in AXES or name in others:
            continue
        table = extrema(dataset.assign(measured=values), name, "measured")
        ratio = table.ratio.where(np.isfinite(table.ratio))
        if is_life(values.attrs):  # of lives that constants are known for, if there are some
            known = ratio.where((table.minimum >= KNOWN_LIVES[0]) & (table.maximum <= KNOWN_LIVES[1]))
            ratio = known if known.notnull().any() else ratio
            if "body" in ratio.dims:
                of_weakest = ratio.where(ratio["body"] == weakest)
                ratio = of_weakest if of_weakest.notnull().any() else ratio
        if ratio.notnull().any():
            there = table.isel(index_at(ratio, int(np.nanargmax(ratio.values))))
            found.append(Lever(name, table, there, float(there.ratio)))
    return sorted(found, key=lambda lever: (lever.name != first, -lever.ratio))


def sentences(dataset: xr.Dataset, indices: xr.Dataset | StudyError | None = None) -> list[Markup]:
    """List the findings as HTML: the study's own message, then the answer to its question.

    The latter begins with the Sobol indices, as from `indices_of`, if these are given.
    """
    text = dataset.attrs.get("figure")
    values = measured(dataset)
    single = values.size == 1 and has_units(dataset)
    moved = [] if single else [each for each in levers(dataset) if each.ratio > _CHANGES]
    lines = rendered(
        "sentences.html",
        message=FigureLayout.from_json(text).message if text else None,
        sensitive=_most_sensitive(indices) if isinstance(indices, xr.Dataset) else [],
        outcome=next(outcome(dataset)) if single else "",
        levers=[(each, measured_at(dataset, each.there), AXES[each.name]) for each in moved],
        ranges=[] if single or (moved and SAMPLE not in values.dims) else [*_ranges(dataset)],
        lives=[] if single else [*life_words(dataset)],
        is_life=is_life,
        families=FAMILIES,
    )
    return [Markup(line.strip()) for line in lines.splitlines() if line.strip()]


def _most_sensitive(indices: xr.Dataset) -> list[tuple[str, Markup, str]]:
    """The two sampled parameters with the largest Sobol indices: meaning, symbol, and the index in words."""
    total = indices.total.isel(quantity=0)
    mean = total.mean([dim for dim in total.dims if dim != "parameter"])
    said = []
    for k in np.argsort(-mean.values)[:2]:
        one = indices.isel(parameter=int(k), quantity=0)
        ends = dict.fromkeys(f"{float(end):.2f}" for end in (one.total.min(), one.total.max()))
        meaning = AXES[str(one.parameter.item())].meaning
        said.append((meaning, symbol_html(str(one.symbol.item())), " to ".join(ends)))
    return said


def _ranges(dataset: xr.Dataset) -> Iterator[tuple[str, xr.DataArray, int, list[str], bool]]:
    """The values of each criterion: its name if there are several, number, ends, whether they vary."""
    several = "criterion" in dataset.dims
    for k in range(dataset.sizes.get("criterion", 1)):
        one = dataset.isel(criterion=k, missing_dims="ignore")
        own = measured_at(dataset, one) if several else measured(dataset)
        known = own.values[np.isfinite(own.values)]
        ends = numbers_words((known.min(), np.median(known), known.max())) if known.size else []
        varies = bool(known.size and known.max() > _CHANGES * known.min())
        yield value_text("criterion", one.criterion.item()) if several else "", own, known.size, ends, varies


def indices_of(dataset: xr.Dataset) -> xr.Dataset | StudyError | None:
    """Sobol indices of what a study asks for; why there are none; None without the design for them."""
    if SAMPLE not in dataset.coords or dataset[SAMPLE].attrs.get("design") != "saltelli":
        return None
    try:
        return sensitivity(dataset, str(measured(dataset).name))
    except StudyError as error:
        return error


def extreme_places(dataset: xr.Dataset) -> dict[str, dict[str, int]]:
    """Indices of the best and of the worst value along each dimension; nothing if there is none."""
    values = measured(dataset)
    badness = -values if is_life(values.attrs) else values
    flat = badness.where(np.isfinite(badness)).values.ravel()
    if not np.isfinite(flat).any():
        return {}
    both = {"best": int(np.nanargmin(flat)), "worst": int(np.nanargmax(flat))}
    return {word: index_at(values, place) for word, place in both.items()}


def extreme_points(dataset: xr.Dataset) -> dict[str, xr.Dataset]:
    """The best and the worst point by words such as "lowest"; one point, without a word, if all are equal."""
    life = is_life(measured(dataset).attrs)
    if "criterion" in dataset.dims:
        dataset = dataset.isel(criterion=0)  # values of several are not to be compared
    points = [dataset.isel(place) for place in extreme_places(dataset).values()]
    words: tuple[str, ...] = ("longest", "shortest") if life else ("lowest", "highest")
    if len({measured(one).item() for one in points}) == 1:
        words, points = ("",), points[1:]
    return dict(zip(words, points, strict=False))


def parameters_of(one: xr.Dataset) -> dict[str, Any]:
    """The parameters without units that one point of results was solved with, for `swtstudy.inspect`."""
    grid = grid_of(one)
    lacking = {*SHAPE_COLUMNS} - {*family_of(grid.fixed["profile"]).shape}
    if grid.fixed.get("criterion", SWT) == SWT:
        lacking.add("normal_sensitivity")
    return {
        name: each
        for name, each in grid.fixed.items()
        if name not in lacking and not grid.row(name).goes_without_saying(each)
    }
