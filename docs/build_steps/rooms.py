"""The rooms of the package, from the ground up, and what the files of each import.

tests/pages/test_rooms.py holds the files against these lists; the pages draw them.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from build_steps.markdown import table

PACKAGE = Path(__file__).resolve().parents[2] / "swtstudy"


@dataclass(frozen=True)
class House:
    """A package whose files lie in rooms.

    Attributes
    ----------
    name
        Dotted name of the package.
    ground
        Rooms that everything stands on, in the order in which they may import one another.
    above
        The other rooms, in that order.
    """

    name: str
    ground: tuple[str, ...]
    above: tuple[str, ...]

    def file_of(self, room: str) -> Path:
        """The file that says what a room holds."""
        return MODULES[self.name if room == "__init__" else f"{self.name}.{room}"]

    @property
    def rooms(self) -> tuple[str, ...]:
        """All rooms: each imports itself and those before it only."""
        return self.ground + self.above

    def room_of(self, module: str) -> str | None:
        """The room of a module, ``__init__`` for the package itself; None for one of another package."""
        own, parts = self.name.split("."), module.split(".")
        if parts[: len(own)] != own:
            return None
        return parts[len(own)] if len(parts) > len(own) else "__init__"

    def imports(self, types: bool = False) -> Iterator[tuple[str, str]]:
        """Every import of one file by another, as modules of this package; see `imported`."""
        for name, path in MODULES.items():
            if self.room_of(name) is not None:
                for other in sorted(imported(path, types)):
                    # The package itself is no room to go to.
                    if self.room_of(other) not in (None, "__init__"):
                        yield name, other


WHOLE = House(
    "swtstudy",
    ("vocabulary",),
    (
        *("kernel", "solver", "points", "study", "results", "figures", "archive", "paper", "faces", "cli"),
        *("__main__", "__init__"),
    ),
)


def module_of(path: Path) -> str:
    """Dotted name of a file of the package."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


#: Every file of the package by its dotted name.
MODULES = {module_of(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def imported(path: Path, types: bool = False) -> frozenset[str]:
    """Modules of the package that a file imports when it runs, anywhere in it; or also for its types."""
    names = {name for name, of_types in _imports(path) if types or not of_types}
    return frozenset(names & MODULES.keys()) - {module_of(path)}


@cache
def _imports(path: Path) -> frozenset[tuple[str, bool]]:
    """Names that a file imports, each with whether that is for types alone."""
    found: set[tuple[str, bool]] = set()
    todo: list[tuple[ast.AST, bool]] = [(ast.parse(path.read_text(encoding="utf-8")), False)]
    while todo:
        node, of_types = todo.pop()
        if isinstance(node, ast.ImportFrom) and node.module:
            names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
            found |= {(name, of_types) for name in names}
        elif isinstance(node, ast.Import):
            found |= {(alias.name, of_types) for alias in node.names}
        guard = isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        # Statements alone: expressions import nothing.
        for part in ("body", "orelse", "finalbody", "handlers", "cases"):
            below = getattr(node, part, [])
            if isinstance(below, list):
                todo += [(each, of_types or (guard and part == "body")) for each in below]
    return frozenset(found)


def rooms(house: House) -> str:
    """A table of the rooms, in the order in which they may import one another, and what each holds."""
    held = ((f"`{_shown(house.file_of(room))}`", _first_line(house.file_of(room))) for room in house.rooms)
    return table(("room", "what it holds"), held)


def _shown(path: Path) -> str:
    """A package by its folder."""
    place = path.relative_to(PACKAGE.parent).as_posix()
    return place.removesuffix("__init__.py")


def _first_line(path: Path) -> str:
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return text.partition("\n")[0]
