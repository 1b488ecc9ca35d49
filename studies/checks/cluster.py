"""Runs on dask.distributed: a worker killed at work; a scheduler and workers started on their own.

python studies/checks/cluster.py > results/cluster.txt
"""

from __future__ import annotations

import argparse
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING

import xarray as xr
from two_thousand import same_values, study_text

from swtstudy import Study, open_results, run

if TYPE_CHECKING:
    from distributed import Client


def kill_at_work(client: Client, killed: list[int]) -> None:
    """Kill a worker as soon as one has work in hand."""
    processes, busy = client.run(os.getpid), []
    while not busy:
        time.sleep(0.02)
        busy = [address for address, tasks in client.processing().items() if tasks]
    killed.append(processes[busy[0]])
    os.kill(killed[0], signal.SIGKILL)


def killed_worker(folder: Path, text: str, expected: xr.Dataset, workers: int) -> None:
    """A LocalCluster of some workers, one of which is killed at work."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        killed: list[int] = []
        killer = threading.Thread(target=kill_at_work, args=(client, killed))
        killer.start()
        begin = time.perf_counter()
        found = run(Study.from_text(text), folder / "local-cluster.nc", client=client)
        print(f"LocalCluster, worker {killed} killed at work: {time.perf_counter() - begin:.1f} s")
        killer.join()
    same_values(found, expected)
    print("  the very values of the undisturbed run")


def separate_processes(folder: Path, text: str, expected: xr.Dataset, workers: int) -> None:
    """Run with `dask scheduler`, some `dask worker` and `swtstudy run --scheduler`, each a process."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    (folder / "study.toml").write_text(text)
    dask = [sys.executable, "-m", "dask"]
    options = {"cwd": folder, "stderr": subprocess.DEVNULL, "env": {**os.environ, "PYTHONPATH": os.getcwd()}}
    scheduler = [*dask, "scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]
    worker = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    processes = [subprocess.Popen(command, **options) for command in (scheduler, *[worker] * workers)]
    try:
        command = [sys.executable, "-m", "swtstudy", "run", "study.toml", "--scheduler", address]
        done = subprocess.run(command, **{**options, "stderr": None}, stdout=subprocess.PIPE, text=True)
        print(f"swtstudy run study.toml --scheduler {address}: exit code {done.returncode}")
        print("  " + done.stdout.strip())
        same_values(open_results(folder / "results" / "study.nc"), expected)
        print("  the very values of the undisturbed run")
    finally:
        for process in reversed(processes):
            process.terminate()
            process.wait()


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument(
        "--quick", action="store_true", help="a small study and one worker, to see that it runs"
    )
    quick = arguments.parse_args().quick
    text, workers = study_text(quick), 1 if quick else 2
    with tempfile.TemporaryDirectory() as name:
        begin = time.perf_counter()
        expected = run(Study.from_text(text), Path(name) / "local.nc", workers=workers)
        seconds = time.perf_counter() - begin
        print(f"{workers} local workers, undisturbed: {expected.s.size} points in {seconds:.1f} s")
        killed_worker(Path(name), text, expected, workers)
        separate_processes(Path(name), text, expected, workers)


if __name__ == "__main__":
    main()
