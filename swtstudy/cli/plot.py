"""swtstudy plot"""

from __future__ import annotations

from pathlib import Path

import click

from swtstudy.cli.completion import archive_completion
from swtstudy.cli.examples import examples


@click.command(
    epilog=examples("swtstudy plot results/figure3.nc", "swtstudy plot results/figure3.nc -o figure3.pdf")
)
@click.argument("archive", shell_complete=archive_completion)
@click.option("--output", "-o", help="PNG, PDF or SVG file; by default a PNG beside the archive.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
def plot(archive: str, output: str | None, style: str | None) -> None:
    """Draw the figure of an ARCHIVE, from the archive alone."""
    from swtstudy.archive.files import check_writable
    from swtstudy.archive.read import open_results
    from swtstudy.figures.draw import draw
    from swtstudy.figures.save import save_figure
    from swtstudy.records.records import MISSING

    target = Path(output) if output else Path(archive).with_suffix(".png")
    dataset = open_results(archive)
    check_writable(target)
    save_figure(draw(dataset, style=style), target, style)
    missing = int((dataset.status == MISSING).sum())
    if missing:
        click.echo(f"{archive}: {missing} of {dataset.s.size} points are missing", err=True)
    click.echo(str(target))
