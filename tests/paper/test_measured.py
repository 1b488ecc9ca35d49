"""What is measured of each statement of the paper, and audits and tables, word by word."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr
from folders import RESULTS
from kept import Kept, told
from made_up import STATEMENTS, audit_of, made_up_point, report

import swtstudy
from swtstudy.paper.audit import open_audit
from swtstudy.paper.markdown import table


@cache
def archive(name: str) -> xr.Dataset:
    path = RESULTS / f"{name}.nc"
    return open_audit(path) if name.startswith("audit_") else swtstudy.open_results(path)


TABLE = (RESULTS / "statements.md").read_text(encoding="utf-8")


#: It looks at the zones of permanent stick of all archives.
LONG = "outside_of_stick"


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n == LONG)) for n in STATEMENTS]
)
def test_a_statement_is_what_the_table_in_the_results_says(name: str) -> None:
    outcome = STATEMENTS[name](*map(archive, STATEMENTS[name].studies))
    row = next(line for line in TABLE.splitlines() if f"| {outcome.statement.sentence} |" in line)
    words = row.replace("\\", "").replace("**", "")
    assert words.endswith(f"| {outcome.statement.criterion} | {outcome.measured} | {outcome.verdict} |")


def test_an_audit_says_what_its_variables_are(kept: Kept) -> None:
    points = [
        made_up_point(s_dense=1.5),
        made_up_point(s_body=1.1, body_y=0.5),
        made_up_point(s_surface=np.nan),
    ]
    found = audit_of(points, poisson_ratio=[0.3, 0.4, 0.5])
    kept("told_audit", told(found))
    kept("report_of_audit", report(found).splitlines())


def test_a_table_of_indices(kept: Kept) -> None:
    shares = np.linspace(0.1, 0.8, 8).reshape(2, 2, 2)
    dims = ("quantity", "normal_amplitude", "parameter")
    found = xr.Dataset(
        {
            f"{name}{end}": (dims, shares + by)
            for name in ("first_order", "total")
            for end, by in (("", 0), ("_low", -0.05), ("_high", 0.1))
        },
        {
            "quantity": ["s", "critical_x"],
            "normal_amplitude": [0.25, 0.5],
            "parameter": ["friction", "poisson_ratio"],
        },
        {"title": "Indices", "size": 8, "confidence": 0.9, "seed": 1},
    ).assign_coords(symbol=("parameter", [r"\mu", r"\nu"]))
    found = found.assign(
        mean=found.total.isel(parameter=0, drop=True), variance=found.total.isel(parameter=1, drop=True)
    )
    for of_paper in (False, True):
        kept(f"table_of_indices_{of_paper}".lower(), table(found, of_paper).splitlines())
