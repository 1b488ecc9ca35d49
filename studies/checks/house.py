"""Size of the package by rooms: what somebody has to find their way through.

``python studies/checks/house.py [folder ...]``, where each folder, this one unless given, holds ``swtstudy``:
``python studies/checks/house.py before after > results/house.txt`` says what a change has done.
"""

from __future__ import annotations

import argparse
import ast
import io
import tokenize
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

#: Tokens that are no code.
BLANK = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
}
COLUMNS = ("files", "code lines", "functions", "dataclasses", "tuned numbers", "imports inside")


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("folders", nargs="*", type=Path, default=[Path(__file__).parents[2]])
    arguments.add_argument("--quick", action="store_true", help="totals alone")
    given = arguments.parse_args()
    for folder in given.folders:
        package = folder / "swtstudy"
        if not package.is_dir():
            arguments.error(f"found no swtstudy in {folder}")
        print(f"{folder.name}:\n")
        report({module_of(path, package): path for path in sorted(package.rglob("*.py"))}, given.quick)


def report(files: dict[str, Path], quick: bool) -> None:
    """Print the rooms of a package, the largest first, and the arrows between them."""
    rooms: dict[str, Counter[str]] = {}
    for name, path in files.items():
        rooms.setdefault(room_of(name), Counter()).update(counts(path))
    whole = sum(rooms.values(), Counter())
    print("".join([f"{'room':<12}", *(f"{column:>16}" for column in COLUMNS), f"{'share':>8}"]))
    largest_first = sorted(rooms.items(), key=lambda item: -item[1]["code lines"])
    for room, count in [*([] if quick else largest_first), ("all", whole)]:
        share = count["code lines"] / whole["code lines"]
        print("".join([f"{room:<12}", *(f"{count[column]:>16,}" for column in COLUMNS), f"{share:>8.1%}"]))
    found = arrows(files)
    print(f"\n{len(rooms)} rooms and loose modules, {len(found)} arrows between them")
    for one, other in sorted(found):
        if (other, one) in found and one < other:
            print(f"both ways: {one} and {other}")
    print()


def module_of(path: Path, package: Path) -> str:
    """Dotted name of a file."""
    parts = path.relative_to(package.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def room_of(module: str) -> str:
    """The folder or loose module of the package in which a module is."""
    return [*module.split("."), "__init__"][1]


def counts(path: Path) -> Counter[str]:
    """Count what one file adds to the columns."""
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    found = Counter(dict.fromkeys(COLUMNS, 0))
    found["files"] = 1
    found["code lines"] = len(code_lines(text, tree))
    inside = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            found["functions"] += 1
            inside |= {each for each in ast.walk(node) if imports_of_package(each)}
        if isinstance(node, ast.ClassDef):
            found["dataclasses"] += any("dataclass" in ast.unparse(each) for each in node.decorator_list)
    found["imports inside"] = len(inside)
    found["tuned numbers"] = sum(len(numbers_in(node)) for node in tree.body)
    return found


def code_lines(text: str, tree: ast.Module) -> set[int]:
    """Numbers of the lines that hold code: no comments, no blank lines, no docstrings."""
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type not in BLANK:
            lines |= set(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
            and ast.get_docstring(node) is not None
        ):
            first = node.body[0]
            lines -= set(range(first.lineno, (first.end_lineno or first.lineno) + 1))
    return lines


def imports_of_package(node: ast.AST) -> bool:
    """Whether a statement imports something of the package."""
    return isinstance(node, ast.ImportFrom) and (node.module or "").startswith("swtstudy")


def numbers_in(node: ast.stmt) -> list[float]:
    """Numbers, but 0 and 1, of a constant of a module, in capitals; not in tables of names or texts."""
    if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
        return []
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    names = [each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)]
    values = [each.value for each in ast.walk(node.value) if isinstance(each, ast.Constant)]
    if not names or names[0] != names[0].upper() or any(isinstance(value, str) for value in values):
        return []
    return [value for value in values if type(value) in (int, float) and value not in (0, 1)]


def arrows(files: dict[str, Path]) -> set[tuple[str, str]]:
    """Pairs of rooms of which the first imports the second, types and imports inside functions included."""
    found = set()
    for name, path in files.items():
        for other in imported(ast.parse(path.read_text(encoding="utf-8")), files):
            if room_of(other) not in (room_of(name), "__init__"):
                found.add((room_of(name), room_of(other)))
    return found


def imported(tree: ast.Module, files: dict[str, Path]) -> Iterator[str]:
    """Modules of the package that a file imports anywhere."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            of_module = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (each if each in files else node.module for each in of_module if node.module in files)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in files)


if __name__ == "__main__":
    main()
