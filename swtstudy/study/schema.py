"""The JSON schema of study files, which editors use to complete, explain and check them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import NUMERIC
from swtstudy.study.figure import QUANTITY, VARIABLES
from swtstudy.study.sampling.distribution import KINDS
from swtstudy.study.tables import StudyTable
from swtstudy.units.labels import KINDS as UNITS
from swtstudy.units.labels import KNOWN
from swtstudy.units.material import KEYS
from swtstudy.units.rows import NAMES_KEY, OF_BODIES, SIMILAR, SIMILAR_KEY, kind_of
from swtstudy.vocabulary.axes import AXES, CONTACT_AXES, QUANTITY_AXES
from swtstudy.vocabulary.families import families_with
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE, NAMED

#: Name of the schema's file beside studies; their first line points to it.
SCHEMA_FILE = "study.schema.json"
SCHEMA_LINE = f"#:schema {SCHEMA_FILE}\n"

_DESCRIPTIONS = {
    "title": "One line that describes the study.",
    "rtol": "Relative accuracy asked of s.",
    "quantities": "What is computed beside s, as data variables of the results.",
    "fixed": "Parameters with a single value. Parameters not given have the values of the paper's Table 1.",
    "axes": "Parameters with several values, in the order of the dimensions: a list or a range.",
    "sample": "Parameters that vary together along the dimension sample: a design, or given points.",
    "units": "Labels of length, force and stress, any consistent set: then the parameters have these units.",
    "material": "Fatigue constants, each a value or one for each body; or names from a file. For cycles.",
    "loads": "Loops of the load, by name: vertices, a CSV file with the columns normal, tangential and, "
    "optionally, bulk, or harmonics.",
    "profiles": "Profiles by name: radius and height, or a CSV file with these columns.",
    "blocks": "Blocks of a sequence of loads that repeats, for Miner's sum; with [material] only.",
    "figure": "What the figure puts where; every axis needs a place.",
}
_RANGE_DESCRIPTIONS = {
    "start": 'First value; a number, or a text such as "2*pi".',
    "stop": "Last value, included.",
    "num": "Number of values.",
    "spacing": 'Equal steps ("linear") or equal ratios ("log").',
    "also": "Further values, put in among those: where curves bend, for example.",
}
_PROFILE_DESCRIPTIONS = {
    "radius": "Radii r, in a length a_H: at least 8, ascending from 0.",
    "height": "Heights f at these radii, in a depth δ0: 0 at the axis.",
    "file": "Path of a CSV file, relative to the study, with a header and the columns radius and height.",
    "smoothing": "Root mean square of what the fit may miss of the heights; 0 to miss none.",
    "columns": "Headers of the file's columns radius and height, or position and height, if they are others.",
    "separator": 'Between the cells of the file: ",", ";", "|", a tab, or a blank for any number of blanks.',
    "decimal": 'The decimal sign in the file: "." or ",".',
    "two_sided": "Whether the file is a trace across the body, with the columns position and height.",
    "level": "Whether the tilt of a trace is taken off; smoothing is by its noise unless given.",
    "geometry": '"axisymmetric", or "plane" for a long body: its radii are then half-widths.',
}
_SAMPLE_DESCRIPTIONS = {
    "design": "How the points are chosen; saltelli is for Sobol indices (swtstudy sensitivity).",
    "size": "Number of points; for sobol and saltelli a power of 2. Of saltelli there are size (d + 2).",
    "seed": "Seed of the random numbers.",
    "ranges": "Sampled parameters: both ends, [low, high], or a distribution.",
    "file": "CSV file of points: a row with names of parameters, then a row for each point.",
    "points": "Points given here: a list of values for each parameter, all of one length.",
}
_LOAD_DESCRIPTIONS = {
    "vertices": "Pairs c_n, c_t, or triples with c_b: the normal load is 1 + its amplitude times c_n, the "
    "tangential one its amplitude times c_t, the bulk stress its mean plus its amplitude times c_b.",
    "file": "Path of a table, relative to the study, with a header and the columns normal, tangential "
    "and, optionally, bulk, of one cycle or of several.",
    "normal": "Harmonics of c_n instead of vertices: rows of order, amplitude and phase.",
    "tangential": "Harmonics of c_t: rows of order, amplitude and phase.",
    "bulk": "Harmonics of c_b, beside those: rows of order, amplitude and phase.",
    "mean_normal": "The mean normal load from which c_n of vertices or harmonics deviates, in its unit.",
    "columns": "Headers of the file's columns normal, tangential and bulk, where they are not these words.",
    "absolute": "Whether the normal column is the load itself: its mean is the mean load of the study.",
    "separator": 'Between the cells of the file: ",", ";", "|", a tab, or a blank for any number of blanks.',
    "decimal": 'The decimal sign in the file: "." or ",".',
    "time": "Header of the file's column of the time; without it samples are even.",
    "recorded_cycles": "Number of cycles that the file holds: they are folded into their mean.",
    "period": "Length of a cycle in the place of their number, in the unit of the time, or in samples.",
    "harmonics": "Highest order of a fit of the file's columns by harmonics: a smooth loop.",
    "keep_cycles": "Whether blocks of the load run all recorded cycles in turn, not their mean.",
}
_BLOCK_DESCRIPTIONS = {
    "load": "Name of a load; of a signal that keeps its cycles all of them in turn.",
    "rounds": "How many rounds of it there are in each repetition of the sequence.",
}
_FIGURE_DESCRIPTIONS = {
    "kind": "Lines over x, or x upright over life; contours or a heat map over x and vertical; "
    "scatter or histogram of a sample.",
    "x": 'Axis along the horizontal axis; "sample" for a scatter or histogram.',
    "vertical": "Axis along the vertical axis of contours or a heat map.",
    "hue": "Axis whose values are the lines.",
    "panels": "Axis whose values are the panels side by side.",
    "y": (
        f"One row of panels for each: {', '.join(VARIABLES)}, "
        f"a quantity that the study asks for, or {QUANTITY} for s over its value at one place."
    ),
    "title": "Title over the figure.",
    "regimes": "Whether to mark where a regime of the contact begins along a line.",
    "validity": "Whether to mark points outside of what the model holds for, such as beyond first yield.",
}
_NAMES = 'What the two bodies are called, such as ["pad", "specimen"]; with units only'
_SIMILAR = "Dundurs' |β| up to which two bodies count as similar (eq. 1); with units only"
#: Keys of the figure whose values are names of axes.
_ROLES = ("x", "vertical", "hue", "panels")
#: Where a sample may be beside axes.
_SAMPLED = {"x": (SAMPLE,)}


def study_schema() -> dict[str, Any]:
    """The JSON schema of study files, from their structure and the table of parameters."""
    schema = StudyTable.model_json_schema()
    schema = {"$schema": "http://json-schema.org/draft-07/schema#", **_without_titles(schema)}
    parts, keys = schema["$defs"], schema["properties"]
    _describe(keys, parts)
    keys["quantities"] = {
        "description": _DESCRIPTIONS["quantities"],
        "type": "array",
        "items": {"anyOf": [{"const": row.name, "description": row.comment} for row in NAMED.values()]},
        "uniqueItems": True,
        "default": [],
    }
    for name in ("start", "stop"):
        parts["RangeTable"]["properties"][name]["type"] = ["number", "string"]
    given = PARAMETERS | {DISTANCE: QUANTITY_AXES[DISTANCE]} | CONTACT_AXES
    keys["units"] = {"description": _DESCRIPTIONS["units"], **_units()}
    keys["material"] = {"description": _DESCRIPTIONS["material"], **_material()}
    _name_keys(keys, parts["SampleTable"]["properties"], given)
    schema |= {"if": {"required": ["units"]}, "else": {"properties": _without_units(given)}}
    roles = parts["FigureTable"]["properties"]
    for role in _ROLES:
        roles[role] = {
            "enum": [*PARAMETERS, *QUANTITY_AXES, *CONTACT_AXES, *_SAMPLED.get(role, ())],
            "description": roles[role]["description"],
        }
    return schema


def _describe(keys: dict[str, Any], parts: dict[str, Any]) -> None:
    """Say what each key of each table is."""
    for table, descriptions in (
        (keys, _DESCRIPTIONS),
        (parts["RangeTable"]["properties"], _RANGE_DESCRIPTIONS),
        (parts["SampleTable"]["properties"], _SAMPLE_DESCRIPTIONS),
        (parts["LoadTable"]["properties"], _LOAD_DESCRIPTIONS),
        (parts["BlockTable"]["properties"], _BLOCK_DESCRIPTIONS),
        (parts["ProfileTable"]["properties"], _PROFILE_DESCRIPTIONS),
        (parts["FigureTable"]["properties"], _FIGURE_DESCRIPTIONS),
    ):
        for name, entry in table.items():
            entry["description"] = descriptions[name]


def _name_keys(keys: dict[str, Any], sample: dict[str, Any], given: Mapping[str, Parameter]) -> None:
    """Say which parameters a table may have."""
    for table, part, entry_of, names in (
        (keys, "fixed", _value, given),
        (keys, "axes", _axis, given),
        (sample, "ranges", _range, NUMERIC),
        (sample, "points", _values, PARAMETERS),
    ):
        # The known names replace pydantic's schema for arbitrary keys, which varies with its version.
        table[part] = {
            "description": table[part]["description"],
            "type": "object",
            "properties": {name: entry_of(given[name]) for name in names},
            "additionalProperties": False,
        }
    similar = {"description": _SIMILAR, "type": "number", "minimum": 0.0, "default": SIMILAR}
    keys["fixed"]["properties"][SIMILAR_KEY] = similar
    pair = {"type": "array", "items": {"type": "string", "minLength": 1}, "minItems": 2, "maxItems": 2}
    keys["fixed"]["properties"][NAMES_KEY] = {"description": _NAMES, **pair}


def schema_text() -> str:
    """The text of the schema's file."""
    return json.dumps(study_schema(), indent=1, ensure_ascii=False) + "\n"


def _units() -> dict[str, Any]:
    """Schema of the units."""
    label = {"type": "string", "minLength": 1}
    kinds = {kind: label | {"examples": list(KNOWN[kind])} for kind in UNITS}
    return {"type": "object", "properties": kinds, "required": [*UNITS], "additionalProperties": False}


def _material() -> dict[str, Any]:
    """Schema of fatigue constants."""
    of_both = {"type": ["number", "string", "array"], "minItems": 2, "maxItems": 2}
    return {"type": "object", "properties": dict.fromkeys(KEYS, of_both), "additionalProperties": False}


def _without_units(given: Mapping[str, Parameter]) -> dict[str, Any]:
    """Rules for parameters that hold in a study without units only: ranges, and which ones it has not."""
    limits: dict[str, Any] = {name: _range_of(row) for name, row in given.items() if name not in CONTACT_AXES}
    several: dict[str, Any] = {name: {"items": limit} for name, limit in limits.items()}
    others = dict.fromkeys(CONTACT_AXES, False)
    fixed = {**limits, **others, SIMILAR_KEY: False, NAMES_KEY: False}
    return {"fixed": {"properties": fixed}, "axes": {"properties": several | others}}


def _range_of(parameter: Parameter) -> dict[str, Any]:
    """The range of a number, in the unit of the table."""
    if parameter.kind == "name":
        return {}
    lower = "exclusiveMinimum" if parameter.open_lower else "minimum"
    return {lower: parameter.lower, "maximum": parameter.upper}


def _value(parameter: Parameter) -> dict[str, Any]:
    """Schema of one value of a parameter: a number in its range, or a text that stands for one.

    What has a unit in a study with units has its range in `_without_units`.
    """
    entry: dict[str, Any] = {"description": _description(parameter)}
    if parameter.default is not None:
        entry["default"] = parameter.default
    if parameter.kind == "name":
        names = list(parameter.names)
        # Beside the built-in ones there may be what the study defines.
        return entry | {"type": "string", "examples": names}
    kinds = ["number", "string"] + ["array"] * (parameter.name in OF_BODIES)
    sized = parameter.scale or parameter.part == "contact"
    return entry | {"type": kinds} | ({} if sized else _range_of(parameter))


def _values(parameter: Parameter) -> dict[str, Any]:
    """Schema of a list of values."""
    value = _value(parameter)
    description = value.pop("description")
    value.pop("default", None)
    return {"description": description, "type": "array", "items": value, "minItems": 1}


def _axis(parameter: Parameter) -> dict[str, Any]:
    """Schema of several values: a list, or a range of numbers."""
    values = _values(parameter)
    description = values.pop("description")
    if parameter.kind == "name":
        return {"description": description, **values}
    return {"description": description, "anyOf": [values, {"$ref": "#/$defs/RangeTable"}]}


def _range(parameter: Parameter) -> dict[str, Any]:
    """Schema of the range of a sampled parameter: both ends, or a distribution."""
    ends = _values(parameter)
    description = ends.pop("description")
    ends["items"]["type"] = ["number", "string"]
    number = {"type": ["number", "string"]}
    numbers = {name: number for names in KINDS.values() for name in names}
    distribution = {
        "type": "object",
        "properties": {
            "distribution": {"enum": list(KINDS)},
            "low": ends["items"],
            "high": ends["items"],
            **numbers,
        },
        "required": ["distribution"],
        "additionalProperties": False,
    }
    return {"description": description, "anyOf": [ends | {"minItems": 2, "maxItems": 2}, distribution]}


def _description(parameter: Parameter) -> str:
    owners = [profile.replace("_", " ") for profile in families_with(parameter.name)]
    of = f"; of the {' and the '.join(owners)}" if owners else ""
    kind = kind_of(parameter.name) if parameter.name in AXES else None
    units = f"with units a {kind}" if kind else ""
    if parameter.part == "contact":
        return f"{parameter.meaning}; with units only{f', a {kind}' if kind else ''}"
    words = [f"{parameter.described}: {parameter.allowed}{of}", parameter.note, units]
    return "; ".join(filter(None, words))


def _without_titles(part: Any) -> Any:
    """A part without the titles that pydantic makes from the names of fields: they add nothing."""
    if isinstance(part, list):
        return [_without_titles(each) for each in part]
    if not isinstance(part, dict):
        return part
    return {
        key: _without_titles(each)
        for key, each in part.items()
        if not (key == "title" and isinstance(each, str))
    }
