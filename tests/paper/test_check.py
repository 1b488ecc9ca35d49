"""The command that checks the statements, and its table."""

from functools import partial

import folders
import pytest
import stand_in
from command import call
from made_up import STATEMENTS

from swtstudy import Study, run

AUDITS = ("audit_parameter_box", "audit_figure3", "audit_figure4")
STUDIES = {name for each in STATEMENTS.values() for name in each.studies} - {*AUDITS}
#: Statements that need no archive.
BY_THEMSELVES = [each for each in STATEMENTS.values() if not each.studies]


def test_missing_archives_are_named_with_the_command_that_makes_them(tmp_path):
    result = call("check", "--results", tmp_path)
    assert result.exit_code == 2
    assert f"{len(STATEMENTS) - len(BY_THEMSELVES)} not checked" in result.stdout
    for name in STUDIES:
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
    result = call("check", "--results", tmp_path)
    assert result.exit_code == 2
    assert "friction.nc has no value at 4 of 384 points" in result.stderr
    assert "swtstudy run friction --retry-failed" in result.stderr


@pytest.mark.pages
def test_the_table_in_the_results_is_that_of_the_archives_beside_it(tmp_path):
    table = tmp_path / "statements.md"
    result = call("check", "--results", folders.RESULTS, "--output", table)
    assert result.exit_code == 0, result.output
    assert table.read_text(encoding="utf-8") == (folders.RESULTS / "statements.md").read_text(
        encoding="utf-8"
    )
