"""SIGKILLs at random moments of a run, and while its archive is written: what is lost.

python studies/checks/kills.py > results/kills.txt
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr
from cheap import cheap, logged
from two_thousand import same_values, study_text

from swtstudy import Study, open_results, run
from swtstudy.archive.parts import parts_folder, points_saved
from swtstudy.archive.run import Stopped
from swtstudy.vocabulary.arrays import IndexArray

WORKERS = 2

#: Chunks in flight in the pool of local workers.
IN_FLIGHT = 2 * WORKERS

WRITE = """
title = "An archive that takes a while to write"
rtol = 1e-2
[axes]
phase = {start = 0, stop = 3, num = 1000}
friction = {start = "0.01", stop = %s, num = %d}
"""


def child(what: str, text: str, path: str, log: str) -> None:
    """The process that is killed: a run."""
    from swtstudy.archive import run as run_module

    cut = run_module.cut

    def noted(*arguments: Any) -> list[IndexArray]:
        found = cut(*arguments)
        with open(f"{log}-chunks", "a") as file:
            file.writelines(f"{len(chunk)}\n" for chunk in found)
        return found

    run_module.cut = noted
    run_module.PART_SECONDS = run_module.PART_SHARE = 0.0  # saved at once
    run(Study.from_text(text), path, solver=partial(logged, log) if what == "run" else cheap, processes=True)


def start(what: str, text: str, path: Path, log: Path) -> subprocess.Popen[bytes]:
    """Start a process that runs `child`."""
    return subprocess.Popen([sys.executable, __file__, what, text, str(path), str(log)])


def workers_of(process: int) -> list[int]:
    """The worker processes of a process."""
    try:
        children = Path(f"/proc/{process}/task/{process}/children").read_text().split()
        return [int(each) for each in children if b"spawn_main" in Path(f"/proc/{each}/cmdline").read_bytes()]
    except OSError:  # it has ended
        return []


def computed(log: Path) -> int:
    """Number of points that have been computed, saved or not."""
    return sum(map(int, log.read_text().split())) if log.exists() else 0


def largest_chunk(log: Path) -> int:
    """Number of points in the largest chunk so far."""
    return max(map(int, Path(f"{log}-chunks").read_text().split()))


def kills_of_runs(folder: Path, text: str, limit: int, dice: random.Random) -> None:
    """Kill runs of a study repeatedly, and let each of them finish at last."""
    for name in ("first", "undisturbed"):  # the first one may compile
        begin = time.perf_counter()
        expected = run(Study.from_text(text), folder / f"{name}.nc")
        seconds = time.perf_counter() - begin
    print(f"undisturbed run of {expected.s.size} points on {WORKERS} workers: {seconds:.1f} s")
    print(
        f"{limit} kills, each at a random moment up to {0.5 * seconds:.1f} s after the first points of a run "
        "were computed;"
    )
    print(f"in flight are {IN_FLIGHT} chunks: with a worker, on the way to one, or on the way back")
    kills = rounds = all_lost = 0
    while kills < limit:
        rounds += 1
        path, log = folder / f"killed{rounds}.nc", folder / f"log{rounds}"
        saved = 0
        while kills < limit and saved < expected.s.size:
            before, done = saved, computed(log)
            Path(f"{log}-chunks").unlink(missing_ok=True)
            whom = "a worker" if kills % 3 == 2 else "the parent"
            if not kill_one(text, path, log, whom, dice.uniform(0, 0.5 * seconds), dice) or path.exists():
                break  # it had finished before, but for the end of its process perhaps
            kills += 1
            saved = points_saved(parts_folder(path))
            assert saved >= before, "saved points were lost"
            lost = computed(log) - done - (saved - before)
            # Chunks in flight are lost when a worker is killed, and again when the parent is killed.
            bound = (2 if whom == "a worker" else 1) * IN_FLIGHT * largest_chunk(log)
            assert lost <= bound, "more was lost than what was in flight"
            all_lost += lost
            print(
                f"run {rounds}, kill {kills:2d}, of {whom:10s}: {saved:4d} points saved "
                f"({saved - before:3d} more), {lost:3d} lost, at most {bound:3d} were in flight",
                flush=True,
            )
        final = run(Study.from_text(text), path, solver=partial(logged, str(log)))
        same_values(final, expected)
        assert not parts_folder(path).exists()
        print(f"run {rounds} ends with the very values of the undisturbed one, nothing else is left")
    print(f"{limit} kills: {all_lost} points lost, {all_lost / limit:.0f} a kill, and never a saved one\n")


def kill_one(text: str, path: Path, log: Path, whom: str, wait: float, dice: random.Random) -> bool:
    """Start a run, and kill it, or first one of its workers, some seconds after its first chunk.

    Returns whether it was still there to be killed.
    """
    process = start("run", text, path, log)
    at = computed(log)
    while computed(log) == at and process.poll() is None:
        time.sleep(0.01)
    time.sleep(wait)
    if whom == "a worker":
        workers = workers_of(process.pid)
        if workers:
            os.kill(dice.choice(workers), signal.SIGKILL)
        time.sleep(dice.uniform(0, 0.35))
    workers = workers_of(process.pid)
    process.send_signal(signal.SIGKILL)
    killed = process.wait() == -signal.SIGKILL
    while any(Path(f"/proc/{worker}").exists() for worker in workers):
        time.sleep(0.01)  # they end on their own
    return killed


def kills_of_writes(folder: Path, rows: int, limit: int, dice: random.Random) -> None:
    """Kill a run while it writes its archive over an older one."""
    small, large = WRITE % ("0.2", 20), WRITE % ("3", rows)
    path = folder / "written.nc"
    old = run(Study.from_text(small), path, solver=cheap, workers=1)
    expected = run(Study.from_text(large), folder / "expected.nc", solver=cheap, workers=1)
    # Everything is computed and saved; only the archive remains to be written.
    make_parts(large, path)
    duration = time_of_write(expected, folder)
    outcome = {"before": 0, "during": 0, "after": 0}
    kept = sorted(parts_folder(path).iterdir())
    saved = {part: part.read_bytes() for part in kept}
    for _ in range(limit):
        process = start("write", large, path, folder / "log")
        while process.poll() is None and not writing(path):
            time.sleep(0.002)
        time.sleep(dice.uniform(0, 6 * duration))
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
            # Back to the earlier state, for the next kill.
            run(Study.from_text(small), path, solver=cheap, workers=1)
            parts_folder(path).mkdir(exist_ok=True)
            for part, content in saved.items():
                part.write_bytes(content)
    print(f"{limit} kills around the write of an archive of {expected.s.size} points ({duration:.2f} s):")
    print(f"  {outcome['during']} with the file half written, {outcome['after']} after it was in place")
    print("  each time the file was the whole old archive or the whole new one")
    final = run(Study.from_text(large), path, solver=cheap, workers=1)
    same_values(final, expected)
    print("  and the run that followed left the new one")


def make_parts(text: str, path: Path) -> None:
    """Stop a run when everything is computed, before it writes its archive."""
    from swtstudy.archive import archive

    save = archive.save

    def stop(*_: object, **__: object) -> None:
        raise Stopped("before the archive")

    archive.save = stop  # type: ignore[assignment]
    try:
        run(Study.from_text(text), path, solver=cheap, workers=1)
    except Stopped:
        pass
    finally:
        archive.save = save


def time_of_write(dataset: xr.Dataset, folder: Path) -> float:
    """Seconds that writing such an archive takes."""
    from swtstudy.archive.archive import save

    begin = time.perf_counter()
    save(dataset, folder / "timed.nc")
    return time.perf_counter() - begin


def writing(path: Path) -> bool:
    """Whether an archive is being written: its unfinished file is there."""
    return any(parts_folder(path).glob(f".{path.stem}-*"))


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument(
        "--quick", action="store_true", help="one kill of a small study, to see that it runs"
    )
    quick = arguments.parse_args().quick
    dice, limit = random.Random(1), 1 if quick else 25
    with tempfile.TemporaryDirectory() as folder:
        kills_of_runs(Path(folder), study_text(quick), limit, dice)
        kills_of_writes(Path(folder), 30 if quick else 300, limit, dice)


if __name__ == "__main__":
    if sys.argv[1:2] in (["run"], ["write"]):
        child(*sys.argv[1:])
    else:
        main()
