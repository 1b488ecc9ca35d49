"""Studies in units of the user's own: runs that end early, go on and are extended."""

import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import stand_in
import xarray as xr
from folders import TESTS
from real import STUDY, plain

from swtstudy import Study, open_results, run
from swtstudy.archive.merge import merge
from swtstudy.archive.netcdf import save
from swtstudy.archive.run import Stopped

#: Without what takes time beside s.
SHORT = plain("critical_distance")
#: At one phase.
HALF = STUDY.replace('[0, "pi/2"]', "[0]")


@pytest.mark.slow
def test_archives_resume_and_extend(tmp_path, solved):
    path, solved = tmp_path / "sphere.nc", solved.isel(phase=[0])
    with pytest.raises(Stopped, match="2 of 4 distinct points are saved"):
        run(Study.from_text(HALF), path, workers=1, solver=_StopsAfter(2))
    partial = open_results(path)
    assert int(partial.SWT.notnull().sum()) == 2
    found = run(Study.from_text(HALF), path, workers=1)
    np.testing.assert_array_equal(found.s, solved.s)
    np.testing.assert_array_equal(found.SWT_line, solved.SWT_line)
    assert "2 of 4 distinct points computed" in found.attrs["history"]
    more = (
        HALF.replace("[150, 200]", "[150, 200, 250]")
        .replace("critical_distance = 0.05", "")
        .replace("[axes]", "[axes]\ncritical_distance = [0.02, 0.05]")
        .replace('"SWT_volume", ', "")
    )
    longer = run(Study.from_text(more), path, workers=1)
    np.testing.assert_array_equal(longer.SWT.sel(normal_force=[150, 200]), solved.SWT)
    kept = longer.SWT_point.sel(normal_force=[150, 200], critical_distance=0.05)
    np.testing.assert_array_equal(kept, solved.SWT_point)
    history = "6 of 6 distinct points computed, 4 of them for quantities that they lacked"
    assert history in longer.attrs["history"]
    assert longer.SWT_volume.notnull().all()
    # The same bodies with others units: everything is known.
    changed = run(Study.from_text(HALF.replace("927", "800")), path, workers=1)
    assert "0 of 4 distinct points computed" in changed.attrs["history"]
    assert (changed.cycles < solved.cycles).all()
    np.testing.assert_array_equal(changed.dissipation, solved.dissipation)


class _StopsAfter:
    """The solver, which is interrupted after some points."""

    def __init__(self, points):
        self.left = points

    def __call__(self, points, rtol):
        from swtstudy.solver.points import solve_points

        if self.left <= 0:
            raise KeyboardInterrupt
        self.left -= len(points)
        return solve_points(points, rtol)


@pytest.mark.slow
def test_archives_are_merged(tmp_path):
    parts = [SHORT.replace("[150, 200]", "[150]"), SHORT.replace("[150, 200]", "[200]")]
    for index, text in enumerate(parts):
        run(Study.from_text(text), tmp_path / f"{index}.nc", workers=1, solver=stand_in.smooth)
    whole = run(Study.from_text(SHORT), tmp_path / "whole.nc", workers=1, solver=stand_in.smooth)
    merged = merge([tmp_path / "0.nc", tmp_path / "1.nc"])
    for name in ("s", "SWT", "cycles", "contact_radius"):
        np.testing.assert_allclose(merged[name], whole[name], rtol=1e-9)
    assert Study.from_text(merged.attrs["study"]).grid.shape == (2, 2, 2)
    other = SHORT.replace('"MPa"', '"N/mm²"')
    run(Study.from_text(other), tmp_path / "other.nc", workers=1, solver=stand_in.smooth)
    with pytest.raises(
        ValueError, match=r"with other units cannot be merged: those in .*0.nc and in .*other.nc"
    ):
        merge([tmp_path / "0.nc", tmp_path / "1.nc", tmp_path / "other.nc"])
    stronger = SHORT.replace("strength = 927", "strength = 900\nyield_strength = 350")
    run(Study.from_text(stronger), tmp_path / "other.nc", workers=1, solver=stand_in.smooth)
    with pytest.raises(ValueError, match="with other materials and yield strengths cannot be merged"):
        merge([tmp_path / "0.nc", tmp_path / "other.nc"])


def test_the_contact_of_an_archive_is_checked(tmp_path):
    run(Study.from_text(SHORT), tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    found = open_results(tmp_path / "a.nc")
    raw = json.loads(found.attrs["contact"])
    wrong = found.assign_attrs(contact=json.dumps({**raw, "materials": [1]}))
    save(wrong, tmp_path / "b.nc")
    with pytest.raises(ValueError, match=r"attribute contact: found .*not a contact"):
        open_results(tmp_path / "b.nc")
    lacking = found.drop_vars("friction")
    save(lacking, tmp_path / "c.nc")
    with pytest.raises(ValueError, match="friction: found nothing"):
        open_results(tmp_path / "c.nc")
    save(found.assign_coords(depth=1e-3), tmp_path / "d.nc")
    with pytest.raises(ValueError, match="depth, normal_force: found both; allowed: one of the two"):
        open_results(tmp_path / "d.nc")
    assert xr.open_dataset(tmp_path / "a.nc").SWT.attrs["units"] == "MPa"


KILLED = """
import os, signal, sys, time
import swtstudy
from swtstudy.solver.points import solve_points
from swtstudy.archive import run

run.PART_SECONDS = 0.0
left = [2]

def solver(points, rtol):
    if left[0] <= 0:
        time.sleep(1.0)  # what is found before is saved by then
        os.kill(os.getpid(), signal.SIGKILL)
    left[0] -= len(points)
    return solve_points(points, rtol)

swtstudy.run(swtstudy.Study.from_toml(sys.argv[1]), sys.argv[2], workers=1, solver=solver)
"""


@pytest.mark.slow
def test_a_killed_run_goes_on(tmp_path, solved):
    (tmp_path / "sphere.toml").write_text(HALF)
    path, solved = tmp_path / "sphere.nc", solved.isel(phase=[0])
    words = (KILLED, tmp_path / "sphere.toml", path)
    environment = os.environ | {"PYTHONPATH": str(TESTS)}
    command = [sys.executable, "-c", *map(str, words)]
    done = subprocess.run(command, capture_output=True, check=False, env=environment)
    assert done.returncode == -signal.SIGKILL, done.stderr
    assert not path.exists()
    found = run(Study.from_text(HALF), path, workers=1)
    assert "2 of 4 distinct points computed" in found.attrs["history"]
    for name in solved.data_vars:
        np.testing.assert_array_equal(found[name], solved[name], err_msg=name)


def test_an_archive_without_the_radius_says_so(solved, tmp_path):
    save(solved.drop_vars("radius"), tmp_path / "t.nc")
    with pytest.raises(ValueError, match=r"t\.nc: radius: found nothing"):
        open_results(tmp_path / "t.nc")
