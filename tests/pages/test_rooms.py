"""The rooms of the code: imports go one way, from a room to those above it, and never in a circle."""

from graphlib import TopologicalSorter
from importlib import import_module

import pytest
from build_steps.rooms import MODULES, WHOLE, imported
from folders import ROOT, TESTS

pytestmark = pytest.mark.pages
ORACLE = "swtstudy.paper.formalisms"


def test_a_file_imports_only_rooms_above() -> None:
    imports = [(own, other, WHOLE.room_of(own), WHOLE.room_of(other)) for own, other in WHOLE.imports(True)]
    assert len(imports) > 50
    order = WHOLE.rooms.index
    assert not [f"{own} imports {other}" for own, other, mine, its in imports if order(its) > order(mine)]


def test_only_statements_of_the_paper_use_the_oracle() -> None:
    # A statement finds its test by name when it is tested.
    assert not [name for name, path in MODULES.items() if ORACLE in imported(path, True)]


def test_no_imports_go_in_a_circle() -> None:
    graph = {name: imported(path) for name, path in MODULES.items()}
    # A package's own file may gather what its modules offer.
    graph = {
        name: {other for other in others if not name.startswith(other + ".")}
        for name, others in graph.items()
    }
    TopologicalSorter(graph).prepare()


def test_no_room_is_missing_in_the_lists() -> None:
    assert {WHOLE.room_of(name) for name in MODULES} - {None} == {*WHOLE.rooms}


@pytest.mark.parametrize("name", [name for name, path in MODULES.items() if "__all__" in path.read_text()])
def test_what_a_module_offers_is_there(name: str) -> None:
    offering = import_module(name)
    for each in offering.__all__:
        assert getattr(offering, each) is not None


def test_tests_are_in_the_folder_of_a_room() -> None:
    folders = {str(path.parent.relative_to(TESTS)) for path in TESTS.rglob("test_*.py")}
    rooms = {room for room in WHOLE.rooms if (ROOT / "swtstudy" / room).is_dir()}
    assert folders - {".", "pages"} == rooms
