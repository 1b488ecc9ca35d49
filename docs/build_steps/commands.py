"""The help of every command."""

import click

from swtstudy.cli import main


def commands() -> str:
    """What ``--help`` prints, command by command."""
    group = main.make_context("swtstudy", [], resilient_parsing=True)
    parts = [f"```text\n{main.get_help(group)}\n```\n"]
    for name in main.list_commands(group):
        command = main.commands[name]
        context = click.Context(command, info_name=name, parent=group)
        parts.append(f"## swtstudy {name}\n\n```text\n{command.get_help(context)}\n```\n")
    return "\n".join(parts)
