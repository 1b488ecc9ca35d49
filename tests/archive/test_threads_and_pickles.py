"""Archives in several threads, and results that are sent to other processes."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
import stand_in
import xarray as xr
from told import RIG

import swtstudy
from swtstudy import Study, open_results, run

TEXT = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = [0.1, 0.25, 0.3, 0.5]\nphase = [0, 1, 2]\n'


def largest(dataset: xr.Dataset) -> float:
    return float(dataset.s.max())


def test_runs_in_several_threads_write_and_read_their_archives(tmp_path):
    def job(number):
        path = tmp_path / f"{number}.nc"
        for more in range(2):
            text = TEXT.replace("0.5]", f"0.5, {1 + more}]")
            run(Study.from_text(text), path, solver=stand_in.smooth)
            open_results(path)
        return open_results(path)

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(job, range(4)))
    for each in found:
        xr.testing.assert_equal(each.drop_vars("run"), found[0].drop_vars("run"))


def test_results_can_be_pickled_and_copied(tmp_path):
    computed = run(Study.from_text(TEXT), tmp_path / "t.nc", solver=stand_in.smooth)
    opened = open_results(tmp_path / "t.nc")
    for dataset in (computed, opened, opened.isel(phase=0), opened.copy(deep=True)):
        xr.testing.assert_identical(pickle.loads(pickle.dumps(dataset)), dataset)
        xr.testing.assert_identical(copy.deepcopy(dataset), dataset)


@pytest.mark.slow
def test_results_go_through_a_process_pool(tmp_path):
    dataset = run(Study.from_text(TEXT), tmp_path / "t.nc", solver=stand_in.smooth)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        assert pool.submit(largest, dataset).result() == largest(dataset)


def test_numpy_may_raise_what_it_likes(tmp_path):
    """What counts as an error in NumPy is the caller's; the solver has values such as inf and NaN."""
    with np.errstate(all="raise"):
        dataset = run(Study.from_text(TEXT), tmp_path / "t.nc")
        amplitudes = {"normal_amplitude": [0, 0.25, 1.2], "tangential_amplitude": [0, 0.5, 2]}
        solved = swtstudy.solve(**amplitudes, flat_radius=0.5, profile="rounded_punch", rtol=1e-2)
        forces = {"normal_force_amplitude": [0, 0.5], "tangential_force_amplitude": [0, 0.5, 1.2]}
        pulled = swtstudy.solve(**forces, profile="cylinder", bulk_stress_amplitude=[0, 0.1], rtol=1e-2)
        loads = {"normal_force_amplitude": 20.0, "tangential_force_amplitude": [0.0, 60.0]}
        contact = swtstudy.physical(**RIG, normal_force=[200.0], **loads)
        real = contact.solve(yield_strength=325.0, rtol=1e-2)
    assert np.isfinite(dataset.s).all()
    assert np.isfinite(solved.s).all()
    assert np.isnan(pulled.s).sum() == 4
    assert np.isfinite(real.yield_ratio).all()
