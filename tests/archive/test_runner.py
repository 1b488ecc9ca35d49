import io
import itertools
import os
import re
import subprocess
import sys
import threading
import time
import types
from functools import partial

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import Terminal
from folders import ROOT, TESTS

import swtstudy
from swtstudy import Study, StudyError, run, run_suite

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


@pytest.mark.parametrize("processes", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_workers_give_what_one_thread_gives(wide, tmp_path, processes):
    here = run(wide, tmp_path / "here.nc", solver=stand_in.smooth, workers=1)
    there = run(wide, tmp_path / "there.nc", solver=stand_in.slow, processes=processes)
    for name in here.data_vars:
        np.testing.assert_array_equal(here[name], there[name])


def test_threads_share_the_work(wide, tmp_path):
    """Each of two threads waits until the other one is there, too."""
    both = threading.Barrier(2, timeout=600)
    calls, met = itertools.count(), []

    def solver(points, rtol):
        if next(calls) < 2:  # `met` may be short of one when a thread comes back
            met.append(both.wait())
        return stand_in.smooth(points, rtol)

    dataset = run(wide, tmp_path / "wide.nc", solver=solver)
    assert sorted(met) == [0, 1]
    assert np.isfinite(dataset.s).all()


@pytest.mark.parametrize("workers", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_work_is_shared_by_processes_with_one_thread_each(wide, tmp_path, monkeypatch, workers):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    environment, script = dict(os.environ), sys.modules["__main__"]
    options = {"solver": stand_in.process, "workers": workers, "processes": True}
    dataset = run(wide, tmp_path / "wide.nc", **options)
    processes = set(np.abs(dataset.critical_x.values).ravel())
    assert len(processes) == workers
    assert os.getpid() not in processes
    assert (dataset.s == 1).all()
    # The workers are gone, and what they started with.
    for process in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(int(process), 0)
    assert dict(os.environ) == environment
    assert sys.modules["__main__"] is script


def test_symmetric_points_are_computed_once(small, tmp_path):
    counting = stand_in.Counting()
    dataset = run(small, tmp_path / "small.nc", solver=counting)
    assert counting.points == 2 * 4
    assert dataset.s.size == 2 * 9
    np.testing.assert_array_equal(dataset.s.isel(phase=0), dataset.s.isel(phase=4))
    np.testing.assert_array_equal(dataset.critical_x.isel(phase=0), -dataset.critical_x.isel(phase=4))


@pytest.mark.slow
def test_a_lost_worker_is_replaced(wide, tmp_path):
    """Processes give what a thread gives, even if one of them is killed."""
    here = run(wide, tmp_path / "here.nc", solver=stand_in.smooth, workers=1)
    solver = partial(stand_in.kill_once, str(tmp_path / "killed"))
    there = run(wide, tmp_path / "there.nc", solver=solver, workers=1, processes=True)
    assert (tmp_path / "killed").exists()
    for name in here.data_vars:
        np.testing.assert_array_equal(here[name], there[name])


def test_a_solver_that_workers_cannot_import_is_said(wide, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "made_here", types.ModuleType("made_here"))
    exec("def solver(points, rtol): pass", vars(sys.modules["made_here"]))
    with pytest.raises(OSError, match=r"a worker cannot .*made_here.*; 0 of 160 distinct points"):
        run(wide, tmp_path / "wide.nc", solver=sys.modules["made_here"].solver, workers=1, processes=True)


@pytest.mark.slow
def test_a_point_that_kills_its_worker_is_alone_in_failing(tmp_path):
    study = Study.from_text('title = "t"\n[axes]\nfriction = [0.1, 0.2, 0.3, 0.4]')
    solver = partial(stand_in.kill_at, 0.3)
    dataset = run(study, tmp_path / "t.nc", solver=solver, workers=1, processes=True)
    assert dataset.message.values.tolist() == [
        "",
        "",
        "the worker process died while it computed this point",
        "",
    ]
    assert np.flatnonzero(np.isnan(dataset.s)).tolist() == [2]


def test_a_run_shows_its_name_and_how_far_it_is_on_a_terminal(small, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    shown = terminal.getvalue().split("\r")
    assert re.match("small: +0%.* 0/8 ", shown[1])
    assert re.match("small: 100%.* 8/8 .* points/s", shown[-1])
    assert shown[-1].endswith("\n")


def taking(seconds, monkeypatch):
    """A solver that takes so many seconds, by the clock that measures progress."""
    now = [time.monotonic()]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])

    def solver(points, rtol):
        now[0] += seconds
        return stand_in.smooth(points, rtol)

    return solver


@pytest.mark.parametrize(("seconds", "shown"), [(1.0, ""), (3.0, "\r100%.* 2/2 ")])
def test_what_takes_no_more_than_two_seconds_shows_nothing(monkeypatch, seconds, shown):
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    monkeypatch.setattr(stand_in.SOLVER, taking(seconds, monkeypatch))
    swtstudy.solve(friction=[0.1, 0.2])
    assert re.match(shown, terminal.getvalue())
    assert bool(terminal.getvalue()) == bool(shown)


@pytest.mark.parametrize(("seconds", "lines"), [(0.0, 0), (31.0, 2)])
def test_a_log_has_a_line_now_and_then(small, tmp_path, monkeypatch, caplog, capfd, seconds, lines):
    caplog.set_level("INFO", logger="swtstudy")
    run(small, tmp_path / "small.nc", solver=taking(seconds, monkeypatch))
    assert capfd.readouterr() == ("", "")
    assert len(caplog.messages) == lines
    assert all(each.startswith("small: 8 of 8 points, ") for each in caplog.messages)


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
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    assert np.isfinite(dataset.s).all()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")
@pytest.mark.parametrize("closing", ["2>&-", "<&- >&- 2>&-"])
def test_the_command_does_without_closed_streams(tmp_path, closing):
    (tmp_path / "one.toml").write_text('title = "t"\nrtol = 1e-2\n')
    command = f'exec "{sys.executable}" -m swtstudy run one.toml {closing}'
    assert subprocess.run(command, shell=True, cwd=tmp_path, timeout=600).returncode == 0
    assert np.isfinite(swtstudy.open_results(tmp_path / "results" / "one.nc").s)


@pytest.mark.slow
def test_a_script_without_a_guard_is_run_once(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import sys; sys.path.insert(0, sys.argv[1])\nimport stand_in\nfrom swtstudy import Study, run\n"
        "print('begun', flush=True)\n"
        f"dataset = run(Study.from_text({WIDE!r}), 'wide.nc', solver=stand_in.slow, processes=True)\n"
        "print(int(dataset.s.notnull().sum()))\n"
    )
    command = [sys.executable, str(script), str(TESTS)]
    done = subprocess.run(command, cwd=tmp_path, timeout=600, capture_output=True, text=True)
    assert (done.stdout, done.stderr, done.returncode) == ("begun\n160\n", "", 0)


def suite(folder):
    """Three studies in a folder."""
    for n in (3, 4, 5):
        text = f'title = "{n}"\naxes.friction = {{ start = 0.1, stop = 0.{n}, num = 150 }}\n'
        (folder / f"{n}.toml").write_text(text)
    return folder, folder / "results"


@pytest.mark.slow
def test_studies_share_their_workers_and_finish_one_after_the_other(tmp_path):
    found = run_suite(*suite(tmp_path), workers=2, processes=True, solver=stand_in.process)
    assert [(name, each.title) for name, each in found.items()] == [("3", "3"), ("4", "4"), ("5", "5")]
    processes = {each for dataset in found.values() for each in dataset.critical_x.values.tolist()}
    assert len(processes) == 2
    assert os.getpid() not in processes
    assert not list((tmp_path / "results").glob("*.parts"))


def test_an_error_in_one_study_leaves_the_others_whole(tmp_path):
    folder, results = suite(tmp_path)
    results.mkdir()
    (results / "4.nc").write_text("no archive")
    with pytest.raises(ValueError, match=r"4.nc"):
        run_suite(folder, results, solver=stand_in.smooth)
    assert sorted(path.name for path in results.iterdir()) == ["3.nc", "4.nc"]
    assert np.isfinite(swtstudy.open_results(results / "3.nc").s).all()


def test_an_archive_that_cannot_be_written_is_told_once(tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, "dump_to_store", full)
    with pytest.raises(OSError, match=r"^cannot write the archive .*3\.nc") as caught:
        run_suite(*suite(tmp_path), solver=stand_in.smooth)
    assert str(caught.value).count("distinct points are saved") == 1


def test_an_archive_that_cannot_be_written_is_told_where_the_next_study_is_stopped(tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    def stopped(points, rtol):
        if points.friction.max() > 0.3 + 1e-9:  # beyond the first study
            raise KeyboardInterrupt
        return stand_in.smooth(points, rtol)

    monkeypatch.setattr(xr.Dataset, "dump_to_store", full)
    with pytest.raises(OSError, match=r"^cannot write the archive .*3\.nc"):
        run_suite(*suite(tmp_path), solver=stopped)


#: Prints what of scipy a worker imports, and whether distributed is there once an archive is written.
IMPORTS = """
import sys
import swtstudy.points.chunk, swtstudy.kernel.batch
print(*(name for name in sys.modules if name.startswith("scipy")))
import swtstudy, stand_in
swtstudy.run(swtstudy.Study.from_text('title = "t"'), sys.argv[1], solver=stand_in.smooth)
print("distributed" in sys.modules)
"""


@pytest.mark.slow
def test_workers_start_without_scipy_and_archives_are_written_without_distributed(tmp_path):
    command = [sys.executable, "-c", IMPORTS, str(tmp_path / "a.nc")]
    options = {"capture_output": True, "text": True, "check": True}
    there = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), str(TESTS)])}
    of_scipy, cluster = subprocess.run(command, env=there, **options).stdout.splitlines()
    # More than half of a worker's start; the profiles and fields that need it import it.
    assert not {"scipy.special", "scipy.optimize"} & {*of_scipy.split()}
    assert cluster == "False"
    assert np.isfinite(xr.open_dataset(tmp_path / "a.nc").s)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        *(
            ({"workers": n}, "workers: found .*; allowed: a number of workers, from 1 on")
            for n in (0, 1.5, "two")
        ),
        ({"study": "figure3"}, "study: found 'figure3'; allowed: a Study"),
    ],
)
def test_what_a_run_cannot_use_is_named(wide, tmp_path, options, words):
    with pytest.raises(StudyError, match=f"^{words}"):
        run(**{"study": wide, "path": tmp_path / "none.nc", **options})
