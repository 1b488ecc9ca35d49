import os
import threading
import time

import numpy as np
import pytest
import stand_in
import xarray as xr

from swtstudy import Study, run

distributed = pytest.importorskip("distributed")
# Its own warnings about a killed worker are none of ours.
pytestmark = pytest.mark.filterwarnings("default")

WIDE = 'title = "t"\nrtol = 1e-3\n[axes]\nfriction = {start = "0.01", stop = 2, num = 400}\n'


@pytest.fixture
def client(tmp_path):
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
