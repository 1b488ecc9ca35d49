"""A study in words: its text, if it was not read from a file, and a summary before anything is computed."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.values import Value
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, QUANTITIES, Request
from swtstudy.vocabulary.wording import html_table, listed, number_of, plain_words, unit_words

if TYPE_CHECKING:
    from swtstudy.study.definition import Study


def to_toml(
    title: str, rtol: float, grid: Grid, figure: FigureLayout | None, asked: Request = NOTHING
) -> str:
    """The text of a study file that gives exactly this grid.

    Examples
    --------
    >>> from fractions import Fraction
    >>> print(to_toml("t", 1e-4, Grid({"friction": 0.3}, {"frequency_ratio": (Fraction(3, 2),)}), None))
    title = "t"
    rtol = 0.0001
    <BLANKLINE>
    [fixed]
    friction = 0.3
    <BLANKLINE>
    [axes]
    frequency_ratio = ["3/2"]
    <BLANKLINE>
    """
    fixed: dict[str, Any] = dict(grid.fixed)
    axes: dict[str, Any] = dict(grid.axes)
    blocks = getattr(grid, "blocks", ())
    for table in (fixed, axes) if blocks else ():  # which have the loads
        table.pop("load", None)
    if asked.distances:
        (axes if asked.is_axis else fixed)[DISTANCE] = (
            asked.distances if asked.is_axis else asked.distances[0]
        )
    tables, of_contacts = _of_contacts(grid)
    tables += [("[fixed]", fixed | of_contacts), ("[axes]", axes)]
    scatter = getattr(grid, "scatter", None)
    draws = dict(zip(scatter.names, map(list, scatter.draws), strict=True)) if scatter else {}
    tables += [("[sample]", {"target_life": scatter.target})] if scatter and scatter.target else []
    tables += [("[sample.points]", grid.samples | draws)] if grid.samples or draws else []
    tables += [(f"[{each.parameter}s.{quoted(each.name)}]", each.content()) for each in grid.given]
    tables += [("[[blocks]]", vars(block)) for block in blocks]
    if figure is not None:
        tables.append(("[figure]", {k: v for k, v in asdict(figure).items() if v not in (None, False)}))
    lines = _lines({"title": title, "rtol": rtol, **({"quantities": asked.names} if asked.names else {})})
    for head, entries in tables:
        lines += ["", head, *_lines(entries)]
    return "\n".join(lines) + "\n"


def _lines(entries: Mapping[str, Any]) -> list[str]:
    return [f"{key} = {quoted(value)}" for key, value in entries.items()]


def _of_contacts(grid: Grid) -> tuple[list[tuple[str, Mapping[str, Any]]], dict[str, Any]]:
    """The tables that a study with units has besides, and its fixed values that are no parameters' values."""
    from swtstudy.study.units.grid import PhysicalGrid
    from swtstudy.study.units.material import LIMIT, SHEAR_CONSTANTS, STRENGTH, TENSILE

    if not isinstance(grid, PhysicalGrid):
        return [], {}
    material = {key: [getattr(each, key) for each in grid.materials] for key in TENSILE}
    for key, name in SHEAR_CONSTANTS.items():
        material[key] = [getattr(each, name) for each in grid.shear_materials]
    material |= {STRENGTH: [*grid.yield_strengths], LIMIT: [*grid.findley_limits]}
    material = {key: both for key, both in material.items() if both}
    tables: list[tuple[str, Mapping[str, Any]]] = [("[units]", vars(grid.units))]
    tables += [("[material]", material)] if material else []
    names = {"bodies": grid.body_names} if grid.body_names else {}
    return tables, {**grid.pairs, **names, "similar": grid.similar}


def quoted(value: object) -> str:
    """A value as in TOML; fractions and what has a name are texts."""
    # JSON is TOML but for DEL, which TOML wants escaped.
    return json.dumps(value, ensure_ascii=False, default=str).replace("\x7f", "\\u007f")


#: How many values of an axis are listed one by one: a cell of a table in a notebook.
_LISTED = 6


def in_one_line(study: Study) -> str:
    """Title, points and accuracy."""
    return f"<Study {study.title!r}: {_size(study)}, rtol {study.rtol:g}>"


def as_html(study: Study) -> str:
    """A table for a notebook: axes, fixed parameters, points, cost, and the places in the figure."""
    from html import escape

    roles = {name: role for role, name in study.figure.roles()} if study.figure else {}
    grid, asked = study.grid, study.asked
    along = [("axis", name, values, roles.get(name)) for name, values in grid.axes.items()]
    along += [("sampled", name, values, roles.get(SAMPLE)) for name, values in grid.samples.items()]
    if asked.distances:
        kind = "axis" if asked.is_axis else "fixed"
        along.append((kind, DISTANCE, asked.distances, roles.get(DISTANCE)))
    rows = [_row(grid, *each) for each in along]
    rows += [("quantity", name, "", QUANTITIES[name].meaning) for name in asked.names]
    rows += [_row(grid, "fixed", name, (value,)) for name, value in grid.fixed.items()]
    rows += [_row(grid, "of each body", name, two) for name, two in getattr(grid, "pairs", {}).items()]
    return (
        f"<div><b>{escape(study.title)}</b><br>{escape(_size(study))}, rtol {study.rtol:g}; "
        f"swtstudy plan tells how long it takes{html_table(rows)}</div>"
    )


def _size(study: Study) -> str:
    axes = " × ".join(f"{size} {name}" for name, size in zip(study.grid.dims, study.grid.shape, strict=True))
    points = number_of(study.grid.size, "point")
    return f"{points} = {axes}" if axes else points


def _row(
    grid: Grid, kind: str, name: str, values: tuple[Value, ...], role: str | None = None
) -> tuple[str, str, str, str]:
    """Kind, name, values and meaning of a parameter."""
    row = grid.row(name)
    return (
        kind,
        name,
        listed([*map(plain_words, values)], _LISTED) + unit_words(row.units),
        row.described + (f"; figure: {role}" if role else ""),
    )
