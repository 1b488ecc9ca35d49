"""Columns of numbers from a CSV file with a header."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.mistakes import Mistake, StudyError, literal

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
        with open(path, encoding="utf-8-sig", newline="") as file:
            rows = csv.reader(file, skipinitialspace=True)
            header = [word.strip() for word in next(rows, [])]
            if not {*names} <= {*header}:
                found = f"the columns {', '.join(header) or 'of an empty file'}"
                raise StudyError([Mistake("", found, f"a header with {', '.join(names)}", source)])
            names = [*names, *(name for name in optional if name in header)]
            places = [header.index(name) for name in names]
            values = [_numbers(row, places, names, rows.line_num, source) for row in _few(rows, source)]
    except OSError as error:
        found = error.strerror or str(error)
        raise StudyError([Mistake("", found, "a CSV file that can be read", source)]) from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise StudyError([Mistake("", f"no text ({error})", "a CSV file in UTF-8", source)]) from None
    return np.array(values, dtype=np.float64).reshape(len(values), len(names))


def _few(rows: Iterator[list[str]], source: str) -> Iterator[list[str]]:
    """The rows that are not empty."""
    count = 0
    for row in rows:
        if not any(word.strip() for word in row):
            continue
        count += 1
        if count > MOST_ROWS:
            raise StudyError([Mistake("", f"more than {MOST_ROWS} rows", f"at most {MOST_ROWS}", source)])
        yield row


def _numbers(row: list[str], places: list[int], names: Sequence[str], line: int, source: str) -> list[float]:
    numbers = []
    for place, name in zip(places, names, strict=True):
        word = row[place].strip() if place < len(row) else ""
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            found = literal(word) if word else "nothing"
            raise StudyError([Mistake(f"line {line}, {name}", found, "a finite number", source)])
        numbers.append(number)
    return numbers
