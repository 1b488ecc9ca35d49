"""Quantities on request: computed, stored and continued like s."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from asking import EVERY, VARIABLES, study
from command import saved

import swtstudy
from swtstudy import Study, open_results, run


def test_a_study_without_them_neither_computes_nor_stores_any(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(stand_in.QUANTITIES, None)
    found = run(study(), tmp_path / "a.nc", workers=1)
    assert not {*found.data_vars} & {*VARIABLES}
    assert "quantities" not in found.attrs["runs"]


def test_an_archive_gets_what_it_lacks_and_keeps_s(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    plain = run(study(), path, workers=1)
    more = run(study(quantities=("dissipation",)), path, workers=1)
    xr.testing.assert_equal(more[[*plain.data_vars]].drop_vars("run"), plain.drop_vars("run"))
    told = "4 of 4 distinct points computed, 4 of them for quantities that they lacked"
    assert told in more.attrs["history"]
    both = run(study(quantities=("stick_radius", "dissipation")), path, workers=1)
    at_once = swtstudy.solve(phase=both.phase.values, rtol=1e-3, quantities=EVERY)
    for name in ("dissipation", "dissipation_error", "stick_radius"):
        np.testing.assert_allclose(both[name], at_once[name], rtol=1e-9)
    (one,) = json.loads(both.attrs["runs"])
    assert one["quantities"] == ["stick_radius", "dissipation"]
    never = stand_in.Counting()
    xr.testing.assert_identical(
        both, run(study(quantities=("stick_radius", "dissipation")), path, solver=never)
    )
    assert never.points == 0


def test_an_extension_computes_them_at_the_new_points_alone(tmp_path: Path) -> None:
    path, asked = tmp_path / "a.nc", ("contact_radius", "force_ratio")
    run(study(axes="phase = [0.5, 1.0]", quantities=asked), path, workers=1)
    grown = run(study(quantities=asked), path, workers=1)
    assert "2 of 4 distinct points computed" in grown.attrs["history"].splitlines()[0]
    assert np.isfinite(grown.force_ratio).all()
    # What is asked no more is kept, not computed again.
    fewer = run(study(quantities=asked[:1]), path, workers=1)
    assert "force_ratio" not in fewer
    assert saved(path, "kept") == 4
    again = run(study(quantities=asked), path, workers=1)
    assert "0 of 4 distinct points computed" in again.attrs["history"].splitlines()[0]
    xr.testing.assert_equal(again.drop_vars("run"), grown.drop_vars("run"))
    assert [*tmp_path.iterdir()] == [path]


@pytest.mark.slow
def test_a_killed_run_goes_on_with_its_quantities(tmp_path: Path) -> None:
    file, axes = tmp_path / "a.toml", "phase = {start = 0.1, stop = 3, num = 150}\nfriction = [0.2, 0.3, 0.4]"
    file.write_text(study(axes=axes, quantities=EVERY).text)
    command = [sys.executable, "-m", "swtstudy", "run", str(file), "--results", str(tmp_path)]
    command += ["--workers", "1"]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    path = tmp_path / "a.nc"
    deadline = time.monotonic() + 60.0
    while not saved(path) and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.02)
    running.kill()
    running.wait()
    assert 0 < saved(path) < 450
    half = open_results(path)
    assert np.isfinite(half.dissipation.values[half.status.values == 0]).all()
    done = run(Study.from_toml(file), path, workers=1)
    direct = swtstudy.solve(phase=done.phase.values[::50], friction=[0.3], rtol=1e-3, quantities=EVERY)
    for name in VARIABLES:
        np.testing.assert_allclose(
            done[name].sel(friction=0.3)[::50], direct[name].isel(friction=0), 1e-9, 1e-14
        )


def test_a_point_at_which_one_fails_is_told_and_keeps_its_s(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "a.nc"
    plain = run(study(), path, workers=1)

    def failing(points, *_):
        if np.isclose(points.phase, 1.0).any():
            raise ArithmeticError("an injected failure")
        return {name: np.ones(len(points)) for name in ("dissipation", "dissipation_error")}

    monkeypatch.setattr(stand_in.QUANTITIES, failing)
    found = run(study(quantities=("dissipation",)), path, workers=1)
    assert found.status.values.tolist() == [0, 1, 0, 0]
    assert "an injected failure" in found.message.values[1]
    assert np.isnan(found.dissipation.values).tolist() == [False, True, False, False]
    np.testing.assert_array_equal(found.s, plain.s)
    monkeypatch.undo()
    mended = run(study(quantities=("dissipation",)), path, workers=1, retry_failed=True)
    assert np.isfinite(mended.dissipation).all()


@pytest.mark.usefixtures("unwrapped")
def test_figures_show_them_with_their_errors(tmp_path: Path) -> None:
    figure = '[figure]\nx = "phase"\ny = ["s", "dissipation"]\n'
    text = study(quantities=("dissipation",)).text + figure
    found = run(Study.from_text(text), tmp_path / "a.nc", workers=1)
    assert r"W/(\mu F_0" in found.swt.figure().axes[1].get_ylabel()
    found["dissipation_error"] = 0.1 * found.dissipation
    with_error, without = found.swt.panels("phase", y=["dissipation", "critical_x"]).axes
    band = with_error.collections[0].get_paths()[0].vertices
    assert band[:, 1].max() == pytest.approx(1.1 * float(found.dissipation.max()))
    assert not without.collections


def test_points_that_lack_some_are_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    run(study(), tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    with caplog.at_level("INFO"):
        stand_in.computed(study(quantities=("dissipation",)).text, tmp_path / "a.nc")
    assert "4 points are computed, but lack quantities that the study asks" in caplog.messages
