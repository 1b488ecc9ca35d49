"""The rooms of the code: imports go one way, from a room to those above it."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "swtstudy"

#: Rooms of the mechanics from the ground up: each imports itself and those before it only.
MECHANICS = (
    "points",
    "numerics",
    "load",
    "indenter",
    "control",
    "contact",
    "planes",
    "events",
    "stress",
    "line",
    "body",
    "solver",
)
#: What besides may not be imported, although it is above: the body's search checks the line's.
APART = {
    "body": {"line"},
    "planes": {"contact", "load", "indenter", "control"},
    "contact": {"indenter", "control"},
}


def imported(path: Path) -> set[str]:
    """Modules of the package that a file imports, anywhere in it but for type checkers alone."""
    tree = ast.parse(path.read_text())
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name for name in found if name.split(".")[0] == "swtstudy"}


def mechanics_files() -> list[Path]:
    return sorted((PACKAGE / "mechanics").rglob("*.py"))


@pytest.mark.parametrize("path", mechanics_files(), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_the_mechanics_import_only_rooms_above(path: Path) -> None:
    own = path.relative_to(PACKAGE / "mechanics").parts[0].removesuffix(".py")
    if own == "__init__":
        return
    for name in imported(path):
        parts = name.split(".")
        assert parts[1] == "mechanics", (
            f"{path.name} imports {name}: the mechanics know nothing of the package"
        )
        room = parts[2]
        assert MECHANICS.index(room) <= MECHANICS.index(own), f"{own} imports {room}"
        assert room not in APART.get(own, ()), f"{own} imports {room}"


def test_the_list_of_rooms_is_complete() -> None:
    there = {
        path.relative_to(PACKAGE / "mechanics").parts[0].removesuffix(".py") for path in mechanics_files()
    }
    assert there - {"__init__"} == set(MECHANICS)
