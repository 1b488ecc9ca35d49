"""Compiled code: where it is kept, that it is compiled once, and what is said of it."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from folders import ROOT

#: A function whose first call compiles, in two threads; processes with an argument begin together.
FIRST_CALL = """
import sys, time
from pathlib import Path
from threading import Thread
from numba.core import event
from swtstudy.kernel.cache import FOLDER
from first_call import count
if len(sys.argv) > 1:
    Path(sys.argv[1]).touch()
    while not Path("go").exists():
        time.sleep(0.005)
threads = [Thread(target=count, args=[3]) for _ in range(2)]
with event.install_recorder("numba:compile") as made:
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
print(sum(each.is_start for _, each in made.buffer), FOLDER)
"""
MODULE = """
from swtstudy.kernel.compiled import jit

@jit
def count(n):
    total = 0
    for i in range(n):
        total += i
    return total
"""


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """A home and a temporary folder of its own."""
    (tmp_path / "first_call.py").write_text(MODULE)
    for name in ("home", "temporary"):
        (tmp_path / name).mkdir()
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("NUMBA_", "XDG_"))}
    folders = {"HOME": str(tmp_path / "home"), "TMPDIR": str(tmp_path / "temporary")}
    return kept | folders | {"PYTHONPATH": f"{ROOT}{os.pathsep}{tmp_path}"}


def start(
    tmp_path: Path, environment: dict[str, str], *arguments: str, **options: int
) -> subprocess.Popen[str]:
    """A process that makes the first call."""
    run = [sys.executable, "-c", FIRST_CALL, *arguments]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    return subprocess.Popen(run, cwd=tmp_path, env=environment, text=True, **options)  # type: ignore[call-overload]


def ended(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Functions compiled anew, and the folder; without a terminal nothing is said."""
    out, errors = process.communicate(timeout=120)
    assert (process.returncode, errors or "") == (0, "")
    misses, folder = out.rstrip("\n").split(" ", 1)
    return int(misses), folder


@pytest.mark.slow
def test_processes_and_threads_compile_once_and_remove_folders_not_used_for_long(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    base = tmp_path / "cache"
    environment["NUMBA_CACHE_DIR"] = str(base)
    for name, days in (("kernel-old", 31), ("kernel-recent", 29), ("of-somebody", 99)):
        (base / name).mkdir(parents=True)
        (base / name / "code").touch()
        os.utime(base / name, (time.time() - 86400 * days,) * 2)
    processes = [start(tmp_path, environment, name) for name in ("a", "b")]
    while not all((tmp_path / name).exists() for name in ("a", "b")):
        assert all(process.poll() is None for process in processes)
        time.sleep(0.01)
    (tmp_path / "go").touch()
    found = [ended(process) for process in processes]
    assert sorted(misses for misses, _ in found) == [0, 1]
    (folder,) = {Path(folder) for _, folder in found}
    assert {path.name for path in base.iterdir()} == {folder.name, "kernel-recent", "of-somebody"}


@pytest.mark.slow
def test_a_copy_of_the_package_elsewhere_compiles_nothing_anew(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    assert ended(start(tmp_path, environment))[0] == 1
    elsewhere = tmp_path / "elsewhere"
    shutil.copytree(ROOT / "swtstudy", elsewhere / "swtstudy", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.move(tmp_path / "first_call.py", elsewhere)
    assert ended(start(tmp_path, environment | {"PYTHONPATH": str(elsewhere)}))[0] == 0


@pytest.mark.parametrize("home", ["home", pytest.param("none", marks=pytest.mark.slow)])
def test_compiled_code_is_kept_where_one_can_write_and_a_terminal_is_told(
    tmp_path: Path, environment: dict[str, str], home: str
) -> None:
    # A file where the home should be: nobody can write below it, and the package is left alone.
    (tmp_path / "none").touch()
    copy = tmp_path / "package" / "swtstudy"
    shutil.copytree(ROOT / "swtstudy", copy, ignore=shutil.ignore_patterns("__pycache__"))
    environment |= {"HOME": str(tmp_path / home), "PYTHONPATH": f"{copy.parent}{os.pathsep}{tmp_path}"}
    environment["PYTHONDONTWRITEBYTECODE"] = "1"
    for folder in (copy / "kernel", copy):
        folder.chmod(0o555)
    before = sorted(copy.rglob("*"))
    misses, folder, heard = on_a_terminal(tmp_path, environment)
    assert (misses, heard) == (1, "compiling the solver, once, for up to a minute\r\n")
    assert Path(folder).is_relative_to(tmp_path / ("temporary" if home == "none" else "home"))
    assert on_a_terminal(tmp_path, environment) == (0, folder, "")
    assert sorted(copy.rglob("*")) == before
    for written in (copy, copy / "kernel"):
        written.chmod(0o755)


def on_a_terminal(tmp_path: Path, environment: dict[str, str]) -> tuple[int, str, str]:
    """Functions compiled anew in a process on a terminal, the folder, and what is told there."""
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    misses, folder = ended(start(tmp_path, environment, stderr=theirs))
    os.write(theirs, b".")
    words = b""
    while not words.endswith(b"."):
        words += os.read(ours, 1000)
    os.close(ours)
    os.close(theirs)
    return misses, folder, words.decode().removesuffix(".")


@pytest.mark.slow
def test_without_any_place_it_compiles_each_time(tmp_path: Path, environment: dict[str, str]) -> None:
    (tmp_path / "none").touch()
    environment |= {"HOME": str(tmp_path / "none"), "NUMBA_CACHE_DIR": str(tmp_path / "none" / "cache")}
    place = "import tempfile; tempfile.gettempdir = lambda: '/dev/null'\n"
    run = [sys.executable, "-c", place + FIRST_CALL]
    done = subprocess.run(run, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout.split()) == (0, ["1"]), done.stderr


READ_ONLY = """
import runpy
import sys
study = sys.argv[1]
for arguments in (["--help"], ["list"], ["validate", study]):
    sys.argv = ["swtstudy", *arguments]
    try:
        runpy.run_module("swtstudy", run_name="__main__")
    except SystemExit as end:
        assert not end.code
assert "numba" not in sys.modules
"""


@pytest.mark.slow
def test_a_study_is_checked_without_a_compiler(tmp_path: Path) -> None:
    """Those with forces are told where friction does not carry them, before anything is solved."""
    study = tmp_path / "forces.toml"
    study.write_text(
        'title = "forces"\n[fixed]\nnormal_force_amplitude = 0.4\nfrequency_ratio = "3/2"\n'
        "[axes]\ntangential_force_amplitude = [0.3, 0.65]\nphase = [0.0, 1.0]\n"
    )
    run = [sys.executable, "-c", READ_ONLY, str(study)]
    answer = subprocess.run(run, capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr
    assert "at 1 of 4 points: the tangential force is up to 1.01 times μ F_N" in answer.stderr


FIRST_VALUE = """
import sys
import swtstudy
swtstudy.solve(phase=1.0)
print({"numba.np.arraymath", "dask.array"} & sys.modules.keys())
"""


def test_a_value_by_code_that_is_kept_loads_nothing_that_it_does_not_need() -> None:
    for _ in range(2):  # the first one may compile
        run = [sys.executable, "-c", FIRST_VALUE]
        done = subprocess.run(run, capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
