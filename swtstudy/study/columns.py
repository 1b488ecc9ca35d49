"""Columns of numbers from a CSV file with a header."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from swtstudy.files import plain_float, read_table
from swtstudy.mechanics.points import FloatArray
from swtstudy.mistakes import Mistake, StudyError, literal, meant

#: More rows than this are no table that someone made for a study.
MOST_ROWS = 100_000


def read_columns(path: Path, names: Sequence[str], optional: Sequence[str] = ()) -> FloatArray:
    """The columns of a CSV file, shape (rows, k), in the order of the names.

    Parameters
    ----------
    path
        The file: a header with the names of the columns, then a row of numbers for each point.
    names
        Names of columns; others in the file are left alone.
    optional
        Names of columns that come behind them if the file has them.

    Raises
    ------
    StudyError
        A ValueError with what is wrong in the file, and in which row.
    """
    source = str(path)
    try:
        header, rows = read_table(path, MOST_ROWS)
    except (OSError, ValueError) as error:
        found = getattr(error, "strerror", None) or str(error)
        raise StudyError([Mistake("", found, "a CSV file in UTF-8 that can be read", source)]) from None
    if wrong := _wrong_header(header, names, optional):
        raise StudyError([Mistake("line 1", *wrong, source)])
    names = [*names, *(name for name in optional if name in header)]
    places = [header.index(name) for name in names]
    values = []
    for line, row in rows:
        if any(row[len(header) :]):
            found = f"{len(row)} cells under {len(header)} columns"
            allowed = "as many as columns: a comma between cells, a point in numbers"
            raise StudyError([Mistake(f"line {line}", found, allowed, source)])
        values.append(_numbers(row, places, names, line, source))
    return np.array(values, dtype=np.float64).reshape(len(values), len(names))


def _wrong_header(header: list[str], names: Sequence[str], optional: Sequence[str]) -> tuple[str, str] | None:
    """What was found in a header and what is allowed, if it lacks a column or leaves one in doubt."""
    allowed = f"a header with {', '.join(names)}"
    if not {*names} <= {*header}:
        return f"the columns {', '.join(header) or 'of an empty file'}", allowed
    lower = [name.lower() for name in header]
    for name in (*names, *optional):
        if lower.count(name) > 1:
            return f"the column {name} twice", "each column once"
    # Such as Bulk, or bulk_stress: left alone it would count as 0.
    for name in (name for name in optional if name not in header):
        for other in header:
            if name in other.lower() or meant(other, [name], {}):
                return f"the column {literal(other)}", f"{name}, if that is meant, or another name"
    return None


def _numbers(row: list[str], places: list[int], names: Sequence[str], line: int, source: str) -> list[float]:
    numbers = []
    for place, name in zip(places, names, strict=True):
        word = row[place] if place < len(row) else ""
        try:
            number = plain_float(word)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            found = literal(word) if word else "nothing"
            raise StudyError([Mistake(f"line {line}, {name}", found, "a finite number", source)])
        numbers.append(number)
    return numbers
