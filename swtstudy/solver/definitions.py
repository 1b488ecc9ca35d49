"""Definitions of a user, loads and tables of profiles, as the text of an attribute, and read from it."""

from __future__ import annotations

import json
from collections.abc import Hashable, Iterable, Mapping
from typing import Any

from pydantic_core import from_json

from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.table import TabulatedProfile
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import literal

_KINDS: dict[str, type[Definition]] = {each.parameter: each for each in (LoadPath, TabulatedProfile)}


def definitions_text(definitions: Iterable[Definition]) -> str:
    """Write definitions as the text of an attribute."""
    return json.dumps(
        [
            {"parameter": each.parameter, "name": each.name, "content": each.content(), **each.notes()}
            for each in definitions
        ]
    )


def defined_in(attributes: Mapping[Hashable, Any]) -> dict[str, dict[str, Definition]]:
    """Read the definitions, by parameter and name, from the attributes of a Dataset.

    Raises
    ------
    ValueError
        If the text is not one of `definitions_text`.
    """
    text = attributes.get("definitions", "[]")
    found: dict[str, dict[str, Definition]] = {}
    try:
        for raw in from_json(text):
            defined = _KINDS[raw["parameter"]].of_content(raw["name"], raw["content"])
            found.setdefault(raw["parameter"], {})[raw["name"]] = defined
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"not definitions: {literal(text)} ({error})") from None
    return found
