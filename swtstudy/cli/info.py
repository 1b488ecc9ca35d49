"""swtstudy info"""

from __future__ import annotations

from pathlib import Path

import click

from swtstudy.cli.options import archive_completion, examples


@click.command(epilog=examples("swtstudy info results/figure3.nc"))
@click.argument("archive", shell_complete=archive_completion)
def info(archive: str) -> None:
    """Describe an ARCHIVE.

    Shows its study and versions, how complete and how accurate it is.
    """
    from swtstudy.archive.describe import describe
    from swtstudy.archive.open import open_results
    from swtstudy.archive.parts import kept_folder, parts_folder, points_saved

    dataset = open_results(archive)
    for line in describe(dataset):
        click.echo(line)
    saved = points_saved(parts_folder(Path(archive)))
    if saved:
        click.echo(f"  unfinished     {saved} distinct points are saved by an unfinished run")
    kept = points_saved(kept_folder(Path(archive)))
    if kept:
        click.echo(
            f"  kept           {kept} distinct points of other studies are in {kept_folder(Path(archive))}"
        )
