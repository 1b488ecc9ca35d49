"""A summary of a study, shown before anything is computed."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.values import Value
from swtstudy.vocabulary.quantities import DISTANCE, QUANTITIES
from swtstudy.vocabulary.wording import listed

if TYPE_CHECKING:
    from swtstudy.study.definition import Study

#: How many values of an axis are listed one by one: a cell of a table in a notebook.
_LISTED = 6


def in_one_line(study: Study) -> str:
    """Title, points and accuracy."""
    return f"<Study {study.title!r}: {_size(study)}, rtol {study.rtol:g}>"


def as_html(study: Study) -> str:
    """A table for a notebook: axes, fixed parameters, points, cost, and the places in the figure."""
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
    rows += [_row(grid, "of each body", name, two) for name, two in grid.of_bodies.items()]
    body = "".join(
        f"<tr><td>{escape(kind)}</td><td><b>{escape(name)}</b></td><td>{escape(values)}</td>"
        f"<td>{escape(meaning)}</td></tr>"
        for kind, name, values, meaning in rows
    )
    return (
        f"<div><b>{escape(study.title)}</b><br>{escape(_size(study))}, rtol {study.rtol:g}; "
        f"{escape(_cost(study))}<table>{body}</table></div>"
    )


def _size(study: Study) -> str:
    axes = " × ".join(f"{size} {name}" for name, size in zip(study.grid.dims, study.grid.shape, strict=True))
    points = f"{study.grid.size} point{'s' * (study.grid.size != 1)}"
    return f"{points} = {axes}" if axes else points


def _cost(study: Study) -> str:
    """Estimated from the number of points and the lengths of their cycles; symmetry can only reduce it."""
    from swtstudy.points.cost import duration, rough_seconds

    ratios = [value.as_integer_ratio() for value in study.grid.values("frequency_ratio")]  # type: ignore[union-attr]
    weight = sum(p + q for p, q in ratios) / len(ratios)
    seconds = rough_seconds(study.grid.size * weight, study.grid.size, study.asked)
    return f"very roughly {duration(seconds)} of one core (swtstudy plan times it)"


def _row(
    grid: Grid, kind: str, name: str, values: tuple[Value, ...], role: str | None = None
) -> tuple[str, str, str, str]:
    """Kind, name, values and meaning of a parameter."""
    row = grid.row(name)
    unit = f" {row.units}" if row.units not in ("1", "rad") else ""
    return (
        kind,
        name,
        listed([*map(_value, values)], _LISTED) + unit,
        row.described + (f"; figure: {role}" if role else ""),
    )


def _value(value: Value) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
