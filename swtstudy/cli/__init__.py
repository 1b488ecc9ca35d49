"""The command line. Each command imports what it needs when it runs, so that help appears at once."""

from __future__ import annotations

import atexit
import gc
import io
import itertools
import logging
import signal
import sys
import warnings
from typing import Any

import click

import swtstudy
from swtstudy.cli import terminal
from swtstudy.cli.checks import audit, check, fit, history, sensitivity
from swtstudy.cli.points import show, solve
from swtstudy.cli.results import info, merge, plot, report
from swtstudy.cli.run import run
from swtstudy.cli.studies import list_studies, new, plan, schema, validate
from swtstudy.vocabulary.wording import printable

#: Exit code for input that cannot be used, the same as click's for wrong options.
BAD_INPUT = 2

#: Exit code after Ctrl-C, the same as in shells.
STOPPED = 130


#: The commands by what they are for, as help lists them.
_SECTIONS = {
    "Studies": (new, validate, plan, run, list_studies, schema),
    "Results": (report, plot, info, merge),
    "Single points": (solve, show, history),
    "What matters, and checks": (sensitivity, fit, check, audit),
}


class _Commands(click.Group):
    """A group whose commands answer bad input with one line per mistake, never with a traceback."""

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        for title, commands in _SECTIONS.items():
            with formatter.section(title):
                # The first paragraph of each, uncut.
                said = (" ".join(str(each.help).split("\n\n")[0].split()) for each in commands)
                formatter.write_dl([*zip((str(each.name) for each in commands), said, strict=True)])

    def resolve_command(
        self, context: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name, command, rest = super().resolve_command(context, args)
        if command is not None and not context.resilient_parsing:
            terminal.check_options(context, command, rest)
        return name, command, rest

    def main(self, *arguments: Any, **options: Any) -> Any:
        for stream in sys.stdout, sys.stderr:
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="replace")  # a console may lack Greek letters
        return super().main(*arguments, **options)

    def invoke(self, context: click.Context) -> Any:
        # Log messages of the package, and warnings, are plain lines.
        warnings.showwarning = lambda message, *_, **__: click.echo(f"Warning: {message}", err=True)
        logger = logging.getLogger("swtstudy")
        if not logger.handlers:
            logger.addHandler(logging.StreamHandler())
        logger.setLevel(logging.INFO)
        # Before it exits, Python would look through all objects once more: for 0.3 s after a run.
        atexit.register(gc.freeze)
        try:
            return super().invoke(context)
        except BrokenPipeError:
            raise  # the reader of our output has closed it, such as `head -1`: click ends silently
        except (ValueError, OSError, MemoryError) as error:
            for line in (str(error) or type(error).__name__).splitlines():
                click.echo(f"Error: {printable(line)}", err=True)
            sys.exit(BAD_INPUT)
        except KeyboardInterrupt as error:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # we are stopping: a second Ctrl-C changes nothing
            click.echo(str(error) or "stopped", err=True)
            sys.exit(STOPPED)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(swtstudy.__version__, prog_name="swtstudy")
def main() -> None:
    """Parameter studies of the Smith–Watson–Topper parameter in frictional contacts.

    \b
    Examples:
      swtstudy run figure3      # a study of the paper: archive and figure
      swtstudy new mine         # a commented study to start from
      swtstudy run --help

    \b
    Shell completion, a line of ~/.bashrc (zsh_source in ~/.zshrc):
      eval "$(_SWTSTUDY_COMPLETE=bash_source swtstudy)"
    """


for _command in itertools.chain(*_SECTIONS.values()):
    main.add_command(_command)
