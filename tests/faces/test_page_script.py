"""The script of a report, run by Node.js where that is installed: values under the pointer, and slices."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from command import succeeded
from real import ALLOY, SPHERE

from swtstudy import Study, run

#: From no tangential load on, where s is 0 and life has no end.
FROM_REST = f"""
title = "Life down to no load"
rtol = 1e-2
{ALLOY}[fixed]
{SPHERE}normal_force = 200
[axes]
tangential_force_amplitude = [0, 20, 40, 60]
[figure]
x = "tangential_force_amplitude"
y = ["cycles", "SWT"]
"""


def shown(page: Path) -> dict[str, Any]:
    done = subprocess.run(["node", Path(__file__).with_name("read_page.js"), page], capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    return json.loads(done.stdout)


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not installed")
def test_the_script_shows_values_also_beside_an_endless_life(tmp_path: Path) -> None:
    results = run(Study.from_text(FROM_REST), tmp_path / "rest.nc")
    assert results.cycles.values[0] == float("inf")
    succeeded("report", tmp_path / "rest.nc", "-o", tmp_path / "rest.html")
    page = shown(tmp_path / "rest.html")
    lives = [each for each in page["hovered"] if each.startswith("N = ")]
    assert len(lives) == 3  # an endless one has no place
    assert f"{results.SWT.values[1]:.4g}" in "; ".join(page["hovered"])
    assert any("N – load cycles to a crack" in each for each in page["choices"][0])
    assert page["drawn"] > 1000
