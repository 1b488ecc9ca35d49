"""swtstudy merge"""

from __future__ import annotations

from pathlib import Path

import click

from swtstudy.cli.options import archive_completion, examples


@click.command(epilog=examples("swtstudy merge results/a.nc results/b.nc -o results/both.nc"))
@click.argument("archives", nargs=-1, required=True, metavar="ARCHIVE...", shell_complete=archive_completion)
@click.option("--output", "-o", required=True, help="File for the merged archive.")
@click.option(
    "--sparse", is_flag=True, help="Allow points that are in none of the archives; they are missing."
)
def merge(archives: tuple[str, ...], output: str, sparse: bool) -> None:
    """Merge several ARCHIVEs into one.

    Along every axis the merged grid has the values of all archives. Points of it that are in none of them
    are refused without --sparse; contradictory values are always refused.
    """
    from swtstudy.archive.lock import locked
    from swtstudy.archive.merge import merge as merge_archives
    from swtstudy.archive.names import check_archive_path
    from swtstudy.archive.parts import parts_folder
    from swtstudy.archive.write import save
    from swtstudy.points.records import MISSING
    from swtstudy.vocabulary.files import check_writable

    target = Path(output)
    check_archive_path(target)
    check_writable(target)
    with locked(parts_folder(target)):
        dataset = merge_archives([Path(archive) for archive in archives], sparse)
        save(dataset, target)
    missing = int((dataset.status == MISSING).sum())
    click.echo(f"{target}: {dataset.s.size} points, {missing} of them missing")
