"""Progress in a log and on a terminal, by a clock of the test."""

import re
import sys
import time
from types import SimpleNamespace

import pytest
from command import Terminal

from swtstudy.vocabulary.progress import Progress


class Clock:
    """A clock that goes on when it is told."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    monkeypatch.setattr(time, "monotonic", own := Clock())
    return own


@pytest.mark.parametrize(
    ("given", "steps", "told"),
    [
        ({"total": 9}, [29.9], []),
        ({"total": 9}, [30.0], ["1 of 9 points, 0.0333/s", "1 of 9 points, 0.0333/s"]),
        ({"total": None, "name": "search", "unit": "steps"}, [40.0], 2 * ["search: 1 steps, 0.025/s"]),
        # A line every half a minute, and one at the end.
        (
            {"total": 9, "name": "mine"},
            [31.0, 29.0, 1.0, 3.0],
            [
                "mine: 1 of 9 points, 0.0323/s",
                "mine: 3 of 9 points, 0.0492/s",
                "mine: 4 of 9 points, 0.0625/s",
            ],
        ),
    ],
)
def test_a_log_has_what_is_done_and_how_fast(
    clock: Clock, caplog: pytest.LogCaptureFixture, given: dict, steps: list[float], told: list[str]
) -> None:
    caplog.set_level("INFO", logger="swtstudy")
    with Progress(**given) as shown:
        for seconds in steps:
            clock.now += seconds
            shown.add()
    assert caplog.messages == told


def test_steps_within_steps_count_outside(clock: Clock, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level("INFO", logger="swtstudy")
    with Progress(2, "outer") as outer:
        with Progress(50, "inner") as inner:
            clock.now += 60.0
            inner.add(5)
        outer.add()
    assert caplog.messages == ["outer: 5 of 2 points, 0.0833/s", "outer: 6 of 2 points, 0.1/s"]
    # What comes after it counts by itself.
    with Progress(3, "later") as later:
        clock.now += 30.0
        later.add()
    assert caplog.messages[2:] == 2 * ["later: 1 of 3 points, 0.0333/s"]


@pytest.mark.parametrize(
    ("given", "steps", "words"),
    [
        ({"total": 4, "name": "mine"}, [1.9], ""),
        ({"total": 4, "name": "mine"}, [2.0], "mine: .* 1/4 "),
        ({"total": 4, "delay": 0.0}, [], " +0%.* 0/4 .* points/s"),
        ({"total": None, "delay": 0.0}, [], ""),
        ({"total": None, "delay": 1.0, "unit": "steps"}, [1.0, 1.0], "1 steps"),
        ({"total": 0, "delay": 0.0}, [], ""),
    ],
)
def test_a_bar_appears_after_some_patience(
    clock: Clock, monkeypatch: pytest.MonkeyPatch, given: dict, steps: list[float], words: str
) -> None:
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    with Progress(**given) as shown:
        for seconds in steps:
            clock.now += seconds
            shown.add()
        text = terminal.getvalue()
    assert bool(text) == bool(words)
    assert not words or re.match(words, text.split("\r")[1])


@pytest.mark.parametrize("config", [{}, {"IPKernelApp": {}}])
def test_a_bar_in_a_notebook_goes_at_its_end(
    clock: Clock, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture, config: dict
) -> None:
    shell = SimpleNamespace(config=config)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell, version_info=(9,)))
    with Progress(4, "mine", delay=0.0) as shown:
        shown.add()
    assert bool(capfd.readouterr().err) == bool(config)
