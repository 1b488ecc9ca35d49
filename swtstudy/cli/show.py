"""swtstudy show"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from swtstudy.cli.options import InSections, examples, study_completion, with_width
from swtstudy.cli.solve import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@click.command(
    cls=InSections,
    epilog=examples(
        "swtstudy show --phase pi/6 --frequency-ratio 3/2 -o point.pdf",
        "swtstudy show --profile rounded_punch --flat-radius 0.5",
        "swtstudy show --profile worn.csv",
        "swtstudy show rig.toml --tangential-force-amplitude 60",
        "swtstudy show rig.toml --profile worn.csv --smoothing 0.0002",
        "swtstudy show --load square loops",
    ),
)
@click.argument("study", required=False, metavar="[STUDY]", shell_complete=study_completion)
@with_parameters("VALUE")
@click.option("--body", default=1, show_default=True, type=click.IntRange(1, 2), help="Of that study.")
@click.option("--output", "-o", default="point.png", show_default=True, help="PNG, PDF or SVG file.")
@click.option("--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file.")
@click.option(
    "--smoothing", type=float, help="What the fit may miss of a profile that is a table; in its lengths."
)
@with_width
def show(
    study: str | None,
    output: str,
    style: str | None,
    smoothing: float | None,
    width: Any,
    body: int,
    **texts: str | None,
) -> None:
    """Draw one parameter point: load path, slip, tractions, stress cycle and swt.

    With a profile and its shape alone, draw the profile itself, its coordinates and its pressure. It may be a
    CSV file with the columns radius and height, in a_H and δ0.

    With a STUDY its contact is drawn in its units, with single values of what are axes there; with one of its
    profiles or a CSV file alone, that profile in its lengths, pressed by the mean load; with the name of one
    of its loads alone, that load: its course with the recorded cycles, its path, and how near friction comes
    to its end.

    The figures are those of swtstudy.inspect, swtstudy.draw_profile and swtstudy.draw_load in Python.

    VALUE is a single value: "3/2", "2*pi" and "sqrt(20)" are numbers too.
    """
    values: dict[str, object] = {name: text for name, text in texts.items() if text is not None}
    words = ""
    if study is None:
        figure = _point_or_profile(values, smoothing or 0.0, style, width)
    elif [*values] == ["load"]:
        figure, words = _load(study, str(values["load"]), style, width)
    else:
        from swtstudy.contacts.of_results import contact_of_study

        of_shape = _of_shape(values)
        contact = contact_of_study(study, values, smoothing, of_shape)
        figure = contact.draw_profile(style, width) if of_shape else contact.inspect(body, style, width)
    from swtstudy.figures.save import save_figure
    from swtstudy.vocabulary.files import check_writable

    check_writable(output)
    save_figure(figure, output, style)
    if words:
        click.echo(words)
    click.echo(output)


def _point_or_profile(values: dict[str, object], smoothing: float, style: str | None, width: Any) -> Figure:
    """A point, or a profile where its shape alone is given."""
    from swtstudy.figures.inspection import inspect
    from swtstudy.figures.profile import draw_profile
    from swtstudy.study.profile_tables import table_from

    if Path(str(values.get("profile"))).suffix == ".csv":
        values = {**values, "profile": table_from(Path(str(values["profile"])), smoothing)}
    return (draw_profile if _of_shape(values) else inspect)(style=style, width=width, **values)


def _of_shape(values: dict[str, object]) -> bool:
    """Return whether a profile and its shape alone are given."""
    return "profile" in values and all(PARAMETERS[name].part == "shape" for name in values)


def _load(source: str, name: str, style: str | None, width: Any) -> tuple[Figure, str]:
    """A load of a study, and what its record is like in words."""
    from swtstudy.figures.load import draw_load
    from swtstudy.study.definition import Study
    from swtstudy.study.loops import read_signal_of
    from swtstudy.study.shipped import find_study

    study, path = Study.from_toml(source), find_study(source)
    signal = read_signal_of(path.read_text(encoding="utf-8-sig"), name, path.parent)
    figure = draw_load(study, name, signal, style=style, width=width)
    return figure, "" if signal is None else f"{name}: {signal.words}"
