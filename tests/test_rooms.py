"""The rooms of the code: imports go one way, from a room to those above it, and never in a circle."""

from __future__ import annotations

import ast
from graphlib import TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "swtstudy"
FILES = sorted(PACKAGE.rglob("*.py"))

#: Rooms of the package from the ground up: each imports itself and those before it only.
ROOMS = (
    *("parameters", "mistakes", "numbers", "accuracy", "version", "files", "wording"),
    *("mechanics", "reference", "grid", "units", "study", "records", "archive", "runner", "results"),
    *("solving", "fields", "figures", "contacts", "audit", "statements", "suite", "accessor"),
    *("registration", "cli", "__main__", "__init__"),
)
#: The same within the mechanics.
MECHANICS = (
    *("points", "numerics", "load", "indenter", "control", "contact", "planes", "events", "stress"),
    *("line", "body", "solver", "__init__"),
)
#: What may not be imported, although it is above: the planes know no contact, the contact knows no indenter,
#: the search over the body is a check of the line's, and the package does not use its oracle.
APART = {
    "planes": {"load", "indenter", "control", "contact"},
    "contact": {"indenter", "control"},
    "body": {"line"},
    **{room: {"reference"} for room in ROOMS if room != "reference"},
}


def module(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module(path): path for path in FILES}


def imported(path: Path) -> set[str]:
    """Modules of the package that a file imports when it runs, anywhere in it."""
    tree = ast.parse(path.read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            node.body = []
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return (found & MODULES.keys()) - {module(path)}


def room_of(name: str, depth: int) -> str:
    parts = name.split(".")
    return parts[depth] if len(parts) > depth else "__init__"


@pytest.mark.parametrize("path", FILES, ids=module)
def test_a_file_imports_only_rooms_above(path: Path) -> None:
    own = module(path)
    for name in imported(path):
        for depth, rooms, of in ((1, ROOMS, "swtstudy"), (2, MECHANICS, "swtstudy.mechanics")):
            both = own.startswith(of) and name.startswith(of + ".")
            if both:
                mine, other = room_of(own, depth), room_of(name, depth)
                assert rooms.index(other) <= rooms.index(mine), f"{own} imports {name}"
                assert other not in APART.get(mine, ()), f"{own} imports {name}"


def test_no_imports_go_in_a_circle() -> None:
    graph = {name: imported(path) for name, path in MODULES.items()}
    # A package's own file may gather what its modules offer.
    graph = {
        name: {other for other in others if not name.startswith(other + ".")}
        for name, others in graph.items()
    }
    TopologicalSorter(graph).prepare()


def test_no_room_is_missing_in_the_lists() -> None:
    assert {room_of(name, 1) for name in MODULES} == {*ROOMS}
    assert {room_of(name, 2) for name in MODULES if name.startswith("swtstudy.mechanics")} == {*MECHANICS}


@pytest.mark.parametrize("name", [name for name, path in MODULES.items() if "__all__" in path.read_text()])
def test_what_a_module_offers_is_there(name):
    offering = import_module(name)
    for each in offering.__all__:
        assert getattr(offering, each) is not None
