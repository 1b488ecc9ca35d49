import json
import os
import re
import select
import shutil
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import call, saved
from folders import TESTS
from solved import COMPUTED, FAILED

from swtstudy import Study, open_results, run

#: Long cycles, so that a block has some thirty points.
LINE = (
    'title = "t"\nrtol = 1e-3\n[fixed]\nfrequency_ratio = "1/15"\n'
    '[axes]\nfriction = {start = "0.01", stop = 4, num = 400}\n'
)
#: So many that a run can be stopped several times.
LONG = LINE.replace("num = 400", "num = 3000")


#: The seconds after which a process that has not ended counts as stuck, on whatever machine.
STUCK = 3000


def square(frictions, phases, rtol=1e-3):
    axes = f"friction = {list(frictions)}\nphase = {list(phases)}\n"
    return Study.from_text(f'title = "t"\nrtol = {rtol}\n[axes]\n{axes}')


@pytest.fixture
def line():
    return Study.from_text(LINE)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "line.nc"


def beside(path, kind="parts"):
    """The folder of what is saved beside an archive."""
    return path.with_name(f"{path.name}.{kind}")


def stop(study, path, after):
    """Start a run that Ctrl-C stops after so many points; how many of them are saved."""
    with pytest.raises(KeyboardInterrupt, match=f"of {study.grid.size} distinct points are saved") as stopped:
        run(study, path, solver=stand_in.Interrupting(after), workers=1)
    return int(str(stopped.value).split()[1])


def computed(study, path, **options):
    """How many points a run computes, and its results."""
    counting = stand_in.Counting()
    dataset = run(study, path, solver=counting, **options)
    return counting.points, dataset


def failures(dataset):
    """Messages of the points that failed, and where these are."""
    at = np.flatnonzero(dataset.status == FAILED)
    return list(zip(dataset.friction.values[at], dataset.message.values[at], strict=True)) if at.size else []


def same(one: xr.Dataset, other: xr.Dataset) -> None:
    xr.testing.assert_equal(one, other)


def test_a_stopped_run_goes_on_and_ends_as_if_undisturbed(line, path, tmp_path):
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    known = stop(line, path, 192)
    assert 0 < known <= 192
    assert not path.exists()
    partial_dataset = open_results(path)
    assert int((partial_dataset.status == COMPUTED).sum()) == known
    assert int(np.isnan(partial_dataset.s).sum()) == 400 - known
    rest, dataset = computed(line, path, workers=1)
    same(dataset, undisturbed)
    assert rest == 400 - known
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["line.nc", "other.nc"]


def test_a_finished_study_is_not_touched(line, path):
    first = run(line, path, solver=stand_in.smooth, workers=1)
    stamp = path.stat().st_mtime_ns
    again, dataset = computed(line, path)
    xr.testing.assert_identical(dataset, first)
    assert again == 0
    assert path.stat().st_mtime_ns == stamp


def test_an_extension_computes_only_what_is_new(path):
    small = run(square([0.1, 0.2, 0.3, 0.4], [0, 0.5, 1, 1.5]), path, solver=stand_in.smooth)
    # Written differently, the old values are still the old points.
    frictions = ["0.1", 0.1 + 0.1, 0.30000000000000004, "2/5", 0.5, 0.6]
    count, large = computed(square(frictions, [0, 0.5, 1, 1.5]), path)
    assert count == 8
    np.testing.assert_array_equal(large.s.isel(friction=slice(4)), small.s)
    assert len(json.loads(large.attrs["runs"])) == 2
    assert set(np.unique(large.run.isel(friction=slice(4)))) == {0}
    assert set(np.unique(large.run.isel(friction=slice(4, 6)))) == {1}
    assert large.attrs["history"].count("\n") == 1


def test_points_that_leave_a_study_are_kept_for_whoever_has_them(path, caplog):
    caplog.set_level("INFO", logger="swtstudy")
    first = run(square([0.1], [0.1, 0.2]), path, solver=stand_in.smooth)
    run(square([0.1], [0.1, 0.3]), path, solver=stand_in.smooth)
    assert f"1 points are not in this study: {beside(path, 'kept')} keeps them" in caplog.text
    run(square([0.1], [0.1, 0.4]), path, solver=stand_in.smooth)
    info = call("info", path)
    assert "  kept           2 distinct points of other studies" in info.output
    assert "unfinished" not in info.output
    count, every = computed(square([0.1], [0.1, 0.2, 0.3, 0.4]), path)
    assert count == 0
    same(every.sel(phase=[0.1, 0.2]).drop_vars("run"), first.drop_vars("run"))
    assert every.attrs["computing_time_seconds"] == pytest.approx(
        sum(run["seconds"] for run in json.loads(every.attrs["runs"])), abs=1e-3
    )
    assert [*path.parent.iterdir()] == [path]


@pytest.mark.slow
def test_the_time_of_a_run_is_told_once(path):
    wide, narrow = square([0.1, 0.2], [0, 1]), square([0.1], [0, 1])
    (first,) = json.loads(run(wide, path, solver=stand_in.smooth).attrs["runs"])
    for study in (narrow, square([0.3], [0, 1]), narrow, wide):
        last = run(study, path, solver=stand_in.smooth)
    (kept,) = json.loads(last.attrs["runs"])
    # It is told in µs, and rounded each time that it is read and written.
    assert kept.pop("seconds") == pytest.approx(first.pop("seconds"), abs=5e-6)
    assert kept == first


def test_an_interrupted_study_is_kept_while_another_is_run(line, path):
    other = square([0.5, 0.6], [1, 2])
    kept = 0
    for _ in range(2):  # beside no archive, and beside a finished one
        stop(line, path, 192)
        kept += saved(path)
        run(other, path, solver=stand_in.smooth, workers=1)
        assert saved(path, "kept") == kept > 0
        assert not beside(path).exists()
    assert computed(line, path)[0] == 400 - kept


def test_points_that_are_kept_outlive_a_kill_at_any_moment(path, monkeypatch):
    wide, narrow = square([0.1, 0.2], [0, 1]), square([0.1], [0, 1])
    run(wide, path, solver=stand_in.smooth)
    run(narrow, path, solver=stand_in.smooth)

    def killed(*_, **__):
        raise KeyboardInterrupt

    for study in (wide, narrow):
        for place in ("xarray.Dataset.dump_to_store", "pathlib.Path.unlink"):
            monkeypatch.setattr(place, killed)
            with pytest.raises(KeyboardInterrupt):
                run(study, path, solver=stand_in.smooth)
            monkeypatch.undo()
        assert computed(study, path)[0] == 0
    assert saved(path, "kept") == 2
    assert computed(wide, path)[0] == 0


def test_only_what_is_too_coarse_is_computed_again(path):
    run(square([0.1, 0.2], [0, 1], rtol=1e-3), path, solver=stand_in.smooth)
    wider = partial(square, [0.1, 0.2, 0.3], [0, 1])
    run(wider(rtol=1e-3), path, solver=stand_in.smooth)
    assert computed(wider(rtol=1e-2), path)[0] == 0
    tighter, dataset = computed(wider(rtol=1e-4), path)
    assert tighter == 6
    assert [run["rtol"] for run in json.loads(dataset.attrs["runs"])] == [1e-4]


def test_another_solver_version_is_not_mixed_in(path, caplog):
    dataset = run(square([0.1, 0.2], [0, 1]), path, solver=stand_in.smooth)
    runs = dataset.attrs["runs"]
    dataset.assign_attrs(runs=runs.replace('"solver_version": "', '"solver_version": "0.')).to_netcdf(path)
    count, grown = computed(square([0.1, 0.2, 0.3], [0, 1]), path)
    assert count == 6
    assert "4 points come from another version of the solver" in caplog.text
    (own,), (now,) = json.loads(runs), json.loads(grown.attrs["runs"])
    assert now["solver_version"] == own["solver_version"]


def test_a_failed_point_is_one_point(path, line):
    dataset = run(line, path, solver=partial(stand_in.fail_at, 0.3), workers=1)
    assert int(np.isfinite(dataset.s).sum()) == 399
    assert failures(dataset) == [(pytest.approx(0.3), "ZeroDivisionError: an injected failure")]
    # It is not tried again unless that is asked for, and its message is not lost.
    count, dataset = computed(Study.from_text(f"# grown\n{LINE}"), path, workers=1)
    assert (count, len(failures(dataset))) == (0, 1)
    count, dataset = computed(line, path, retry_failed=True, workers=1)
    assert (count, failures(dataset)) == (1, [])
    assert np.isfinite(dataset.s).all()


def test_a_damaged_part_is_computed_again(line, path, caplog):
    stop(line, path, 192)
    part = next(beside(path).glob("*.npz"))
    part.write_bytes(part.read_bytes()[:-100])
    dataset = run(line, path, solver=stand_in.smooth, workers=1)
    assert np.isfinite(dataset.s).all()
    assert "will be computed again" in caplog.text


def test_a_part_that_cannot_be_read_now_is_there_for_later(line, path, monkeypatch):
    for _ in range(2):
        known = stop(line, path, 96)
    first, read = min(beside(path).glob("*.npz")), Path.read_bytes

    def unreadable(part):
        if part == first:
            raise OSError(5, "Input/output error")
        return read(part)

    monkeypatch.setattr(Path, "read_bytes", unreadable)
    assert 0 < stop(line, path, 0) < known
    assert 0 < saved(path) < known
    monkeypatch.undo()
    assert saved(path) == known


def test_a_full_disk_stops_the_run_but_loses_nothing(line, path, tmp_path, monkeypatch):
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    fsync, calls = os.fsync, []

    def full(handle):
        calls.append(handle)
        if len(calls) > 2:
            raise OSError(28, "No space left on device")
        fsync(handle)

    monkeypatch.setattr("swtstudy.archive.run.PART_SECONDS", 0.05)
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match=r"No space left on device; \d+ of 400 distinct points are saved"):
        run(line, path, solver=stand_in.slow, workers=1)
    monkeypatch.undo()
    count, dataset = computed(line, path, workers=1)
    same(dataset, undisturbed)
    assert 0 < count < 400


def test_a_disk_too_full_for_the_archive_loses_nothing(line, path, monkeypatch):
    def full(*_, **__):
        raise RuntimeError("NetCDF: HDF error")

    monkeypatch.setattr(xr.Dataset, "dump_to_store", full)
    with pytest.raises(OSError, match="400 of 400 distinct points are saved"):
        run(line, path, solver=stand_in.smooth, workers=1)
    monkeypatch.undo()
    count, dataset = computed(line, path, workers=1)
    assert np.isfinite(dataset.s).all()
    assert count == 0


@pytest.mark.slow
@pytest.mark.parametrize("signals", [(signal.SIGINT, signal.SIGINT), (signal.SIGTERM,)])
def test_ctrl_c_twice_or_sigterm_ends_a_run_cleanly(tmp_path, signals):
    first, *later = signals
    with told_run(tmp_path, LONG, up_to=1.0) as process:
        heard(process, "saved")
        children = workers_of(process.pid)
        process.send_signal(first)
        heard(process, "leaving")
        for each in later:
            process.send_signal(each)
        _, words = process.communicate("now leave\n")
    assert re.fullmatch(r"stopped; \d+ of 3000 distinct points are saved beside .*; the same .*\n", words)
    assert process.returncode == 130
    assert children
    gone(children)


def test_ctrl_c_in_the_midst_of_a_submission_comes_after_it(line, tmp_path, monkeypatch):
    """It would leave a lock of the executor closed, for which the process waits when it ends."""
    submit, submitted = ThreadPoolExecutor.submit, []

    def interrupted(*arguments):
        submitted.append(False)
        signal.raise_signal(signal.SIGINT)
        submitted[-1] = True
        return submit(*arguments)

    monkeypatch.setattr(ThreadPoolExecutor, "submit", interrupted)
    # A shell that starts the tests in the background has it ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with pytest.raises(KeyboardInterrupt, match="0 of 400 distinct points"):
        run(line, tmp_path / "line.nc", solver=stand_in.smooth, workers=1)
    assert submitted == [True]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.1, r"cannot write the archive \(.*\); (400) of 400 distinct points"),
        (60.0, r"File too large; (0) of 400 distinct points"),  # one part, of all points
    ],
)
def test_a_file_that_cannot_grow_is_one_line_and_loses_nothing(path, tmp_path, seconds, words):
    before = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))\n"
        f"from swtstudy.archive import run; run.PART_SECONDS = {seconds}\n"
    )
    done = subprocess.run(command_of(tmp_path, LINE, before), timeout=60, capture_output=True, text=True)
    assert done.returncode == 2
    said = re.fullmatch(f"Error: {words} are saved beside .*; once that is fixed, .*\n", done.stderr)
    assert said
    assert computed(Study.from_text(LINE), path, workers=1)[0] == 400 - int(said[1])


def command_of(folder, text, before=""):
    """`swtstudy run` of a study in a folder with the slow stand-in, as a process of its own."""
    (folder / "line.toml").write_text(text)
    code = (
        f"{before}import sys; sys.path.insert(0, sys.argv[1])\nimport stand_in\n"
        "from swtstudy.cli import main\nfrom swtstudy.archive import run\n"
        "run.run_several.__kwdefaults__['solver'] = stand_in.slow\n"
        "main(['run', sys.argv[2], '--results', sys.argv[3]])"
    )
    return [sys.executable, "-c", code, str(TESTS), str(folder / "line.toml"), str(folder)]


@contextmanager
def told_run(folder, text, up_to):
    """A run of a study in a folder that says what it does (`told_run.py`), killed in the end."""
    (folder / "line.toml").write_text(text)
    gate = folder / "gate"
    if not gate.exists():
        os.mkfifo(gate)
    script = str(TESTS / "told_run.py")
    command = [sys.executable, script, str(folder / "line.toml"), str(folder), str(up_to), str(gate)]
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with subprocess.Popen(command, **pipes, text=True) as process:
        try:
            yield process
        finally:
            process.kill()


def heard(process, word: str) -> None:
    """Return once a process has said a word."""
    assert any(line == f"{word}\n" for line in process.stdout), process.stderr.read()


def workers_of(process: int) -> list[int]:
    with open(f"/proc/{process}/task/{process}/children") as file:
        return [int(word) for word in file.read().split()]


def gone(processes: list[int]) -> None:
    """Return once none of the processes is there any more."""
    for each in processes:
        with suppress(ProcessLookupError):
            handle = os.pidfd_open(each)
            assert select.select([handle], [], [], STUCK)[0], f"process {each} goes on"
            os.close(handle)


@pytest.mark.slow
def test_a_killed_run_goes_on_and_ends_as_if_undisturbed(path, tmp_path):
    line, known = Study.from_text(LONG), 0
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    for up_to in (1.0, 2.0, 3.0):
        with told_run(tmp_path, LONG, up_to) as process:
            heard(process, "saved")
            process.kill()
            process.wait()
            assert saved(path) > known
            known = saved(path)
    assert not path.exists()
    same(run(line, path, solver=stand_in.smooth, workers=1), undisturbed)


def test_one_run_at_a_time(line, path):
    fcntl = pytest.importorskip("fcntl")
    beside(path).mkdir()
    # The kernel's lock is per open file, such as that of another run.
    with open(beside(path) / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        print("process 4321 on a computer", file=lock, flush=True)
        with pytest.raises(OSError, match=f"{path} is being written by process 4321 on a computer"):
            run(line, path, solver=stand_in.smooth, workers=1)
    # Nothing stale is left of it.
    assert np.isfinite(run(line, path, solver=stand_in.smooth, workers=1).s).all()
    assert [*path.parent.iterdir()] == [path]


@pytest.mark.slow
def test_workers_end_with_their_parent(tmp_path):
    with told_run(tmp_path, LINE, up_to=1.0) as process:
        heard(process, "saved")
        children = workers_of(process.pid)
        process.kill()
        process.wait()
    assert children
    gone(children)


def test_partial_results_of_an_extension(path, line):
    half = Study.from_text(LINE.replace("stop = 4, num = 400", "stop = 2, num = 200"))
    old = run(half, path, solver=stand_in.smooth, workers=1)
    stop(line, path, 32)
    same(open_results(path), old)
    both = open_results(path, partial=True)
    assert both.sizes == {"friction": 400}
    assert 200 < int((both.status == COMPUTED).sum()) < 400
    shutil.rmtree(beside(path))
    same(open_results(path, partial=True), old)


#: Files that studies name, and studies that name them.
FILES = {
    "cycle.csv": "normal,tangential\n0.5,1\n-0.5,-1\n0,0.2\n",
    "worn.csv": "radius,height\n" + "".join(f"{r / 10},{max(r / 10 - 0.3, 0.0) ** 2}\n" for r in range(25)),
    "points.csv": "friction,phase\n" + "".join(f"{0.1 + k / 300},{k / 100}\n" for k in range(100)),
    "metals.toml": "[alloy]\nstrength = 927\nstrength_exponent = -0.113\nductility = 0.409\n"
    "ductility_exponent = -0.713\n",
}
FRICTIONS = '[axes]\nfriction = {start = "0.01", stop = 2, num = 100}\n'
OF_FILES = {
    "loads": '[fixed]\nload = "cycle"\n[loads.cycle]\nfile = "cycle.csv"\n' + FRICTIONS,
    "profiles": '[fixed]\nprofile = "worn"\n[profiles.worn]\nfile = "worn.csv"\nsmoothing = 1e-3\n'
    + FRICTIONS,
    "sample": '[sample]\nfile = "points.csv"\n',
    "material": '[units]\nlength = "mm"\nforce = "N"\nstress = "MPa"\n[material]\nfile = "metals.toml"\n'
    'name = "alloy"\n[fixed]\nyoung_modulus = 7e4\npoisson_ratio = 0.3\nradius = 50\nnormal_force = 100\n'
    "tangential_amplitude = 1e-3\n" + FRICTIONS,
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("part", OF_FILES)
def test_what_is_left_of_a_run_needs_no_file_of_its_study(tmp_path, monkeypatch, part):
    folder, path = tmp_path / "studies", tmp_path / "results" / "study.nc"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text)
    (folder / "study.toml").write_text(f'title = "t"\nrtol = 1e-3\n{OF_FILES[part]}')
    study = Study.from_toml(folder / "study.toml")
    stop(study, path, 32)
    shutil.rmtree(folder)
    monkeypatch.chdir(tmp_path)
    left = open_results(path)
    assert 0 < int((left.status == COMPUTED).sum()) < 100
    again = Study.from_text(left.attrs["study"])
    assert again.grid == study.grid
    rest, whole = computed(again, path, workers=1)
    assert rest < 100
    same(whole.where(left.status == COMPUTED), left.where(left.status == COMPUTED))


def test_a_kill_while_parts_are_gathered_counts_no_point_twice(line, path):
    known = stop(line, path, 192)
    for part in list(beside(path).glob("*.npz")):
        shutil.copy(part, part.with_name(f"{int(part.stem) + 500:06d}.npz"))
    assert saved(path) == known
    assert computed(line, path, workers=1)[0] == 400 - known
