"""swtstudy check"""

from __future__ import annotations

import shutil
from pathlib import Path

import click

from swtstudy.cli.options import examples

#: Commands that make everything to be checked: the audit is not part of the suite.
EVERYTHING = "swtstudy run --all && swtstudy audit parameter_box"


@click.command(epilog=examples(f"{EVERYTHING} && swtstudy check"))
@click.option("--results", default="results", show_default=True, help="Folder with the archives.")
@click.option("--output", "-o", help="Markdown file for the table; by default statements.md in that folder.")
def check(results: str, output: str | None) -> None:
    """Test what the paper says on the archives of its studies.

    Prints a table of the statements with what was measured, and writes it to a Markdown file. The exit code
    is 0 if every statement was checked, whether or not it holds; 2, without a file, if archives are missing
    or have gaps.
    """
    from swtstudy.paper.statements.check import check as check_statements
    from swtstudy.paper.statements.report import markdown, summary, terminal_table
    from swtstudy.vocabulary.files import check_writable, write_text

    target = Path(output) if output else Path(results) / "statements.md"
    outcomes = check_statements(results)
    checked = [outcome for outcome in outcomes if outcome.finding is not None]
    click.echo(terminal_table(checked, shutil.get_terminal_size((120, 24)).columns))
    click.echo(summary(outcomes))
    problems = dict.fromkeys(
        line for outcome in outcomes if outcome.finding is None for line in outcome.problem.splitlines()
    )
    if problems:
        raise ValueError("\n".join([*problems, f"all of them: {EVERYTHING}"]))
    check_writable(target)
    write_text(target, markdown(outcomes))
    click.echo(str(target))
