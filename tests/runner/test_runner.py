import io
import os
import subprocess
import sys
import threading
import types
from dataclasses import replace
from functools import partial
from pathlib import Path
from unittest import mock

import numpy as np
import pytest
import stand_in
import xarray as xr
from folders import TESTS

import swtstudy
from swtstudy import Study, StudyError, run
from swtstudy.archive.paths import ArchiveError
from swtstudy.points.grid import Grid
from swtstudy.points.records import FAILED, Records, Run
from swtstudy.points.unique import SECONDS_PER_WEIGHT, duration, unique_points, weights
from swtstudy.runner import engine
from swtstudy.runner.chunk import Chunk
from swtstudy.runner.collector import CHUNK_SECONDS, Pace, ProgressBar
from swtstudy.runner.engine import LOST_WORKER, WorkerError, solve
from swtstudy.runner.run import run_several
from swtstudy.runner.workers import LocalPool, _clean_start
from swtstudy.runner.workload import estimate

WIDE = """
title = "Enough for workers"
[axes]
profile = ["paraboloid", "rounded_punch"]
phase = {start = 0, stop = 3, num = 20}
friction = [0.1, 0.2, 0.3, 0.4]
[fixed]
flat_radius = 0.5
"""


@pytest.fixture
def wide():
    return Study.from_text(WIDE)


def test_workers_give_what_one_process_gives(wide, tmp_path):
    here = run(wide, tmp_path / "here.nc", solver=stand_in.smooth, workers=1)
    there = run(wide, tmp_path / "there.nc", solver=stand_in.slow)
    for name in here.data_vars:
        np.testing.assert_array_equal(here[name], there[name])


@pytest.mark.slow
def test_work_is_shared_by_workers_with_one_thread_each(wide, tmp_path):
    dataset = run(wide, tmp_path / "wide.nc", solver=stand_in.process)
    processes = set(np.abs(dataset.critical_x.values).ravel())
    assert len(processes) == 2
    assert os.getpid() not in processes
    assert (dataset.s == 1).all()


def test_symmetric_points_are_computed_once(small, tmp_path):
    counting = stand_in.Counting()
    dataset = run(small, tmp_path / "small.nc", solver=counting)
    assert counting.points == 2 * 4
    assert dataset.s.size == 2 * 9
    np.testing.assert_array_equal(dataset.s.isel(phase=0), dataset.s.isel(phase=4))
    np.testing.assert_array_equal(dataset.critical_x.isel(phase=0), -dataset.critical_x.isel(phase=4))


def test_chunks_aim_at_a_fraction_of_a_second(small):
    pace = Pace()
    for _ in range(30):
        pace.update(0.02 * small.grid.size, 2 * small.grid.size)
    assert pace.chunk_weight() == pytest.approx(CHUNK_SECONDS / 0.01)


def single_chunks(study):
    points = unique_points(study.grid)
    return points.table, [Chunk.of(points, [np.array([i])]) for i in range(len(points.table))]


def test_a_lost_worker_is_replaced(wide, tmp_path):
    table, chunks = single_chunks(wide)
    done = []
    with LocalPool(2) as pool:
        solver = partial(stand_in.kill_once, str(tmp_path / "killed"))
        solve(chunks, 1e-3, solver, lambda rows, found: done.extend(rows), pool)
    assert (tmp_path / "killed").exists()
    assert sorted(done) == list(range(len(table)))


@pytest.mark.slow
def test_only_what_was_in_hand_is_tried_alone(wide, tmp_path, monkeypatch):
    alone, on_its_own = [], engine._Waves._alone
    monkeypatch.setattr(
        engine._Waves, "_alone", lambda waves, chunk: (alone.append(chunk), on_its_own(waves, chunk))
    )
    table, chunks = single_chunks(wide)
    done = []
    # In the second wave, of 16 chunks.
    solver = partial(stand_in.kill_once_at, 0.4, str(tmp_path / "killed"))
    with LocalPool(2) as pool:
        solve(chunks, 1e-3, solver, lambda rows, found: done.extend(rows), pool)
    assert sorted(done) == list(range(len(table)))
    assert 1 <= len(alone) <= 2 * 2


def test_a_solver_that_workers_cannot_import_is_said(wide, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "made_here", types.ModuleType("made_here"))
    exec("def solver(points, rtol): pass", vars(sys.modules["made_here"]))
    with pytest.raises(WorkerError, match=r"a worker cannot .*made_here.*; 0 of 160 distinct points"):
        run(wide, tmp_path / "wide.nc", solver=sys.modules["made_here"].solver)


@pytest.mark.slow
def test_a_point_that_kills_its_worker_is_alone_in_failing():
    study = Study.from_text('title = "t"\n[axes]\nfriction = [0.1, 0.2, 0.3, 0.4]')
    chunk = Chunk.of(unique_points(study.grid), [np.arange(2), np.arange(2, 4)])
    results = []
    with LocalPool(1) as pool:
        solve([chunk], 1e-3, partial(stand_in.kill_at, 0.3), lambda *each: results.append(each), pool)
    assert sorted(row for rows, _ in results for row in rows) == list(range(4))
    ((rows, failed),) = [each for each in results if (each[1].status == FAILED).any()]
    assert rows.tolist() == [2]
    assert failed.message.tolist() == [LOST_WORKER]


@pytest.mark.parametrize("solver", [stand_in.fail_at, stand_in.lose_at])
def test_one_failure_is_one_point(solver):
    study = Study.from_text('title = "t"\n[axes]\nfriction = {start = "0.1", stop = 1, num = 10}')
    results = []
    chunk = Chunk.of(unique_points(study.grid), [np.arange(10)])
    solve([chunk], 1e-3, partial(solver, 0.3), lambda rows, found: results.append(found))
    (found,) = results
    assert np.flatnonzero(found.status == FAILED).tolist() == [2]
    assert np.flatnonzero(np.isnan(found.solution.s)).tolist() == [2]
    assert np.flatnonzero(found.message).tolist() == [2]


def test_rooms_import_only_what_lies_before_them():
    rooms = ("grid", "study", "records", "archive", "runner")
    package = Path(swtstudy.__file__).parent
    for number, room in enumerate(rooms):
        for file in (package / room).rglob("*.py"):
            text = file.read_text(encoding="utf-8")
            for later in rooms[number + 1 :]:
                assert f"swtstudy.{later}" not in text, (file, later)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


class Clock:
    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 5.0
        return self.now


def test_the_name_of_a_study_is_no_study(tmp_path):
    with pytest.raises(StudyError, match="study: found 'figure3'; allowed: a Study"):
        run("figure3", tmp_path / "figure3.nc")


def test_a_terminal_shows_points_rate_and_time_left():
    terminal = Terminal()
    progress = ProgressBar(10, terminal, Clock())
    progress.add(4)
    progress.close()
    assert "4 of 10 points (40 %), 0.8/s, 7.5 s left" in terminal.getvalue()


def test_a_log_has_a_line_now_and_then(caplog):
    caplog.set_level("INFO", logger="swtstudy")
    file = io.StringIO()
    progress = ProgressBar(100, file, Clock())
    for _ in range(100):
        progress.add(1)
    assert file.getvalue() == ""
    assert 10 <= len(caplog.messages) <= 20
    assert caplog.messages[-1].startswith("100 of 100 points")


class Gone(Terminal):
    """A terminal that is closed after the first words."""

    def write(self, text: str) -> int:
        if self.getvalue():
            raise OSError(5, "Input/output error")
        return super().write(text)


def closed() -> io.StringIO:
    stream = io.StringIO()
    stream.close()
    return stream


@pytest.mark.parametrize("stream", [None, closed(), Gone()])
def test_a_run_does_without_a_stream_that_is_gone(small, tmp_path, monkeypatch, stream):
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr("sys.stdout", stream)
    monkeypatch.setattr("swtstudy.runner.collector._BAR_SECONDS", 0.0)
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    assert np.isfinite(dataset.s).all()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")
@pytest.mark.parametrize("closing", ["2>&-", "<&- >&- 2>&-"])
def test_the_command_does_without_closed_streams(tmp_path, closing):
    (tmp_path / "one.toml").write_text('title = "t"\nrtol = 1e-2\n')
    command = f'exec "{sys.executable}" -m swtstudy run one.toml {closing}'
    assert subprocess.run(command, shell=True, cwd=tmp_path, timeout=60).returncode == 0
    assert np.isfinite(swtstudy.open_results(tmp_path / "results" / "one.nc").s)


@pytest.mark.slow
def test_a_script_without_a_guard_is_run_once(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import sys; sys.path.insert(0, sys.argv[1])\nimport stand_in\nfrom swtstudy import Study, run\n"
        "print('begun', flush=True)\n"
        f"dataset = run(Study.from_text({WIDE!r}), 'wide.nc', solver=stand_in.slow)\n"
        "print(int(dataset.s.notnull().sum()))\n"
    )
    command = [sys.executable, str(script), str(TESTS)]
    done = subprocess.run(command, cwd=tmp_path, timeout=60, capture_output=True, text=True)
    assert (done.stdout, done.stderr, done.returncode) == ("begun\n160\n", "", 0)


def test_a_short_run_is_quiet_in_a_log(small, tmp_path, caplog, capfd):
    caplog.set_level("INFO", logger="swtstudy")
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    assert caplog.messages == []
    assert capfd.readouterr() == ("", "")


def test_workers_start_with_one_thread_each_and_without_the_script_that_calls(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    monkeypatch.delenv(names[1], raising=False)
    monkeypatch.delenv(names[2], raising=False)
    main = sys.modules["__main__"]
    with _clean_start():
        assert [os.environ[name] for name in names] == ["1", "1", "1"]
        assert sys.modules["__main__"] is not main
    assert [os.environ.get(name) for name in names] == ["7", None, None]
    assert sys.modules["__main__"] is main


def test_workers_keep_the_memory_of_arrays_unless_the_user_says_otherwise(monkeypatch):
    monkeypatch.setenv("MALLOC_TRIM_THRESHOLD_", "1000")
    monkeypatch.delenv("MALLOC_MMAP_THRESHOLD_", raising=False)
    with _clean_start():
        assert os.environ["MALLOC_TRIM_THRESHOLD_"] == "1000"
        assert int(os.environ["MALLOC_MMAP_THRESHOLD_"]) == 2**25  # the most that glibc takes
    assert os.environ["MALLOC_TRIM_THRESHOLD_"] == "1000"
    assert "MALLOC_MMAP_THRESHOLD_" not in os.environ


def test_the_pace_of_the_first_chunks_and_of_later_ones():
    """The first are a fifth as long as later ones; then the mean of the last estimate and the new timing."""
    pace = Pace()
    assert pace.chunk_weight() == pytest.approx(0.2 * CHUNK_SECONDS / SECONDS_PER_WEIGHT)
    pace.update(4.0, 200)
    assert pace.seconds_per_weight == pytest.approx(0.02)
    pace.update(4.0, 100)
    assert pace.seconds_per_weight == pytest.approx(0.03)
    assert pace.chunk_weight() == pytest.approx(0.7 / 0.03)
    pace.update(0.0, 10**9)
    for _ in range(60):
        pace.update(0.0, 10**9)
    assert pace.chunk_weight() == 10_000


def test_an_estimate_is_the_seconds_of_a_kind_times_its_points():
    """Two kinds, of 1 s and 2 s a point; what is saved counts no more."""
    text = (
        'title = "t"\n[axes]\nfrequency_ratio = [1, "1/2"]\nfriction = {start = 0.1, stop = 0.9, num = 5}\n'
    )
    points = unique_points(Study.from_text(text).grid)
    table, timed = points.table, []
    slow = partial(timed_by_ratio, timed)
    missing = np.ones(len(table), bool)
    patched = mock.patch.multiple("swtstudy.runner.workload", solve_chunk=slow, _BUDGET=100.0)
    with patched:
        assert estimate(points, missing, 1e-3, None) == pytest.approx(5 * 1.0 + 5 * 2.0)
        missing[:3] = False
        left = {1: 5, 2: 5}
        left[int(table["q"][0])] -= 3
        assert estimate(points, missing, 1e-3, None) == pytest.approx(left[1] * 1.0 + left[2] * 2.0)
        assert estimate(points, np.zeros(len(table), bool), 1e-3, None) == 0.0


def test_a_plan_times_no_more_points_than_its_budget_allows():
    """Of points of 1 s two at a time are too long, and those of ratio 1/2 are known by their weight."""
    text = (
        'title = "t"\n[axes]\nfrequency_ratio = [1, "1/2"]\nfriction = {start = 0.1, stop = 0.9, num = 50}\n'
    )
    points, timed, told = unique_points(Study.from_text(text).grid), [], []
    every = np.ones(len(points.table), bool)
    with mock.patch("swtstudy.runner.workload.solve_chunk", partial(timed_by_ratio, timed)):
        seconds = estimate(points, every, 1e-3, None, lambda result: told.append(len(result)))
    assert sum(told) <= 2
    weight = weights(points.table)
    assert seconds == pytest.approx(50.0 * weight.sum() / weight[points.table["q"] == 1].sum())
    # Of quick points each ratio has its share of the budget.
    quick = partial(timed_by_ratio, [], second=0.04)
    with mock.patch("swtstudy.runner.workload.solve_chunk", quick):
        assert estimate(points, every, 1e-3, None) == pytest.approx(0.04 * (50 * 1.0 + 50 * 2.0))


def test_a_loop_of_many_vertices_is_timed_by_one_of_fewer():
    """Of k log k seconds a point, whatever is timed."""
    t = 2.0 * np.pi * np.arange(1600) / 1600
    loop = swtstudy.LoadPath("long", np.stack([0.2 * np.cos(t), 0.2 * np.sin(t)], axis=1))
    grid = Grid({"load": loop}, {"friction": (0.3, 0.5)})
    points, counts = unique_points(grid), []

    def solve(chunk, rtol, solver):
        (load,) = chunk.definitions.values()
        k = len(load.vertices)
        counts.append(k)
        seconds = float(len(chunk) * 1e-4 * k * np.log(k))
        return that_took(seconds, chunk.table)

    with mock.patch("swtstudy.runner.workload.solve_chunk", solve):
        seconds = estimate(points, np.ones(2, bool), 1e-3, None)
    assert 100 < max(counts) <= 200
    assert seconds == pytest.approx(2 * 1e-4 * 1600 * np.log(1600))


def timed_by_ratio(timed, chunk, rtol, solver, second=1.0):
    """Records that took q seconds a point."""
    return that_took(second * float(chunk.table["q"].sum()), chunk.table)


def that_took(seconds, table):
    """Records of points for which a worker took some seconds."""
    return replace(Records.missing(table), runs=(Run("1", 1e-3, "", "", seconds=seconds),))


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.04, "0.0 s"),
        (9.9, "9.9 s"),
        (10, "10 s"),
        (59.4, "59 s"),
        (59.6, "1 min 0 s"),
        (3599, "59 min 59 s"),
        (3600, "1 h 0 min"),
        (7379, "2 h 2 min"),
        (360_000, "100 h 0 min"),
    ],
)
def test_durations(seconds, words):
    assert duration(seconds) == words


def test_long_cycles_weigh_more():
    text = 'title = "t"\n[axes]\nfrequency_ratio = [1, "2/3", "5/2"]\n'
    table = unique_points(Study.from_text(text).grid).table
    assert sorted(weights(table).tolist()) == [2, 5, 7]


@pytest.mark.slow
def test_studies_share_their_workers_and_finish_one_after_the_other(tmp_path):
    studies = [
        Study.from_text(f'title = "{n}"\naxes.friction = {{ start = 0.1, stop = 0.{n}, num = 150 }}\n')
        for n in (3, 4, 5)
    ]
    paths = [tmp_path / f"{n}.nc" for n in range(3)]
    found, threads = [], []

    def finished(study, path, dataset):
        assert path.exists()
        threads.append(threading.current_thread())
        found.append((study.title, path.name, frozenset(dataset.critical_x.values.tolist())))

    run_several(zip(studies, paths, strict=True), finished, workers=2, solver=stand_in.process)
    assert [each[:2] for each in found] == [("3", "0.nc"), ("4", "1.nc"), ("5", "2.nc")]
    processes = {each[2] for each in found}
    assert len(frozenset.union(*processes)) == 2
    assert os.getpid() not in frozenset.union(*processes)
    # Another thread writes while the workers compute the next study; at the end there is none.
    assert threads[0] is threads[1] is not threads[2] is threading.main_thread()
    assert not list(tmp_path.glob("*.parts"))


def test_an_error_in_one_study_leaves_the_others_whole(tmp_path):
    studies = [Study.from_text(f'title = "{n}"\naxes.friction = [0.1, 0.{n}]\n') for n in (3, 4, 5)]
    paths = [tmp_path / f"{n}.nc" for n in range(3)]
    paths[1].write_text("no archive")
    titles = []
    with pytest.raises(ArchiveError, match=r"1.nc"):
        run_several(
            zip(studies, paths, strict=True),
            lambda study, path, dataset: titles.append(study.title),
            solver=stand_in.smooth,
        )
    assert titles == ["3"]
    assert paths[0].exists()
    assert not paths[2].exists()
    assert not list(tmp_path.glob("*.parts"))


def printed(*lines):
    """What a Python process of its own prints."""
    command = [sys.executable, "-c", "\n".join(lines)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def test_the_solver_starts_without_scipy():
    # More than half of a worker's start; the profiles and fields that need it import it.
    found = printed(
        "import sys, swtstudy.runner.chunk, swtstudy.mechanics.solver",
        "print([name for name in sys.modules if name.startswith('scipy')])",
    )
    assert "scipy.special" not in found
    assert "scipy.optimize" not in found


def test_workers_start_before_this_process_has_imported_what_archives_need(tmp_path):
    found = printed(
        "import sys; from swtstudy import Study; from swtstudy.runner import run, workers",
        "def start(count):",
        "    print('xarray' in sys.modules, 'swtstudy.mechanics.solver' in sys.modules)",
        "    raise OSError('enough')",
        "workers.start_workers = start",
        "study = Study.from_text('title = \"a\"\\n[axes]\\nphase = {start = 0, stop = 3, num = 2000}\\n')",
        "try:",
        f"    run.run(study, {str(tmp_path / 'a.nc')!r})",
        "except OSError as error: print(error)",
    )
    assert found.splitlines()[0] == "False False"
    assert "enough" in found.splitlines()[1]


def test_writing_an_archive_imports_no_cluster(tmp_path):
    found = printed(
        "import sys; from pathlib import Path; import xarray as xr; from swtstudy.archive.netcdf import save",
        f"save(xr.Dataset({{'a': ('x', [0.5])}}), Path({str(tmp_path / 'a.nc')!r}))",
        "print('distributed' in sys.modules)",
    )
    assert found == "False"
    assert float(xr.open_dataset(tmp_path / "a.nc").a[0]) == 0.5


def test_workers_are_gone_after_the_block():
    with LocalPool(1) as pool:
        worker = pool.submit(os.getpid).result()
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


@pytest.mark.parametrize("workers", [0, -5, 1.5, "two"])
def test_there_must_be_workers(wide, tmp_path, workers):
    with pytest.raises(StudyError, match=r"^workers: found .*; allowed: a number of processes, from 1 on"):
        run(wide, tmp_path / "none.nc", workers=workers)
