"""The JSON schema of study files, which editors use to complete, explain and check them."""

from __future__ import annotations

import json
from typing import Any

from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import NUMERIC
from swtstudy.study.keys import StudyTable
from swtstudy.study.sample import DISTRIBUTIONS
from swtstudy.study.units.material import BY_NAME, PROPERTIES
from swtstudy.study.units.rows import (
    CARRIER_KEY,
    KNOWN,
    NAMES_KEY,
    OF_ALL,
    OF_BODIES,
    SIMILAR,
    SIMILAR_KEY,
    UNIT_KINDS,
    kind_of,
)
from swtstudy.vocabulary.choices import families_with
from swtstudy.vocabulary.parameters import CONTACT_AXES, PARAMETERS, QUANTITY_AXES, Parameter
from swtstudy.vocabulary.quantities import DISTANCE, NAMED

#: Name of the schema's file beside studies; their first line points to it.
SCHEMA_FILE = "study.schema.json"
SCHEMA_LINE = f"#:schema {SCHEMA_FILE}\n"

_NAMES = 'What the two bodies are called, such as ["pad", "specimen"]; with units only'
_SIMILAR = "|β|/μ up to which two bodies count as similar, β Dundurs' constant (eq. 1); with units only"
_CARRIER = "The body that carries the bulk stress, 1 or 2, or its name; with units only"
_LABEL = {"type": "string", "minLength": 1}
_TWO = {"minItems": 2, "maxItems": 2}


def schema_text() -> str:
    """The text of the schema's file."""
    return json.dumps(study_schema(), indent=1, ensure_ascii=False) + "\n"


def study_schema() -> dict[str, Any]:
    """The JSON schema of study files, from their structure and the table of parameters."""
    schema = {"$schema": "http://json-schema.org/draft-07/schema#", **_plain(StudyTable.model_json_schema())}
    keys, parts = schema["properties"], {name: part["properties"] for name, part in schema["$defs"].items()}
    keys["quantities"] = {
        "description": keys["quantities"]["description"],
        "type": "array",
        "items": {"anyOf": [{"const": row.name, "description": row.comment} for row in NAMED.values()]},
        "uniqueItems": True,
        "default": [],
    }
    for name in ("start", "stop"):
        parts["RangeTable"][name]["type"] = ["number", "string"]
    layout = parts["FigureLayout"]
    for role in ("x", "vertical", "hue", "panels"):
        names = [*PARAMETERS, *QUANTITY_AXES, *CONTACT_AXES, *((SAMPLE,) if role == "x" else ())]
        layout[role] = {"enum": names, "description": layout[role]["description"]}
    of_both = {"type": ["number", "string", "array"], **_TWO}
    meanings = {key: row["meaning"] for key, row in PROPERTIES.items()} | BY_NAME
    kinds = {k: {"description": f"Of each {k}.", **_LABEL, "examples": list(KNOWN[k])} for k in UNIT_KINDS}
    _close(keys, "units", kinds, required=[*UNIT_KINDS])
    _close(keys, "material", {key: {"description": words, **of_both} for key, words in meanings.items()})
    # A study without units (alone) has ranges of numbers, and no sizes of a contact.
    fixed, axes, ranges, points, fixed_alone, axes_alone = (dict[str, Any]() for _ in range(6))
    given = PARAMETERS | {DISTANCE: QUANTITY_AXES[DISTANCE]} | CONTACT_AXES
    for name, row in given.items():
        description, value, limits = {"description": _description(row)}, _value(row), _limits(row)
        several = {"type": "array", "items": value, "minItems": 1}
        either = several if row.kind == "name" else {"anyOf": [several, {"$ref": "#/$defs/RangeTable"}]}
        fixed[name] = description | ({} if row.default is None else {"default": row.default}) | value
        axes[name] = description | either
        if name in NUMERIC:
            ranges[name] = description | _range(value)
        if name in PARAMETERS:
            points[name] = description | several
        fixed_alone[name] = False if name in CONTACT_AXES else limits
        axes_alone[name] = False if name in CONTACT_AXES else {"items": limits}
    fixed[SIMILAR_KEY] = {"description": _SIMILAR, "type": "number", "minimum": 0.0, "default": SIMILAR}
    fixed[NAMES_KEY] = {"description": _NAMES, "type": "array", "items": _LABEL, **_TWO}
    fixed[CARRIER_KEY] = {"description": _CARRIER, "type": ["integer", "string"], "default": 1}
    fixed_alone |= dict.fromkeys(OF_ALL, False)
    _close(keys, "fixed", fixed)
    _close(keys, "axes", axes)
    _close(parts["SampleTable"], "ranges", ranges)
    _close(parts["SampleTable"], "points", points)
    alone = {"fixed": {"properties": fixed_alone}, "axes": {"properties": axes_alone}}
    return schema | {"if": {"required": ["units"]}, "else": {"properties": alone}}


def _close(tables: dict[str, Any], name: str, keys: dict[str, Any], **more: Any) -> None:
    """Let a table have known keys alone: pydantic's schema for arbitrary ones varies with its version."""
    kept = {"description": tables[name]["description"], "type": "object", "properties": keys}
    tables[name] = {**kept, **more, "additionalProperties": False}


def _limits(parameter: Parameter) -> dict[str, Any]:
    """The range of a number, in the unit of the table; nothing for a name."""
    if parameter.kind == "name":
        return {}
    lower = "exclusiveMinimum" if parameter.open_lower else "minimum"
    return {lower: parameter.lower, "maximum": parameter.upper}


def _value(parameter: Parameter) -> dict[str, Any]:
    """Schema of one value: a number, or a text that stands for one; in its range if it has no unit."""
    if parameter.kind == "name":
        # Beside the built-in ones there may be what the study defines.
        return {"type": "string", "examples": [*parameter.names]}
    kinds = ["number", "string"] + ["array"] * (parameter.name in OF_BODIES)
    sized = parameter.scale or parameter.part == "contact"
    return {"type": kinds} | ({} if sized else _limits(parameter))


def _range(value: dict[str, Any]) -> dict[str, Any]:
    """Schema of the range of a sampled parameter, from that of a value: both ends, or a distribution."""
    number = {"type": ["number", "string"]}
    end = value | number
    others = {name: number for names in DISTRIBUTIONS.values() for name in names}
    distribution = {
        "type": "object",
        "properties": {"distribution": {"enum": list(DISTRIBUTIONS)}, "low": end, "high": end, **others},
        "required": ["distribution"],
        "additionalProperties": False,
    }
    return {"anyOf": [{"type": "array", "items": end, **_TWO}, distribution]}


def _description(parameter: Parameter) -> str:
    """The meaning of a parameter, and which values and profiles it is for."""
    kind = kind_of(parameter.name)
    if parameter.part == "contact":
        return f"{parameter.meaning}; with units only{f', a {kind}' if kind else ''}"
    owners = [profile.replace("_", " ") for profile in families_with(parameter.name)]
    of = f"; of the {' and the '.join(owners)}" if owners else ""
    units = f"with units a {kind}{', which stays there' * bool(parameter.note)}" if kind else ""
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
