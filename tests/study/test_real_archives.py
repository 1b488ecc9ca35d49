"""Studies in units of the user's own: runs that end early, go on and are extended."""

import numpy as np
import pytest
import stand_in
from command import merged
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
