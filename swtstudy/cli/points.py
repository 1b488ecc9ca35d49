"""Commands on single points: solve and show."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import swtstudy
from swtstudy.cli import terminal
from swtstudy.study.shipped import find_study
from swtstudy.study.units.rows import Units, rows
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, literal, refused
from swtstudy.vocabulary.parameters import AXES, CONTACT_AXES, PARAMETERS, QUANTITY_AXES, Parameter, short
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.wording import raised

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Sizes of a contact in a study with units.
_SIZES = [row for name, row in rows(Units()).items() if name in CONTACT_AXES and name != "body"]


#: Why there is no s in a regime.
WHY = {
    "not_finite": "s is infinite, since swt grows without bound towards the edge of the contact",
    "no_equilibrium": "there is no s, since friction does not carry the force, or the normal force pulls",
}


#: The columns that every point has, and their digits.
_FORMATS = {
    "s": ".6f", "s_error": ".1e", "s_surface": ".6f", "critical_x": "z.5f", "critical_angle": "z.2f",
    "regime": "",
}  # fmt: skip


def with_parameters(metavar: str, parameters: Iterable[Parameter]) -> Callable[[Any], Any]:
    """Decorate a command with one option for each parameter."""

    def decorate(command: Any) -> Any:
        for parameter in reversed([*parameters]):
            option = f"--{parameter.name.replace('_', '-')}"
            command = click.option(option, metavar=metavar, help=parameter.brief)(command)
        return command

    return decorate


@click.command(cls=terminal.InSections)
@with_parameters(terminal.SEVERAL, PARAMETERS.values())
@click.option("--rtol", default=DEFAULT_RTOL, show_default=True, help="Target of the relative error of s.")
@click.option("--quantities", metavar=terminal.SEVERAL, help="Columns beside s, such as dissipation.")
@with_parameters(terminal.SEVERAL, [QUANTITY_AXES[DISTANCE]])
def solve(rtol: float, quantities: str | None, **texts: str | None) -> None:
    """Print s for single values or lists: a table, or tabs in a pipe.

    \b
    Examples:
      swtstudy solve --phase 0,pi/2 --profile rounded_punch --flat-radius 1/2
      swtstudy list --parameters  # what each means
    """
    from swtstudy.results.evaluate import to_table

    parameters: dict[str, Any] = {name: _values(text) for name, text in texts.items() if text is not None}
    asked = [] if quantities is None else [part.strip() for part in quantities.split(",")]
    dataset = swtstudy.solve(rtol=rtol, quantities=asked, **parameters)
    dims = [*map(str, dataset.s.dims)]
    # A quantity with dimensions of its own has a column for each place in them.
    table = to_table(dataset, [str(dim) for dim in dataset.dims if dim not in dims])
    found = {name: [*map(short, table[name].tolist())] for name in dims}
    for name in (*_FORMATS, *(n for n in table if n not in (*_FORMATS, *dataset.coords))):
        found[name] = [f"{value:{_FORMATS.get(name, '.6g')}}" for value in table[name]]
    lines, room = [*zip(*found.values(), strict=True)], terminal.line_length()
    if room is None:  # for programs
        click.echo("\n".join("\t".join(line) for line in [(*found,), *lines]))
    else:
        click.echo(terminal.fitted([*found], [[*map(raised, line)] for line in lines], room))
    for name in (name for name in WHY if name in found["regime"]):
        terminal.say(f"{name}: {WHY[name]}", err=True)


def _values(text: str) -> str | list[str]:
    parts = [part.strip() for part in text.split(",")]
    return parts if len(parts) > 1 else parts[0]


@click.command(cls=terminal.NamesInSections)
@click.argument("study", required=False, metavar="[STUDY]", shell_complete=terminal.study_completion)
@with_parameters("VALUE", (*PARAMETERS.values(), *_SIZES))
@click.option("--body", metavar="BODY", help="1 or 2, or its name.  [default: 1]")
@click.option("--output", "-o", default="point.png", show_default=True, help="PNG, PDF or SVG file.")
@terminal.with_style
@click.option("--smoothing", type=float, help="Largest misfit of a table, in its lengths.")
@terminal.with_width
def show(
    study: str | None,
    output: str,
    style: str | None,
    smoothing: float | None,
    width: Any,
    body: str | None,
    **texts: str | None,
) -> None:
    """Draw one parameter point: load path, slip, tractions, stress cycle and swt.

    A profile and its shape alone are drawn as a profile, which may be a CSV file with the columns radius and
    height, in a_H and δ0.

    With a STUDY, its contact is drawn in its units, at single values of axes and blocks; alone, one of its
    profiles or a CSV file pressed by the mean load, or one of its loads with recorded cycles, path and
    friction.

    A parameter is an option, such as --phase "2*pi"; see swtstudy list --parameters.

    \b
    Examples:
      swtstudy show --phase pi/6 --frequency-ratio 3/2 -o point.pdf
      swtstudy show --profile rounded_punch --flat-radius 0.5
      swtstudy show rig.toml --profile worn.csv --smoothing 0.0002
      swtstudy show --load square loops
    """
    from swtstudy.figures.sheet import INCH, TALLEST
    from swtstudy.figures.style import save_figure
    from swtstudy.study.reading import read_signal_of

    check_writable(output)
    values: dict[str, object] = {name: text for name, text in texts.items() if text is not None}
    look, words = dict[str, Any](style=style, width=width), ""
    if study is not None and [*values] == ["load"] and body is None:
        path, name = find_study(study), str(values["load"])
        signal = read_signal_of(path.read_text(encoding="utf-8-sig"), name, path.parent)
        words = f"{name}: {signal.words}" if signal else ""
        figure = swtstudy.draw_load(swtstudy.Study.from_toml(study), name, signal, **look)
    else:
        figure = _contact_or_profile(study, values, smoothing, body, look)
    save_figure(figure, output, style)
    if width == "column" and figure.get_figheight() > TALLEST:
        height = f"{output} is {INCH * figure.get_figheight():.0f} cm high, more than a page"
        terminal.say(f"{height}: --width page draws it lower", err=True)
    if words:
        click.echo(words)
    click.echo(output)


def _contact_or_profile(
    study: str | None,
    values: dict[str, object],
    smoothing: float | None,
    body: str | None,
    look: dict[str, Any],
) -> Figure:
    """One contact, or a profile where its shape alone is given; of a study with units, in these."""
    from swtstudy.faces.contacts import PhysicalContact
    from swtstudy.study.definition import one_of_study
    from swtstudy.study.keys import ProfileTable
    from swtstudy.study.reading import profile_from
    from swtstudy.study.units.grid import PhysicalGrid

    # A profile, its shape and sizes of the contact at rest alone.
    of_shape = "profile" in values and all(AXES[name].part in ("shape", "contact") for name in values)
    path = Path(str(values.get("profile")))
    if study is not None:
        grid = one_of_study(study, values, smoothing, of_shape)
        if isinstance(grid, PhysicalGrid):
            contact, one = PhysicalContact(grid), int(body) if body in ("1", "2") else body or 1
            return contact.draw_profile(**look) if of_shape else contact.inspect(one, **look)
        if body is not None:
            raise refused("body", literal(body), "no body in a study without units")
        values = {n: v for n, v in grid.fixed.items() if not of_shape or PARAMETERS[n].part == "shape"}
    elif path.suffix == ".csv":
        table = ProfileTable(file=path.name, smoothing=smoothing or 0.0)
        values = {**values, "profile": profile_from(path.stem, table, path.parent)}
    draw: Any = swtstudy.draw_profile if of_shape else swtstudy.inspect
    return draw(**look, **values)
