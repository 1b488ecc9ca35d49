"""A study in words: its text, if it was not read from a file, and a summary before anything is computed."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.values import Value
from swtstudy.study.figure import FigureLayout
from swtstudy.study.units.grid import ContactDetails, PhysicalGrid
from swtstudy.study.units.material import LIMIT, SHEAR_CONSTANTS, STRENGTH, TENSILE
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
    fixed, axes, points = (dict[str, Any](part) for part in (grid.fixed, grid.axes, grid.samples))
    if asked.distances and asked.is_axis:
        axes[DISTANCE] = asked.distances
    elif asked.distances:
        fixed[DISTANCE] = asked.distances[0]
    layout = asdict(figure) if figure else {}
    about, units = ContactDetails(), dict[str, str]()
    if isinstance(grid, PhysicalGrid):
        about, units = grid.about, vars(grid.units)
        names = {"bodies": about.body_names} if about.body_names else {}
        fixed |= {**about.pairs, **names, "similar": about.similar}
    for table in (fixed, axes) if about.blocks else ():  # which have the loads
        table.pop("load", None)
    material = {key: [getattr(each, key) for each in about.materials] for key in TENSILE}
    for key, name in SHEAR_CONSTANTS.items():
        material[key] = [getattr(each, name) for each in about.shear_materials]
    material |= {STRENGTH: [*about.yield_strengths], LIMIT: [*about.findley_limits]}
    if about.scatter:
        points |= zip(about.scatter.names, about.scatter.draws, strict=True)
    tables: list[tuple[str, Mapping[str, Any]]] = [
        ("[units]", units),
        ("[material]", {key: both for key, both in material.items() if both}),
        ("[fixed]", fixed),
        ("[axes]", axes),
        ("[sample]", {"target_life": about.target_life} if about.target_life else {}),
        ("[sample.points]", points),
        *((f"[{each.parameter}s.{quoted(each.name)}]", each.content()) for each in grid.given),
        *(("[[blocks]]", vars(block)) for block in about.blocks),
        ("[figure]", {key: value for key, value in layout.items() if value not in (None, False)}),
    ]
    text = _lines({"title": title, "rtol": rtol, **({"quantities": asked.names} if asked.names else {})})
    for head, entries in tables:
        if entries or head in ("[fixed]", "[axes]"):
            text += f"\n{head}\n{_lines(entries)}"
    return text


def _lines(entries: Mapping[str, Any]) -> str:
    """The lines of a table."""
    return "".join(f"{key} = {quoted(value)}\n" for key, value in entries.items())


def quoted(value: object) -> str:
    """A value as in TOML; fractions and what has a name are texts."""
    # JSON is TOML but for DEL, which TOML wants escaped.
    return json.dumps(value, ensure_ascii=False, default=str).replace("\x7f", "\\u007f")


#: How many values of an axis are listed one by one: a cell of a table in a notebook.
_LISTED = 6
_Row = tuple[str, str, str, str]


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


def _row(grid: Grid, kind: str, name: str, values: tuple[Value, ...], role: str | None = None) -> _Row:
    """Kind, name, values and meaning of a parameter."""
    row = grid.row(name)
    words = listed([*map(plain_words, values)], _LISTED) + unit_words(row.units)
    return kind, name, words, row.described + (f"; figure: {role}" if role else "")
