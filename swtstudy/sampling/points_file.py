"""Points from a CSV file: a header with names of parameters, and a row for each point."""

from __future__ import annotations

import csv
from pathlib import Path

from swtstudy.mistakes import Report, literal

#: Key of the file in messages.
KEY = "sample.file"
ALLOWED = "a CSV file: a row with names of parameters, then a row with their values for each point"


def read_points(path: Path, report: Report) -> dict[str, list[object]] | None:
    """The columns of a file by name; numbers are read, other texts are left. None if there are mistakes."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = [(reader.line_num, row) for reader in [csv.reader(file)] for row in reader if any(row)]
    except (OSError, ValueError, csv.Error) as error:  # a UnicodeDecodeError is a ValueError
        report(KEY, f"{literal(str(path))} ({getattr(error, 'strerror', None) or error})", ALLOWED)
        return None
    if len(rows) < 2:
        report(KEY, f"{literal(str(path))} without points", ALLOWED)
        return None
    names = [name.strip() for name in rows[0][1]]
    twice = {name for name in names if names.count(name) > 1}
    ragged = [line for line, row in rows[1:] if len(row) != len(names)]
    if twice:
        report(KEY, f"{', '.join(sorted(twice))} twice in the first row", "each parameter once")
    if ragged:
        more = f" and {len(ragged) - 1} more" if len(ragged) > 1 else ""
        report(KEY, f"line {ragged[0]}{more} with another number of values", f"{len(names)} values")
    if twice or ragged:
        return None
    columns = zip(*(row for _, row in rows[1:]), strict=True)
    return {
        name: [_number_or_text(cell) for cell in column] for name, column in zip(names, columns, strict=True)
    }


def _number_or_text(cell: str) -> object:
    try:
        return float(cell)
    except ValueError:
        return cell.strip()
