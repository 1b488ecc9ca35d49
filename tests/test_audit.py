"""The audit of a study."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from made_up import made_up_audit, made_up_point

from swtstudy.archive.write import save
from swtstudy.audit.audit import audit_study, sample_rows
from swtstudy.audit.point import VERDICTS
from swtstudy.audit.report import report
from swtstudy.audit.table import audit_dataset, audited_points, canonical_rows, open_audit
from swtstudy.cli import main
from swtstudy.grid.canonical import COLUMNS
from swtstudy.study.definition import Study

PARAMETER_BOX = Path(__file__).parent.parent / "studies" / "audit" / "parameter_box.toml"
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


def test_a_larger_sample_extends_a_smaller_one():
    grid = Study.from_toml(PARAMETER_BOX).grid
    few, many = (sample_rows(grid, points, seed=0) for points in (5, 12))
    assert many.shape == (12, len(COLUMNS))
    np.testing.assert_array_equal(many[:5], few)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ({}, "none"),
        ({"s_body": 1.1}, "line_search"),
        ({"s_body": 1.1, "normal": np.array([0.8, 0.6, 0.0])}, "plane_through_y"),
        ({"s_body": 1.1, "position": np.array([0.5, 0.5, 0.0])}, "symmetry_line"),
        ({"s_body": 1.1, "position": np.array([0.5, 0.5, 0.1])}, "surface"),
        ({"s_surface": np.nan}, "not_finite"),
    ],
)
def test_verdicts(changes, verdict):
    assert made_up_point(**changes).verdict == verdict


def test_audited_points_are_read_as_they_were_written(tmp_path):
    written = made_up_audit(on_line=2, off_line=1)
    save(written, tmp_path / "audit.nc")
    read = audited_points(open_audit(tmp_path / "audit.nc"))
    again = audit_dataset(np.array(list(read)), list(read.values()))
    for name in written.variables:
        np.testing.assert_array_equal(again[name], written[name])
    np.testing.assert_array_equal(list(read), canonical_rows(written))


def test_other_files_are_not_taken_for_an_audit(tmp_path):
    save(made_up_audit().drop_vars("s_body"), tmp_path / "other.nc")
    with pytest.raises(ValueError, match="not an audit"):
        audit_study(Study.from_text(STUDY), tmp_path / "other.nc")
    with pytest.raises(ValueError, match=r"study: found 'figure3'; allowed: a Study"):
        audit_study("figure3", tmp_path / "audit.nc")


def test_a_damaged_audit_is_named(tmp_path):
    path = tmp_path / "audit.nc"
    save(made_up_audit(), path)
    content = path.read_bytes()
    assert b"paraboloid" in content
    path.write_bytes(content.replace(b"paraboloid", b"qaraboloid"))
    with pytest.raises(ValueError, match=f"^{path}: a damaged file: wrong check sum of profile"):
        open_audit(path)


def test_report():
    text = report(made_up_audit(on_line=3, off_line=1))
    assert "| on the surface, off the line | 1 | 4.0% | 0.45 |" in text
    assert "| 0.4–0.45 | 1 | 1 | 4.00% | 0.00% |" in text
    assert "at 1 points: 1 of the 1" in text


def test_command_goes_on_where_it_was(tmp_path):
    study = tmp_path / "two.toml"
    study.write_text(STUDY)
    arguments = ["audit", str(study), "--workers", "1", "--results", str(tmp_path), "--points"]
    assert CliRunner().invoke(main, [*arguments, "1"]).exit_code == 0
    first = open_audit(tmp_path / "audit_two.nc")
    # What is there already is taken as it is.
    save(first.assign(s_body=first.s_body * 3.0), tmp_path / "audit_two.nc")
    outcome = CliRunner().invoke(main, [*arguments, "2"])
    assert outcome.exit_code == 0, outcome.output
    dataset = open_audit(tmp_path / "audit_two.nc")
    assert dataset.sizes["sample"] == 2
    known = dataset.poisson_ratio == float(first.poisson_ratio[0])
    np.testing.assert_allclose(dataset.s_body[known], 3.0 * first.s_body)
    new = dataset.isel(sample=np.flatnonzero(~known))
    expected = "symmetry_line" if float(new.poisson_ratio[0]) == 0.5 else "none"
    assert VERDICTS[int(new.verdict[0])] == expected
    assert float(new.remainder[0]) == pytest.approx(0.0, abs=1e-3)
    np.testing.assert_allclose(new.s_all_planes, new.s, rtol=1e-3)
    assert "2 points" in (tmp_path / "audit_two.md").read_text(encoding="utf-8")
