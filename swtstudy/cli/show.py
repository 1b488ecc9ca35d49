"""swtstudy show"""

from __future__ import annotations

import click

from swtstudy.cli.examples import examples
from swtstudy.cli.solve import with_parameters


@click.command(epilog=examples("swtstudy show --phase pi/6 --frequency-ratio 3/2 -o point.pdf"))
@with_parameters("VALUE")
@click.option("--output", "-o", default="point.png", show_default=True, help="PNG, PDF or SVG file.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
def show(output: str, style: str | None, **texts: str | None) -> None:
    """Draw one parameter point: load path, slip, tractions, stress cycle and swt.

    The figure is that of swtstudy.inspect in Python.

    VALUE is a single value: "3/2", "2*pi" and "sqrt(20)" are numbers too.
    """
    from swtstudy.figures.inspection import inspect
    from swtstudy.figures.save import save_figure
    from swtstudy.files import check_writable

    parameters: dict[str, object] = {name: text for name, text in texts.items() if text is not None}
    figure = inspect(style=style, **parameters)
    check_writable(output)
    save_figure(figure, output, style)
    click.echo(output)
