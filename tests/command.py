"""The command in this process."""

from __future__ import annotations

from click.testing import CliRunner, Result

from swtstudy.cli import main as main


def call(*arguments: object) -> Result:
    """What the command does with arguments."""
    return CliRunner().invoke(main, list(map(str, arguments)))
