"""Tables and lines for a terminal, as wide as it is."""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterable, Sequence
from itertools import groupby
from shutil import get_terminal_size
from typing import Any

import click

from swtstudy.vocabulary.wording import printable

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
    look: dict[str, Any] = {"subsequent_indent": " " * indent}
    look |= {"break_long_words": False, "break_on_hyphens": False}
    return textwrap.fill(line, max(width, indent + 12), **look)


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
