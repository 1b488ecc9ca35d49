"""What the figure of a study shows: which dimension goes where, and what is drawn over it."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterator
from dataclasses import asdict, dataclass

from swtstudy.grid.grid import Grid
from swtstudy.grid.values import Value, read_value
from swtstudy.mistakes import Report, literal, nearest
from swtstudy.parameters import LETTERS, PARAMETERS

_NORMALISED = re.compile(r"s\s*/\s*s\s*\(\s*(\w+)\s*=\s*([^()]+|[^()]*\([^()]*\)[^()]*)\)")


#: Kinds of figures: lines over x, or s as a surface over x and vertical.
KINDS = ("lines", "contour", "heatmap")


@dataclass(frozen=True)
class FigureLayout:
    """Layout of a figure.

    Attributes
    ----------
    x
        Dimension along the horizontal axis.
    hue
        Dimension whose values are the lines, or None for one line.
    panels
        Dimension whose values are the panels side by side, or None for one panel.
    y
        One row of panels for each: "s", or "s/s(name=value)" for s over its value at one place; the paper's
        letter may stand for the name.
    title
        Title over the figure, or None.
    kind
        "lines"; "contour", with the places of least and greatest s along x; or "heatmap", a cell a point.
    vertical
        Dimension along the vertical axis of a contour or heat map, None for lines.
    regimes
        Whether lines are marked where a regime of the contact begins.
    """

    x: str
    hue: str | None = None
    panels: str | None = None
    y: tuple[str, ...] = ("s",)
    title: str | None = None
    kind: str = "lines"
    vertical: str | None = None
    regimes: bool = False

    def to_json(self) -> str:
        """The layout as text, for an archive."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> FigureLayout:
        """The layout from the text in an archive."""
        raw = json.loads(text)
        return cls(**{**raw, "y": tuple(raw["y"])})

    def roles(self) -> Iterator[tuple[str, str]]:
        """Role and dimension of every dimension that is used."""
        for role in ("x", "vertical", "hue", "panels"):
            name = getattr(self, role)
            if name is not None:
                yield role, name


def reference(y: str) -> tuple[str, Value] | None:
    """Name and value of the place that a quantity is normalised with; None for plain "s".

    Raises
    ------
    ValueError
        If the text is neither; the message says why.

    Examples
    --------
    >>> reference("s/s(flat_radius=0)")
    ('flat_radius', 0.0)
    >>> reference("s/s(b=0)")
    ('flat_radius', 0.0)
    """
    if y.strip() == "s":
        return None
    match = _NORMALISED.fullmatch(y.strip())
    if match is None:
        raise ValueError("not a quantity")
    name, raw = match.groups()
    name = LETTERS.get(unicodedata.normalize("NFKC", name), name)  # a keyboard's µ is not the letter μ
    if name not in PARAMETERS:
        raise ValueError(f"unknown parameter {name}")
    return name, read_value(PARAMETERS[name], raw.strip())


def wrong_roles(layout: FigureLayout) -> Iterator[tuple[str, str, str]]:
    """Key, found and allowed of everything that this kind of figure must or must not have."""
    if layout.kind not in KINDS:
        yield ".kind", literal(layout.kind), nearest(layout.kind, KINDS)
    elif layout.kind == "lines":
        if layout.vertical is not None:
            yield ".vertical", literal(layout.vertical), 'none for kind = "lines", whose vertical axis is y'
    else:
        if layout.vertical is None:
            yield ".vertical", "nothing", f'the name of an axis (kind = "{layout.kind}" needs it)'
        if layout.hue is not None:
            yield ".hue", literal(layout.hue), f'none for kind = "{layout.kind}"'
    for role, name in (("x", layout.x), ("vertical", layout.vertical)):
        if name == "profile" and layout.kind != "heatmap":
            yield f".{role}", "'profile'", "an axis of numbers"
    if not layout.y:
        yield ".y", "an empty list", 'at least one of "s" or "s/s(name=value)"'


def check_figure(layout: FigureLayout, dims: list[str], grid: Grid | None, report: Report) -> None:
    """Report every dimension that the figure asks for and the study lacks, and the other way round.

    Parameters
    ----------
    layout
        The figure.
    dims
        Names of the axes of the study.
    grid
        The grid, if it is free of mistakes, to look up the places used for normalisation.
    report
        Takes key, found and allowed of a mistake.
    """
    used: dict[str, str] = {}
    for role, name in layout.roles():
        if name not in dims:
            report(f"figure.{role}", f"{literal(name)}, not an axis of this study", nearest(name, dims))
        elif name in used:
            report(f"figure.{role}", f"{literal(name)}, used for {used[name]} too", "each axis once")
        used.setdefault(name, role)
    for key, found, allowed in wrong_roles(layout):
        report(f"figure{key}", found, allowed)
    if layout.kind == "contour" and grid is not None:
        for role in ("x", "vertical"):
            name = getattr(layout, role)
            if name in dims and len(grid.values(name)) < 2:
                report(f"figure.{role}", f"{name} with a single value", "an axis of two values or more")
    for name in dims:
        if name not in used and name in PARAMETERS:
            report("figure", f"no place for the axis {name}", "every axis as x, hue, vertical or panels")
    for y in layout.y:
        _check_quantity(y, dims, grid, report)


def _check_quantity(y: str, dims: list[str], grid: Grid | None, report: Report) -> None:
    try:
        place = reference(y)
    except ValueError as error:
        report("figure.y", f"{literal(y)} ({error})", '"s" or "s/s(name=value)"')
        return
    if place is None:
        return
    name, value = place
    if name not in dims:
        report("figure.y", f"{literal(y)}: {name} is not an axis of this study", nearest(name, dims))
    elif grid is not None and not any(_same(value, other) for other in grid.values(name)):
        report("figure.y", f"{literal(y)}: {value} is not on that axis", f"a value of the axis {name}")


def _same(one: Value, other: Value) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= 1e-11 * max(abs(one), abs(other))
    return one == other
