"""Comments, docstrings and pages name what exists."""

import importlib
import re
from pathlib import Path

import pytest
from folders import ROOT

TEXTS = [
    *(path for folder in ("swtstudy", "studies") for path in sorted((ROOT / folder).rglob("*.py"))),
    *sorted((ROOT / "docs").rglob("*.md")),
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
]


def exists(name: str) -> bool:
    """Whether a dotted name is that of a module, or of something in one."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            found = getattr(found, part, None)
        return found is not None
    return False


@pytest.mark.parametrize("name", ["swtstudy.study.units.rows.SIMILAR", "swtstudy.run", "swtstudy.points"])
def test_what_exists_is_found(name: str) -> None:
    assert exists(name)
    assert not exists(f"{name}s_of_old")


def test_names_of_the_package_exist() -> None:
    names = {
        (path, name) for path in TEXTS for name in re.findall(r"swtstudy(?:\.\w+)+", path.read_text("utf-8"))
    }
    assert len(names) > 1000
    assert not [(str(path.relative_to(ROOT)), name) for path, name in sorted(names) if not exists(name)]


def test_files_of_tests_exist() -> None:
    named: set[tuple[Path, str]] = {
        (path, name) for path in TEXTS for name in re.findall(r"\btests/[\w/]+\.py", path.read_text("utf-8"))
    }
    assert named
    assert not [
        (str(path.relative_to(ROOT)), name) for path, name in sorted(named) if not (ROOT / name).exists()
    ]


def test_docstrings_begin_with_what_a_thing_is_or_does() -> None:
    """No question words, and no pronoun without a noun."""
    vague = re.compile(r'^\s*r?"""(?:What|Whether|Those|How)\b.*', re.MULTILINE)
    files = sorted((ROOT / "swtstudy").rglob("*.py"))
    found = [(path.name, line) for path in files for line in vague.findall(path.read_text("utf-8"))]
    assert not found
