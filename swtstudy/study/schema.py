"""The JSON schema of study files, which editors use to complete, explain and check them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import NUMERIC
from swtstudy.study.keys import StudyTable
from swtstudy.study.sample import DISTRIBUTIONS
from swtstudy.study.units.material import BY_NAME, PROPERTIES
from swtstudy.study.units.rows import KNOWN, NAMES_KEY, OF_BODIES, SIMILAR, SIMILAR_KEY, kind_of
from swtstudy.study.units.rows import UNIT_KINDS as UNITS
from swtstudy.vocabulary.choices import families_with
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import CONTACT_AXES, PARAMETERS, QUANTITY_AXES
from swtstudy.vocabulary.quantities import DISTANCE, NAMED

#: Name of the schema's file beside studies; their first line points to it.
SCHEMA_FILE = "study.schema.json"
SCHEMA_LINE = f"#:schema {SCHEMA_FILE}\n"

_NAMES = 'What the two bodies are called, such as ["pad", "specimen"]; with units only'
_SIMILAR = "|β|/μ up to which two bodies count as similar, β Dundurs' constant (eq. 1); with units only"


def study_schema() -> dict[str, Any]:
    """The JSON schema of study files, from their structure and the table of parameters."""
    schema = StudyTable.model_json_schema()
    schema = {"$schema": "http://json-schema.org/draft-07/schema#", **_plain(schema)}
    parts, keys = schema["$defs"], schema["properties"]
    keys["quantities"] = {
        "description": keys["quantities"]["description"],
        "type": "array",
        "items": {"anyOf": [{"const": row.name, "description": row.comment} for row in NAMED.values()]},
        "uniqueItems": True,
        "default": [],
    }
    for name in ("start", "stop"):
        parts["RangeTable"]["properties"][name]["type"] = ["number", "string"]
    given = PARAMETERS | {DISTANCE: QUANTITY_AXES[DISTANCE]} | CONTACT_AXES
    label = {"type": "string", "minLength": 1}
    kinds = {k: {"description": f"Of each {k}.", **label, "examples": list(KNOWN[k])} for k in UNITS}
    of_both = {"type": ["number", "string", "array"], "minItems": 2, "maxItems": 2}
    meanings = {key: row["meaning"] for key, row in PROPERTIES.items()} | BY_NAME
    properties = {key: {"description": meaning, **of_both} for key, meaning in meanings.items()}
    _close(keys, "units", kinds, required=[*UNITS])
    _close(keys, "material", properties)
    _name_keys(keys, parts["SampleTable"]["properties"], given)
    schema |= {"if": {"required": ["units"]}, "else": {"properties": _without_units(given)}}
    for role in ("x", "vertical", "hue", "panels"):
        entry = parts["FigureLayout"]["properties"][role]
        names = [*PARAMETERS, *QUANTITY_AXES, *CONTACT_AXES, *((SAMPLE,) if role == "x" else ())]
        parts["FigureLayout"]["properties"][role] = {"enum": names, "description": entry["description"]}
    return schema


def _name_keys(keys: dict[str, Any], sample: dict[str, Any], given: Mapping[str, Parameter]) -> None:
    """Say which parameters a table may have."""
    for table, part, entry_of, names in (
        (keys, "fixed", _single, given),
        (keys, "axes", _axis, given),
        (sample, "ranges", _range, NUMERIC),
        (sample, "points", _list, PARAMETERS),
    ):
        rows = {name: given[name] for name in names}
        described = {n: {"description": _description(row), **entry_of(row)} for n, row in rows.items()}
        _close(table, part, described)
    similar = {"description": _SIMILAR, "type": "number", "minimum": 0.0, "default": SIMILAR}
    keys["fixed"]["properties"][SIMILAR_KEY] = similar
    pair = {"type": "array", "items": {"type": "string", "minLength": 1}, "minItems": 2, "maxItems": 2}
    keys["fixed"]["properties"][NAMES_KEY] = {"description": _NAMES, **pair}


def _close(tables: dict[str, Any], name: str, keys: Mapping[str, Any], **more: Any) -> None:
    """Let a table have known keys alone: pydantic's schema for arbitrary ones varies with its version."""
    kept = {"description": tables[name]["description"], "type": "object", "properties": keys}
    tables[name] = {**kept, **more, "additionalProperties": False}


def schema_text() -> str:
    """The text of the schema's file."""
    return json.dumps(study_schema(), indent=1, ensure_ascii=False) + "\n"


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

    `_without_units` has the ranges of parameters that have a unit in a study with units.
    """
    if parameter.kind == "name":
        # Beside the built-in ones there may be what the study defines.
        return {"type": "string", "examples": [*parameter.names]}
    kinds = ["number", "string"] + ["array"] * (parameter.name in OF_BODIES)
    sized = parameter.scale or parameter.part == "contact"
    return {"type": kinds} | ({} if sized else _range_of(parameter))


def _single(parameter: Parameter) -> dict[str, Any]:
    """Schema of a fixed value, with its default."""
    default = {} if parameter.default is None else {"default": parameter.default}
    return default | _value(parameter)


def _list(parameter: Parameter) -> dict[str, Any]:
    """Schema of a list of values."""
    return {"type": "array", "items": _value(parameter), "minItems": 1}


def _axis(parameter: Parameter) -> dict[str, Any]:
    """Schema of several values: a list, or a range of numbers."""
    values = _list(parameter)
    return values if parameter.kind == "name" else {"anyOf": [values, {"$ref": "#/$defs/RangeTable"}]}


def _range(parameter: Parameter) -> dict[str, Any]:
    """Schema of the range of a sampled parameter: both ends, or a distribution."""
    number = {"type": ["number", "string"]}
    end = _value(parameter) | number
    distribution = {
        "type": "object",
        "properties": {
            "distribution": {"enum": list(DISTRIBUTIONS)},
            "low": end,
            "high": end,
            **{name: number for names in DISTRIBUTIONS.values() for name in names},
        },
        "required": ["distribution"],
        "additionalProperties": False,
    }
    return {"anyOf": [{"type": "array", "items": end, "minItems": 2, "maxItems": 2}, distribution]}


def _description(parameter: Parameter) -> str:
    owners = [profile.replace("_", " ") for profile in families_with(parameter.name)]
    of = f"; of the {' and the '.join(owners)}" if owners else ""
    kind = kind_of(parameter.name)
    units = f"with units a {kind}" if kind else ""
    if parameter.part == "contact":
        return f"{parameter.meaning}; with units only{f', a {kind}' if kind else ''}"
    words = [f"{parameter.described}: {parameter.allowed}{of}", parameter.note, units]
    return "; ".join(filter(None, words))


def _plain(part: Any) -> Any:
    """A part with descriptions in one line, and without pydantic's titles: the names of fields and tables."""
    if isinstance(part, list):
        return [_plain(each) for each in part]
    if not isinstance(part, dict):
        return part
    titled = isinstance(part.get("title"), str)
    plain = {key: _plain(each) for key, each in part.items() if not (titled and key == "title")}
    words = plain.get("description")
    return plain | ({"description": " ".join(words.split())} if isinstance(words, str) else {})
