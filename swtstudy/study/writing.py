"""A study in words: its text, if it was not read from a file, and a summary before anything is computed."""

from __future__ import annotations

import json
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
    single, several = ((), asked.distances) if asked.is_axis else (asked.distances, ())
    tables, fixed = _of_contacts(grid)
    blocks = getattr(grid, "blocks", ())
    single_values = {name: value for name, value in grid.fixed.items() if not (blocks and name == "load")}
    axes = {name: values for name, values in grid.axes.items() if not (blocks and name == "load")}
    lines += [
        *tables,
        "",
        "[fixed]",
        *(f"{name} = {_literal(value)}" for name, value in single_values.items()),
    ]
    lines += fixed
    lines += [f"{DISTANCE} = {value!r}" for value in single]
    lines += ["", "[axes]"]
    lines += [f"{name} = [{', '.join(map(_literal, values))}]" for name, values in axes.items()]
    lines += [f"{DISTANCE} = {[*several]}"] * bool(several)
    if grid.samples:
        lines += ["", "[sample.points]"]
        lines += [f"{name} = [{', '.join(map(_literal, values))}]" for name, values in grid.samples.items()]
    for defined in grid.given:
        lines += ["", f"[{defined.parameter}s.{quoted(defined.name)}]"]
        lines += [f"{key} = {json.dumps(value)}" for key, value in defined.content().items()]
    for block in blocks:
        lines += ["", "[[blocks]]", f"load = {quoted(block.load)}", f"rounds = {block.rounds!r}"]
    if figure is not None:
        lines += ["", "[figure]", f"kind = {quoted(figure.kind)}"]
        lines += (f"{role} = {quoted(name)}" for role, name in figure.roles())
        lines.append(f"y = [{', '.join(map(quoted, figure.y))}]")
        if figure.title:
            lines.append(f"title = {quoted(figure.title)}")
        lines += [f"{mark} = true" for mark in ("regimes", "validity") if getattr(figure, mark)]
        if figure.caption:
            lines.append(f"caption = {quoted(figure.caption)}")
    return "\n".join(lines) + "\n"


def _of_contacts(grid: Grid) -> tuple[list[str], list[str]]:
    """The tables that a study with units has besides, and its fixed values that are no parameters' values."""
    from swtstudy.units.grid import PhysicalGrid
    from swtstudy.units.material import LIMIT, SHEAR_CONSTANTS, STRENGTH

    if not isinstance(grid, PhysicalGrid):
        return [], []
    tables = ["", "[units]", *(f"{kind} = {quoted(label)}" for kind, label in vars(grid.units).items())]
    pairs = zip(*(vars(each).items() for each in grid.materials), strict=True)
    material = [f"{one[0]} = {[one[1], other[1]]}" for one, other in pairs]
    material += [
        f"{key} = {[getattr(each, name) for each in grid.shear_materials]}"
        for key, name in SHEAR_CONSTANTS.items()
        if grid.shear_materials
    ]
    material += [f"{STRENGTH} = {[*grid.yield_strengths]}"] * bool(grid.yield_strengths)
    material += [f"{LIMIT} = {[*grid.findley_limits]}"] * bool(grid.findley_limits)
    tables += ["", "[material]", *material] if material else []
    fixed = [f"{name} = {[*two]}" for name, two in grid.pairs.items()]
    fixed += [f"bodies = [{', '.join(map(quoted, grid.body_names))}]"] * bool(grid.body_names)
    return tables, [*fixed, f"similar = {grid.similar!r}"]


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
        f"{escape(_cost(study))}{html_table(rows)}</div>"
    )


def _size(study: Study) -> str:
    axes = " × ".join(f"{size} {name}" for name, size in zip(study.grid.dims, study.grid.shape, strict=True))
    points = f"{study.grid.size} point{'s' * (study.grid.size != 1)}"
    return f"{points} = {axes}" if axes else points


def _cost(study: Study) -> str:
    """Estimated from the number of points and the lengths of their cycles; symmetry can only reduce it."""
    from swtstudy.points.unique import duration, rough_seconds

    ratios = [value.as_integer_ratio() for value in study.grid.values("frequency_ratio")]  # type: ignore[union-attr]
    weight = sum(p + q for p, q in ratios) / len(ratios)
    seconds = rough_seconds(study.grid.size * weight, study.grid.size, study.asked)
    return f"very roughly {duration(seconds)} of one core (swtstudy plan times it)"


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
