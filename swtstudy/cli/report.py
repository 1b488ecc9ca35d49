"""swtstudy report"""

from __future__ import annotations

import click

from swtstudy.cli.options import archive_completion, examples


@click.command(
    epilog=examples(
        "swtstudy report results/figure3.nc",
        "swtstudy report results/figure3.nc -o to_send.html",
        "swtstudy report results/*.nc -o site/",
    )
)
@click.argument("archives", metavar="ARCHIVE...", nargs=-1, required=True, shell_complete=archive_completion)
@click.option(
    "--output", "-o", help="HTML file, by default beside the archive; of several archives a folder."
)
@click.option(
    "--workers", default=2, show_default=True, type=click.IntRange(1), help="Processes, for several."
)
def report(archives: tuple[str, ...], output: str | None, workers: int) -> None:
    """Write an HTML page about each ARCHIVE, to send to people without Python.

    A page needs no other file and no network: what matters in a sentence, the figure with its values, slices,
    extrema, the best and the worst point, settings, errors, a CSV file, and how to make it again.

    Several archives also get a page that lists them. Files that are no archives are left out.
    """
    from swtstudy.reports.site import write_reports

    for path, problem in write_reports(archives, output, workers):
        click.echo(problem or str(path), err=bool(problem))
