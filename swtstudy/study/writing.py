"""Writing the text of a study that was not read from a file."""

from __future__ import annotations

import json
from fractions import Fraction

from swtstudy.points.grid import Grid
from swtstudy.points.values import Value
from swtstudy.study.figure import FigureLayout
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, Request


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
