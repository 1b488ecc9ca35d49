"""Columns of numbers from a file of a user: a table with a header, as rigs and spreadsheets write them."""

from __future__ import annotations

import csv
import io
import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.files import LARGEST_TABLE, plain_float, read_text, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, meant, nearest

if TYPE_CHECKING:
    import pandas as pd

#: More rows than this are no table that someone recorded for a study.
MOST_ROWS = 1_000_000
#: What may stand between cells and within numbers; a blank stands for any number of them.
SEPARATORS, DECIMALS = (",", ";", "\t", " ", "|"), (".", ",")


@dataclass(frozen=True)
class Form:
    """The form of a table: its separator, its decimal sign, its headers.

    Attributes
    ----------
    separator
        What is between cells, one of `SEPARATORS`.
    decimal
        The decimal sign of numbers, "." or ",".
    headers
        The headers of columns that are not those names that they have here.
    """

    separator: str = ","
    decimal: str = "."
    headers: Mapping[str, str] = field(default_factory=dict)

    def header(self, name: str) -> str:
        """Return the header of a column."""
        return self.headers.get(name, name)


PLAIN = Form()


def form_of(given: Mapping[str, Any]) -> Form:
    """The form by what is given of ``separator``, ``decimal`` and ``columns``, the headers."""
    separator, decimal = given.get("separator") or PLAIN.separator, given.get("decimal") or PLAIN.decimal
    # Those of the file are stripped, too.
    headers = {own: str(header).strip() for own, header in (given.get("columns") or {}).items()}
    return Form(separator, decimal, headers)


def check_form(given: Mapping[str, Any], names: Sequence[str], report: Report) -> None:
    """Report what is wrong with a form, of which there may be headers of columns of these names."""
    before = len(report)
    for key, allowed in (("separator", SEPARATORS), ("decimal", DECIMALS)):
        if given.get(key) is not None and given[key] not in allowed:
            report(key, literal(given[key]), f"one of {', '.join(map(repr, allowed))}")
    headers = given.get("columns")
    if headers is not None and not (
        isinstance(headers, Mapping)
        and all(isinstance(each, str) and each.strip() for each in headers.values())
    ):
        report("columns", literal(headers), f'a table of headers, such as {{ {names[0]} = "Fn [N]" }}')
        return
    for name in headers or ():
        if name not in names:
            report(f"columns.{name}", literal(name), nearest(str(name), names, {}))
    form = PLAIN if len(report) > before else form_of(given)
    if form.separator == form.decimal:
        report("separator, decimal", f"both {form.decimal!r}", "two different signs")


def read_columns(path: Path, names: Sequence[str], optional: Sequence[str], form: Form) -> FloatArray:
    """The columns of a table, shape (rows, k), in the order of the names.

    Parameters
    ----------
    path
        The file: a header with the names of the columns, then a row of numbers for each point.
    names
        Names of columns; others in the file are left alone.
    optional
        Names of columns that come behind them if the file has them.
    form
        How it is written.

    Raises
    ------
    StudyError
        A ValueError with what is wrong in the file, and in which row.
    """
    source = str(path)
    try:
        text = io.StringIO(read_text(path, LARGEST_TABLE), newline=None).read()  # lines end as \n, \r\n or \r
    except (OSError, ValueError) as error:
        raise StudyError(
            [Mistake("", reason_of(error), "a CSV file in UTF-8 that can be read", source)]
        ) from None
    try:
        line, header = _header(text, form)
        if wrong := _wrong_header(header, names, optional, form):
            wrong = _wrong_separator(text, names, optional, form) or wrong
            raise StudyError([Mistake(f"line {line}", *wrong, source)])
    except csv.Error as error:
        raise StudyError([Mistake("", str(error), "a CSV file that can be read", source)]) from None
    names = [*names, *(name for name in optional if form.header(name) in header)]
    table = _cells(text, line, len(header), form, source)
    columns = [_numbers(table[header.index(form.header(name))], form, name, source) for name in names]
    return np.stack(columns, axis=1)


def read_as_given(path: Path, names: Sequence[str], given: Mapping[str, Any]) -> FloatArray:
    """The columns of a table in the form that is given; a StudyError with every mistake in that."""
    check_form(given, names, report := Report())
    report.refuse()
    return read_columns(path, names, (), form_of(given))


def _header(text: str, form: Form) -> tuple[int, list[str]]:
    """The first line that is not empty: its number, and its cells."""
    for number, line in enumerate(io.StringIO(text), start=1):
        if line.strip():
            between = {"delimiter": form.separator, "skipinitialspace": True}
            cells = next(csv.reader([" ".join(line.split()) if form.separator == " " else line], **between))  # type: ignore[arg-type]
            return number, [cell.strip() for cell in cells]
    return 1, []


def _cells(text: str, line: int, width: int, form: Form, source: str) -> pd.DataFrame:
    """The cells below the header as texts, by column from 0 on and by the number of their line."""
    import pandas as pd

    options: dict[str, Any] = {"header": None, "dtype": str, "keep_default_na": False}
    options |= {"skip_blank_lines": False, "skipinitialspace": True, "skiprows": line}
    options["sep"] = r"\s+" if form.separator == " " else form.separator
    try:
        with warnings.catch_warnings():
            # Of a first row that is longer than the names pandas would drop the rest.
            warnings.simplefilter("error", pd.errors.ParserWarning)
            table = pd.read_csv(io.StringIO(text), names=range(width + 1), index_col=False, **options)
    except pd.errors.ParserWarning:
        cells = text.split("\n")[line].count(form.separator) + 1
        raise StudyError([_too_long(cells, width, line + 1, source)]) from None
    except (pd.errors.ParserError, ValueError) as error:
        raise StudyError([_unreadable(str(error), width, source)]) from None
    if len(table) > MOST_ROWS:
        raise StudyError([Mistake("", f"{len(table)} rows", f"at most {MOST_ROWS}", source)])
    table = table.fillna("").apply(lambda column: column.str.strip())
    table.index = table.index + line + 1
    table = table[(table != "").any(axis=1)]
    if (table[width] != "").any():
        raise StudyError([_too_long(width + 1, width, int((table[width] != "").idxmax()), source)])
    return table


def _unreadable(error: str, width: int, source: str) -> Mistake:
    """Say in our words what pandas could not read."""
    counts = re.search(r"Expected \d+ fields in line (\d+), saw (\d+)", error)
    if counts:
        return _too_long(int(counts[2]), width, int(counts[1]), source)
    return Mistake("", error.rpartition("C error: ")[2].strip(), "a CSV file that can be read", source)


def _too_long(found: int, width: int, line: int, source: str) -> Mistake:
    allowed = "as many as columns: a comma between cells, a point in numbers; or say separator and decimal"
    return Mistake(f"line {line}", f"{found} cells under {width} columns", allowed, source)


def _wrong_separator(
    text: str, names: Sequence[str], optional: Sequence[str], form: Form
) -> tuple[str, str] | None:
    """Return what was found and what is allowed, if a header has its columns only with another separator."""
    for separator in SEPARATORS:
        other = replace(form, separator=separator)
        header, own = (_header(text, each)[1] for each in (other, form))
        enough = separator != " " and len(header) >= len(names) > len(own)
        if enough or not _wrong_header(header, names, optional, other):
            found = f"cells parted by {separator!r}, while separator is {form.separator!r}"
            return found, f"separator = {separator!r}"
    return None


def _wrong_header(
    header: list[str], names: Sequence[str], optional: Sequence[str], form: Form
) -> tuple[str, str] | None:
    """Return what was found in a header and what is allowed, if it lacks a column or leaves one in doubt."""
    for own, other in form.headers.items():
        if other not in header:
            return f"no column {literal(other)}, which is to be {own}", nearest(other, header, {})
    allowed = f"a header with {', '.join(names)}, or columns = {{...}} that says which these are"
    if not {*map(form.header, names)} <= {*header}:
        return f"the columns {', '.join(header) or 'of an empty file'}", allowed
    for other in map(form.header, names):
        alike = [name for name in names if form.header(name) == other]
        if len(alike) > 1:
            return f"the column {literal(other)} as {' and '.join(alike)}", "a column of its own for each"
    lower = [name.lower() for name in header]
    for name in map(form.header, (*names, *optional)):
        if lower.count(name.lower()) > 1:
            return f"the column {name} twice", "each column once"
    # Such as Bulk, or bulk_stress: left alone it would count as 0.
    for name in () if form.headers else (name for name in optional if name not in header):
        for other in header:
            if name in other.lower() or meant(other, [name], {}):
                return f"the column {literal(other)}", f"{name}, if that is meant, or another name"
    return None


def _numbers(cells: pd.Series, form: Form, name: str, source: str) -> FloatArray:
    """The numbers in a column."""
    values = np.empty(len(cells))
    for row, (line, cell) in enumerate(cells.items()):
        try:
            values[row] = _number(cell, form.decimal)
        except ValueError:
            values[row] = math.nan
        if not math.isfinite(values[row]):
            found = literal(cell) if cell else "nothing"
            raise StudyError([Mistake(f"line {line}, {form.header(name)}", found, "a finite number", source)])
    return values


def _number(cell: str, decimal: str) -> float:
    """The number in a cell; with a decimal comma, a point would be one of thousands."""
    if decimal == ".":
        return plain_float(cell)
    if "." in cell:
        raise ValueError("a point beside a decimal comma")
    return plain_float(cell.replace(decimal, "."))
