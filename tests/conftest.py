"""Shared by the tests: a small study and the fast stand-in for the mechanics."""

from __future__ import annotations

import gc
import os
import signal
from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

# Before NumPy: two processes of tests with two BLAS threads each would fight for two cores.
os.environ.setdefault("OMP_NUM_THREADS", "1")

import pytest

import swtstudy  # imports the rest when it is used: the process that only hands out tests needs none of it

if TYPE_CHECKING:
    import xarray as xr
    from kept import Kept

#: Tests of these files share what is costly: the files of each line stay with one process.
TOGETHER = (
    # The first line compiles most of the solver.
    ("outcome", "elements", "inspected_forces", "beneath", "terminal"),
    ("cli",),
    ("counted_cycles",),
    ("critical_distance",),
    ("develop", "rooms"),
    ("force_control",),
    ("fit",),
    ("inspection_panels",),
    ("optimise",),
    ("overlooked",),
    ("real_archives", "real_contacts", "real_studies"),
    ("report",),
    ("s_error",),
    ("sensitivity",),
    ("shown",),
    ("trace",),
    ("validity",),
)
#: Tests of these files compile nothing: one process runs them while another compiles.
READING = (
    *("runner", "archive", "archive_check", "archive_check_sums", "archive_names", "cf", "figures", "drawn"),
    *("legend", "drawn_profile", "quantities", "show_load", "jumps", "contour_labels", "hostile_names"),
    *("marked_validity", "loop_legend", "optimise", "statements", "safe_files", "audit"),
    *("study", "schema", "rig_files", "expression", "scripts", "check", "formalisms"),
    *("resume", "sensitivity", "told_of_files", "told_of_signals", "parts", "client", "messages", "mistakes"),
    *("limits", "definitions", "radii", "doubts", "writing", "calls"),
)
#: Tests of these files need little more compiled code than that of s, in the order in which that is there.
OF_S_ALONE = (
    *("sample", "file_systems", "save", "page_numbers", "cli", "sessions", "checked", "describe"),
    *("trace", "accessor", "designers_figures", "every_attribute", "tables_of_users", "bounds_of_statements"),
    *("many_values", "plane_units"),
)
GROUP_OF = {f"test_{name}.py": group[0] for group in TOGETHER for name in group}

#: Examples in docstrings that take seconds.
LONG_EXAMPLES = ("swtstudy.results.optimise.optimise",)

SMALL = """
title = "A small study"
rtol = 1e-3

[fixed]
frequency_ratio = 1

[axes]
normal_amplitude = [0.25, "8/9"]
phase = { start = 0, stop = "2*pi", num = 9 }

[figure]
x = "phase"
hue = "normal_amplitude"
"""


@pytest.fixture(scope="session")
def small_text() -> str:
    return SMALL


@pytest.fixture
def small(small_text) -> swtstudy.Study:
    return swtstudy.Study.from_text(small_text)


@pytest.fixture(scope="session")
def solved(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """Results of the study with units of `real`."""
    from real import STUDY

    study = swtstudy.Study.from_text(STUDY)
    return swtstudy.run(study, tmp_path_factory.mktemp("real") / "sphere.nc", workers=1)


@pytest.fixture
def unwrapped(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures whose titles and labels stay in one line: the layout takes most of the time of a figure."""
    for module in ("draw", "sheet"):
        monkeypatch.setattr(f"swtstudy.figures.{module}.wrap_texts", lambda _: None)


@pytest.fixture
def without_points(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages without the pictures of points, which take seconds."""
    monkeypatch.setattr("swtstudy.faces.page.points_of", lambda *_: [])


@pytest.fixture(scope="session")
def kept(request: pytest.FixtureRequest) -> Kept:
    """What is kept of figures and Datasets, by name."""
    from kept import Kept

    return Kept(request.config.getoption("--keep"))


@pytest.fixture(autouse=True)
def signals_as_they_were() -> Iterator[None]:
    """A stopped command ignores further Ctrl-C; in this process, so would all that is started from here."""
    before = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}
    yield
    for each, handler in before.items():
        signal.signal(each, handler)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark as slow the later cases of tests of which the first are quick, and examples in docstrings."""
    cases = Counter[str]()
    for item in items:
        test = item.nodeid.partition("[")[0]
        quick = item.get_closest_marker("quick")
        cases[test] += 1
        if item.name in LONG_EXAMPLES or (quick and cases[test] > quick.args[0]):
            item.add_marker(pytest.mark.slow)
    items.sort(key=turn_of)


def turn_of(item: pytest.Item) -> tuple[int, int]:
    """Which tests are run first: what compiles, what does not, what stays with one process, all others."""
    name, group = item.path.stem.removeprefix("test_"), GROUP_OF.get(item.path.name)
    if name in TOGETHER[0]:
        return 0, TOGETHER[0].index(name)
    if name in READING:
        return 1, 0
    if name in OF_S_ALONE:
        return 2, OF_S_ALONE.index(name)
    return (4 if group is None else 3), 0


def pytest_collection() -> None:
    """Collect no garbage for now: Python would look through a million objects, again and again."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Collect garbage again; the objects that are there by now stay, and are not looked at any more."""
    gc.collect()
    gc.freeze()
    gc.enable()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Who runs what in two processes: the groups of pytest-xdist 3.8 are lost with pytest 9.2."""
    from xdist.scheduler import LoadScopeScheduling

    config.option.loadscopereorder = False  # they are in order

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.split("::")[0].rpartition("/")[2]
            return GROUP_OF.get(file, nodeid)

    return Scheduling(config, log)


def pytest_addoption(parser: pytest.Parser) -> None:
    words = "How many studies test_fuzz.py changes; 8700 take some ten minutes."
    parser.addoption("--changed-studies", type=int, default=150, help=words)
    words = "Keep what figures and Datasets show now, instead of comparing it with what is kept."
    parser.addoption("--keep", action="store_true", help=words)
