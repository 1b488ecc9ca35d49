"""Shared by commands: options with their checks, completion by the shell, lines and tables for a terminal."""

from __future__ import annotations

import re
import sys
import textwrap
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from shutil import get_terminal_size
from typing import Any

import click
from click import Context, Parameter
from click.shell_completion import CompletionItem

from swtstudy.study.shipped import shipped_studies
from swtstudy.vocabulary.mistakes import Report, literal, meant, refused
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import printable

#: Placeholder of an option that takes several values, separated by commas.
SEVERAL = "VALUES"


#: Parts of parameters as headings of help.
PARTS = {
    "load": "The load",
    "shape": "The profile and its shape",
    "body": "The bodies",
    "bulk": "The bodies",
    "criterion": "The criterion",
    "contact": "A contact in units",
}


def by_section(names: Iterable[str]) -> dict[str, list[str]]:
    """Names of options under the headings of help, parameters first, in the order of `PARTS`."""
    found: dict[str, list[str]] = {title: [] for title in (*PARTS.values(), "Options")}
    for name in names:
        row = AXES.get(name)
        found[PARTS.get(row.part, "Options") if row else "Options"].append(name)
    return {title: own for title, own in found.items() if own}


class InSections(click.Command):
    """A command whose many parameters are listed by what they are a part of, a line each."""

    #: False where parameters are only named.
    explains = True

    def format_options(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        records = {}
        for each in self.get_params(context):
            if isinstance(each, click.Option) and (record := each.get_help_record(context)):
                records[str(each.name)] = (record[0].removesuffix(f" {each.metavar}"), record[1])
        formatter.write_paragraph()
        for title, names in by_section(records).items():
            formatter.write_heading(title)
            with formatter.indentation():
                if self.explains or title == "Options":
                    formatter.write_dl([records[name] for name in names], col_max=32)
                else:
                    formatter.write_text(", ".join(names))


class NamesInSections(InSections):
    """A command whose parameters are only named there: another one explains them."""

    explains = False


def check_options(context: click.Context, command: click.Command, args: list[str]) -> None:
    """Refuse unknown options, and options given more than once that take a single value.

    Raises
    ------
    StudyError
        With every repeated option.
    UsageError
        For an unknown option, with the one that was meant, also for a symbol such as --mu.
    """
    own = click.Context(command, context, command.name)
    try:
        _, _, order = command.make_parser(own).parse_args(list(args))
    except click.NoSuchOption as error:
        options = [name for each in command.params for name in each.opts if name.startswith("--")]
        names = {name.removeprefix("--").replace("-", "_"): name for name in options}
        close = meant(error.option_name.lstrip("-"), names)
        if close is None:
            raise
        words = f"No such option '{error.option_name}'. Did you mean '{names[close]}'?"
        raise click.UsageError(words, own) from None
    except click.UsageError:
        return  # click reports it
    report = Report()
    for parameter, count in Counter(order).items():
        single = isinstance(parameter, click.Option) and not (parameter.multiple or parameter.is_flag)
        if single and count > 1:
            allowed = "once" + ", with values separated by commas" * (parameter.metavar == SEVERAL)
            report(parameter.opts[0], f"{count} times", allowed)
    report.refuse()


def study_completion(context: Context, parameter: Parameter, incomplete: str) -> list[CompletionItem]:
    """Studies of the paper by name, and study files here or in the folder studies."""

    return _offered(incomplete, "*.toml", "studies/*.toml", names=shipped_studies())


def archive_completion(context: Context, parameter: Parameter, incomplete: str) -> list[CompletionItem]:
    """Archives here or in the folder results."""
    return _offered(incomplete, "*.nc", "results/*.nc")


def _offered(incomplete: str, *patterns: str, names: Iterable[str] = ()) -> list[CompletionItem]:
    """Names and files that begin with the incomplete word, or else the files that the shell finds."""
    files = [str(path) for pattern in patterns for path in sorted(Path().glob(pattern))]
    items = [CompletionItem(name) for name in (*names, *files) if name.startswith(incomplete)]
    return items or [CompletionItem(incomplete, type="file")]


#: Arguments and options of several commands.
with_study = click.argument("study", shell_complete=study_completion)
_several = partial(click.argument, nargs=-1, required=True)
with_studies = _several("studies", metavar="STUDY...", shell_complete=study_completion)
with_archive = click.argument("archive", shell_complete=archive_completion)
with_archives = _several("archives", metavar="ARCHIVE...", shell_complete=archive_completion)
with_results = click.option(
    "--results", default="results", show_default=True, help="Folder for archives and what is made of them."
)
with_width = click.option(
    "--width",
    type=click.Choice(["column", "page"]),
    help="For print: 8.5 or 17.5 cm wide; else for a screen.",
)
with_style = click.option(
    "--style", metavar="STYLE", help="A matplotlib style: its name, or a .mplstyle file."
)
with_confidence = click.option(
    "--confidence", default=0.95, show_default=True, help="Level of the confidence intervals."
)
with_workers = click.option(
    "--workers", default=2, show_default=True, type=click.IntRange(1), help="Threads, or processes."
)


_NUMBER = re.compile(r"[-−+]?[\d.,·%e+⁻⁰¹²³⁴⁵⁶⁷⁸⁹-]+|nan|inf|–|")


def line_length() -> int | None:
    """Letters in a line of the terminal; None for a pipe or a file, whose lines may be of any length."""
    try:
        return get_terminal_size().columns if sys.stdout is not None and sys.stdout.isatty() else None
    except ValueError:
        return None  # a closed stream


def wrapped(line: str, width: int | None, indent: int = 0) -> str:
    """A line broken between words where it is longer than so many letters; further lines are indented.

    Examples
    --------
    >>> print(wrapped("axis  phase: 0, 0.04363 … 2π (151 values)", 26, 6))
    axis  phase: 0, 0.04363 …
          2π (151 values)
    """
    line = printable(line)
    if width is None or len(line) <= width:
        return line
    whole: dict[str, Any] = {"break_long_words": False, "break_on_hyphens": False}
    return textwrap.fill(line, max(width, indent + 12), subsequent_indent=" " * indent, **whole)


def pairs(option: str, texts: Iterable[str], allowed: str) -> dict[str, str]:
    """Read an option that is repeated, each time with a name, =, and a text."""
    found = {}
    for text in texts:
        name, sign, own = text.partition("=")
        if not sign:
            raise refused(option, literal(text), allowed)
        if name.strip() in found:
            raise refused(option, f"{name.strip()} twice", "one value of each")
        found[name.strip()] = own.strip()
    return found


def say(line: object, indent: int = 0, err: bool = False) -> None:
    """Print a line, broken where it is longer than the terminal's lines."""
    click.echo(wrapped(str(line), line_length(), indent), err=err)


def say_next(command: str) -> None:
    """Name the command that usually comes next, on a terminal alone: programs read the other lines."""
    if line_length() is not None:
        say(f"next: {command}")


def table(rows: Iterable[Sequence[str]], width: int = 10_000, head: Sequence[str] = ()) -> str:
    """Rows in columns, numbers to the right; what is too wide for the width is broken between words.

    Examples
    --------
    >>> print(table([["0", "0.142857"], ["1.5708", "0.15"]], head=["phase", "s"]))
     phase         s
         0  0.142857
    1.5708      0.15
    """
    from rich.console import Console
    from rich.table import Table

    grid, rows = Table.grid(padding=(0, 2, 0, 0)), [*rows]
    for column in zip(*rows, strict=True):
        numbers = all(_NUMBER.fullmatch(cell) for cell in column)
        # Only cells of three words and more are broken.
        whole = max(len(cell.split()) for cell in column) < 3
        grid.add_column(justify="right" if numbers else "left", overflow="fold", no_wrap=whole)
    for row in ([head] if head else []) + rows:
        grid.add_row(*map(printable, row))
    console = Console(width=width, color_system=None, markup=False, highlight=False)
    with console.capture() as capture:
        console.print(grid)
    return "\n".join(map(str.rstrip, capture.get().rstrip("\n").splitlines()))


def fitted(head: Sequence[str], rows: list[list[str]], width: int) -> str:
    """A table side by side; where that is too wide each row by itself, its names beside its values.

    Examples
    --------
    >>> print(fitted(["phase", "s"], [["0", "0.142857"], ["1.5708", "0.15"]], 14))
    phase         0
    s      0.142857
    <BLANKLINE>
    phase  1.5708
    s        0.15
    """
    flat = table(rows, head=head)
    if max(map(len, flat.splitlines())) <= width:
        return flat
    return "\n\n".join(table([*zip(head, row, strict=True)]) for row in rows)


def of_markdown(text: str, width: int | None) -> str:
    """Markdown whose tables are set in columns, and whose lines fit; as it is for a pipe or a file.

    Examples
    --------
    >>> print(of_markdown("| parameter | alone |\\n|---|---|\\n| friction | 0.59 |", 80))
    parameter  alone
    friction    0.59
    """
    if width is None:
        return text
    parts: list[str] = []
    for is_table, lines in groupby(text.splitlines(), lambda line: line.startswith("|")):
        if is_table:
            head, _, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
            parts.append(table(rows, width, head))
        else:
            parts += [wrapped(line, width, 2 * line.startswith("* ")) for line in lines]
    return "\n".join(parts)
