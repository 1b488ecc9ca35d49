"""What the tests of quantities ask for."""

from __future__ import annotations

from swtstudy import Study
from swtstudy.vocabulary.quantities import NAMED, Request

EVERY = tuple(NAMED)
VARIABLES = tuple(Request(EVERY).variables)


def study(
    more: str = "", axes: str = "phase = [0.5, 1.0, 2.0, 4.0]", quantities: tuple[str, ...] = ()
) -> Study:
    """A study that asks for quantities."""
    asked = f"quantities = {list(quantities)}\n" if quantities else ""
    return Study.from_text(f'title = "t"\nrtol = 1e-3\n{asked}{more}[axes]\n{axes}\n')
