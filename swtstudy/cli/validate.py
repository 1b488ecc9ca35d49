"""swtstudy validate"""

from __future__ import annotations

import click

from swtstudy.cli.completion import study_completion
from swtstudy.cli.examples import examples


@click.command(epilog=examples("swtstudy validate mine.toml", "swtstudy validate studies"))
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...", shell_complete=study_completion)
def validate(studies: tuple[str, ...]) -> None:
    """Check each STUDY (a TOML file) without computing anything."""
    from swtstudy.study.several import read_studies

    for source, study in read_studies(studies).items():
        sizes = " × ".join(
            f"{size} {name}" for name, size in zip(study.grid.dims, study.grid.shape, strict=True)
        )
        click.echo(f"{source}: valid, {study.grid.size} points" + (f" = {sizes}" if sizes else ""))
