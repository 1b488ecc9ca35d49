"""The layout of a study's figure: which dimension goes where, which quantity is drawn; checks of it."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Collection, Iterator, Mapping
from dataclasses import asdict, fields
from typing import Annotated, ClassVar

from pydantic import BeforeValidator, ConfigDict, Field, StrictBool, WithJsonSchema
from pydantic.dataclasses import dataclass

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.values import Value, index_of, read_exact, read_value
from swtstudy.vocabulary.choices import FIGURES
from swtstudy.vocabulary.derived import lacking
from swtstudy.vocabulary.files import read_json
from swtstudy.vocabulary.mistakes import Report, literal, meant, nearest
from swtstudy.vocabulary.parameters import AXES, LETTERS, QUANTITY_AXES
from swtstudy.vocabulary.quantities import COUNTED, EVERY_VARIABLE, SOLVED, Request

_NORMALISED = re.compile(r"s\s*/\s*s\s*\(\s*(\w+)\s*=\s*([^()]+|[^()]*\([^()]*\)[^()]*)\)")

#: The data variables of an archive.
VARIABLES = (*SOLVED, "status", "run")

#: Key, found and allowed of mistakes.
Wrong = Iterator[tuple[str, str, str]]
#: The further quantity of a figure, in words.
QUANTITY = '"s/s(name=value)"'


Axis = Annotated[str, "the name of an axis"]
OtherAxis = Annotated[str | None, "the name of an axis"]
Text = Annotated[str | None, "a text"]
Flag = Annotated[StrictBool, "true or false"]
_KINDS = "; ".join(f"{name}: {each.words}" for name, each in FIGURES.items()) + "."
Kind = Annotated[str, "a text", Field(description=_KINDS, json_schema_extra={"enum": [*FIGURES]})]
_EITHER = [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]
Quantities = Annotated[
    tuple[str, ...],
    'a text, or a list of texts, such as "s" or "s/s(flat_radius=0)"',
    # A tuple, too, of the list in an archive, which is read strictly.
    BeforeValidator(lambda y: (y,) if isinstance(y, str) else tuple(y) if isinstance(y, list) else y),
    WithJsonSchema({"anyOf": _EITHER}),
    Field(
        description=f"One row of panels for each: {', '.join(VARIABLES)}, a quantity that the study asks "
        f"for, or {QUANTITY} for s over its value at one place."
    ),
]


@dataclass(frozen=True, config=ConfigDict(extra="forbid", use_attribute_docstrings=True))
class FigureLayout:
    """The layout of the figure: x, hue, vertical and panels are dimensions of the study."""

    #: Words for it as a whole, in messages.
    allowed: ClassVar[str]

    x: Axis
    """Axis along the horizontal axis; "sample" for a scatter or histogram."""
    hue: OtherAxis = None
    """Axis whose values are the lines."""
    panels: OtherAxis = None
    """Axis whose values are the panels side by side."""
    y: Quantities = ("s",)
    title: Text = None
    """Title over the figure."""
    kind: Kind = "lines"
    vertical: OtherAxis = None
    """Axis along the vertical axis of contours or a heat map."""
    regimes: Flag = False
    """True to mark where a regime of the contact begins along a line."""
    validity: Flag = False
    """True to mark points outside of what the model holds for, such as beyond first yield."""
    caption: Text = None
    """Text beneath the figure, in reports."""
    message: Text = None
    """Headline of reports, instead of what the results say first."""

    def to_json(self) -> str:
        """The layout as text, for an archive."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> FigureLayout:
        """The layout from its text in an archive."""
        return cls(**json.loads(text))

    def roles(self) -> Iterator[tuple[str, str]]:
        """Role and name of every dimension that is used."""
        names = ((role, getattr(self, role)) for role in ("x", "vertical", "hue", "panels"))
        return ((role, name) for role, name in names if name is not None)

    @property
    def free(self) -> list[str]:
        """Roles that another axis may take: the lines, the panels."""
        lacks = FIGURES[self.kind].lacks if self.kind in FIGURES else ()
        return [role for role in ("hue", "panels") if role not in lacks and getattr(self, role) is None]


_, *_OPTIONAL, _LAST = (field.name for field in fields(FigureLayout))
FigureLayout.allowed = f"a table with x and, optionally, {', '.join(_OPTIONAL)} and {_LAST}"


def reference(y: str) -> tuple[str, Value] | None:
    """Parameter and value of the place that normalises a quantity; None for a data variable.

    Raises
    ------
    ValueError
        If the text is neither; the message gives the reason.

    Examples
    --------
    >>> reference("s/s(flat_radius=0)")
    ('flat_radius', 0.0)
    >>> reference("s/s(b=0)")
    ('flat_radius', 0.0)
    """
    if y.strip().isidentifier():
        return None
    match = _NORMALISED.fullmatch(y.strip())
    if match is None:
        raise ValueError("not a quantity")
    name, raw = match.groups()
    name = LETTERS.get(unicodedata.normalize("NFKC", name), name)  # a keyboard's µ is not the letter μ
    if name not in AXES:
        raise ValueError(f"unknown parameter {name}")
    if AXES[name].kind == "name":
        return name, raw.strip()  # what results or a study define has names of its own
    if AXES[name].scale or AXES[name].part == "contact":
        return name, float(read_exact(raw.strip()))  # whose range depends on its unit
    return name, read_value(AXES[name], raw.strip())


def wrong_layout(layout: FigureLayout) -> Wrong:
    """Key, found and allowed of everything that is wrong with a layout for any results."""
    used: dict[str, str] = {}
    for role, name in layout.roles():
        if name in used:
            yield f"figure.{role}", f"{literal(name)}, also used for {used[name]}", "each axis once"
        used.setdefault(name, role)
    if layout.kind in FIGURES:
        yield from _wrong_roles(layout)
    else:
        yield "figure.kind", literal(layout.kind), nearest(layout.kind, FIGURES)
    if not layout.y:
        yield "figure.y", "an empty list", f"at least one of {', '.join(VARIABLES)}, or {QUANTITY}"
    if problem := wrong_formula(layout.title or ""):
        yield "figure.title", f"{literal(layout.title)} ({problem})", "a text; formulae between $ as in LaTeX"


def _wrong_roles(layout: FigureLayout) -> Wrong:
    """Find mistakes in what is combined with the kind of figure."""
    kind, named = FIGURES[layout.kind], f'kind = "{layout.kind}"'
    if kind.of == "surface" and layout.vertical is None:
        yield "figure.vertical", "nothing", f"the name of an axis ({named} needs it)"
    for part, why in kind.lacks.items():
        if given := getattr(layout, part):
            found, allowed = ("true", "false") if given is True else (literal(given), "none")
            yield f"figure.{part}", found, f"{allowed} for {named}{why}"
    of_samples = " or ".join(name for name, each in FIGURES.items() if each.of == "sample")
    for role, name in layout.roles():
        is_name = name in AXES and AXES[name].kind == "name"
        if role in ("x", "vertical") and is_name and layout.kind != "heatmap":
            yield f"figure.{role}", literal(name), f"an axis of numbers, and {name} as hue or panels"
        if name == SAMPLE and (role != "x" or kind.of != "sample"):
            yield f"figure.{role}", f"{name!r}", f"an axis; a sample is x of kind {of_samples}"
    if kind.of == "sample" and layout.x != SAMPLE:
        yield "figure.x", literal(layout.x), f'"{SAMPLE}" for {named}'


#: Words for allowed values where there is no axis to name.
NO_AXIS = "a figure needs an axis of numbers; swtstudy show STUDY draws one point"


def wrong_axes(layout: FigureLayout, sizes: Mapping[str, int | None], of: str) -> Wrong:
    """Key, found and allowed of everything in a layout that does not fit the given axes.

    Parameters
    ----------
    layout
        The figure.
    sizes
        Number of values of each axis; None if not known.
    of
        The owner of these axes, in words, for messages.
    """
    for role, name in layout.roles():
        if name not in sizes:
            allowed = nearest(name, sizes) if sizes else NO_AXIS
            yield f"figure.{role}", f"{literal(name)}, not an axis of {of}", allowed
        elif layout.kind == "contour" and role in ("x", "vertical") and sizes[name] == 1:
            yield f"figure.{role}", f"{name} with a single value", "an axis of two values or more"
    names = [name for _, name in layout.roles()]
    lacks_vertical = layout.kind in FIGURES and FIGURES[layout.kind].of == "surface" and not layout.vertical
    placed = {name if name in sizes else meant(name, sizes) for name in names} - {None}
    lacking = [name for name in sizes if name not in placed and name in (*AXES, SAMPLE)]
    # A place whose mistake is said already may name an axis without one.
    for name in lacking if len(lacking) > len(names) + lacks_vertical - len(placed) else ():
        such = f', such as {layout.free[-1]} = "{name}"' if layout.free else ""
        allowed = f"every axis as x, hue, vertical or panels{such}"
        allowed += ", or with a single value" + f", such as by --at {name}=…" * (of == "these results")
        yield "figure", f"no place for the axis {name}", allowed


def check_figure(
    layout: FigureLayout, dims: list[str], grid: Grid | None, asked: Request, report: Report, unsure: set[str]
) -> None:
    """Report everything in a figure that does not fit its study.

    Parameters
    ----------
    layout
        The figure.
    dims
        Names of the axes of the study.
    grid
        The grid, to look up the places used for normalisation; None if it has mistakes itself.
    asked
        The study's quantities beside s.
    report
        Called with key, found and allowed of each mistake.
    unsure
        Names of what the study may have but for other mistakes, which are reported.
    """
    made = {} if grid is None else grid.made(asked)
    known = [*dict.fromkeys((*VARIABLES, *asked.variables, *made))]
    lengths: dict[str, int | None] = {} if grid is None else {**grid.sizes}
    found = [*wrong_layout(layout)]
    for y in layout.y or ("s",):
        name = y.strip()
        if name in unsure:
            continue
        if name in made:
            sizes = {dim: {**lengths, **asked.sizes}[dim] for dim in made[name]}
        else:  # of what is no quantity, all that the figure uses
            sizes = {dim: lengths.get(dim) for dim in dims if dim not in QUANTITY_AXES}
            unknown = name.isidentifier() and name not in VARIABLES
            used = [each for _, each in layout.roles() if each in QUANTITY_AXES and unknown]
            sizes |= {dim: asked.sizes[dim] for dim in asked.variables.get(name, used)}
        of = f"{y} in this study" if asked.distances or {*dims} - {*sizes} else "this study"
        found += wrong_axes(layout, sizes, of)
        found += _wrong_quantity(y, dims, grid, asked, known)
    if layout.regimes and layout.x in QUANTITY_AXES:
        found.append(("figure.regimes", f"true over {layout.x}", "false: there is one regime at a point"))
    for mistake in dict.fromkeys(found):
        report(*mistake)


def _wrong_quantity(y: str, dims: list[str], grid: Grid | None, asked: Request, known: list[str]) -> Wrong:
    """Key, found and allowed of a quantity that a study does not have, or of its place."""
    name, found = y.strip(), literal(y)
    try:
        place = reference(y)
    except ValueError as error:
        yield "figure.y", f"{found} ({error})", f"{', '.join(known)}, or {QUANTITY}"
        return
    if place is not None:
        parameter, value = place
        if parameter not in dims:
            yield "figure.y", f"{found}: {parameter} is not an axis of this study", nearest(parameter, dims)
        elif grid is not None and index_of(value, grid.values(parameter)) is None:
            yield "figure.y", f"{found}: {value} is not on that axis", f"a value of the axis {parameter}"
    elif name in COUNTED:
        yield "figure.y", f"{found}, which has several values at a point", "cycles, which is made of it"
    elif name in known:
        pass
    elif name in EVERY_VARIABLE:
        allowed = f"what it asks for, {', '.join(known)}, or {QUANTITY}"
        yield "figure.y", f"{found}, which this study does not ask for", allowed
    elif grid and (lacks := lacking(name, grid, grid.values("criterion"), asked)):
        allowed = f"in a study with {' and '.join(lacks)}; or {', '.join(known)}"
        yield "figure.y", found, allowed
    else:
        allowed = f"{nearest(y, known)}; or {QUANTITY}".replace("?;", "?")
        yield "figure.y", f"{found} (not a quantity)", allowed


def wrong_formula(text: str) -> str | None:
    """Reason why matplotlib cannot draw the formulae in a text, if there is one."""
    if "$" not in text:
        return None
    # Imported only if there is a formula: the import takes longer than the rest of the check.
    from matplotlib.cbook import is_math_text
    from matplotlib.mathtext import MathTextParser

    try:
        if is_math_text(text):
            MathTextParser("path").parse(text)
    except ValueError as error:
        # Without the name of the parser's error.
        return str(error).strip().splitlines()[-1].partition(": ")[2]
    return None


def read_figure(text: object, others: Collection[str] = ()) -> FigureLayout:
    """The layout of an archive's figure, which may show others than what every study may have.

    Raises
    ------
    ValueError
        With the reason, if no study has such a layout.
    """
    layout: FigureLayout = read_json(FigureLayout, text)
    for key, found, allowed in wrong_layout(layout):
        raise ValueError(f"{key.removeprefix('figure.')}: found {found}; allowed: {allowed}")
    for y in layout.y:
        if reference(y) is None and y.strip() not in (*VARIABLES, *EVERY_VARIABLE, *others):
            raise ValueError(f"{literal(y)} is not a quantity")
    return layout
