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

import numpy as np
import pytest
import stand_in
import xarray as xr
from click.testing import CliRunner
from folders import TESTS
from solved import COMPUTED, FAILED

from swtstudy import Study, open_results, run
from swtstudy.archive import parts as archive_parts
from swtstudy.archive import run as run_module
from swtstudy.archive import work
from swtstudy.archive import workers as workers_module
from swtstudy.archive.describe import failures
from swtstudy.archive.parts import kept_folder, parts_folder, points_saved, read_parts
from swtstudy.archive.paths import LockedError, locked
from swtstudy.archive.run import Stopped
from swtstudy.cli import main
from swtstudy.points import chunk

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


def same(one: xr.Dataset, other: xr.Dataset) -> None:
    xr.testing.assert_equal(one, other)


def test_a_stopped_run_goes_on_and_ends_as_if_undisturbed(line, tmp_path):
    path = tmp_path / "line.nc"
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    with pytest.raises(Stopped, match="of 400 distinct points are saved") as stopped:
        run(line, path, solver=stand_in.Interrupting(192), workers=1)
    saved = int(str(stopped.value).split()[1])
    assert 0 < saved <= 192
    assert not path.exists()
    partial_dataset = open_results(path)
    assert int((partial_dataset.status == COMPUTED).sum()) == saved
    assert int(np.isnan(partial_dataset.s).sum()) == 400 - saved
    rest = stand_in.Counting()
    same(run(line, path, solver=rest, workers=1), undisturbed)
    assert rest.points == 400 - saved
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["line.nc", "other.nc"]


def test_a_finished_study_is_not_touched(line, tmp_path):
    path = tmp_path / "line.nc"
    first = run(line, path, solver=stand_in.smooth, workers=1)
    stamp = path.stat().st_mtime_ns
    again = stand_in.Counting()
    xr.testing.assert_identical(run(line, path, solver=again), first)
    assert again.points == 0
    assert path.stat().st_mtime_ns == stamp


def test_an_extension_computes_only_what_is_new(tmp_path):
    path = tmp_path / "square.nc"
    small = run(square([0.1, 0.2, 0.3, 0.4], [0, 0.5, 1, 1.5]), path, solver=stand_in.smooth)
    counting = stand_in.Counting()
    # Written differently, the old values are still the old points.
    frictions = ["0.1", 0.1 + 0.1, 0.30000000000000004, "2/5", 0.5, 0.6]
    large = run(square(frictions, [0, 0.5, 1, 1.5]), path, solver=counting)
    assert counting.points == 8
    np.testing.assert_array_equal(large.s.isel(friction=slice(4)), small.s)
    assert len(json.loads(large.attrs["runs"])) == 2
    assert set(np.unique(large.run.isel(friction=slice(4)))) == {0}
    assert set(np.unique(large.run.isel(friction=slice(4, 6)))) == {1}
    assert large.attrs["history"].count("\n") == 1


def test_points_that_leave_a_study_are_kept_for_whoever_has_them(tmp_path, caplog):
    caplog.set_level("INFO", logger="swtstudy")
    path = tmp_path / "square.nc"
    first = run(square([0.1], [0.1, 0.2]), path, solver=stand_in.smooth)
    run(square([0.1], [0.1, 0.3]), path, solver=stand_in.smooth)
    assert f"1 points are not in this study: {kept_folder(path)} keeps them" in caplog.text
    run(square([0.1], [0.1, 0.4]), path, solver=stand_in.smooth)
    assert points_saved(kept_folder(path)) == 2
    info = CliRunner().invoke(main, ["info", str(path)])
    assert "  kept           2 distinct points of other studies" in info.output
    assert "unfinished" not in info.output
    counting = stand_in.Counting()
    every = run(square([0.1], [0.1, 0.2, 0.3, 0.4]), path, solver=counting)
    assert counting.points == 0
    same(every.sel(phase=[0.1, 0.2]).drop_vars("run"), first.drop_vars("run"))
    assert every.attrs["computing_time_seconds"] == pytest.approx(
        sum(run["seconds"] for run in json.loads(every.attrs["runs"])), abs=1e-3
    )
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["square.nc"]


def test_the_time_of_a_run_is_told_once(tmp_path):
    path = tmp_path / "square.nc"
    wide, narrow = square([0.1, 0.2], [0, 1]), square([0.1], [0, 1])
    (first,) = json.loads(run(wide, path, solver=stand_in.smooth).attrs["runs"])
    for study in (narrow, square([0.3], [0, 1]), narrow, wide):
        last = run(study, path, solver=stand_in.smooth)
    (kept,) = json.loads(last.attrs["runs"])
    # It is told in µs, and rounded each time that it is read and written.
    assert kept.pop("seconds") == pytest.approx(first.pop("seconds"), abs=5e-6)
    assert kept == first


def test_an_interrupted_study_is_kept_while_another_is_run(line, tmp_path):
    path = tmp_path / "line.nc"
    other = square([0.5, 0.6], [1, 2])
    saved = 0
    for _ in range(2):  # beside no archive, and beside a finished one
        with pytest.raises(Stopped):
            run(line, path, solver=stand_in.Interrupting(192), workers=1)
        saved += points_saved(parts_folder(path))
        run(other, path, solver=stand_in.smooth, workers=1)
        assert points_saved(kept_folder(path)) == saved > 0
        assert not parts_folder(path).exists()
        assert int(work.assess(line, path).todo.sum()) == 400 - saved


def test_points_that_are_kept_outlive_a_kill_at_any_moment(tmp_path, monkeypatch):
    path = tmp_path / "square.nc"
    wide, narrow = square([0.1, 0.2], [0, 1]), square([0.1], [0, 1])
    run(wide, path, solver=stand_in.smooth)
    run(narrow, path, solver=stand_in.smooth)

    def killed(*_, **__):
        raise KeyboardInterrupt

    for study in (wide, narrow):
        for place in (xr.Dataset, "dump_to_store"), (archive_parts, "_remove"):
            monkeypatch.setattr(*place, killed)
            with pytest.raises(KeyboardInterrupt):
                run(study, path, solver=stand_in.smooth)
            monkeypatch.undo()
            counting = stand_in.Counting()
            assert int(work.assess(wide, path).todo.sum()) == 0
        run(study, path, solver=counting)
        assert counting.points == 0
    assert points_saved(kept_folder(path)) == len(read_parts(kept_folder(path))) == 2


def test_only_what_is_too_coarse_is_computed_again(tmp_path):
    path = tmp_path / "square.nc"
    run(square([0.1, 0.2], [0, 1], rtol=1e-3), path, solver=stand_in.smooth)
    run(square([0.1, 0.2, 0.3], [0, 1], rtol=1e-3), path, solver=stand_in.smooth)
    looser, tighter = stand_in.Counting(), stand_in.Counting()
    run(square([0.1, 0.2, 0.3], [0, 1], rtol=1e-2), path, solver=looser)
    assert looser.points == 0
    dataset = run(square([0.1, 0.2, 0.3], [0, 1], rtol=1e-4), path, solver=tighter)
    assert tighter.points == 6
    assert [run["rtol"] for run in json.loads(dataset.attrs["runs"])] == [1e-4]


def test_another_solver_version_is_not_mixed_in(tmp_path, monkeypatch, caplog):
    path = tmp_path / "square.nc"
    run(square([0.1, 0.2], [0, 1]), path, solver=stand_in.smooth)
    monkeypatch.setattr("swtstudy.vocabulary.version.SOLVER_VERSION", "next")
    for module in (chunk, run_module, workers_module, work):
        monkeypatch.setattr(module, "SOLVER_VERSION", "next")
    counting = stand_in.Counting()
    dataset = run(square([0.1, 0.2, 0.3], [0, 1]), path, solver=counting)
    assert counting.points == 6
    assert "4 points come from another version of the solver" in caplog.text
    assert [run["solver_version"] for run in json.loads(dataset.attrs["runs"])] == ["next"]


def test_a_failed_point_is_one_point(tmp_path, line):
    path = tmp_path / "line.nc"
    dataset = run(line, path, solver=partial(stand_in.fail_at, 0.3), workers=1)
    assert int(np.isfinite(dataset.s).sum()) == 399
    assert [*failures(dataset)] == [("friction=0.3", "ZeroDivisionError: an injected failure")]
    assert dataset.status.sel(friction=0.3, method="nearest").item() == FAILED
    # It is not tried again unless that is asked for, and its message is not lost.
    counting = stand_in.Counting()
    text = LINE.replace("title", "# grown\ntitle")
    dataset = run(Study.from_text(text), path, solver=counting, workers=1)
    assert counting.points == 0
    assert len([*failures(dataset)]) == 1
    dataset = run(line, path, solver=counting, retry_failed=True, workers=1)
    assert counting.points == 1
    assert np.isfinite(dataset.s).all()
    assert [*failures(dataset)] == []


def test_a_damaged_part_is_computed_again(line, tmp_path, caplog):
    path = tmp_path / "line.nc"
    with pytest.raises(Stopped):
        run(line, path, solver=stand_in.Interrupting(192), workers=1)
    for part in parts_folder(path).glob("*.npz"):
        part.write_bytes(part.read_bytes()[:-100])
        break
    dataset = run(line, path, solver=stand_in.smooth, workers=1)
    assert np.isfinite(dataset.s).all()
    assert "will be computed again" in caplog.text


def test_a_part_that_cannot_be_read_now_is_there_for_later(line, tmp_path, monkeypatch):
    path = tmp_path / "line.nc"
    for _ in range(2):
        with pytest.raises(Stopped):
            run(line, path, solver=stand_in.Interrupting(96), workers=1)
    saved, first = points_saved(parts_folder(path)), min(parts_folder(path).glob("*.npz"))
    read = archive_parts.Path.read_bytes

    def unreadable(part):
        if part == first:
            raise OSError(5, "Input/output error")
        return read(part)

    monkeypatch.setattr(archive_parts.Path, "read_bytes", unreadable)
    with pytest.raises(Stopped):
        run(line, path, solver=stand_in.Interrupting(0), workers=1)
    assert 0 < points_saved(parts_folder(path)) < saved
    monkeypatch.undo()
    assert points_saved(parts_folder(path)) == saved


def test_a_full_disk_stops_the_run_but_loses_nothing(line, tmp_path, monkeypatch):
    path = tmp_path / "line.nc"
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    fsync, calls = os.fsync, []

    def full(handle):
        calls.append(handle)
        if len(calls) > 2:
            raise OSError(28, "No space left on device")
        fsync(handle)

    monkeypatch.setattr(run_module, "PART_SECONDS", 0.05)
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match=r"No space left on device; \d+ of 400 distinct points are saved"):
        run(line, path, solver=stand_in.slow, workers=1)
    monkeypatch.undo()
    counting = stand_in.Counting()
    same(run(line, path, solver=counting, workers=1), undisturbed)
    assert 0 < counting.points < 400


def test_a_disk_too_full_for_the_archive_loses_nothing(line, tmp_path, monkeypatch):
    path = tmp_path / "line.nc"

    def full(*_, **__):
        raise RuntimeError("NetCDF: HDF error")

    monkeypatch.setattr(xr.Dataset, "dump_to_store", full)
    with pytest.raises(OSError, match="400 of 400 distinct points are saved"):
        run(line, path, solver=stand_in.smooth, workers=1)
    monkeypatch.undo()
    counting = stand_in.Counting()
    assert np.isfinite(run(line, path, solver=counting, workers=1).s).all()
    assert counting.points == 0


@pytest.mark.parametrize(
    "signals", [(signal.SIGINT, signal.SIGINT), pytest.param((signal.SIGTERM,), marks=pytest.mark.slow)]
)
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
    with pytest.raises(Stopped, match="0 of 400 distinct points"):
        run(line, tmp_path / "line.nc", solver=stand_in.smooth, workers=1)
    assert submitted == [True]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.1, r"cannot write the archive \(.*\); (400) of 400 distinct points"),
        (60.0, r"File too large; (0) of 400 distinct points"),  # one part, of all points
    ],
)
def test_a_file_that_cannot_grow_is_one_line_and_loses_nothing(tmp_path, seconds, words):
    path = tmp_path / "line.nc"
    before = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))\n"
        f"from swtstudy.archive import run; run.PART_SECONDS = {seconds}\n"
    )
    done = subprocess.run(command_of(tmp_path, LINE, before), timeout=60, capture_output=True, text=True)
    assert done.returncode == 2
    said = re.fullmatch(f"Error: {words} are saved beside .*; once that is fixed, .*\n", done.stderr)
    assert said
    assert points_saved(parts_folder(path)) == int(said[1])
    counting = stand_in.Counting()
    run(Study.from_text(LINE), path, solver=counting, workers=1)
    assert counting.points == 400 - int(said[1])


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
def test_a_killed_run_goes_on_and_ends_as_if_undisturbed(tmp_path):
    path, line = tmp_path / "line.nc", Study.from_text(LONG)
    undisturbed = run(line, tmp_path / "other.nc", solver=stand_in.smooth, workers=1)
    saved = 0
    for up_to in (1.0, 2.0, 3.0):
        with told_run(tmp_path, LONG, up_to) as process:
            heard(process, "saved")
            process.kill()
            process.wait()
            assert points_saved(parts_folder(path)) > saved
            saved = points_saved(parts_folder(path))
    assert not path.exists()
    same(run(line, path, solver=stand_in.smooth, workers=1), undisturbed)


def test_one_run_at_a_time(line, tmp_path):
    path = tmp_path / "line.nc"
    # The kernel's lock is per open file: another process, as a second run is, must be refused.
    code = (
        "import sys, time, pathlib\nfrom swtstudy.archive.paths import locked\n"
        "with locked(pathlib.Path(sys.argv[1])):\n    print('held', flush=True)\n    time.sleep(60)\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, str(parts_folder(path))], stdout=subprocess.PIPE, text=True
    ) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(LockedError, match=f"is being written by process {holder.pid}"):
            run(line, path, solver=stand_in.smooth, workers=1)
        holder.kill()
        holder.wait()
    # Nothing stale is left of it.
    assert np.isfinite(run(line, path, solver=stand_in.smooth, workers=1).s).all()


def test_the_lock_leaves_nothing(tmp_path):
    for _ in range(2):
        with locked(tmp_path / "folder"):
            assert (tmp_path / "folder" / "lock").exists()
        assert not (tmp_path / "folder").exists()


def test_workers_end_with_their_parent(tmp_path):
    code = (
        "import time\nfrom swtstudy.archive.workers import start_workers\n"
        "pool = start_workers(2)\npool.submit(int).result()\n"
        "print(*[p.pid for p in pool._processes.values()], flush=True)\ntime.sleep(60)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        workers = [int(word) for word in parent.stdout.readline().split()]
        parent.kill()
        parent.wait()
    assert workers
    gone(workers)


def test_an_archive_without_one_of_the_variables_says_so(line, tmp_path):
    path = tmp_path / "line.nc"
    run(line, path, solver=stand_in.smooth, workers=1).drop_vars("s_surface").to_netcdf(path)
    with pytest.raises(ValueError, match=r"line.nc: s_surface: found nothing; allowed: .*; move"):
        run(line, path, solver=stand_in.smooth, workers=1)


def test_a_file_that_is_no_archive_is_not_replaced(line, tmp_path):
    path = tmp_path / "line.nc"
    path.write_bytes(b"precious")
    with pytest.raises(ValueError, match="move it away"):
        run(line, path, solver=stand_in.smooth, workers=1)
    assert path.read_bytes() == b"precious"


def test_partial_results_of_an_extension(tmp_path, line):
    path = tmp_path / "line.nc"
    half = Study.from_text(LINE.replace("stop = 4, num = 400", "stop = 2, num = 200"))
    old = run(half, path, solver=stand_in.smooth, workers=1)
    with pytest.raises(Stopped):
        run(line, path, solver=stand_in.Interrupting(32), workers=1)
    same(open_results(path), old)
    both = open_results(path, partial=True)
    assert both.sizes == {"friction": 400}
    assert 200 < int((both.status == COMPUTED).sum()) < 400
    shutil.rmtree(parts_folder(path))
    same(open_results(path, partial=True), old)


#: Files that studies name, and studies that name them.
FILES = {
    "cycle.csv": "normal,tangential\n0.5,1\n-0.5,-1\n0,0.2\n",
    "worn.csv": "radius,height\n" + "".join(f"{r / 10},{max(r / 10 - 0.3, 0.0) ** 2}\n" for r in range(25)),
    "points.csv": "friction,phase\n" + "".join(f"{0.1 + k / 300},{k / 100}\n" for k in range(100)),
    "metals.toml": "[alloy]\nstrength = 927\nstrength_exponent = -0.113\nductility = 0.409\n"
    "ductility_exponent = -0.713\n",
}
FRICTIONS = '[axes]\nfriction = {start = "0.01", stop = 4, num = 100}\n'
OF_FILES = {
    "loads": '[fixed]\nload = "cycle"\n[loads.cycle]\nfile = "cycle.csv"\n' + FRICTIONS,
    "profiles": '[fixed]\nprofile = "worn"\n[profiles.worn]\nfile = "worn.csv"\nsmoothing = 1e-3\n'
    + FRICTIONS,
    "sample": '[sample]\nfile = "points.csv"\n',
    "material": '[units]\nlength = "mm"\nforce = "N"\nstress = "MPa"\n[material]\nfile = "metals.toml"\n'
    'name = "alloy"\n[fixed]\nyoung_modulus = 7e4\npoisson_ratio = 0.3\nradius = 50\nnormal_force = 100\n'
    "tangential_amplitude = 1e-3\n" + FRICTIONS,
}


@pytest.mark.parametrize("part", OF_FILES)
def test_what_is_left_of_a_run_needs_no_file_of_its_study(tmp_path, monkeypatch, part):
    folder, path = tmp_path / "studies", tmp_path / "results" / "study.nc"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text)
    (folder / "study.toml").write_text(f'title = "t"\nrtol = 1e-3\n{OF_FILES[part]}')
    study = Study.from_toml(folder / "study.toml")
    with pytest.raises(Stopped):
        run(study, path, solver=stand_in.Interrupting(32), workers=1)
    shutil.rmtree(folder)
    monkeypatch.chdir(tmp_path)
    left = open_results(path)
    assert 0 < int((left.status == COMPUTED).sum()) < 100
    again = Study.from_text(left.attrs["study"])
    assert again.grid == study.grid
    rest = stand_in.Counting()
    whole = run(again, path, solver=rest, workers=1)
    assert rest.points < 100
    same(whole.where(left.status == COMPUTED), left.where(left.status == COMPUTED))


def test_a_kill_while_parts_are_gathered_counts_no_point_twice(line, tmp_path):
    path = tmp_path / "line.nc"
    with pytest.raises(Stopped):
        run(line, path, solver=stand_in.Interrupting(192), workers=1)
    folder = parts_folder(path)
    saved = points_saved(folder)
    for part in list(folder.glob("*.npz")):
        shutil.copy(part, folder / f"{int(part.stem) + 500:06d}.npz")
    assert len(read_parts(folder)) == 2 * saved
    assert points_saved(folder) == saved
    rest = stand_in.Counting()
    run(line, path, solver=rest, workers=1)
    assert rest.points == 400 - saved
