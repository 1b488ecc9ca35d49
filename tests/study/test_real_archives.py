"""Studies in units of the user's own: runs that end early, go on and are extended."""

import numpy as np
import pytest
import stand_in
from real import STUDY

from swtstudy import Study, open_results, run

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
