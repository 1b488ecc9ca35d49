"""swtstudy show"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from swtstudy.cli.examples import examples
from swtstudy.cli.options import InSections, with_width
from swtstudy.cli.solve import with_parameters
from swtstudy.parameters import PARAMETERS


@click.command(
    cls=InSections,
    epilog=examples(
        "swtstudy show --phase pi/6 --frequency-ratio 3/2 -o point.pdf",
        "swtstudy show --profile rounded_punch --flat-radius 0.5",
        "swtstudy show --profile worn.csv",
    ),
)
@with_parameters("VALUE")
@click.option("--output", "-o", default="point.png", show_default=True, help="PNG, PDF or SVG file.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
@with_width
def show(output: str, style: str | None, width: Any, **texts: str | None) -> None:
    """Draw one parameter point: load path, slip, tractions, stress cycle and swt.

    With a profile and its shape alone, draw the profile itself, its coordinates and its pressure. It may be a
    CSV file with the columns radius and height, in a_H and δ0.

    The figures are those of swtstudy.inspect and swtstudy.draw_profile in Python.

    VALUE is a single value: "3/2", "2*pi" and "sqrt(20)" are numbers too.
    """
    from swtstudy.figures.inspection import inspect
    from swtstudy.figures.profile import draw_profile
    from swtstudy.figures.save import save_figure
    from swtstudy.files import check_writable
    from swtstudy.study.profile_tables import table_from

    parameters: dict[str, object] = {name: text for name, text in texts.items() if text is not None}
    if Path(str(parameters.get("profile"))).suffix == ".csv":
        parameters["profile"] = table_from(Path(str(parameters["profile"])))
    of_shape = bool(parameters) and all(PARAMETERS[name].part == "shape" for name in parameters)
    figure = (draw_profile if of_shape else inspect)(style=style, width=width, **parameters)
    check_writable(output)
    save_figure(figure, output, style)
    click.echo(output)
