"""Random small changes of the package, with the operators of mutmut."""

from __future__ import annotations

import ast
import random
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import libcst as cst
from libcst.metadata import MetadataWrapper, PositionProvider
from mutmut.mutation.mutators import mutation_operators, operator_assignment

#: The changes at one place of a file: its syntax tree, and pairs of an old and a new part of it.
Place = tuple[cst.Module, list[tuple[cst.CSTNode, cst.CSTNode]]]

#: Mutants of the smallest room.
AT_LEAST = 3


@dataclass(frozen=True)
class Mutant:
    """One change: the file and the line, that line as it was and as it is now, and the whole text."""

    file: str
    line: int
    was: str
    now: str
    text: str

    @property
    def room(self) -> str:
        """The folder: of the mechanics the one below it."""
        return room_of(self.file)


def room_of(file: str) -> str:
    """The room of a file of the package."""
    return "/".join(Path(file).parts[1:-1][:2]) or "."


def sample(project: Path, folder: str, size: int, dice: random.Random) -> list[Mutant]:
    """Mutants of every room in a folder, as many as it has places that can be changed; in random order."""
    rooms: dict[str, list[tuple[str, Place]]] = defaultdict(list)
    for path in sorted((project / folder).rglob("*.py")):
        file = str(path.relative_to(project))
        rooms[room_of(file)] += [(file, place) for place in _places(path.read_text(encoding="utf-8"))]
    total = sum(map(len, rooms.values()))
    chosen = []
    for places in rooms.values():
        count = max(AT_LEAST, round(size * len(places) / total))
        for file, (module, changes) in dice.sample(places, min(count, len(places))):
            old, new = dice.choice(changes)
            chosen.append(_mutant(file, module.code, module.deep_replace(old, new).code))
    mutants = [mutant for mutant in chosen if mutant]
    dice.shuffle(mutants)
    return mutants


def _places(text: str) -> Iterable[Place]:
    wrapper, walk = MetadataWrapper(cst.parse_module(text)), _Walk()
    module = wrapper.visit(walk)
    return [(module, changes) for changes in walk.found.values() if changes]


class _Walk(cst.CSTVisitor):
    """All changes of a file, by place."""

    METADATA_DEPENDENCIES = (PositionProvider,)

    def __init__(self) -> None:
        self.found: dict[tuple[int, int], list[tuple[cst.CSTNode, cst.CSTNode]]] = defaultdict(list)

    def on_visit(self, node: cst.CSTNode) -> bool:
        if _tells_nothing(node):
            return False
        start = self.get_metadata(PositionProvider, node).start
        for kind, operator in mutation_operators:
            # None for a value fails at once, and says nothing of the tests.
            if isinstance(node, kind) and operator is not operator_assignment:
                changes = [(node, new) for new in operator(node) if not _drops_little(node, new)]
                self.found[start.line, start.column] += changes
        return True


def _tells_nothing(node: cst.CSTNode) -> bool:
    """True without an effect that a test should check: types, sentences for a reader, zip's strict."""
    if isinstance(node, cst.SimpleString):
        return " " in node.value
    if isinstance(node, cst.Arg) and node.keyword:
        return node.keyword.value == "strict"
    if isinstance(node, cst.If) and isinstance(node.test, cst.Name):
        return node.test.value == "TYPE_CHECKING"
    return isinstance(node, cst.Annotation | cst.Import | cst.ImportFrom | cst.Decorator)


def _drops_little(old: cst.CSTNode, new: cst.CSTNode) -> bool:
    """Whether a call was changed to get None for an argument, or to lose zip's strict."""
    if not (isinstance(old, cst.Call) and isinstance(new, cst.Call)):
        return False
    before, after = (sum(map(_tells_nothing, call.args)) for call in (old, new))
    nothing = any(isinstance(each.value, cst.Name) and each.value.value == "None" for each in new.args)
    return nothing or after < before


def _mutant(file: str, old: str, new: str) -> Mutant | None:
    """A change as text, or None where it means the same, or nothing."""
    try:
        if ast.dump(ast.parse(old)) == ast.dump(ast.parse(new)):
            return None
    except SyntaxError:
        return None
    before, after = old.splitlines(), new.splitlines()
    first = next(i for i, pair in enumerate(zip(before, after, strict=False)) if pair[0] != pair[1])
    return Mutant(file, first + 1, before[first].strip(), after[first].strip(), new)
