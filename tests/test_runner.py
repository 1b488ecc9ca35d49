import io
import os
from functools import partial

import numpy as np
import pytest
import stand_in

from swtstudy import Study, run
from swtstudy.runner.chunk import Chunk, Result
from swtstudy.runner.engines import Here, LocalWorkers
from swtstudy.runner.pace import Pace
from swtstudy.runner.plan import cut, unique_points
from swtstudy.runner.progress import Progress

WIDE = """
title = "Enough for workers"
[axes]
profile = ["paraboloid", "rounded_punch"]
phase = {start = 0, stop = 3, num = 20}
friction = [0.1, 0.2, 0.3]
[fixed]
flat_radius = 0.5
"""


def test_workers_give_what_one_process_gives(tmp_path):
    study = Study.from_text(WIDE)
    here = run(study, tmp_path / "here.nc", solver=stand_in.smooth)
    there = run(study, tmp_path / "there.nc", solver=stand_in.slow)
    for name in here.data_vars:
        np.testing.assert_array_equal(here[name], there[name])
    distinct = study.grid.size
    assert here.s.size == distinct


def test_work_is_shared_by_workers_with_one_thread_each(tmp_path):
    dataset = run(Study.from_text(WIDE), tmp_path / "wide.nc", solver=stand_in.process)
    processes = set(np.abs(dataset.critical_x.values).ravel())
    assert len(processes - {float(os.getpid())}) == 2
    probed = np.abs(dataset.critical_x) == os.getpid()
    assert (dataset.s.where(~probed, 1) == 1).all()


def test_chunking_does_not_change_values(small):
    points = unique_points(small.grid)
    whole = stand_in.smooth
    found = {}
    for size in (1, 3, 100):
        s = np.full(len(points.table), np.nan)

        def deliver(result: Result, s=s) -> None:
            s[result.start : result.start + len(result)] = result.solution.s

        Here().solve(cut(points.table, 0, lambda size=size: size), 1e-3, whole, deliver)
        found[size] = s
    assert (found[1] == found[3]).all()
    assert (found[1] == found[100]).all()


def test_symmetric_points_are_computed_once(small, tmp_path):
    computed = []

    def counting(points, rtol):
        computed.append(len(points))
        return stand_in.smooth(points, rtol)

    dataset = run(small, tmp_path / "small.nc", solver=counting)
    assert sum(computed) == 2 * 4
    assert dataset.s.size == 2 * 9
    np.testing.assert_array_equal(dataset.s.isel(phase=0), dataset.s.isel(phase=4))
    np.testing.assert_array_equal(dataset.critical_x.isel(phase=0), -dataset.critical_x.isel(phase=4))


def test_chunks_aim_at_a_fraction_of_a_second():
    pace = Pace()
    first = pace.chunk_size()
    solution = stand_in.smooth
    assert first >= 1
    from swtstudy.grid.canonical import points_from
    from swtstudy.grid.reading import read_grid

    grid, _ = read_grid({}, {})
    table = grid.canonical()[0]
    pace.update(Result(0, solution(points_from(table), 1e-3), 0.01))
    assert 0.1 <= pace.chunk_size() * 0.01 <= 1


def test_a_lost_worker_is_replaced(small, tmp_path):
    points = unique_points(small.grid)
    done = []
    with LocalWorkers(2) as engine:
        chunks = [Chunk(i, points.table[i : i + 1]) for i in range(len(points.table))]
        solver = partial(stand_in.kill_once, str(tmp_path / "killed"))
        engine.solve(chunks, 1e-3, solver, lambda result: done.append(result.start))
    assert sorted(done) == list(range(len(points.table)))


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_progress_shows_points_rate_and_time_left_on_a_terminal_only():
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        progress = Progress(10, stream)
        progress.add(4)
        progress.close()
    assert "4/10 points" in terminal.getvalue()
    assert "/s" in terminal.getvalue()
    assert "left" in terminal.getvalue()
    assert file.getvalue() == ""


def test_an_error_of_the_solver_leaves_no_file(small, tmp_path):
    def broken(points, rtol):
        raise ZeroDivisionError("a mistake in the solver")

    with pytest.raises(ZeroDivisionError):
        run(small, tmp_path / "small.nc", solver=broken)
    assert list(tmp_path.iterdir()) == []
