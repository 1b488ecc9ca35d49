"""swtstudy show"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from swtstudy.cli.completion import study_completion
from swtstudy.cli.examples import examples
from swtstudy.cli.options import InSections, with_width
from swtstudy.cli.solve import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS


@click.command(
    cls=InSections,
    epilog=examples(
        "swtstudy show --phase pi/6 --frequency-ratio 3/2 -o point.pdf",
        "swtstudy show --profile rounded_punch --flat-radius 0.5",
        "swtstudy show --profile worn.csv",
        "swtstudy show rig.toml --tangential-force-amplitude 60",
        "swtstudy show --load square loops",
    ),
)
@click.argument("study", required=False, metavar="[STUDY]", shell_complete=study_completion)
@with_parameters("VALUE")
@click.option("--body", default=1, show_default=True, type=click.IntRange(1, 2), help="Of that study.")
@click.option("--output", "-o", default="point.png", show_default=True, help="PNG, PDF or SVG file.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
@click.option(
    "--smoothing", type=float, default=0.0, help="What the fit may miss of a profile in a CSV file."
)
@with_width
def show(
    study: str | None,
    output: str,
    style: str | None,
    smoothing: float,
    width: Any,
    body: int,
    **texts: str | None,
) -> None:
    """Draw one parameter point: load path, slip, tractions, stress cycle and swt.

    With a profile and its shape alone, draw the profile itself, its coordinates and its pressure. It may be a
    CSV file with the columns radius and height, in a_H and δ0.

    With a STUDY its contact is drawn in its units, with single values of what are axes there; with the name
    of one of its loads alone, that load: its course with the recorded cycles, its path, and how near friction
    comes to its end.

    The figures are those of swtstudy.inspect, swtstudy.draw_profile and swtstudy.draw_load in Python.

    VALUE is a single value: "3/2", "2*pi" and "sqrt(20)" are numbers too.
    """
    from swtstudy.figures.inspection import inspect
    from swtstudy.figures.profile import draw_profile
    from swtstudy.figures.save import save_figure
    from swtstudy.study.profile_tables import table_from
    from swtstudy.vocabulary.files import check_writable

    if study is not None:
        if [name for name, text in texts.items() if text is not None] == ["load"]:
            _show_load(study, str(texts["load"]), output, style, width)
        else:
            _show_contact(study, texts, body, output, style, width)
        return
    parameters: dict[str, object] = {name: text for name, text in texts.items() if text is not None}
    if Path(str(parameters.get("profile"))).suffix == ".csv":
        parameters["profile"] = table_from(Path(str(parameters["profile"])), smoothing)
    of_shape = bool(parameters) and all(PARAMETERS[name].part == "shape" for name in parameters)
    figure = (draw_profile if of_shape else inspect)(style=style, width=width, **parameters)
    check_writable(output)
    save_figure(figure, output, style)
    click.echo(output)


def _show_contact(
    study: str, texts: Mapping[str, str | None], body: int, output: str, style: str | None, width: Any
) -> None:
    """Draw the contact of a study with units."""
    from swtstudy.contacts.of_results import contact_of_study
    from swtstudy.figures.save import save_figure
    from swtstudy.vocabulary.files import check_writable

    values = {name: text for name, text in texts.items() if text is not None}
    figure = contact_of_study(study, values).inspect(body, style, width)
    check_writable(output)
    save_figure(figure, output, style)
    click.echo(output)


def _show_load(source: str, name: str, output: str, style: str | None, width: Any) -> None:
    """Draw a load of a study, and say what its record is like."""
    from swtstudy.figures.load import draw_load
    from swtstudy.figures.save import save_figure
    from swtstudy.study.definition import Study
    from swtstudy.study.loops import read_signal_of
    from swtstudy.study.shipped import find_study
    from swtstudy.vocabulary.files import check_writable

    study, path = Study.from_toml(source), find_study(source)
    signal = read_signal_of(path.read_text(encoding="utf-8-sig"), name, path.parent)
    figure = draw_load(study, name, signal, style=style, width=width)
    check_writable(output)
    save_figure(figure, output, style)
    if signal is not None:
        click.echo(f"{name}: {signal.words}")
    click.echo(output)
