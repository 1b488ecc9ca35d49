"""swtstudy schema"""

from __future__ import annotations

import click

from swtstudy.cli.options import examples


@click.command(epilog=examples("swtstudy schema", "swtstudy schema -o study.schema.json"))
@click.option("--output", "-o", help="File for the schema; by default it is printed.")
def schema(output: str | None) -> None:
    """Write the JSON schema of study files.

    Editors that know TOML schemas (Even Better TOML in VS Code, Taplo) use it to complete, explain and check
    a study whose first line is "#:schema study.schema.json".
    """
    from swtstudy.study.schema import schema_text
    from swtstudy.vocabulary.files import check_writable, write_text

    if output is None:
        click.echo(schema_text(), nl=False)
        return
    check_writable(output)
    write_text(output, schema_text())
    click.echo(output)
