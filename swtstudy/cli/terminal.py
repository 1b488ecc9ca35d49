"""Tables and lines for a terminal, as wide as it is."""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterator, Sequence
from itertools import groupby
from shutil import get_terminal_size

#: Blanks between columns.
_GAP = "  "
#: A column of words is not made narrower.
_NARROWEST = 12


def line_length() -> int | None:
    """Letters in a line of the terminal; None for a pipe or a file, whose lines may be of any length."""
    try:
        return get_terminal_size().columns if sys.stdout is not None and sys.stdout.isatty() else None
    except ValueError:
        return None  # a closed stream


def printable(text: str) -> str:
    """A text without control characters, which a terminal would obey; lines and tabs stay.

    Examples
    --------
    >>> printable("a\x1b[31m title")
    'a�[31m title'
    """
    return re.sub(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", "\N{REPLACEMENT CHARACTER}", text)


def cut(line: str, width: int | None) -> str:
    """A line no longer than so many letters, with an ellipsis where words are left out.

    Examples
    --------
    >>> cut("Figure 3: s over the phase", 12)
    'Figure 3: s…'
    """
    line = printable(line)
    return line if width is None or len(line) <= width else f"{line[: width - 1].rstrip()}…"


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
    return textwrap.fill(
        line,
        max(width, indent + _NARROWEST),
        subsequent_indent=" " * indent,
        break_long_words=False,
        break_on_hyphens=False,
    )


def fitted(lines: list[list[str]], width: int) -> list[str]:
    """A table with a head: its columns side by side, or one below the other where they are too wide.

    Examples
    --------
    >>> for line in fitted([["phase", "s"], ["0", "0.142857"], ["1.5708", "0.15"]], 14):
    ...     print(line)
    phase         0
    s      0.142857
    <BLANKLINE>
    phase  1.5708
    s        0.15
    """
    flat = aligned(lines)
    if max(map(len, flat)) <= width:
        return flat
    head, *rows = lines
    return [line for part in _blocks(head, rows, width) for line in part][:-1]


def aligned(lines: list[list[str]]) -> list[str]:
    """Lines whose columns are as wide as they need to be, words to the left and numbers to the right.

    Examples
    --------
    >>> for line in aligned([["phase", "s"], ["0", "0.142857"], ["1.5708", "0.15"]]):
    ...     print(line)
     phase         s
         0  0.142857
    1.5708      0.15
    """
    return _set(lines, _of_words(lines))


def _blocks(head: list[str], rows: list[list[str]], width: int) -> Iterator[list[str]]:
    """The rows as columns beside the head, as many as there is room for, and an empty line below them."""
    while rows:
        count = 1
        for more in range(2, len(rows) + 1):
            if max(map(len, _upright(head, rows[:more]))) > width:
                break
            count = more
        yield [*_upright(head, rows[:count]), ""]
        rows = rows[count:]


def _upright(head: list[str], rows: list[list[str]]) -> list[str]:
    return _set([list(line) for line in zip(head, *rows, strict=True)], [True, *[False] * len(rows)])


def _of_words(lines: list[list[str]]) -> list[bool]:
    """Which columns have words, by their last lines."""
    return [column[-1][-1:].isalpha() and column[-1] != "nan" for column in zip(*lines, strict=True)]


def _set(lines: list[list[str]], left: Sequence[bool]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        _GAP.join(
            f"{cell:{'<' if own else '>'}{width}}"
            for cell, own, width in zip(line, left, widths, strict=True)
        ).rstrip()
        for line in lines
    ]


def of_markdown(text: str, width: int | None) -> str:
    """Markdown whose tables are set in columns, and whose lines are no longer than so many letters.

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
            rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
            filled = [row for row in rows if any(set(cell) - {"-"} for cell in row)]  # no rule below the head
            parts += [line for row in _table(filled, width) for line in row]
        else:
            parts += [wrapped(line, width, 2 * line.startswith("* ")) for line in lines]
    return "\n".join(parts)


def _table(rows: list[list[str]], width: int) -> list[list[str]]:
    """The lines of each row: for want of room the widest column is broken, or the last one is set below."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    widest = widths.index(max(widths))
    room = width - sum(widths) + widths[widest] - len(_GAP) * (len(widths) - 1)
    if room >= min(widths[widest], _NARROWEST) or len(widths) == 1:
        return _broken(rows, widest, max(room, _NARROWEST))
    margin = " " * 4
    below = [textwrap.wrap(row[-1], width, initial_indent=margin, subsequent_indent=margin) for row in rows]
    above = _table([row[:-1] for row in rows], width)
    return [[*lines, *others] for lines, others in zip(above, below, strict=True)]


def _broken(rows: list[list[str]], column: int, width: int) -> list[list[str]]:
    """The lines of each row, with the cells of one column broken to a width."""
    parts = [textwrap.wrap(row[column], width) or [""] for row in rows]
    cells = [
        [part if k == column else each * (number == 0) for k, each in enumerate(row)]
        for row, own in zip(rows, parts, strict=True)
        for number, part in enumerate(own)
    ]
    lines = iter(_set(cells, _of_words(rows)))
    return [[next(lines) for _ in own] for own in parts]
