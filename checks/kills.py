"""SIGKILLs at random moments of a run, and of the writing of its archive: what is lost.

python checks/kills.py > results/kills.txt
"""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

import xarray as xr

sys.path.insert(0, str(Path(__file__).parent))

from cheap import cheap, logged

from swtstudy import Study, open_results, run
from swtstudy.archive.parts import parts_folder, points_saved
from swtstudy.runner.run import Stopped

KILLS = 25

RUN = """
title = "2,000 points"
rtol = 1e-4
[axes]
phase = {start = 0, stop = 3, num = 100}
friction = {start = "0.05", stop = 1, num = 20}
"""

WRITE = """
title = "An archive that takes a while to write"
rtol = 1e-2
[axes]
phase = {start = 0, stop = 3, num = 1000}
friction = {start = "0.01", stop = %s, num = %d}
"""


def child(what: str, text: str, path: str, log: str) -> None:
    """What is killed: a run in a process of its own."""
    solver = partial(logged, log) if what == "run" else cheap
    run(Study.from_text(text), path, solver=solver)


def start(what: str, text: str, path: Path, log: Path) -> subprocess.Popen[bytes]:
    """Start such a process."""
    return subprocess.Popen([sys.executable, __file__, what, text, str(path), str(log)])


def workers_of(process: int) -> list[int]:
    """The worker processes of a process."""
    children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    return [int(each) for each in children if b"spawn_main" in Path(f"/proc/{each}/cmdline").read_bytes()]


def same_values(one: xr.Dataset, other: xr.Dataset) -> None:
    """Everything but the provenance is the same, to the last bit."""
    xr.testing.assert_equal(one.drop_attrs().drop_vars("run"), other.drop_attrs().drop_vars("run"))


def computed(log: Path) -> int:
    """Points that were ever computed to the end."""
    return sum(map(int, log.read_text().split())) if log.exists() else 0


def kills_of_runs(folder: Path, dice: random.Random) -> None:
    """Kill a run of 2,000 points, again and again, and let it end."""
    begin = time.perf_counter()
    expected = run(Study.from_text(RUN), folder / "undisturbed.nc")
    print(f"undisturbed run of {expected.s.size} points: {time.perf_counter() - begin:.1f} s")
    path, log = folder / "killed.nc", folder / "log"
    lost = saved_before = 0
    for kill in range(1, KILLS + 1):
        process = start("run", RUN, path, log)
        # From the first work of this process on: imports can take longer than the wait.
        whom = "a worker" if kill % 3 == 0 else "the parent"
        at = computed(log)
        while computed(log) == at and process.poll() is None:
            time.sleep(0.01)
        time.sleep(dice.uniform(0, 1.0))
        if process.poll() is not None:
            break
        if whom == "a worker":
            workers = workers_of(process.pid)
            subprocess.run(["kill", "-9", str(dice.choice(workers))], check=False)
            time.sleep(dice.uniform(0, 0.35))
        process.send_signal(signal.SIGKILL)
        process.wait()
        time.sleep(0.5)  # workers end on their own
        assert not path.exists()
        saved = points_saved(parts_folder(path))
        assert saved >= saved_before, "saved points were lost"
        total_lost = computed(log) - saved
        note = (
            f"kill {kill:2d} of {whom:10s}: {saved:4d} points saved, {total_lost - lost:3d} computed in vain"
        )
        print(note, flush=True)
        lost, saved_before = total_lost, saved
    final = run(Study.from_text(RUN), path, solver=partial(logged, str(log)))
    same_values(final, expected)
    assert not parts_folder(path).exists()
    print(f"all kills: {lost} points of {expected.s.size} computed in vain")
    print("the final archive has the very values of the undisturbed one\n")


def kills_of_writes(folder: Path, dice: random.Random) -> None:
    """Kill a run while it writes its archive over an older one."""
    small, large = WRITE % ("0.2", 20), WRITE % ("3", 300)
    path = folder / "written.nc"
    old = run(Study.from_text(small), path, solver=cheap)
    expected = run(Study.from_text(large), folder / "expected.nc", solver=cheap)
    # All is computed and saved; what is left is to write the archive.
    make_parts(large, path)
    duration = time_of_write(expected, folder)
    outcome = {"before": 0, "during": 0, "after": 0}
    kept = sorted(parts_folder(path).iterdir())
    saved = {part: part.read_bytes() for part in kept}
    for _ in range(KILLS):
        process = start("write", large, path, folder / "log")
        while process.poll() is None and not writing(path):
            time.sleep(0.002)
        time.sleep(dice.uniform(0, 4 * duration))
        during = writing(path)
        process.send_signal(signal.SIGKILL)
        process.wait()
        found = open_results(path)
        if found.sizes == old.sizes:
            same_values(found, old)
            outcome["during" if during else "before"] += 1
        else:
            same_values(found, expected)
            outcome["after"] += 1
            # Back to where it was, for the next kill.
            run(Study.from_text(small), path, solver=cheap)
            parts_folder(path).mkdir(exist_ok=True)
            for part, content in saved.items():
                part.write_bytes(content)
    print(f"{KILLS} kills around the write of an archive of {expected.s.size} points ({duration:.2f} s):")
    print(f"  {outcome['during']} with the file half written, {outcome['after']} after it was in place")
    print("  each time the file was the whole old archive or the whole new one")
    final = run(Study.from_text(large), path, solver=cheap)
    same_values(final, expected)
    print("  and the run that followed left the new one")


def make_parts(text: str, path: Path) -> None:
    """Stop a run when all is computed, before it writes its archive."""
    from swtstudy.archive import files

    save = files.save

    def stop(*_: object, **__: object) -> None:
        raise Stopped("before the archive")

    files.save = stop  # type: ignore[assignment]
    try:
        run(Study.from_text(text), path, solver=cheap)
    except Stopped:
        pass
    finally:
        files.save = save


def time_of_write(dataset: xr.Dataset, folder: Path) -> float:
    """Seconds that writing such an archive takes."""
    from swtstudy.archive.files import save

    begin = time.perf_counter()
    save(dataset, folder / "timed.nc")
    return time.perf_counter() - begin


def writing(path: Path) -> bool:
    """Whether an archive is being written: its unfinished file is there."""
    return any(parts_folder(path).glob(f".{path.stem}-*"))


def main() -> None:
    dice = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        kills_of_runs(Path(folder), dice)
        kills_of_writes(Path(folder), dice)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        child(*sys.argv[1:])
    else:
        main()
