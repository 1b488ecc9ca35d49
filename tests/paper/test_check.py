"""The command that checks the statements, and its table."""

from functools import partial

import folders
import pytest
import stand_in
from click.testing import CliRunner
from made_up import made_up_audit

from swtstudy import Study, open_results, run
from swtstudy.archive.netcdf import save
from swtstudy.cli import main
from swtstudy.paper.statements.check import STUDIES, about_archive, check, markdown, summary
from swtstudy.paper.statements.statement import STATEMENTS

AUDITS = ("audit_parameter_box", "audit_figure3", "audit_figure4")
#: Statements that need no archive.
BY_THEMSELVES = [each for each in STATEMENTS.values() if not each.studies]


def test_missing_archives_are_named_with_the_command_that_makes_them(tmp_path):
    result = CliRunner().invoke(main, ["check", "--results", str(tmp_path)])
    assert result.exit_code == 2
    assert f"{len(STATEMENTS) - len(BY_THEMSELVES)} not checked" in result.stdout
    for name in {*STUDIES} - {*AUDITS}:
        assert f"{tmp_path / name}.nc is missing; made by: swtstudy run {name}" in result.stderr
    for name in AUDITS:
        made_by = f"swtstudy audit {name.removeprefix('audit_')}"
        assert f"{tmp_path / name}.nc is missing; made by: {made_by}" in result.stderr
    audits = "swtstudy audit parameter_box && swtstudy audit figure3 figure4 --points 100"
    assert f"all of them: swtstudy run --all && {audits}" in result.stderr
    assert not list(tmp_path.iterdir())


def test_an_archive_with_gaps_is_not_checked(tmp_path):
    study = Study.from_toml(folders.STUDIES / "friction.toml")
    run(study, tmp_path / "friction.nc", solver=partial(stand_in.lose_at, 0.3), workers=1)
    result = CliRunner().invoke(main, ["check", "--results", str(tmp_path)])
    assert result.exit_code == 2
    assert "friction.nc has no value at 4 of 384 points" in result.stderr
    assert "swtstudy run friction --retry-failed" in result.stderr


@pytest.mark.slow
def test_all_archives_make_a_table(tmp_path):
    for name in AUDITS:
        save(made_up_audit(), tmp_path / f"{name}.nc")
    for name in {*STUDIES} - {*AUDITS}:
        study = Study.from_toml(folders.STUDIES / f"{name}.toml")
        run(study, tmp_path / f"{name}.nc", solver=stand_in.smooth, workers=1)
    result = CliRunner().invoke(main, ["check", "--results", str(tmp_path)])
    assert result.exit_code == 0, result.output
    table = (tmp_path / "statements.md").read_text(encoding="utf-8")
    rows = [line for line in table.splitlines() if line.startswith("| ")][1:]
    assert len(rows) == len(STATEMENTS)
    assert all(row.count(" | ") >= 4 for row in rows)
    assert summary(check(tmp_path)) in table


def test_statements_about_one_archive_are_those_about_its_study_alone():
    dataset = open_results(folders.RESULTS / "figure3.nc")
    outcomes = about_archive("figure3", dataset)
    assert all(each.statement.studies == ["figure3"] for each in outcomes)
    assert all(each.finding.holds for each in outcomes)
    assert about_archive("mine", dataset) == []


def test_what_is_not_checked_is_in_the_table():
    assert "**not checked**" in markdown(check("nowhere"))


def test_the_table_in_the_results_is_that_of_the_archives_beside_it(tmp_path):
    table = tmp_path / "statements.md"
    result = CliRunner().invoke(main, ["check", "--results", str(folders.RESULTS), "--output", str(table)])
    assert result.exit_code == 0, result.output
    assert table.read_text(encoding="utf-8") == (folders.RESULTS / "statements.md").read_text(
        encoding="utf-8"
    )
    outcomes = {each.statement.sentence: each.finding for each in check(folders.RESULTS)}
    finding = outcomes["s rises with the amplitude of the tangential oscillation."]
    assert not finding.holds
    assert "of 128 random curves" in finding.measured
