import io
import itertools
import os
import re
import subprocess
import sys
import threading
import types
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from folders import TESTS
from solved import FAILED

import swtstudy
from swtstudy import Study, StudyError, run
from swtstudy.archive.describe import failures
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.run import run_several
from swtstudy.archive.workers import LOST_WORKER, LocalPool, WorkerError, _clean_start
from swtstudy.vocabulary import progress
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.wording import duration

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
    both = threading.Barrier(2, timeout=60)
    calls, met = itertools.count(), []

    def solver(points, rtol):
        if next(calls) < 2:  # `met` may be short of one when a thread comes back
            met.append(both.wait())
        return stand_in.smooth(points, rtol)

    dataset = run(wide, tmp_path / "wide.nc", solver=solver)
    assert sorted(met) == [0, 1]
    assert np.isfinite(dataset.s).all()


@pytest.mark.slow
def test_work_is_shared_by_processes_with_one_thread_each(wide, tmp_path):
    dataset = run(wide, tmp_path / "wide.nc", solver=stand_in.process, processes=True)
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
    with pytest.raises(WorkerError, match=r"a worker cannot .*made_here.*; 0 of 160 distinct points"):
        run(wide, tmp_path / "wide.nc", solver=sys.modules["made_here"].solver, workers=1, processes=True)


@pytest.mark.slow
def test_a_point_that_kills_its_worker_is_alone_in_failing(tmp_path):
    study = Study.from_text('title = "t"\n[axes]\nfriction = [0.1, 0.2, 0.3, 0.4]')
    solver = partial(stand_in.kill_at, 0.3)
    dataset = run(study, tmp_path / "t.nc", solver=solver, workers=1, processes=True)
    assert dataset.message.values.tolist() == ["", "", LOST_WORKER, ""]
    assert np.flatnonzero(np.isnan(dataset.s)).tolist() == [2]


@pytest.mark.parametrize("solver", [stand_in.fail_at, stand_in.lose_at])
def test_one_failure_is_one_point(tmp_path, solver):
    study = Study.from_text('title = "t"\n[axes]\nfriction = {start = "0.1", stop = 1, num = 10}')
    dataset = run(study, tmp_path / "t.nc", solver=partial(solver, 0.3))
    assert np.flatnonzero(dataset.status == FAILED).tolist() == [2]
    assert np.flatnonzero(np.isnan(dataset.s)).tolist() == [2]
    ((where, _),) = failures(dataset)
    assert where == "friction=0.3"


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


def test_the_name_of_a_study_is_no_study(tmp_path):
    with pytest.raises(StudyError, match="study: found 'figure3'; allowed: a Study"):
        run("figure3", tmp_path / "figure3.nc")


def test_a_run_shows_its_name_and_how_far_it_is_on_a_terminal(small, tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    shown = terminal.getvalue().split("\r")
    assert re.match("small: +0%.* 0/8 ", shown[1])
    assert re.match("small: 100%.* 8/8 .* points/s", shown[-1])
    assert shown[-1].endswith("\n")


def test_what_takes_no_more_than_two_seconds_shows_nothing(monkeypatch):
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    with Progress(2, "quick") as quick:
        quick.add()
    assert terminal.getvalue() == ""
    with Progress(2, "slow") as slow:
        monkeypatch.setattr(slow, "_begin", slow._begin - 3.0)
        slow.add()
        assert re.match("\rslow: +50%", terminal.getvalue())


def test_a_log_has_a_line_now_and_then(monkeypatch, caplog, capfd):
    caplog.set_level("INFO", logger="swtstudy")
    monkeypatch.setattr(progress, "LINE_SECONDS", 0.0)
    with Progress(100, "long", delay=0.0) as counted:
        for _ in range(10):
            counted.add(10)
    assert capfd.readouterr() == ("", "")
    assert len(caplog.messages) == 11
    assert caplog.messages[-1].startswith("long: 100 of 100 points, ")


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
    assert subprocess.run(command, shell=True, cwd=tmp_path, timeout=60).returncode == 0
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


@pytest.mark.slow
def test_studies_share_their_workers_and_finish_one_after_the_other(tmp_path):
    studies = [
        Study.from_text(f'title = "{n}"\naxes.friction = {{ start = 0.1, stop = 0.{n}, num = 150 }}\n')
        for n in (3, 4, 5)
    ]
    paths = [tmp_path / f"{n}.nc" for n in range(3)]
    found = []

    def finished(study, path, dataset):
        assert path.exists()
        found.append((study.title, path.name, frozenset(dataset.critical_x.values.tolist())))

    solver = stand_in.process
    run_several(zip(studies, paths, strict=True), finished, workers=2, processes=True, solver=solver)
    assert [each[:2] for each in found] == [("3", "0.nc"), ("4", "1.nc"), ("5", "2.nc")]
    processes = {each[2] for each in found}
    assert len(frozenset.union(*processes)) == 2
    assert os.getpid() not in frozenset.union(*processes)
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


def test_an_archive_that_cannot_be_written_is_told_once(tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, "dump_to_store", full)
    pairs = [
        (Study.from_text(f'title = "{n}"\naxes.friction = [0.1, 0.{n}]\n'), tmp_path / f"{n}.nc")
        for n in (3, 4)
    ]
    with pytest.raises(OSError, match=r"^cannot write the archive .*3\.nc") as caught:
        run_several(pairs, lambda *_: None, solver=stand_in.smooth)
    assert str(caught.value).count("distinct points are saved") == 1


#: Prints what of scipy a worker imports, and whether distributed is there once an archive is written.
IMPORTS = """
import sys
from pathlib import Path
import swtstudy.points.chunk, swtstudy.kernel.batch
print(*(name for name in sys.modules if name.startswith("scipy")))
import xarray as xr
from swtstudy.archive.netcdf import save
save(xr.Dataset({"a": ("x", [0.5])}), Path(sys.argv[1]))
print("distributed" in sys.modules)
"""


def test_workers_start_without_scipy_and_archives_are_written_without_distributed(tmp_path):
    command = [sys.executable, "-c", IMPORTS, str(tmp_path / "a.nc")]
    of_scipy, cluster = subprocess.run(
        command, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    # More than half of a worker's start; the profiles and fields that need it import it.
    assert not {"scipy.special", "scipy.optimize"} & {*of_scipy.split()}
    assert cluster == "False"
    assert float(xr.open_dataset(tmp_path / "a.nc").a[0]) == 0.5


def test_workers_are_gone_after_the_block():
    with LocalPool(1) as pool:
        worker = pool.submit(os.getpid).result()
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


def test_a_client_is_one_of_dask(wide, tmp_path):
    with pytest.raises(StudyError, match=r"^client: found 'tcp://host:8786'; allowed: a Client of dask"):
        run(wide, tmp_path / "none.nc", client="tcp://host:8786")


@pytest.mark.parametrize("workers", [0, -5, 1.5, "two"])
def test_there_must_be_workers(wide, tmp_path, workers):
    with pytest.raises(StudyError, match=r"^workers: found .*; allowed: a number of workers, from 1 on"):
        run(wide, tmp_path / "none.nc", workers=workers)
