"""Points from a CSV file: a header with names of parameters, and a row for each point."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from swtstudy.points.reading import LONGEST_AXIS
from swtstudy.vocabulary.files import plain_float, read_table
from swtstudy.vocabulary.mistakes import Report, literal

#: Key of the file in messages.
KEY = "sample.file"
ALLOWED = "a CSV file: a row with names of parameters, then a row with their values for each point"


def read_points(path: Path, report: Report) -> dict[str, list[object]] | None:
    """The columns of a file by name; numbers are read, other texts are left. None if there are mistakes."""
    try:
        names, rows = read_table(path, LONGEST_AXIS)
    except (OSError, ValueError) as error:
        report(KEY, f"{literal(str(path))} ({getattr(error, 'strerror', None) or error})", ALLOWED)
        return None
    if not rows:
        report(KEY, f"{literal(str(path))} without points", ALLOWED)
        return None
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    ragged = [line for line, row in rows if len(row) != len(names)]
    if twice:
        report(KEY, f"{', '.join(twice)} twice in the first row", "each parameter once")
    if ragged:
        more = f" and {len(ragged) - 1} more" if len(ragged) > 1 else ""
        report(KEY, f"line {ragged[0]}{more} with another number of values", f"{len(names)} values")
    if twice or ragged:
        return None
    columns = zip(*(row for _, row in rows), strict=True)
    return {
        name: [_number_or_text(cell) for cell in column] for name, column in zip(names, columns, strict=True)
    }


def _number_or_text(cell: str) -> object:
    try:
        return plain_float(cell)
    except ValueError:
        return cell
