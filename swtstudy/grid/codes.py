"""Names as numbers in canonical rows."""

from __future__ import annotations

from swtstudy.parameters import FAMILIES

#: The names by their code; archives' parts say which ones they count on.
NAMES = tuple(FAMILIES)


def code_of(profile: str) -> float:
    """The number that stands for a profile."""
    return float(NAMES.index(profile))


def name_of(code: float) -> str:
    """The profile that a number stands for."""
    return NAMES[int(code)]
