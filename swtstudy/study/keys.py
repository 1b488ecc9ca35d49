"""The keys of a study file: the one table of their types, of what messages allow, and of their descriptions.

Pydantic checks the structure, and words its errors like the other mistakes; the schema is made of the same
table. Values of parameters are checked against their own table.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from inspect import signature
from typing import Annotated, Any, ClassVar, Literal, Self, get_args

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError

from swtstudy.points.reading import END, LONGEST_AXIS
from swtstudy.solver.load_path import HIGHEST_ORDER
from swtstudy.study.figure import FigureLayout, Flag
from swtstudy.study.units.life import Block
from swtstudy.study.units.rows import right_place
from swtstudy.vocabulary import mistakes as rules
from swtstudy.vocabulary.choices import AXISYMMETRIC
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, nearest, plain
from swtstudy.vocabulary.naming import Function, with_arguments

#: Designs: a Sobol sequence, a Latin hypercube, independent random points, and the points for Sobol indices.
DesignName = Literal["sobol", "latin_hypercube", "random", "saltelli"]
DESIGNS: tuple[DesignName, ...] = get_args(DesignName)
#: Separators between cells; a blank stands for any number of them.
Separator = Literal[",", ";", "\t", "|", " "]
SEPARATORS: tuple[Separator, ...] = get_args(Separator)


class Table(BaseModel):
    """A table of a study file: a text among the annotations of a key says what messages allow for it."""

    model_config = ConfigDict(extra="forbid", strict=True, use_attribute_docstrings=True)
    #: Words for the table as a whole, in messages.
    allowed: ClassVar[str]

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Self:
        """The table with the keys that are not None; a StudyError with every mistake in them."""
        try:
            return cls.model_validate({n: plain(value) for n, value in given.items() if value is not None})
        except ValidationError as error:
            raise StudyError(_mistakes(cls, error, "")) from None


File = Annotated[str | None, "the path of a CSV file"]
Positive = Annotated[float | None, "a positive number", Field(gt=0.0, allow_inf_nan=False)]
Order = Annotated[int | None, f"a whole number, 1 to {HIGHEST_ORDER}", Field(ge=1, le=HIGHEST_ORDER)]
Size = Annotated[int | None, f"a whole number from 1 to {LONGEST_AXIS}", Field(ge=1, le=LONGEST_AXIS)]
Accuracy = Annotated[float, rules.ALLOWED_RTOL, Field(ge=rules.SMALLEST_RTOL, le=rules.LARGEST_RTOL)]


class FileTable(Table):
    """The form of a table in a file."""

    columns: Annotated[dict[str, str], 'a table of headers, such as { normal = "Fn [N]" }'] = {}
    """Headers of the file's columns, where they are not the names that they have here."""
    separator: Annotated[Separator | None, f"one of {', '.join(map(repr, SEPARATORS))}"] = None
    """Between cells; a blank for any number of blanks. Found from the header unless given."""
    decimal: Annotated[Literal[".", ","] | None, "one of '.', ','"] = None
    """The decimal sign in numbers. Found from the first rows unless given."""
    encoding: Annotated[str | None, 'the name of an encoding, such as "cp1252"'] = None
    """Encoding of the text, UTF-8 unless given; "cp1252" or "latin-1" for older programs."""
    scale: Annotated[dict[str, float], "a table of numbers, such as { normal = 1000 }"] = {}
    """Factors of columns, such as { normal = 1000 } for kN, or -1 for the other sign."""
    skip_rows: Annotated[int, "a whole number of lines, 0 or more", Field(ge=0)] = 0
    """Lines above the header. Found unless given, and told."""
    units_row: Annotated[bool | None, "true or false"] = None
    """True if a row of units follows the header. Found unless given, and told."""
    sheet: Annotated[str | int | None, "the name of a sheet, or its number from 1 on"] = None
    """Sheet of a workbook; the first one unless given."""

    def header(self, name: str) -> str:
        """The header of a column."""
        return " ".join(self.columns.get(name, name).split())


class SignalTable(FileTable):
    """The form of a signal in a file, and its cycles."""

    absolute: Flag = False
    """True if the normal column is the load itself: its mean is the mean load of the study."""
    time: Annotated[str | None, "the header of the column of the time", Field(min_length=1)] = None
    """Header of the file's column of the time; without it samples are even."""
    recorded_cycles: Annotated[int | None, "a whole number of cycles, 1 or more", Field(ge=1)] = None
    """Number of cycles that the file holds: they are folded into their mean."""
    period: Positive = None
    """Length of a cycle instead of their number, in the unit of the time, or in samples."""
    frequency: Positive = None
    """Cycles per unit of the time, such as Hz, instead of the period."""
    skip_cycles: Annotated[int, "a whole number of cycles, 0 or more", Field(ge=0)] = 0
    """Number of cycles at the begin of the record, such as a start-up, that are left out."""
    harmonics: Order = None
    """Highest order of a fit of the file's columns by harmonics: a smooth loop."""
    despike: Flag = False
    """True to replace spikes by the value that the samples beside them or the other cycles suggest."""


class TraceTable(FileTable):
    """A trace in a file, and the profile that is made of it."""

    level: Flag = True
    """True to take off the tilt of a trace; smoothing is by its noise unless given."""
    smoothing: Any = None
    """Root mean square of what the fit may miss of the heights; 0 to miss none."""
    geometry: Any = AXISYMMETRIC
    """"axisymmetric", or "plane" for a long body: its radii are then half-widths."""


class RangeTable(Table):
    """Values of an axis in equal steps or equal ratios, both ends included."""

    allowed = "a list of values or {start, stop, num}"

    start: Annotated[Any, END]
    """First value; a number, or a text such as "2*pi"."""
    stop: Annotated[Any, END]
    """Last value, included."""
    num: Annotated[int, "a whole number"]
    """Number of values."""
    spacing: Annotated[Literal["linear", "log"], '"linear" or "log"'] = "linear"
    """Equal steps ("linear") or equal ratios ("log")."""
    also: Annotated[list[Any], "a list of values"] = []
    """Further values, put in among the others: where curves bend, for example."""


Axis = Annotated[
    Annotated[list[Any], Tag("list")] | Annotated[RangeTable, Tag("range")],
    Discriminator(lambda raw: "range" if isinstance(raw, dict) else "list"),
]


class SampleTable(FileTable):
    """Parameters that vary together: a design of points in ranges, or given points."""

    allowed = "a table with design, size and ranges, with points, or with file"

    design: Annotated[DesignName | None, f"one of {', '.join(DESIGNS)}"] = None
    """The choice of the points; saltelli is for Sobol indices (swtstudy sensitivity)."""
    size: Size = None
    """Number of points; for sobol and saltelli a power of 2; saltelli makes size (d + 2) of them."""
    seed: Annotated[int, rules.ALLOWED_SEED, Field(ge=0, le=rules.LARGEST_SEED)] = 0
    """Seed of the random numbers."""
    ranges: Annotated[dict[str, Any], "a table of ranges"] = {}
    """Sampled parameters, and constants of [material]: both ends, [low, high], or a distribution."""
    covariance: Annotated[dict[str, Any], "a table of covariances"] = {}
    """Variances and covariances of constants, which scatter normally about the values in [material]."""
    target_life: Annotated[Positive, "a number of load cycles, greater than 0"] = None
    """Load cycles before which the probability of a crack is asked for."""
    file: File = None
    """CSV file of points: a row with names of parameters, then a row for each point."""
    points: Annotated[dict[str, list[Any]], "a table of lists of values"] = {}
    """Points given here: a list of values for each parameter, all of one length."""


class LoadTable(SignalTable):
    """A loop of loads: its vertices, its harmonics, or the file of a signal."""

    allowed = "a table with vertices, with normal and tangential, or with file"

    vertices: Any = None
    """Pairs c_n, c_t, or triples with c_b: the normal load is 1 + its amplitude times c_n, the tangential one
    its amplitude times c_t, the bulk stress its mean plus its amplitude times c_b."""
    file: File = None
    """Path of a table, relative to the study, with a header and the columns normal, tangential and,
    optionally, bulk, of one cycle or of several."""
    normal: Any = None
    """Harmonics of c_n instead of vertices: rows of order k, amplitude A and phase α of A sin(kφ + α)."""
    tangential: Any = None
    """Harmonics of c_t: rows of order, amplitude and phase."""
    bulk: Any = None
    """Harmonics of c_b, beside the two others: rows of order, amplitude and phase."""
    mean_normal: Any = None
    """The mean normal load from which c_n of vertices or harmonics deviates, in its unit."""
    keep_cycles: Flag = False
    """True if blocks of the load run all recorded cycles in turn, not their mean."""


class ProfileTable(TraceTable):
    """A profile as a table: its radii and heights, or the file that has them."""

    allowed = "a table with radius and height, or file"

    radius: Any = None
    """Radii r, in a length a_H: at least 8, ascending from 0."""
    height: Any = None
    """Heights f at these radii, in a depth δ0: 0 at the axis."""
    file: File = None
    """Path of a CSV file, relative to the study, with a header and the columns radius and height."""
    two_sided: Flag = False
    """True if the file is a trace across the body, with the columns position and height."""


class StudyTable(Table):
    """A study file."""

    title: Annotated[str, "a text that is not empty", Field(min_length=1)]
    """One line that describes the study."""
    rtol: Accuracy = rules.DEFAULT_RTOL
    """Relative accuracy asked of s."""
    quantities: Any = []
    """Quantities computed beside s, as data variables of the results."""
    fixed: Annotated[dict[str, Any], "a table of single values"] = {}
    """Parameters with a single value. Parameters not given have the values of the paper's Table 1."""
    axes: Annotated[dict[str, Axis], "a table of axes"] = {}
    """Parameters with several values, in the order of the dimensions: a list or a range."""
    sample: SampleTable | None = None
    """Parameters that vary together along the dimension sample: a design, or given points."""
    units: Annotated[dict[str, Any] | None, "a table with length, force and stress"] = None
    """Labels of length, force and stress, any consistent set: then the parameters have these units."""
    material: Annotated[dict[str, Any] | None, "a table of fatigue constants"] = None
    """Fatigue constants, each a value or one for each body; or names from a file. For cycles."""
    loads: Annotated[dict[str, LoadTable], "a table of loops, [loads.NAME]"] = {}
    """Loops of the load, by name: vertices, a CSV file with the columns normal, tangential and, optionally,
    bulk, or harmonics."""
    profiles: Annotated[dict[str, ProfileTable], "a table of profiles, [profiles.NAME]"] = {}
    """Profiles by name: radius and height, or a CSV file with these columns."""
    blocks: Annotated[list[Block], Block.allowed] = []
    """Blocks of a sequence of loads that repeats, for Miner's sum; with [material] only."""
    figure: FigureLayout | None = None
    """The layout of the figure; every axis needs a place."""


#: The tables within a study file, and how many keys lead to one of them.
_WITHIN: dict[str, tuple[Any, int]] = {
    "axes": (RangeTable, 2),
    "sample": (SampleTable, 1),
    "loads": (LoadTable, 2),
    "profiles": (ProfileTable, 2),
    "blocks": (Block, 2),
    "figure": (FigureLayout, 1),
}
#: How many keys lead to what is left out of a part of a study where one of its keys is wrong.
_LEVELS = {"axes": 2, "loads": 2, "profiles": 2, "sample": 3}


def read_study(raw: Mapping[str, Any], source: str) -> tuple[StudyTable, list[Mistake]]:
    """The tables of a study without what is wrong in them, and all mistakes in their structure.

    A wrong axis, load or profile is None.
    """
    left: dict[Any, Any] = {name: plain(value) for name, value in deepcopy(dict(raw)).items()}
    mistakes: list[Mistake] = []
    while True:
        try:
            table = StudyTable.model_validate(left)
            break
        except ValidationError as error:
            mistakes = mistakes or _mistakes(StudyTable, error, source)
            places = (detail["loc"] for detail in error.errors())
        for place in {place[: _LEVELS.get(str(place[0]), 1)] for place in places}:
            if place == ("title",):
                left["title"] = "-"
            elif place == ("blocks",) and isinstance(left["blocks"], list):  # their loads are still known
                loads = [each.get("load") for each in left["blocks"] if isinstance(each, dict)]
                left["blocks"] = [{"load": each, "rounds": 1} for each in loads if isinstance(each, str)]
            elif not _drop(left, *place):  # pydantic names keys that are no Unicode otherwise
                left.pop(place[0], None)
    if not rules.storable(str(raw.get("title", ""))):
        mistakes = [*mistakes, Mistake("title", literal(raw["title"]), rules.STORABLE, source)]
    parts = [part for part in ("axes", "loads", "profiles") if isinstance(raw.get(part), dict)]
    sound = {part: {name: getattr(table, part).get(name) for name in raw[part]} for part in parts}
    return table.model_copy(update=sound), mistakes


def _drop(left: dict[Any, Any], first: Any, *others: Any) -> bool:
    """Take the entry at a place out of tables; False if there is none."""
    inner = left.get(first)
    if others and isinstance(inner, dict):
        return _drop(inner, *others)
    return left.pop(first, left) is not left


def _mistakes(model: type[Table], error: ValidationError, source: str) -> list[Mistake]:
    """The mistakes in a table, each at the key that is wrong."""
    found = {_mistake(model, detail, source) for detail in error.errors(include_url=False)}
    return sorted(found, key=lambda mistake: mistake.key)


def _mistake(model: type[Table], detail: Any, source: str) -> Mistake:
    """A mistake as pydantic tells it, with what the innermost table on the way to it allows."""
    path = [part for part in detail["loc"] if part not in ("list", "range")]  # pydantic's tags, not keys
    table, levels = _WITHIN.get(str(path[0]), (model, 0)) if model is StudyTable else (model, 0)
    if len(path) < levels:
        table, levels = model, 0
    keys = table.__pydantic_fields__
    allowed = ""
    if len(path) == levels:
        allowed = table.allowed
    elif row := keys.get(str(path[levels])):
        if row.annotation != dict[str, list[Any]]:
            path = path[: levels + 1]  # what follows are kinds of values, or places in a list
        allowed = next((each for each in reversed(row.metadata) if isinstance(each, str)), "")
    name = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    if detail["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
        key, choice = str(path[-1]), right_place if len(path) == 1 else nearest
        return Mistake(name, f"unknown key {literal(key)}", choice(key, keys), source)
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(name, found, allowed or detail["msg"], source)


def with_keys(model: type[Table]) -> Callable[[Function], Function]:
    """Decorate a function whose further arguments are the keys of a table: its signature names them."""
    return with_arguments(signature(model).parameters.values())


@contextmanager
def under(report: Report, key: str, part: str = "") -> Iterator[None]:
    """Within a with block, report the mistakes of a StudyError in a table: each at its key, or at a part."""
    try:
        yield
    except StudyError as error:
        for each in error.mistakes:
            own, found, place = key, each.found, ": ".join(filter(None, (each.source, each.key)))
            if not each.source and re.split(r"[,.]", each.key)[0] in SignalTable.model_fields:
                own = f"{key}.{each.key}"
            elif place:
                own, found = f"{key}.{part}" if part else key, f"{found} ({place})"
            report(own, found, each.allowed)
