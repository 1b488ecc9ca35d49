"""The JSON schema of study files, which editors use to complete, explain and check them."""

from __future__ import annotations

import json
from typing import Any

from swtstudy.parameters import BUILT_IN, PARAMETERS, QUANTITY_AXES, Parameter, families_with
from swtstudy.quantities import DISTANCE, NAMED
from swtstudy.study.figure import QUANTITY, VARIABLES
from swtstudy.study.tables import StudyTable

#: Name of the schema's file beside studies; their first line points to it.
SCHEMA_FILE = "study.schema.json"
SCHEMA_LINE = f"#:schema {SCHEMA_FILE}\n"

_DESCRIPTIONS = {
    "title": "One line that describes the study.",
    "rtol": "Relative accuracy asked of s.",
    "quantities": "What is computed beside s, as data variables of the results.",
    "fixed": "Parameters with a single value. Parameters not given have the values of the paper's Table 1.",
    "axes": "Parameters with several values, in the order of the dimensions: a list or a range.",
    "loads": "Loops of the load, by name: vertices, or a CSV file with the columns normal and tangential.",
    "profiles": "Profiles by name: radius and height, or a CSV file with these columns.",
    "figure": "What the figure puts where; every axis needs a place.",
}
_RANGE_DESCRIPTIONS = {
    "start": 'First value; a number, or a text such as "2*pi".',
    "stop": "Last value, included.",
    "num": "Number of values.",
    "spacing": 'Equal steps ("linear") or equal ratios ("log").',
}
_PROFILE_DESCRIPTIONS = {
    "radius": "Radii r, in a length a_H: at least 8, ascending from 0.",
    "height": "Heights f at these radii, in a depth δ0: 0 at the axis.",
    "file": "Path of a CSV file, relative to the study, with a header and the columns radius and height.",
    "smoothing": "Root mean square of what the fit may miss of the heights; 0 to miss none.",
}
_LOAD_DESCRIPTIONS = {
    "vertices": "Pairs c_n, c_t: the normal load is 1 + its amplitude times c_n, the tangential one its "
    "amplitude times c_t.",
    "file": "Path of a CSV file, relative to the study, with a header and the columns normal and tangential.",
}
_FIGURE_DESCRIPTIONS = {
    "kind": "Lines over x, or contours or a heat map over x and vertical.",
    "x": "Axis along the horizontal axis.",
    "vertical": "Axis along the vertical axis of contours or a heat map.",
    "hue": "Axis whose values are the lines.",
    "panels": "Axis whose values are the panels side by side.",
    "y": (
        f"One row of panels for each: {', '.join(VARIABLES)}, "
        f"a quantity that the study asks for, or {QUANTITY} for s over its value at one place."
    ),
    "title": "Title over the figure.",
    "regimes": "Whether to mark where a regime of the contact begins along a line.",
}
#: Keys of the figure whose values are names of axes.
_ROLES = ("x", "vertical", "hue", "panels")


def study_schema() -> dict[str, Any]:
    """The JSON schema of study files, from their structure and the table of parameters."""
    schema = StudyTable.model_json_schema()
    schema = {"$schema": "http://json-schema.org/draft-07/schema#", **_without_titles(schema)}
    parts, keys = schema["$defs"], schema["properties"]
    for table, descriptions in (
        (keys, _DESCRIPTIONS),
        (parts["RangeTable"]["properties"], _RANGE_DESCRIPTIONS),
        (parts["LoadTable"]["properties"], _LOAD_DESCRIPTIONS),
        (parts["ProfileTable"]["properties"], _PROFILE_DESCRIPTIONS),
        (parts["FigureTable"]["properties"], _FIGURE_DESCRIPTIONS),
    ):
        for name, entry in table.items():
            entry["description"] = descriptions[name]
    keys["quantities"] = {
        "description": keys["quantities"]["description"],
        "type": "array",
        "items": {"anyOf": [{"const": row.name, "description": row.comment} for row in NAMED.values()]},
        "uniqueItems": True,
        "default": [],
    }
    for name in ("start", "stop"):
        parts["RangeTable"]["properties"][name]["type"] = ["number", "string"]
    given = PARAMETERS | {DISTANCE: QUANTITY_AXES[DISTANCE]}
    for part, entry_of in (("fixed", _value), ("axes", _axis)):
        # The known names replace pydantic's schema for arbitrary keys, which varies with its version.
        keys[part] = {
            "description": keys[part]["description"],
            "type": "object",
            "properties": {name: entry_of(row) for name, row in given.items()},
            "additionalProperties": False,
        }
    roles = parts["FigureTable"]["properties"]
    for role in _ROLES:
        roles[role] = {"enum": [*PARAMETERS, *QUANTITY_AXES], "description": roles[role]["description"]}
    return schema


def schema_text() -> str:
    """The text of the schema's file."""
    return json.dumps(study_schema(), indent=1, ensure_ascii=False) + "\n"


def _value(parameter: Parameter) -> dict[str, Any]:
    """Schema of one value of a parameter: a number in its range, or a text that stands for one."""
    entry: dict[str, Any] = {"description": _description(parameter)}
    if parameter.default is not None:
        entry["default"] = parameter.default
    if parameter.kind == "name":
        names = list(BUILT_IN[parameter.name])
        # Beside the built-in ones there may be what the study defines.
        return entry | {"type": "string", "examples": names}
    lower = "exclusiveMinimum" if parameter.open_lower else "minimum"
    return entry | {"type": ["number", "string"], lower: parameter.lower, "maximum": parameter.upper}


def _axis(parameter: Parameter) -> dict[str, Any]:
    """Schema of several values: a list, or a range of numbers."""
    value = _value(parameter)
    description = value.pop("description")
    value.pop("default", None)
    values = {"type": "array", "items": value, "minItems": 1}
    if parameter.kind == "name":
        return {"description": description, **values}
    return {"description": description, "anyOf": [values, {"$ref": "#/$defs/RangeTable"}]}


def _description(parameter: Parameter) -> str:
    owners = [profile.replace("_", " ") for profile in families_with(parameter.name)]
    of = f"; of the {' and the '.join(owners)}" if owners else ""
    return f"{parameter.meaning}: {parameter.allowed}{of}"


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
