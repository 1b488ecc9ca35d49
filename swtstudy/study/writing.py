"""A study in words: its text, if it was not read from a file, and a summary before anything is computed."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.values import Value
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, QUANTITIES, Request
from swtstudy.vocabulary.wording import html_table, listed, plain_words, unit_words

if TYPE_CHECKING:
    from swtstudy.study.definition import Study


def to_toml(
    title: str, rtol: float, grid: Grid, figure: FigureLayout | None, asked: Request = NOTHING
) -> str:
    """The text of a study file that gives exactly this grid.

    Examples
    --------
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
    lines = [f"title = {quoted(title)}", f"rtol = {rtol!r}"]
    if asked.names:
        lines.append(f"quantities = [{', '.join(map(quoted, asked.names))}]")
    tables, of_contacts = _of_contacts(grid)
    blocks = getattr(grid, "blocks", ())
    fixed = {name: _literal(value) for name, value in grid.fixed.items()} | of_contacts
    axes = _lists(grid.axes)
    if blocks:  # which have the loads
        fixed.pop("load", None)
        axes.pop("load", None)
    if asked.distances and asked.is_axis:
        axes[DISTANCE] = repr([*asked.distances])
    elif asked.distances:
        fixed[DISTANCE] = repr(asked.distances[0])
    lines += [*tables, *_table("[fixed]", fixed), *_table("[axes]", axes)]
    scatter = getattr(grid, "scatter", None)
    if scatter and scatter.target:
        lines += _table("[sample]", {"target_life": repr(scatter.target)})
    draws = dict(zip(scatter.names, scatter.draws, strict=True)) if scatter else {}
    if points := {**grid.samples, **draws}:
        lines += _table("[sample.points]", _lists(points))
    for defined in grid.given:
        content = {key: json.dumps(value) for key, value in defined.content().items()}
        lines += _table(f"[{defined.parameter}s.{quoted(defined.name)}]", content)
    for block in blocks:
        lines += _table("[[blocks]]", {"load": quoted(block.load), "rounds": repr(block.rounds)})
    if figure is not None:
        lines += _table("[figure]", _of_figure(figure))
    return "\n".join(lines) + "\n"


def _table(head: str, entries: Mapping[str, str]) -> list[str]:
    return ["", head, *(f"{key} = {value}" for key, value in entries.items())]


def _lists(values: Mapping[str, Sequence[Value]]) -> dict[str, str]:
    return {name: f"[{', '.join(map(_literal, each))}]" for name, each in values.items()}


def _of_figure(figure: FigureLayout) -> dict[str, str]:
    """The entries of the table of a figure."""
    entries = {"kind": quoted(figure.kind)} | {role: quoted(name) for role, name in figure.roles()}
    entries["y"] = f"[{', '.join(map(quoted, figure.y))}]"
    if figure.title:
        entries["title"] = quoted(figure.title)
    entries |= {mark: "true" for mark in ("regimes", "validity") if getattr(figure, mark)}
    words = {"caption": figure.caption, "message": figure.message}
    return entries | {key: quoted(text) for key, text in words.items() if text}


def _of_contacts(grid: Grid) -> tuple[list[str], dict[str, str]]:
    """The tables that a study with units has besides, and its fixed values that are no parameters' values."""
    from swtstudy.units.grid import PhysicalGrid
    from swtstudy.units.material import LIMIT, SHEAR_CONSTANTS, STRENGTH

    if not isinstance(grid, PhysicalGrid):
        return [], {}
    tables = _table("[units]", {kind: quoted(label) for kind, label in vars(grid.units).items()})
    pairs = zip(*(vars(each).items() for each in grid.materials), strict=True)
    of_both = {one[0]: [one[1], other[1]] for one, other in pairs}
    for key, name in SHEAR_CONSTANTS.items():
        of_both[key] = [getattr(each, name) for each in grid.shear_materials]
    of_both |= {STRENGTH: [*grid.yield_strengths], LIMIT: [*grid.findley_limits]}
    material = {key: repr(both) for key, both in of_both.items() if both}
    tables += _table("[material]", material) if material else []
    fixed = {name: repr([*two]) for name, two in grid.pairs.items()}
    if grid.body_names:
        fixed["bodies"] = f"[{', '.join(map(quoted, grid.body_names))}]"
    return tables, fixed | {"similar": repr(grid.similar)}


def _literal(value: Value) -> str:
    return quoted(str(value)) if isinstance(value, str | Fraction | Definition) else repr(value)


def quoted(text: str) -> str:
    """A text as a TOML string."""
    # A JSON string is a TOML string but for DEL, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


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
    points = f"{study.grid.size} point{'s' * (study.grid.size != 1)}"
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
