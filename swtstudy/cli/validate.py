"""swtstudy validate"""

from __future__ import annotations

import click

from swtstudy.cli.options import examples, study_completion


@click.command(epilog=examples("swtstudy validate mine.toml", "swtstudy validate studies"))
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...", shell_complete=study_completion)
def validate(studies: tuple[str, ...]) -> None:
    """Check each STUDY (a TOML file) without computing anything."""
    from swtstudy.archive.names import archive_paths
    from swtstudy.study.several import read_studies

    defined = read_studies(studies)
    archive_paths(defined, "")
    for source, study in defined.items():
        sizes = " × ".join(
            f"{size} {name}" for name, size in zip(study.grid.dims, study.grid.shape, strict=True)
        )
        click.echo(f"{source}: valid, {study.grid.size} points" + (f" = {sizes}" if sizes else ""))
