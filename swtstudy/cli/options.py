"""Options that are given twice, where click would silently take the last."""

from __future__ import annotations

from collections import Counter

import click

from swtstudy.mistakes import Mistake, StudyError

#: Stands for an option's value where several may be given between commas.
SEVERAL = "VALUES"


def check_options(context: click.Context, command: click.Command, args: list[str]) -> None:
    """Refuse an option that is there more than once, unless it is meant to be.

    Raises
    ------
    StudyError
        With each of them.
    """
    try:
        _, _, order = command.make_parser(click.Context(command, context)).parse_args(list(args))
    except click.UsageError:
        return  # click reports it
    mistakes = []
    for parameter, count in Counter(order).items():
        single = isinstance(parameter, click.Option) and not (parameter.multiple or parameter.is_flag)
        if single and count > 1:
            allowed = "once" + ", several values between commas" * (parameter.metavar == SEVERAL)
            mistakes.append(Mistake(parameter.opts[0], f"{count} times", allowed))
    if mistakes:
        raise StudyError(mistakes)
