"""swtstudy merge"""

from __future__ import annotations

from pathlib import Path

import click

from swtstudy.cli.completion import archive_completion
from swtstudy.cli.examples import examples


@click.command(epilog=examples("swtstudy merge results/a.nc results/b.nc -o results/both.nc"))
@click.argument("archives", nargs=-1, required=True, metavar="ARCHIVE...", shell_complete=archive_completion)
@click.option("--output", "-o", required=True, help="Where the merged archive goes.")
def merge(archives: tuple[str, ...], output: str) -> None:
    """Merge each ARCHIVE into one.

    Values that contradict each other are refused.
    """
    from swtstudy.archive.files import check_writable, save
    from swtstudy.archive.lock import locked
    from swtstudy.archive.merge import merge as merge_archives
    from swtstudy.archive.parts import parts_folder
    from swtstudy.records.records import MISSING

    target = Path(output)
    check_writable(target)
    with locked(parts_folder(target)):
        dataset = merge_archives([Path(archive) for archive in archives])
        save(dataset, target)
    missing = int((dataset.status == MISSING).sum())
    click.echo(f"{target}: {dataset.s.size} points, {missing} of them missing")
