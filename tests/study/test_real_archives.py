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
from command import call, merged
from folders import ROOT, TESTS
from real import STUDY, plain

from swtstudy import Study, open_results, run

#: Without what takes time beside s.
SHORT = plain("critical_distance")
#: At one phase.
HALF = STUDY.replace('[0, "pi/2"]', "[0]")


@pytest.mark.slow
def test_archives_resume_and_extend(tmp_path):
    path = tmp_path / "sphere.nc"
    smooth = {"workers": 1, "solver": stand_in.smooth}
    solved = run(Study.from_text(HALF), tmp_path / "at_once.nc", **smooth)
    with pytest.raises(KeyboardInterrupt, match="2 of 4 distinct points are saved"):
        run(Study.from_text(HALF), path, workers=1, solver=stand_in.Interrupting(after=2))
    partial = open_results(path)
    assert int(partial.SWT.notnull().sum()) == 2
    found = run(Study.from_text(HALF), path, **smooth)
    np.testing.assert_array_equal(found.s, solved.s)
    np.testing.assert_array_equal(found.SWT_line, solved.SWT_line)
    assert "2 of 4 distinct points computed" in found.attrs["history"]
    more = (
        HALF.replace("[150, 200]", "[150, 200, 250]")
        .replace("critical_distance = 0.05", "")
        .replace("[axes]", "[axes]\ncritical_distance = [0.02, 0.05]")
        .replace('"SWT_volume", ', "")
    )
    longer = run(Study.from_text(more), path, **smooth)
    np.testing.assert_array_equal(longer.SWT.sel(normal_force=[150, 200]), solved.SWT)
    kept = longer.SWT_point.sel(normal_force=[150, 200], critical_distance=0.05)
    np.testing.assert_array_equal(kept, solved.SWT_point)
    history = "6 of 6 distinct points computed, 4 of them for quantities that they lacked"
    assert history in longer.attrs["history"]
    assert longer.SWT_volume.notnull().all()
    # The same bodies with others units: everything is known.
    changed = run(Study.from_text(HALF.replace("927", "800")), path, **smooth)
    assert "0 of 4 distinct points computed" in changed.attrs["history"]
    assert (changed.cycles < solved.cycles).all()
    np.testing.assert_array_equal(changed.dissipation, solved.dissipation)


@pytest.mark.slow
def test_archives_are_merged(tmp_path):
    parts = [SHORT.replace("[150, 200]", "[150]"), SHORT.replace("[150, 200]", "[200]")]
    for index, text in enumerate(parts):
        run(Study.from_text(text), tmp_path / f"{index}.nc", workers=1, solver=stand_in.smooth)
    whole = run(Study.from_text(SHORT), tmp_path / "whole.nc", workers=1, solver=stand_in.smooth)
    both = merged(tmp_path / "0.nc", tmp_path / "1.nc")
    for name in ("s", "SWT", "cycles", "contact_radius"):
        np.testing.assert_allclose(both[name], whole[name], rtol=1e-9)
    assert Study.from_text(both.attrs["study"]).grid.shape == (2, 2, 2)
    other = SHORT.replace('"MPa"', '"N/mm²"')
    run(Study.from_text(other), tmp_path / "other.nc", workers=1, solver=stand_in.smooth)
    several = [tmp_path / name for name in ("0.nc", "1.nc", "other.nc")]
    told = call("merge", *several, "-o", tmp_path / "all.nc").stderr
    assert f"with other units cannot be merged: those in {several[0]} and in {several[2]}" in told
    stronger = SHORT.replace("strength = 927", "strength = 900\nyield_strength = 350")
    run(Study.from_text(stronger), tmp_path / "other.nc", workers=1, solver=stand_in.smooth)
    told = call("merge", several[0], several[2], "-o", tmp_path / "all.nc").stderr
    assert "with other materials and yield strengths cannot be merged" in told


def test_the_contact_of_an_archive_is_checked(tmp_path):
    found = run(Study.from_text(SHORT), tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    wrong = json.dumps({**json.loads(found.attrs["contact"]), "materials": [1]})
    for changed, words in (
        (found.assign_attrs(contact=wrong), "attribute contact: found .*not a contact"),
        (found.drop_vars("friction"), "friction: found nothing"),
        (found.drop_vars("radius"), r"b\.nc: radius: found nothing"),
        (found.assign_coords(depth=1e-3), "depth, normal_force: found both; allowed: one of the two"),
    ):
        changed.to_netcdf(tmp_path / "b.nc")
        with pytest.raises(ValueError, match=words):
            open_results(tmp_path / "b.nc")
    assert xr.open_dataset(tmp_path / "a.nc").SWT.attrs["units"] == "MPa"


KILLED = """
import os, signal, sys, time
import stand_in, swtstudy

left = [2]

def solver(points, rtol):
    if left[0] <= 0:
        time.sleep(2.0)  # what is found before is saved within a second
        os.kill(os.getpid(), signal.SIGKILL)
    left[0] -= len(points)
    return stand_in.smooth(points, rtol)

swtstudy.run(swtstudy.Study.from_toml(sys.argv[1]), sys.argv[2], workers=1, solver=solver)
"""


@pytest.mark.slow
def test_a_killed_run_goes_on(tmp_path):
    study, path = Study.from_text(HALF), tmp_path / "sphere.nc"
    (tmp_path / "sphere.toml").write_text(HALF)
    command = [sys.executable, "-c", KILLED, str(tmp_path / "sphere.toml"), str(path)]
    environment = os.environ | {"PYTHONPATH": f"{TESTS}{os.pathsep}{ROOT}"}
    done = subprocess.run(command, capture_output=True, check=False, env=environment)
    assert done.returncode == -signal.SIGKILL, done.stderr
    assert not path.exists()
    found = run(study, path, workers=1, solver=stand_in.smooth)
    assert "2 of 4 distinct points computed" in found.attrs["history"]
    at_once = run(study, tmp_path / "at_once.nc", workers=1, solver=stand_in.smooth)
    for name in {*at_once.data_vars} - {"run"}:
        np.testing.assert_array_equal(found[name], at_once[name], err_msg=name)
