"""The time of a run, foreseen by a clock that goes on while points are solved."""

import time
from pathlib import Path

import numpy as np
import pytest
import stand_in

from swtstudy import Study
from swtstudy.archive.run import Work, estimate

LINE = 'title = "t"\nrtol = 1e-3\n[axes]\nfriction = {{start = 0.1, stop = 2, num = {count}}}\n'


class Clock:
    """A clock, and a solver that takes so many seconds for a point and for a call."""

    def __init__(self, each: float, call: float = 0.0) -> None:
        self.each, self.call, self.now = each, call, 50.0
        self.solved: list[int] = []

    def __call__(self) -> float:
        return self.now

    def solve(self, points: stand_in.Points, rtol: float) -> stand_in.Solution:
        assert rtol == 1e-3
        self.solved.append(len(points))
        self.now += self.call + self.each * len(points)
        return stand_in.smooth(points, rtol)


def foreseen(monkeypatch: pytest.MonkeyPatch, clock: Clock, text: str) -> tuple[float, int, int]:
    monkeypatch.setattr(time, "perf_counter", clock)
    monkeypatch.setattr(stand_in.SOLVER, clock.solve)
    return estimate(Work(Study.from_text(text), Path("absent.nc")))


def test_quick_points_are_all_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    seconds, timed, parts = foreseen(monkeypatch, clock := Clock(1e-3), LINE.format(count=300))
    assert seconds == pytest.approx(0.3)
    assert timed == 300
    # The first call compiles; then each part has a point by itself first.
    assert clock.solved[0] == 1
    assert len(clock.solved) == 1 + 2 * parts
    assert sum(clock.solved) == 1 + parts + 300


def test_slow_points_are_timed_for_a_few_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    seconds, timed, parts = foreseen(monkeypatch, clock := Clock(1.5), LINE.format(count=3000))
    assert seconds == pytest.approx(4500.0)
    assert timed == len(clock.solved) - 1 == 3
    assert parts > 16


def test_what_a_call_takes_is_shared_by_its_points(monkeypatch: pytest.MonkeyPatch) -> None:
    one = foreseen(monkeypatch, Clock(0.0, 1e-3), LINE.format(count=300))
    assert one[0] == pytest.approx(1e-3 * one[2])


def test_nothing_takes_no_time(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    study = Study.from_text(LINE.format(count=3))
    work = Work(study, tmp_path / "absent.nc")
    work.found["status"][:] = 0
    assert estimate(work) == (0.0, 0, 0)


def test_a_loop_of_many_vertices_is_timed_by_one_with_fewer(monkeypatch: pytest.MonkeyPatch) -> None:
    """As k log k with k vertices."""
    seconds = {}
    for count in (150, 200, 201, 400):
        angle = 2.0 * np.pi * np.arange(count) / count
        vertices = np.stack([0.5 * np.sin(angle), 0.5 * np.cos(angle)], 1).round(9).tolist()
        text = f'{LINE.format(count=3)}[fixed]\nload = "mine"\n[loads.mine]\nvertices = {vertices}\n'
        seconds[count], *_ = foreseen(monkeypatch, Clock(0.01), text)
    assert seconds[150] == seconds[200] == pytest.approx(0.03)
    for many, few in ((201, 101), (400, 200)):
        grown = many * np.log(many) / (few * np.log(few))
        assert seconds[many] == pytest.approx(0.03 * grown)
