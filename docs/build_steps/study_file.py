"""The reference of study files, from their JSON schema."""

import json
from typing import Any

from build_steps.markdown import table
from swtstudy.study.keys import FileTable
from swtstudy.study.schema import study_schema

_HEAD = ("key", "meaning", "value", "default")


def study_file() -> str:
    """One table for each table of a study file."""
    schema = study_schema()
    keys, parts = schema["properties"], schema["$defs"]
    required = set(schema.get("required", ()))
    own = ("units", "material", "fixed", "axes", "figure", "sample", "loads", "blocks", "profiles")
    plain = {name: entry for name, entry in keys.items() if name not in own}
    return "\n".join(
        [
            "## Top of the file\n",
            _table(plain, required),
            *_section("units", keys, keys["units"]),
            *_section("material", keys, keys["material"]),
            f"## `[fixed]`\n\n{keys['fixed']['description']}\n",
            _parameters(keys["fixed"]["properties"]),
            f"## `[axes]`\n\n{keys['axes']['description']} The names and ranges of their values are those of "
            "`[fixed]`. A range has\n",
            _table(parts["RangeTable"]["properties"], set(parts["RangeTable"]["required"])),
            *_section("sample", keys, parts["SampleTable"]),
            *_section("loads", keys, parts["LoadTable"], ".NAME"),
            f"## `[[blocks]]`\n\n{keys['blocks']['description']}\n",
            _table(parts["Block"]["properties"], set(parts["Block"]["required"])),
            *_section("profiles", keys, parts["ProfileTable"], ".NAME"),
            f"## `[figure]`\n\n{keys['figure']['description']}\n",
            _table(parts["FigureLayout"]["properties"], set(parts["FigureLayout"]["required"])),
        ]
    )


def _section(name: str, keys: dict[str, Any], part: dict[str, Any], more: str = "") -> tuple[str, str]:
    head = f"## `[{name}{more}]`\n\n{keys[name]['description']}\n"
    # How a file is written comes behind what else a table has.
    entries = dict(sorted(part["properties"].items(), key=lambda entry: entry[0] in FileTable.model_fields))
    return head, _table(entries, set(part.get("required", ())))


def _table(entries: dict[str, Any], required: set[str]) -> str:
    rows = (
        (
            f"`{name}`",
            _plain(entry["description"]),
            _value(entry),
            "required" if name in required else _default(entry),
        )
        for name, entry in entries.items()
    )
    return table(_HEAD, rows)


def _parameters(entries: dict[str, Any]) -> str:
    """The meaning of a parameter says already what it may be."""
    rows = ((f"`{name}`", _plain(entry["description"]), _default(entry)) for name, entry in entries.items())
    return table(("key", "meaning and values", "default"), rows)


def _plain(text: str) -> str:
    """Text as it stands: the asterisk of E* begins no italics."""
    return text.replace("*", r"\*")


def _default(entry: dict[str, Any]) -> str:
    value = entry.get("default")
    if isinstance(value, float):
        return f"`{value:.6g}`"
    return "–" if value is None else f"`{json.dumps(value, ensure_ascii=False)}`"


def _value(entry: dict[str, Any]) -> str:
    """What a value may be, in words."""
    if "const" in entry:
        return f"`{entry['const']}`"
    if "enum" in entry:
        names = entry["enum"]
        shown = ", ".join(f"`{json.dumps(name)}`" for name in names)
        return shown if len(names) < 10 else "name of an axis"
    if "anyOf" in entry:
        return " or ".join(_value(each) for each in entry["anyOf"] if each.get("type") != "null")
    if "examples" in entry:
        return f"text such as {', '.join(f'`{each}`' for each in entry['examples'][:3])}"
    if entry.get("type") == "array":
        items = entry["items"]
        return f"a list of {_value(items)}{'' if 'anyOf' in items else 's'}"
    kinds = entry.get("type", "–")
    words = " or ".join(_WORDS.get(kind, kind) for kind in ([kinds] if isinstance(kinds, str) else kinds))
    limits = [f"{sign} {entry[key]:g}" for key, sign in _LIMITS.items() if key in entry]
    return " ".join([words, ", ".join(limits)]).strip()


_WORDS = {"object": "table", "array": "a pair", "string": "text", "boolean": "true or false"}
_LIMITS = {"exclusiveMinimum": ">", "minimum": "≥", "maximum": "≤"}
