"""The keys of a study file: their types, what they are for, and what is allowed in messages.

A key is told of here alone: pydantic checks it, messages say what is allowed, the schema has its description.
Pydantic's errors are worded like the other mistakes. Values of parameters are checked elsewhere, against
their own table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError

from swtstudy.study.design import DESIGNS, DesignName
from swtstudy.study.figure import KINDS, QUANTITY, VARIABLES, Kind
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    DEFAULT_RTOL,
    LARGEST_RTOL,
    SMALLEST_RTOL,
    Mistake,
    literal,
    nearest,
)


@dataclass(frozen=True)
class Allowed:
    """Words for what a key may hold, where pydantic's own message would not say it."""

    words: str


AxisName = Annotated[str, Allowed("the name of an axis")]
OtherAxisName = Annotated[str | None, Allowed("the name of an axis")]
File = Annotated[str | None, Allowed("the path of a CSV file")]
Flag = Annotated[bool, Allowed("true or false")]
Text = Annotated[str | None, Allowed("a text")]
_BLOCK = Allowed("[[blocks]] with load and rounds")


def _quoted(names: Sequence[str]) -> str:
    *others, last = (f'"{name}"' for name in names)
    return f"{', '.join(others)} or {last}"


def _key(description: str, default: Any = ..., **limits: Any) -> Any:
    """A key with its description in the schema."""
    return Field(default, description=description, **limits)


class Table(BaseModel):
    """A table of a study file."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    #: What is allowed in the place of the table.
    allowed: ClassVar[str]


class RangeTable(Table):
    """Values of an axis in equal steps or equal ratios, both ends included."""

    allowed = "a list of values or {start, stop, num}"

    start: Any = _key('First value; a number, or a text such as "2*pi".')
    stop: Any = _key("Last value, included.")
    num: Annotated[int, Allowed("a whole number")] = _key("Number of values.")
    spacing: Annotated[Literal["linear", "log"], Allowed('"linear" or "log"')] = _key(
        'Equal steps ("linear") or equal ratios ("log").', "linear"
    )
    also: Annotated[list[Any], Allowed("a list of values")] = _key(
        "Further values, put in among those: where curves bend, for example.", []
    )


def _axis_kind(raw: object) -> str:
    return "range" if isinstance(raw, dict) else "list"


Axis = Annotated[
    Annotated[list[Any], Tag("list")] | Annotated[RangeTable, Tag("range")], Discriminator(_axis_kind)
]


class SampleTable(Table):
    """Parameters that vary together: a design of points in ranges, or given points."""

    allowed = "a table with design, size and ranges, with points, or with file"

    design: Annotated[DesignName | None, Allowed(_quoted(DESIGNS))] = _key(
        "How the points are chosen; saltelli is for Sobol indices (swtstudy sensitivity).", None
    )
    size: Annotated[int | None, Allowed("a whole number")] = _key(
        "Number of points; for sobol and saltelli a power of 2. Of saltelli there are size (d + 2).", None
    )
    seed: Annotated[int, Allowed("a whole number")] = _key("Seed of the random numbers.", 0)
    ranges: Annotated[dict[str, Any], Allowed("a table of ranges")] = _key(
        "Sampled parameters: both ends, [low, high], or a distribution.", {}
    )
    file: File = _key("CSV file of points: a row with names of parameters, then a row for each point.", None)
    points: Annotated[dict[str, list[Any]], Allowed("a table of lists of values")] = _key(
        "Points given here: a list of values for each parameter, all of one length.", {}
    )


class FigureTable(Table):
    """The layout of the figure: x, hue, vertical and panels are dimensions of the study."""

    kind: Annotated[Kind, Allowed(_quoted(KINDS))] = _key(
        "Lines over x, or x upright over life; contours or a heat map over x and vertical; "
        "scatter or histogram of a sample.",
        "lines",
    )
    x: AxisName = _key('Axis along the horizontal axis; "sample" for a scatter or histogram.')
    vertical: OtherAxisName = _key("Axis along the vertical axis of contours or a heat map.", None)
    hue: OtherAxisName = _key("Axis whose values are the lines.", None)
    panels: OtherAxisName = _key("Axis whose values are the panels side by side.", None)
    y: Annotated[
        str | list[str], Allowed('a text, or a list of texts, such as "s" or "s/s(flat_radius=0)"')
    ] = _key(
        f"One row of panels for each: {', '.join(VARIABLES)}, "
        f"a quantity that the study asks for, or {QUANTITY} for s over its value at one place.",
        "s",
    )
    title: Text = _key("Title over the figure.", None)
    regimes: Flag = _key("Whether to mark where a regime of the contact begins along a line.", False)
    caption: Text = _key("What there is to say beneath the figure, in reports.", None)
    message: Text = _key("Headline of reports, instead of what the results say first.", None)
    validity: Flag = _key(
        "Whether to mark points outside of what the model holds for, such as beyond first yield.", False
    )


*_OPTIONAL, _LAST = (name for name, field in FigureTable.model_fields.items() if not field.is_required())
FigureTable.allowed = f"a table with x and, optionally, {', '.join(_OPTIONAL)} and {_LAST}"


#: Of files that are tables; checked where they are read.
_SEPARATOR = _key(
    'Between the cells of the file: ",", ";", "|", a tab, or a blank for any number of blanks.', None
)
_DECIMAL = _key('The decimal sign in the file: "." or ",".', None)


class LoadTable(Table):
    """A loop of loads: its vertices, its harmonics, or the file of a signal."""

    allowed = "a table with vertices, with normal and tangential, or with file"

    vertices: Any = _key(
        "Pairs c_n, c_t, or triples with c_b: the normal load is 1 + its amplitude times c_n, the "
        "tangential one its amplitude times c_t, the bulk stress its mean plus its amplitude times c_b.",
        None,
    )
    file: File = _key(
        "Path of a table, relative to the study, with a header and the columns normal, tangential "
        "and, optionally, bulk, of one cycle or of several.",
        None,
    )
    normal: Any = _key(
        "Harmonics of c_n instead of vertices: rows of order k, amplitude A and phase α of A sin(kφ + α).",
        None,
    )
    tangential: Any = _key("Harmonics of c_t: rows of order, amplitude and phase.", None)
    bulk: Any = _key("Harmonics of c_b, beside those: rows of order, amplitude and phase.", None)
    mean_normal: Any = _key(
        "The mean normal load from which c_n of vertices or harmonics deviates, in its unit.", None
    )
    columns: Any = _key(
        "Headers of the file's columns normal, tangential and bulk, where they are not these words.", None
    )
    absolute: Any = _key(
        "Whether the normal column is the load itself: its mean is the mean load of the study.", None
    )
    separator: Any = _SEPARATOR
    decimal: Any = _DECIMAL
    time: Any = _key("Header of the file's column of the time; without it samples are even.", None)
    recorded_cycles: Any = _key(
        "Number of cycles that the file holds: they are folded into their mean.", None
    )
    period: Any = _key(
        "Length of a cycle in the place of their number, in the unit of the time, or in samples.", None
    )
    harmonics: Any = _key("Highest order of a fit of the file's columns by harmonics: a smooth loop.", None)
    despike: Any = _key(
        "Whether samples that stand out from all other cycles take the median of the cycles.", None
    )
    keep_cycles: Flag = _key(
        "Whether blocks of the load run all recorded cycles in turn, not their mean.", False
    )


class BlockTable(Table):
    """A block of a sequence: rounds of a load."""

    allowed = _BLOCK.words

    load: Annotated[str, Allowed("the name of a load")] = _key(
        "Name of a load; of a signal that keeps its cycles all of them in turn."
    )
    rounds: Annotated[Any, _BLOCK] = _key(
        "How many rounds of it there are in each repetition of the sequence."
    )


class ProfileTable(Table):
    """A profile as a table: its radii and heights, or the file that has them."""

    allowed = "a table with radius and height, or file"

    radius: Any = _key("Radii r, in a length a_H: at least 8, ascending from 0.", None)
    height: Any = _key("Heights f at these radii, in a depth δ0: 0 at the axis.", None)
    file: File = _key(
        "Path of a CSV file, relative to the study, with a header and the columns radius and height.", None
    )
    smoothing: Any = _key("Root mean square of what the fit may miss of the heights; 0 to miss none.", None)
    geometry: Any = _key(
        '"axisymmetric", or "plane" for a long body: its radii are then half-widths.', "axisymmetric"
    )
    columns: Any = _key(
        "Headers of the file's columns radius and height, or position and height, if they are others.", None
    )
    separator: Any = _SEPARATOR
    decimal: Any = _DECIMAL
    two_sided: Flag = _key(
        "Whether the file is a trace across the body, with the columns position and height.", False
    )
    level: Flag = _key(
        "Whether the tilt of a trace is taken off; smoothing is by its noise unless given.", True
    )


class StudyTable(Table):
    """A study file."""

    title: Annotated[str, Allowed("a text that is not empty")] = _key(
        "One line that describes the study.", min_length=1
    )
    rtol: Annotated[float, Allowed(ALLOWED_RTOL)] = _key(
        "Relative accuracy asked of s.", DEFAULT_RTOL, ge=SMALLEST_RTOL, le=LARGEST_RTOL
    )
    # Checked against the table of quantities.
    quantities: Any = _key("What is computed beside s, as data variables of the results.", [])
    fixed: Annotated[dict[str, Any], Allowed("a table of single values")] = _key(
        "Parameters with a single value. Parameters not given have the values of the paper's Table 1.", {}
    )
    axes: Annotated[dict[str, Axis], Allowed("a table of axes")] = _key(
        "Parameters with several values, in the order of the dimensions: a list or a range.", {}
    )
    sample: SampleTable | None = _key(
        "Parameters that vary together along the dimension sample: a design, or given points.", None
    )
    # Checked where units and constants are read.
    units: Annotated[dict[str, Any] | None, Allowed("a table with length, force and stress")] = _key(
        "Labels of length, force and stress, any consistent set: then the parameters have these units.", None
    )
    material: Annotated[dict[str, Any] | None, Allowed("a table of fatigue constants")] = _key(
        "Fatigue constants, each a value or one for each body; or names from a file. For cycles.", None
    )
    loads: Annotated[dict[str, LoadTable], Allowed("a table of loops, [loads.NAME]")] = _key(
        "Loops of the load, by name: vertices, a CSV file with the columns normal, tangential and, "
        "optionally, bulk, or harmonics.",
        {},
    )
    profiles: Annotated[dict[str, ProfileTable], Allowed("a table of profiles, [profiles.NAME]")] = _key(
        "Profiles by name: radius and height, or a CSV file with these columns.", {}
    )
    blocks: Annotated[list[BlockTable], _BLOCK] = _key(
        "Blocks of a sequence of loads that repeats, for Miner's sum; with [material] only.", []
    )
    figure: FigureTable | None = _key("What the figure puts where; every axis needs a place.", None)


#: The tables within a study: how many keys lead to one, and its keys.
_INNER: dict[str, tuple[int, type[Table]]] = {
    "axes": (2, RangeTable),
    "sample": (1, SampleTable),
    "loads": (2, LoadTable),
    "profiles": (2, ProfileTable),
    "blocks": (2, BlockTable),
    "figure": (1, FigureTable),
}


def read_structure(raw: Mapping[str, Any], source: str) -> tuple[StudyTable | None, list[Mistake]]:
    """The tables of a study file, or all that is wrong with their structure."""
    try:
        return StudyTable.model_validate(raw), []
    except ValidationError as error:
        found = {_mistake(detail, source) for detail in error.errors(include_url=False)}
        return None, sorted(found, key=lambda mistake: mistake.key)


def _mistake(detail: Any, source: str) -> Mistake:
    path = list(detail["loc"])
    if path[0] == "axes" and path[2:3] in (["list"], ["range"]):
        del path[2]  # pydantic's tag, not a key
    if path[:2] == ["figure", "y"]:
        path = path[:2]  # both members of the union report it: one mistake is enough
    key = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    if detail["type"] == "extra_forbidden":
        return Mistake(key, f"unknown key {literal(path[-1])}", nearest(str(path[-1]), _known(path)), source)
    allowed = _allowed(path) or detail["msg"]
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(key, found, allowed, source)


def _allowed(path: list[Any]) -> str:
    """Words for what a key or the place of a table may hold; empty where pydantic's message says it."""
    depth, table = _INNER.get(str(path[0]), (0, StudyTable))
    if len(path) == depth:
        return table.allowed
    if len(path) > depth + 1:
        return ""
    model, name = (table, path[depth]) if len(path) > depth else (StudyTable, path[0])
    metadata = model.model_fields[name].metadata if name in model.model_fields else []
    return next((each.words for each in metadata if isinstance(each, Allowed)), "")


def _known(path: list[Any]) -> list[str]:
    depth, table = _INNER.get(str(path[0]), (0, StudyTable))
    return list((table if len(path) > depth else StudyTable).model_fields)
