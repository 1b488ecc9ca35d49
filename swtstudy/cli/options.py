"""Shared by commands: checks of options, completion of arguments by the shell."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import click
from click import Context, Parameter
from click.shell_completion import CompletionItem

from swtstudy.study.shipped import shipped_studies
from swtstudy.vocabulary.mistakes import Report, meant
from swtstudy.vocabulary.parameters import AXES

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
        names = {name: f"--{name.replace('_', '-')}" for name in (p.name for p in command.params) if name}
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


#: Arguments of several commands.
with_studies = click.argument(
    "studies", nargs=-1, required=True, metavar="STUDY...", shell_complete=study_completion
)
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
with_workers = click.option(
    "--workers", default=2, show_default=True, type=click.IntRange(1), help="Threads, or processes."
)
