"""The audit of a study."""

import csv

import numpy as np
import pytest
from click.testing import CliRunner

from swtstudy.audit.audit import sample_rows
from swtstudy.audit.point import VERDICTS, Finding, audit_point
from swtstudy.audit.table import findings_dataset, summary, write_table
from swtstudy.cli import main
from swtstudy.grid.canonical import COLUMNS
from swtstudy.study.definition import Study

STUDY = """
title = "two points"
[fixed]
tangential_amplitude = 0.1
normal_amplitude = 0.5
[axes]
poisson_ratio = [0.3, 0.5]
phase = [0.6, "0.6 + 2*pi"]
"""


def test_points_are_distinct():
    rows = sample_rows(Study.from_text(STUDY).grid, points=10, seed=1)
    assert rows.shape == (2, len(COLUMNS))


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ({}, "none"),
        ({"s_body": 1.1}, "line_search"),
        ({"s_body": 1.1, "normal": np.array([0.8, 0.6, 0.0])}, "plane_through_y"),
        ({"s_body": 1.1, "position": np.array([0.5, 0.5, 0.0])}, "symmetry_line"),
        ({"s_body": 1.1, "position": np.array([0.5, 0.5, 0.1])}, "surface"),
        ({"s": np.nan}, "not_finite"),
    ],
)
def test_verdicts(changes, verdict):
    line = {
        "s": 1.0,
        "critical_x": 1.0,
        "s_all_planes": 1.0,
        "s_body": 1.0,
        "position": np.array([1.0, 0.0, 0.0]),
        "normal": np.array([1.0, 0.0, 0.0]),
    }
    assert Finding(**(line | changes)).verdict == verdict


def test_table(tmp_path):
    rows = sample_rows(Study.from_text(STUDY).grid, points=10, seed=1)
    dataset = findings_dataset(rows, [audit_point(row) for row in rows])
    verdicts = [VERDICTS[code] for code in dataset.verdict.values]
    assert dict(zip(dataset.poisson_ratio.values, verdicts, strict=True)) == {
        0.3: "none",
        0.5: "symmetry_line",
    }
    np.testing.assert_allclose(dataset.s_all_planes, dataset.s, rtol=1e-3)
    assert summary(dataset)[0].startswith("2 points, 0 of them without a finite s")
    write_table(dataset, tmp_path / "audit.csv")
    with open(tmp_path / "audit.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    assert [line["verdict"] for line in table] == verdicts
    assert float(table[0]["s"]) == pytest.approx(float(dataset.s[0]), rel=1e-8)


def test_command(tmp_path):
    study = tmp_path / "two.toml"
    study.write_text(STUDY)
    arguments = ["audit", str(study), "--points", "1", "--workers", "1", "--results", str(tmp_path)]
    outcome = CliRunner().invoke(main, arguments)
    assert outcome.exit_code == 0, outcome.output
    assert (tmp_path / "audit_two.csv").exists()
    assert "1 points" in outcome.output
