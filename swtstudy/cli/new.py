"""swtstudy new"""

from __future__ import annotations

from pathlib import Path

import click

from swtstudy.cli.options import examples
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal


@click.command(epilog=examples("swtstudy new mine", "swtstudy plan mine.toml", "swtstudy run mine.toml"))
@click.argument("name")
@click.option("--units", is_flag=True, help="A study of real contacts, in N, mm and MPa.")
def new(name: str, units: bool) -> None:
    """Write NAME.toml, a small commented study to start from.

    Beside it goes the schema that editors use to complete and check studies. An existing study is never
    replaced.
    """
    from swtstudy.study.schema import SCHEMA_FILE, schema_text
    from swtstudy.study.template import template, template_with_units
    from swtstudy.vocabulary.files import check_writable, write_text

    if Path(name).name in ("", ".toml"):
        raise StudyError([Mistake("NAME", literal(name), "a name for the study, such as mine")])
    target = Path(name if name.endswith(".toml") else f"{name}.toml")
    check_writable(target)
    try:
        open(target, "x").close()
    except FileExistsError:
        raise FileExistsError(f"{target} already exists; choose another name") from None
    try:
        write_text(target, (template_with_units if units else template)(target.stem.replace("_", " ")))
    except BaseException:
        target.unlink()  # empty still, and in the way of another try
        raise
    click.echo(str(target))
    schema = target.with_name(SCHEMA_FILE)
    if not schema.exists():
        write_text(schema, schema_text())
        click.echo(str(schema))
