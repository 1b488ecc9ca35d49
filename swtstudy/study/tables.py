"""The keys of a study file: their types, what they are for, and what is allowed in messages.

A key is told of here alone: pydantic checks it, messages say what is allowed, the schema has its description.
Pydantic's errors are worded like the other mistakes. Values of parameters are checked elsewhere, against
their own table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Tag

from swtstudy.points.reading import LONGEST_AXIS
from swtstudy.study.columns import FileTable
from swtstudy.study.design import DESIGNS, DesignName
from swtstudy.study.figure import KINDS, QUANTITY, VARIABLES, Kind
from swtstudy.study.keys import Allowed, Table, key, read_keys
from swtstudy.study.signal import SignalTable
from swtstudy.study.trace import TraceTable
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    ALLOWED_SEED,
    DEFAULT_RTOL,
    LARGEST_RTOL,
    LARGEST_SEED,
    SMALLEST_RTOL,
    Mistake,
)

AxisName = Annotated[str, Allowed("the name of an axis")]
OtherAxisName = Annotated[str | None, Allowed("the name of an axis")]
File = Annotated[str | None, Allowed("the path of a CSV file")]
Flag = Annotated[bool, Allowed("true or false")]
Text = Annotated[str | None, Allowed("a text")]
_BLOCK = Allowed("[[blocks]] with load and rounds")


def _quoted(names: Sequence[str]) -> str:
    *others, last = (f'"{name}"' for name in names)
    return f"{', '.join(others)} or {last}"


class RangeTable(Table):
    """Values of an axis in equal steps or equal ratios, both ends included."""

    allowed = "a list of values or {start, stop, num}"

    start: Any = key('First value; a number, or a text such as "2*pi".')
    stop: Any = key("Last value, included.")
    num: Annotated[int, Allowed("a whole number")] = key("Number of values.")
    spacing: Annotated[Literal["linear", "log"], Allowed('"linear" or "log"')] = key(
        'Equal steps ("linear") or equal ratios ("log").', "linear"
    )
    also: Annotated[list[Any], Allowed("a list of values")] = key(
        "Further values, put in among those: where curves bend, for example.", []
    )


def _axis_kind(raw: object) -> str:
    return "range" if isinstance(raw, dict) else "list"


Axis = Annotated[
    Annotated[list[Any], Tag("list")] | Annotated[RangeTable, Tag("range")], Discriminator(_axis_kind)
]


class SampleTable(FileTable):
    """Parameters that vary together: a design of points in ranges, or given points."""

    allowed = "a table with design, size and ranges, with points, or with file"

    design: Annotated[DesignName | None, Allowed(_quoted(DESIGNS))] = key(
        "How the points are chosen; saltelli is for Sobol indices (swtstudy sensitivity).", None
    )
    size: Annotated[int | None, Allowed(f"a whole number from 1 to {LONGEST_AXIS}")] = key(
        "Number of points; for sobol and saltelli a power of 2. Of saltelli there are size (d + 2).",
        None,
        ge=1,
        le=LONGEST_AXIS,
    )
    seed: Annotated[int, Allowed(ALLOWED_SEED)] = key("Seed of the random numbers.", 0, ge=0, le=LARGEST_SEED)
    ranges: Annotated[dict[str, Any], Allowed("a table of ranges")] = key(
        "Sampled parameters, and constants of [material]: both ends, [low, high], or a distribution.", {}
    )
    covariance: Annotated[dict[str, Any], Allowed("a table of covariances")] = key(
        "Variances and covariances of constants, which scatter normally about those of [material].", {}
    )
    target_life: Annotated[float | None, Allowed("a number")] = key(
        "Load cycles before which the probability of a crack is asked for.", None
    )
    file: File = key("CSV file of points: a row with names of parameters, then a row for each point.", None)
    points: Annotated[dict[str, list[Any]], Allowed("a table of lists of values")] = key(
        "Points given here: a list of values for each parameter, all of one length.", {}
    )


class FigureTable(Table):
    """The layout of the figure: x, hue, vertical and panels are dimensions of the study."""

    kind: Annotated[Kind, Allowed(_quoted(KINDS))] = key(
        "Lines over x, or x upright over life; contours or a heat map over x and vertical; "
        "scatter or histogram of a sample.",
        "lines",
    )
    x: AxisName = key('Axis along the horizontal axis; "sample" for a scatter or histogram.')
    vertical: OtherAxisName = key("Axis along the vertical axis of contours or a heat map.", None)
    hue: OtherAxisName = key("Axis whose values are the lines.", None)
    panels: OtherAxisName = key("Axis whose values are the panels side by side.", None)
    y: Annotated[
        str | list[str],
        Allowed('a text, or a list of texts, such as "s" or "s/s(flat_radius=0)"', whole=True),
    ] = key(
        f"One row of panels for each: {', '.join(VARIABLES)}, "
        f"a quantity that the study asks for, or {QUANTITY} for s over its value at one place.",
        "s",
    )
    title: Text = key("Title over the figure.", None)
    regimes: Flag = key("Whether to mark where a regime of the contact begins along a line.", False)
    caption: Text = key("What there is to say beneath the figure, in reports.", None)
    message: Text = key("Headline of reports, instead of what the results say first.", None)
    validity: Flag = key(
        "Whether to mark points outside of what the model holds for, such as beyond first yield.", False
    )


*_OPTIONAL, _LAST = (name for name, field in FigureTable.model_fields.items() if not field.is_required())
FigureTable.allowed = f"a table with x and, optionally, {', '.join(_OPTIONAL)} and {_LAST}"


class LoadTable(SignalTable):
    """A loop of loads: its vertices, its harmonics, or the file of a signal."""

    allowed = "a table with vertices, with normal and tangential, or with file"

    vertices: Any = key(
        "Pairs c_n, c_t, or triples with c_b: the normal load is 1 + its amplitude times c_n, the "
        "tangential one its amplitude times c_t, the bulk stress its mean plus its amplitude times c_b.",
        None,
    )
    file: File = key(
        "Path of a table, relative to the study, with a header and the columns normal, tangential "
        "and, optionally, bulk, of one cycle or of several.",
        None,
    )
    normal: Any = key(
        "Harmonics of c_n instead of vertices: rows of order k, amplitude A and phase α of A sin(kφ + α).",
        None,
    )
    tangential: Any = key("Harmonics of c_t: rows of order, amplitude and phase.", None)
    bulk: Any = key("Harmonics of c_b, beside those: rows of order, amplitude and phase.", None)
    mean_normal: Any = key(
        "The mean normal load from which c_n of vertices or harmonics deviates, in its unit.", None
    )
    keep_cycles: Flag = key(
        "Whether blocks of the load run all recorded cycles in turn, not their mean.", False
    )


class BlockTable(Table):
    """A block of a sequence: rounds of a load."""

    allowed = _BLOCK.words

    load: Annotated[str, Allowed("the name of a load")] = key(
        "Name of a load; of a signal that keeps its cycles all of them in turn."
    )
    rounds: Annotated[Any, _BLOCK] = key(
        "How many rounds of it there are in each repetition of the sequence."
    )


class ProfileTable(TraceTable):
    """A profile as a table: its radii and heights, or the file that has them."""

    allowed = "a table with radius and height, or file"

    radius: Any = key("Radii r, in a length a_H: at least 8, ascending from 0.", None)
    height: Any = key("Heights f at these radii, in a depth δ0: 0 at the axis.", None)
    file: File = key(
        "Path of a CSV file, relative to the study, with a header and the columns radius and height.", None
    )
    two_sided: Flag = key(
        "Whether the file is a trace across the body, with the columns position and height.", False
    )


class StudyTable(Table):
    """A study file."""

    title: Annotated[str, Allowed("a text that is not empty")] = key(
        "One line that describes the study.", min_length=1
    )
    rtol: Annotated[float, Allowed(ALLOWED_RTOL)] = key(
        "Relative accuracy asked of s.", DEFAULT_RTOL, ge=SMALLEST_RTOL, le=LARGEST_RTOL
    )
    # Checked against the table of quantities.
    quantities: Any = key("What is computed beside s, as data variables of the results.", [])
    fixed: Annotated[dict[str, Any], Allowed("a table of single values")] = key(
        "Parameters with a single value. Parameters not given have the values of the paper's Table 1.", {}
    )
    axes: Annotated[dict[str, Axis], Allowed("a table of axes")] = key(
        "Parameters with several values, in the order of the dimensions: a list or a range.", {}
    )
    sample: SampleTable | None = key(
        "Parameters that vary together along the dimension sample: a design, or given points.", None
    )
    # Checked where units and constants are read.
    units: Annotated[dict[str, Any] | None, Allowed("a table with length, force and stress")] = key(
        "Labels of length, force and stress, any consistent set: then the parameters have these units.", None
    )
    material: Annotated[dict[str, Any] | None, Allowed("a table of fatigue constants")] = key(
        "Fatigue constants, each a value or one for each body; or names from a file. For cycles.", None
    )
    loads: Annotated[dict[str, LoadTable], Allowed("a table of loops, [loads.NAME]")] = key(
        "Loops of the load, by name: vertices, a CSV file with the columns normal, tangential and, "
        "optionally, bulk, or harmonics.",
        {},
    )
    profiles: Annotated[dict[str, ProfileTable], Allowed("a table of profiles, [profiles.NAME]")] = key(
        "Profiles by name: radius and height, or a CSV file with these columns.", {}
    )
    blocks: Annotated[list[BlockTable], _BLOCK] = key(
        "Blocks of a sequence of loads that repeats, for Miner's sum; with [material] only.", []
    )
    figure: FigureTable | None = key("What the figure puts where; every axis needs a place.", None)


def read_structure(raw: Mapping[str, Any], source: str) -> tuple[StudyTable | None, list[Mistake]]:
    """The tables of a study file, or all that is wrong with their structure."""
    return read_keys(StudyTable, raw, source)
