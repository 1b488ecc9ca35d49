"""The keys of a study file: the one table of their types, of what messages allow, and of their descriptions.

Pydantic checks the structure, and words its errors like the other mistakes; the schema is made of the same
table. Values of parameters are checked against their own table.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from inspect import signature
from typing import Annotated, Any, ClassVar, Literal, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError

from swtstudy.loads.smooth_path import HIGHEST_ORDER
from swtstudy.points.reading import LONGEST_AXIS
from swtstudy.study.figure import KINDS, QUANTITY, VARIABLES, Kind
from swtstudy.vocabulary import mistakes as rules
from swtstudy.vocabulary.choices import AXISYMMETRIC
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest, plain
from swtstudy.vocabulary.naming import Function, with_arguments

#: Designs: a Sobol sequence, a Latin hypercube, independent random points, and the points for Sobol indices.
DesignName = Literal["sobol", "latin_hypercube", "random", "saltelli"]
DESIGNS: tuple[DesignName, ...] = get_args(DesignName)
#: Separators between cells; a blank stands for any number of them.
Separator = Literal[",", ";", "\t", "|", " "]
SEPARATORS: tuple[Separator, ...] = get_args(Separator)


@dataclass(frozen=True)
class Allowed:
    """Words for what a key may hold, where its type does not say it.

    Attributes
    ----------
    words
        The words.
    whole
        Whether the mistakes of its parts are one mistake of the key.
    """

    words: str
    whole: bool = False


#: Words for what a key of a type may hold.
_OF_TYPES = {bool: "true or false", str: "a text", int: "a whole number"}


def key(description: str, default: Any = ..., **limits: Any) -> Any:
    """A key with its description in the schema."""
    return Field(default, description=description, **limits)


class Table(BaseModel):
    """A table of a study file."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    #: Words for the table as a whole, in messages.
    allowed: ClassVar[str]


AnyTable = TypeVar("AnyTable", bound=Table)


def _quoted(names: Sequence[str]) -> str:
    *others, last = (f'"{name}"' for name in names)
    return f"{', '.join(others)} or {last}"


AxisName = Annotated[str, Allowed("the name of an axis")]
OtherAxisName = Annotated[str | None, Allowed("the name of an axis")]
File = Annotated[str | None, Allowed("the path of a CSV file")]
Positive = Annotated[float | None, Allowed("a positive number"), Field(gt=0.0, allow_inf_nan=False)]


class FileTable(Table):
    """The form of a table in a file."""

    columns: Annotated[
        dict[str, str], Allowed('a table of headers, such as { normal = "Fn [N]" }', whole=True)
    ] = key("Headers of the file's columns, where they are not the names that they have here.", {})
    separator: Annotated[Separator | None, Allowed(f"one of {', '.join(map(repr, SEPARATORS))}")] = key(
        "Between cells; a blank for any number of blanks. Found from the header unless given.", None
    )
    decimal: Annotated[Literal[".", ","] | None, Allowed("one of '.', ','")] = key(
        "The decimal sign in numbers. Found from the first rows unless given.", None
    )
    encoding: Annotated[str | None, Allowed('the name of an encoding, such as "cp1252"')] = key(
        'Encoding of the text, UTF-8 unless given; "cp1252" or "latin-1" for older programs.', None
    )
    scale: Annotated[
        dict[str, float], Allowed("a table of numbers, such as { normal = 1000 }", whole=True)
    ] = key("Factors of columns, such as { normal = 1000 } for kN, or -1 for the other sign.", {})
    skip_rows: Annotated[int, Allowed("a whole number of lines, 0 or more")] = key(
        "Lines above the header. Found unless given, and told.", 0, ge=0
    )
    units_row: bool | None = key(
        "Whether a row of units follows the header. Found unless given, and told.", None
    )
    sheet: Annotated[
        str | int | None, Allowed("the name of a sheet, or its number from 1 on", whole=True)
    ] = key("Sheet of a workbook; the first one unless given.", None)

    def header(self, name: str) -> str:
        """The header of a column."""
        return " ".join(self.columns.get(name, name).split())


class SignalTable(FileTable):
    """The form of a signal in a file, and its cycles."""

    absolute: bool = key(
        "Whether the normal column is the load itself: its mean is the mean load of the study.", False
    )
    time: Annotated[str | None, Allowed("the header of the column of the time")] = key(
        "Header of the file's column of the time; without it samples are even.", None, min_length=1
    )
    recorded_cycles: Annotated[int | None, Allowed("a whole number of cycles, 1 or more")] = key(
        "Number of cycles that the file holds: they are folded into their mean.", None, ge=1
    )
    period: Positive = key(
        "Length of a cycle instead of their number, in the unit of the time, or in samples.", None
    )
    frequency: Positive = key("Cycles per unit of the time, such as Hz, instead of the period.", None)
    harmonics: Annotated[
        int | None, Allowed(f"a whole number, 1 to {HIGHEST_ORDER}"), Field(ge=1, le=HIGHEST_ORDER)
    ] = key("Highest order of a fit of the file's columns by harmonics: a smooth loop.", None)
    despike: bool = key(
        "Whether spikes take the value that the samples beside them or the other cycles suggest.", False
    )


class TraceTable(FileTable):
    """A trace in a file, and the profile that is made of it."""

    level: bool = key(
        "Whether the tilt of a trace is taken off; smoothing is by its noise unless given.", True
    )
    smoothing: Any = key("Root mean square of what the fit may miss of the heights; 0 to miss none.", None)
    geometry: Any = key(
        '"axisymmetric", or "plane" for a long body: its radii are then half-widths.', AXISYMMETRIC
    )


class RangeTable(Table):
    """Values of an axis in equal steps or equal ratios, both ends included."""

    allowed = "a list of values or {start, stop, num}"

    start: Any = key('First value; a number, or a text such as "2*pi".')
    stop: Any = key("Last value, included.")
    num: int = key("Number of values.")
    spacing: Annotated[Literal["linear", "log"], Allowed('"linear" or "log"')] = key(
        'Equal steps ("linear") or equal ratios ("log").', "linear"
    )
    also: Annotated[list[Any], Allowed("a list of values")] = key(
        "Further values, put in among those: where curves bend, for example.", []
    )


def _axis_kind(raw: object) -> str:
    return "range" if isinstance(raw, dict | RangeTable) else "list"


Axis = Annotated[
    Annotated[list[Any], Tag("list")] | Annotated[RangeTable, Tag("range")], Discriminator(_axis_kind)
]


class SampleTable(FileTable):
    """Parameters that vary together: a design of points in ranges, or given points."""

    allowed = "a table with design, size and ranges, with points, or with file"

    design: Annotated[DesignName | None, Allowed(_quoted(DESIGNS))] = key(
        "How the points are chosen; saltelli is for Sobol indices (swtstudy sensitivity).", None
    )
    size: Annotated[
        int | None, Allowed(f"a whole number from 1 to {LONGEST_AXIS}"), Field(ge=1, le=LONGEST_AXIS)
    ] = key(
        "Number of points; for sobol and saltelli a power of 2. Of saltelli there are size (d + 2).", None
    )
    seed: Annotated[int, Allowed(rules.ALLOWED_SEED)] = key(
        "Seed of the random numbers.", 0, ge=0, le=rules.LARGEST_SEED
    )
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
    title: str | None = key("Title over the figure.", None)
    regimes: bool = key("Whether to mark where a regime of the contact begins along a line.", False)
    caption: str | None = key("What there is to say beneath the figure, in reports.", None)
    message: str | None = key("Headline of reports, instead of what the results say first.", None)
    validity: bool = key(
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
    keep_cycles: bool = key(
        "Whether blocks of the load run all recorded cycles in turn, not their mean.", False
    )


class BlockTable(Table):
    """A block of a sequence: rounds of a load."""

    allowed = "[[blocks]] with load and rounds"

    load: Annotated[str, Allowed("the name of a load")] = key(
        "Name of a load; of a signal that keeps its cycles all of them in turn."
    )
    rounds: Annotated[Any, Allowed(allowed)] = key(
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
    two_sided: bool = key(
        "Whether the file is a trace across the body, with the columns position and height.", False
    )


class StudyTable(Table):
    """A study file."""

    title: Annotated[str, Allowed("a text that is not empty")] = key(
        "One line that describes the study.", min_length=1
    )
    rtol: Annotated[float, Allowed(rules.ALLOWED_RTOL)] = key(
        "Relative accuracy asked of s.", rules.DEFAULT_RTOL, ge=rules.SMALLEST_RTOL, le=rules.LARGEST_RTOL
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
    blocks: Annotated[list[BlockTable], Allowed(BlockTable.allowed)] = key(
        "Blocks of a sequence of loads that repeats, for Miner's sum; with [material] only.", []
    )
    figure: FigureTable | None = key("What the figure puts where; every axis needs a place.", None)


class Parts(StudyTable):
    """The sound parts of a study file; None for an axis, a load or a profile that is wrong."""

    axes: dict[str, Any] = {}
    loads: dict[str, Any] = {}
    profiles: dict[str, Any] = {}


#: How many keys lead to what is left out of a part of a study where one of its keys is wrong.
_LEVELS = {"axes": 2, "loads": 2, "profiles": 2, "sample": 3}


def read_study(raw: Mapping[str, Any], source: str) -> tuple[Parts, list[Mistake]]:
    """The sound parts of the tables of a study, and all mistakes in their structure."""
    table, mistakes = read_keys(StudyTable, raw, source)
    if not rules.storable(str(raw.get("title", ""))):
        mistakes = [*mistakes, Mistake("title", literal(raw["title"]), rules.STORABLE, source)]
    left: dict[Any, Any] = deepcopy(dict(raw)) if table is None else {}
    if isinstance(blocks := left.get("blocks"), list):  # the loads of wrong ones are still known
        loads = [each for each in blocks if isinstance(each, dict) and isinstance(each.get("load"), str)]
        left["blocks"] = [{"load": each["load"], "rounds": each.get("rounds", 1)} for each in loads]
    while table is None:
        try:
            table = StudyTable.model_validate({name: plain(value) for name, value in left.items()})
        except ValidationError as error:
            places = (detail["loc"] for detail in error.errors())
            for place in {place[: _LEVELS.get(str(place[0]), 1)] for place in places}:
                if place == ("title",):
                    left["title"] = "-"
                elif not _drop(left, *place):
                    left.pop(place[0], None)
    found = {name: getattr(table, name) for name in StudyTable.model_fields}
    for part in ("axes", "loads", "profiles"):
        names = raw.get(part)
        found[part] = {name: found[part].get(name) for name in (names if isinstance(names, dict) else ())}
    return Parts.model_construct(**found), mistakes


def _drop(left: dict[Any, Any], first: Any, *others: Any) -> bool:
    """Take the entry at a place out of tables; False if there is none."""
    inner = left.get(first)
    if others and isinstance(inner, dict):
        return _drop(inner, *others)
    return left.pop(first, left) is not left


def read_keys(
    model: type[AnyTable], raw: Mapping[str, Any], source: str = ""
) -> tuple[AnyTable | None, list[Mistake]]:
    """The table with these keys, or every mistake in them."""
    try:
        return model.model_validate({name: plain(value) for name, value in raw.items()}), []
    except ValidationError as error:
        found = {_mistake(model, detail, source) for detail in error.errors(include_url=False)}
        return None, sorted(found, key=lambda mistake: mistake.key)


def sound_keys(model: type[AnyTable], given: Mapping[str, Any]) -> AnyTable:
    """The table with the keys that are not None; a StudyError with every mistake in them."""
    found, mistakes = read_keys(model, {name: value for name, value in given.items() if value is not None})
    if found is None:
        raise StudyError(mistakes)
    return found


def _mistake(model: type[Table], detail: Any, source: str) -> Mistake:
    path = [part for part in detail["loc"] if part not in ("list", "range")]  # pydantic's tags, not keys
    field = model.model_fields.get(str(path[0]))
    levels, inner = _inner(field.annotation) if field else (0, None)
    allowed = ""
    if inner is not None and len(path) == levels:
        allowed = inner.allowed
    elif inner is None or len(path) < levels:
        levels, inner = 0, model
    if not allowed and (row := inner.model_fields.get(str(path[levels]))):
        words = next((each for each in row.metadata if isinstance(each, Allowed)), None)
        kinds = (row.annotation, *get_args(row.annotation))
        words = words or next((Allowed(_OF_TYPES[kind]) for kind in kinds if kind in _OF_TYPES), None)
        if words and (words.whole or len(path) == levels + 1):
            path, allowed = path[: levels + 1], words.words
    name = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    if detail["type"] == "extra_forbidden":
        known = nearest(str(path[-1]), inner.model_fields)
        return Mistake(name, f"unknown key {literal(path[-1])}", known, source)
    found = "nothing" if detail["type"] == "missing" else literal(detail["input"])
    return Mistake(name, found, allowed or detail["msg"], source)


def _inner(kind: Any) -> tuple[int, type[Table] | None]:
    """The table within the type of a key, and how many keys lead to it."""
    if isinstance(kind, type) and issubclass(kind, Table):
        return 1, kind
    for each in get_args(kind):
        levels, table = _inner(each)
        if table is not None:
            return levels + (get_origin(kind) in (dict, list)), table
    return 0, None


def with_keys(model: type[Table]) -> Callable[[Function], Function]:
    """Decorate a function whose further arguments are the keys of a table: its signature names them."""
    return with_arguments(signature(model).parameters.values())


def place_of(mistake: Mistake) -> str:
    """Where in a file or a list the mistake is."""
    place = ": ".join(part for part in (mistake.source, mistake.key) if part)
    return f" ({place})" if place else ""
