"""swtstudy plot"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from swtstudy.cli.options import archive_completion, examples, with_width


@click.command(
    epilog=examples(
        "swtstudy plot results/figure3.nc --width column -o figure3.pdf",
        "swtstudy plot results/figure3.nc --y critical_x --y regime",
        "swtstudy plot results/contour.nc --kind heatmap --y critical_angle -o angle.png",
    )
)
@click.argument("archive", shell_complete=archive_completion)
@click.option("--output", "-o", help="PNG, PDF or SVG file; by default a PNG beside the archive.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
@with_width
@click.option("--x", help="The axis along the horizontal axis.")
@click.option("--hue", help="The axis whose values are the lines.")
@click.option("--panels", help="The axis whose values are the panels.")
@click.option("--vertical", help="The axis along the vertical axis of contours and heat maps.")
@click.option("--kind", help="lines, life, contour or heatmap.")
@click.option(
    "--y", multiple=True, help="What is drawn, such as s, critical_x or regime; repeat for more rows."
)
@click.option("--title", help="A title over the figure.")
@click.option("--regimes", is_flag=True, default=None, help="Mark where a regime of the contact begins.")
@click.option(
    "--validity", is_flag=True, default=None, help="Mark what is outside of what the model holds for."
)
def plot(archive: str, output: str | None, style: str | None, width: Any, **own: Any) -> None:
    """Draw a figure of an ARCHIVE, from the archive alone.

    With --x the options alone define the layout; without it they change the layout stored in the archive.
    """
    from swtstudy.archive.open import open_results
    from swtstudy.figures.draw import draw, layout_of
    from swtstudy.figures.save import save_figure
    from swtstudy.points.records import MISSING
    from swtstudy.study.figure import FigureLayout
    from swtstudy.vocabulary.files import check_writable

    target = Path(output) if output else Path(archive).with_suffix(".png")
    dataset = open_results(archive)
    check_writable(target)
    given = {key: value for key, value in own.items() if value not in (None, ())}
    layout = FigureLayout(**given) if own["x"] else replace(layout_of(dataset), **given)
    save_figure(draw(dataset, layout, style, width), target, style)
    missing = int((dataset.status == MISSING).sum())
    if missing:
        click.echo(f"{archive}: {missing} of {dataset.s.size} points are missing", err=True)
    click.echo(str(target))
