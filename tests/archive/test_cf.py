"""Archives follow the CF conventions, according to the IOOS checker."""

import json

import pytest
import stand_in

from swtstudy import Study, run

# The checker's dependencies warn, each in its way.
pytestmark = pytest.mark.filterwarnings("ignore")

FOUR = 'title = "t"\n[axes]\nphase = [0, 1]\nfrequency_ratio = ["1/2", 1]\nfriction = [0.1, 0.2]\n'
NAMED = 'title = "t"\n[axes]\nprofile = ["rounded_punch", "truncated_paraboloid"]\nflat_radius = [0, 1]\n'


@pytest.mark.quick(1)
@pytest.mark.parametrize("text", [FOUR, NAMED, 'title = "t"'])
def test_cf(text, tmp_path):
    checker = pytest.importorskip("compliance_checker.runner")
    run(Study.from_text(text), tmp_path / "archive.nc", solver=stand_in.smooth)
    checker.CheckSuite.load_all_available_checkers()
    report = tmp_path / "report.json"
    passed, _ = checker.ComplianceChecker.run_checker(
        str(tmp_path / "archive.nc"),
        ["cf:1.11"],
        0,
        "strict",
        output_filename=str(report),
        output_format="json",
    )
    found = json.loads(report.read_text())["cf:1.11"]
    assert (found["high_count"], found["medium_count"]) == (0, 0), [
        (check["name"], check["msgs"]) for check in found["all_priorities"] if check["msgs"]
    ]
    assert passed
