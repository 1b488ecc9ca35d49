import os
import re
import socket
import subprocess
import sys
import threading
import time
from functools import partial

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import saved
from folders import TESTS

from swtstudy import Study, run

# The warnings of distributed about a killed worker are none of ours.
pytestmark = [pytest.mark.filterwarnings("default"), pytest.mark.slow]

WIDE = 'title = "t"\nrtol = 1e-3\n[axes]\nfriction = {start = "0.01", stop = 2, num = 400}\n'


@pytest.fixture(autouse=True)
def distributed():
    return pytest.importorskip("distributed")


@pytest.fixture
def client(distributed, tmp_path):
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path)
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def test_a_cluster_that_loses_a_worker_gives_what_one_process_gives(client, tmp_path):
    study = Study.from_text(WIDE)
    expected = run(study, tmp_path / "here.nc", solver=stand_in.smooth, workers=1)
    victim = next(iter(client.run(os.getpid).values()))
    killed = []

    def kill():
        time.sleep(0.5)
        os.kill(victim, 9)
        killed.append(victim)

    killer = threading.Thread(target=kill)
    killer.start()
    dataset = run(study, tmp_path / "there.nc", client=client, solver=stand_in.slow)
    killer.join()
    assert killed
    assert np.isfinite(dataset.s).all()
    xr.testing.assert_equal(dataset.drop_vars("run"), expected.drop_vars("run"))


def test_a_point_that_kills_the_workers_of_a_cluster_fails(client, tmp_path):
    study = Study.from_text('title = "t"\n[fixed]\nfriction = 0.3')
    client.run_on_scheduler(lambda dask_scheduler: setattr(dask_scheduler, "allowed_failures", 0))
    dataset = run(study, tmp_path / "t.nc", client=client, solver=partial(stand_in.kill_at, 0.3))
    assert dataset.message == "the worker process died while it computed this point"


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_a_cluster_without_workers_is_said_and_so_is_one_that_is_gone(tmp_path):
    path, port = tmp_path / "results" / "line.nc", free_port()
    address = f"tcp://127.0.0.1:{port}"
    (tmp_path / "line.toml").write_text(WIDE)
    code = (
        "import swtstudy.archive.workers as workers\nworkers.CHECK_SECONDS = 0.5\nimport stand_in\n"
        "from swtstudy.cli import main\nfrom swtstudy.archive import run\n"
        "run.run_several.__kwdefaults__['solver'] = stand_in.slow\n"
        f"main(['run', 'line.toml', '--scheduler', '{address}'])"
    )
    options = {"cwd": tmp_path, "env": os.environ | {"PYTHONPATH": str(TESTS)}, "text": True}
    quiet = options | {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    dask = [sys.executable, "-m", "dask"]
    command = [*dask, "scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]
    scheduler = subprocess.Popen(command, **quiet)
    worker = None
    try:
        wait_for(lambda: answers(port))
        with subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, **options) as process:
            assert process.stderr is not None
            lines = [process.stderr.readline() for _ in range(2)]
            worker = subprocess.Popen([*dask, "worker", address, "--no-nanny", "--no-dashboard"], **quiet)
            wait_for(lambda: saved(path))
            scheduler.kill()
            _, rest = process.communicate(timeout=60)
        assert lines[0].startswith("dashboard: ")
        assert lines[1] == "the cluster has no workers; waiting for some\n"
        gone = "Error: the dask scheduler is gone; [1-9][0-9]* of 400 distinct points are saved beside .*\n"
        assert re.fullmatch(gone, rest)
        assert process.returncode == 2
    finally:
        for each in filter(None, (scheduler, worker)):
            each.kill()
            each.wait()


def wait_for(condition) -> None:
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def answers(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
