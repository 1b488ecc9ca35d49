"""What the pages for developers say of the code: its places are there, and a value goes the way it shows."""

import ast
import importlib
import operator
import re
import sys
import threading
from types import CodeType

import pytest
from build_steps.house import drawn_imports, plan
from build_steps.rooms import WHOLE
from command import call
from folders import ROOT

PAGES = [(ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8") for name in ("develop", "extend")]
PAGE = "\n".join(PAGES)
#: Files named there, with what they hold: `file.py::name`.
PLACES = sorted(set(re.findall(r"`(swtstudy/[\w/]+\.py)(?:::([\w.]+))?`", PAGE)))
STEPS = re.findall(r"^\d+\. `(swtstudy/[\w/]+\.py)::([\w.]+)`", PAGE, re.MULTILINE)

STUDY = """
title = "Two points"
rtol = 1e-2
[fixed]
normal_amplitude = "8/9"
[axes]
phase = [0, 1]
[figure]
x = "phase"
"""


def held_by(body: list[ast.stmt], prefix: str = "") -> set[str]:
    """Names of the functions and classes in a file, those of a class after its name and a dot."""
    found = set()
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(prefix + node.name)
        if isinstance(node, ast.ClassDef):
            found |= held_by(node.body, f"{prefix}{node.name}.")
    return found


@pytest.mark.parametrize(("file", "name"), PLACES)
def test_every_place_is_there(file: str, name: str) -> None:
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert not name or name in held_by(tree.body)


@pytest.mark.pages
def test_a_value_goes_the_ten_steps(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "two.toml").write_text(STUDY, encoding="utf-8")
    assert len(STEPS) == 10
    steps = {id(code_of(file, name)): (file, name) for file, name in STEPS}
    done: list[tuple[str, str]] = []

    def note(frame, event, _) -> None:
        if event == "return" and id(frame.f_code) in steps:
            done.append(steps.pop(id(frame.f_code)))
            if not steps:
                sys.setprofile(before)

    before = sys.getprofile()
    sys.setprofile(note)
    threading.setprofile(note)  # where points are solved
    try:
        result = call("run", "two.toml")
    finally:
        sys.setprofile(before)
        threading.setprofile(None)  # type: ignore[arg-type]
    assert result.exit_code == 0, result.output
    assert done == STEPS


def code_of(file: str, name: str) -> CodeType:
    """The code of a function of the package."""
    module = importlib.import_module(file.removesuffix(".py").replace("/", "."))
    return operator.attrgetter(name)(module).__code__


@pytest.mark.pages
def test_the_picture_says_every_import_and_no_other() -> None:
    def leads_to(room: str) -> set[str]:
        return drawn[room].union(*map(leads_to, drawn[room]))

    drawn = drawn_imports(WHOLE)
    said = {(room, other) for room in drawn for other in leads_to(room)}
    pairs = {(WHOLE.room_of(own), WHOLE.room_of(other)) for own, other in WHOLE.imports()}
    direct = {(room, other) for room, other in pairs if room != other and {room, other} <= drawn.keys()}
    assert len(direct) > len(drawn)
    assert direct <= said
    assert {(room, other) for room, others in drawn.items() for other in others} <= direct


def test_an_arrow_goes_down_and_passes_every_floor_between() -> None:
    floors, lines = plan({"a": set(), "b": {"a"}, "c": {"b"}, "d": {"a", "c"}})
    level = {place: number for number, floor in enumerate(floors) for place in floor}
    assert [level[room] for room in "abcd"] == [0, 1, 2, 3]
    assert sorted(len(line) for line in lines) == [2, 2, 2, 4]
    for line in lines:
        levels = [level[place] for place in line]
        assert levels == list(range(levels[0], levels[-1] - 1, -1))
