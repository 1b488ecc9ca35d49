"""The text of a study that was not read from a file, or names other files; and that of its definitions."""

from __future__ import annotations

import json
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import asdict
from typing import Any

from pydantic_core import from_json

from swtstudy.points.grid import Grid
from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.table import TabulatedProfile
from swtstudy.study.figure import FigureLayout
from swtstudy.study.units.grid import ContactDetails, PhysicalGrid
from swtstudy.study.units.material import LIMIT, SHEAR_CONSTANTS, STRENGTH, TENSILE
from swtstudy.study.units.rows import CARRIER_KEY, NAMES_KEY, SIMILAR_KEY
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import literal
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, Request


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
        names = {NAMES_KEY: about.body_names} if about.body_names else {}
        carrier = {CARRIER_KEY: about.bulk_stress_body + 1} if grid.is_pulled else {}
        fixed |= {**about.pairs, **names, **carrier, SIMILAR_KEY: about.similar}
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


_KINDS: dict[str, type[Definition]] = {each.parameter: each for each in (LoadPath, TabulatedProfile)}


def definitions_text(definitions: Iterable[Definition]) -> str:
    """Write definitions as the text of an attribute."""
    return json.dumps(
        [
            {"parameter": each.parameter, "name": each.name, "content": each.content(), **each.notes()}
            for each in definitions
        ]
    )


def defined_in(attributes: Mapping[Hashable, Any]) -> dict[str, dict[str, Definition]]:
    """Read the definitions, by parameter and name, from the attributes of a Dataset.

    Raises
    ------
    ValueError
        If the text is not one of `definitions_text`.
    """
    text = attributes.get("definitions", "[]")
    found: dict[str, dict[str, Definition]] = {}
    try:
        for raw in from_json(text):
            defined = _KINDS[raw["parameter"]].of_content(raw["name"], raw["content"])
            found.setdefault(raw["parameter"], {})[raw["name"]] = defined
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"not definitions: {literal(text)} ({error})") from None
    return found
