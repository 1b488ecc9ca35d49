"""Tables in files of a user, as rigs and spreadsheets write them: text with a header, or a workbook."""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
import warnings
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from swtstudy.study.keys import SEPARATORS, FileTable
from swtstudy.units.rows import KNOWN
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.files import LARGEST_TABLE, plain_float, read_file, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, meant, nearest, refused

#: More rows than this are no table that someone recorded for a study, nor are more columns.
MOST_ROWS, MOST_COLUMNS = 1_000_000, 1000
#: Rows in which a header is searched: loggers write a block of settings above it.
WITHIN = 200
#: Encodings that European rigs write where it is not UTF-8: Windows', and one that reads any byte.
ENCODINGS = ("cp1252", "latin-1")
_ENCODING_WORDS = " or ".join(map(literal, ENCODINGS))
_READABLE = "a CSV file that can be read"
_AS_CSV = "the sheet saved as CSV UTF-8"
#: First bytes of files that are no text, what they are, and the way to export them.
_OF_MATLAB = 'writetable(table(time, normal, tangential), "record.csv") in MATLAB'
FORMATS = (
    (b"\xd0\xcf\x11\xe0", "an Excel workbook before 2007", "saved as .xlsx, or the sheet as CSV UTF-8"),
    (b"MATLAB", "a MATLAB file", _OF_MATLAB),
    (b"\x89HDF", "an HDF5 file, as of MATLAB", _OF_MATLAB),
    (b"TDSm", "a LabVIEW TDMS file", "nptdms.TdmsFile(path).as_dataframe().to_csv(...) in Python"),
)

#: A number with a decimal comma, and its way out.
COMMA_HINT = "; a comma in numbers is decimal = ',', if all have one"
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")

#: Cells, in small letters, without a value: MATLAB and pandas write NaN.
MISSING = ("", "nan")
#: Number of the line of a row, and its cells.
Row = tuple[int, list[str]]


class UserTable(NamedTuple):
    """A table from a file.

    Attributes
    ----------
    headers
        The headers of its columns.
    units
        The cells of its row of units; empty without one.
    cells
        The lines of its rows, and their cells as texts.
    form
        How it is written, with what was found out.
    source
        The path, for messages.
    line
        Number of the line of the header.
    """

    headers: list[str]
    units: list[str]
    cells: list[Row]
    form: FileTable
    source: str
    line: int

    def has(self, name: str) -> bool:
        """Return whether the table has a column."""
        return self.form.header(name) in self.headers

    def texts(self, name: str) -> list[str]:
        """The cells of a column."""
        column = self.headers.index(self.form.header(name))
        return [cells[column] for _, cells in self.cells]

    def numbers(self, names: Sequence[str]) -> FloatArray:
        """Columns of numbers, scaled, shape (rows, k); a StudyError with the first mistake of each kind."""
        found, hints, report = [], set(), Report(self.source)
        for name in names:
            texts = self.texts(name)
            values = np.array([number(text, self.form.decimal) for text in texts])
            found.append(values * self.form.scale.get(name, 1.0))
            for row in np.flatnonzero(~np.isfinite(values))[:1]:
                text, hint = texts[row], ""  # the key that is usually missing there
                if text.lower() in MISSING:
                    timed = "time" in type(self.form).model_fields
                    hint = "; with the header of the time, time = ..., such rows are left out" * timed
                    hint = hint or "; leave such rows out"
                elif "," in text and self.form.decimal == ".":
                    hint = COMMA_HINT
                elif row == 0:
                    hint = "; lines above the header are skip_rows, a row of units is units_row = true"
                if hint not in hints:
                    place, shown = f"line {self.cells[row][0]}, {self.form.header(name)}", literal(text)
                    report(place, shown if text else "nothing", f"a finite number{hint}")
                hints |= {hint} - {""}
        report.refuse()
        return np.stack(found, axis=1)

    def values(self, name: str) -> list[object]:
        """The cells of a column, numbers where they are, scaled, and texts."""
        found = ((text, number(text, self.form.decimal)) for text in self.texts(name))
        factor = self.form.scale.get(name, 1.0)
        return [factor * value if math.isfinite(value) else text for text, value in found]

    def unit(self, name: str, kind: str) -> tuple[str, str]:
        """The unit of a column that its row of units or its header says, and its kind; empty if unknown.

        In a row of units or in brackets a unit of any kind counts, elsewhere one of the kind asked for.
        """
        column = self.headers.index(self.form.header(name))
        header, cell = self.headers[column], (self.units[column : column + 1] or [""])[0]
        bracket = re.search(r"[\[(]([^\[(]*)[\])]$", header)
        for text in (cell.strip("[]() "), bracket[1].strip() if bracket else ""):
            kinds = [each for each, known in KNOWN.items() if text in known]
            if kinds:
                return text, kind if kind in kinds else kinds[0]
        for text in (cell, header):
            words = re.findall(r"[A-Za-zµμ]+", text)
            if words and words[-1] in KNOWN[kind] and words[-1] != "in":
                return words[-1], kind
        return "", kind


def number(cell: str, decimal: str | None) -> float:
    """The number in a cell; NaN if there is none, or a point of thousands beside a decimal comma."""
    try:
        if decimal == ",":
            cell = cell.replace(".", "_").replace(",", ".")
        return plain_float(cell)
    except ValueError:
        return math.nan


def read_columns(
    path: Path,
    names: Sequence[str],
    optional: Sequence[str],
    form: FileTable,
    kinds: Mapping[str, str] | None = None,
    labels: Mapping[str, Any] | None = None,
    gaps: bool = False,
) -> tuple[FloatArray, IndexArray]:
    """Columns of numbers of a table, shape (rows, k), in the order of the names, and the lines of the rows.

    Parameters
    ----------
    path
        The file: a header with the names of the columns, then a row of numbers for each point.
    names
        Names of columns; others in the file are left alone.
    optional
        Names of further columns, appended if the file has them.
    form
        How it is written.
    kinds, labels
        "length", "force" or "stress" by column, and the study's label by kind: a unit of another kind is a
        mistake, and so is another unit without `scale`, or with the inverse of its factor.
    gaps
        Whether rows with an empty cell or NaN are left out, with a message; otherwise they are mistakes.

    Raises
    ------
    StudyError
        A ValueError with what is wrong in the file, and in which row.
    """
    known, report = dict.fromkeys((*names, *optional, *(kinds or ()))), Report()
    for part in ("scale", "columns"):
        for name in (each for each in getattr(form, part) if each not in known):
            report(f"{part}.{name}", literal(name), nearest(name, known, {}))
    if not known.keys() >= form.columns.keys():
        report.refuse()  # which column is meant is unknown
    with report:
        table = read_table(path, names, optional, form, told=report)
        for name in () if form.columns else (name for name in optional if not table.has(name)):
            # Such as Bulk, or bulk_stress: left alone it would count as 0.
            if alike := [each for each in table.headers if name in each.lower() or meant(each, [name], {})]:
                allowed = f"{name}, if that is meant, or another name"
                found = f"the column {literal(alike[0])}"
                report.append(Mistake(f"line {table.line}", found, allowed, table.source))
        names = [*names, *filter(table.has, optional)]
        for name, kind in (kinds or {}).items():
            if labels and name in names:
                report += _wrong_unit(table, name, kind, str(labels.get(kind)))
        columns = [table.headers.index(form.header(name)) for name in names]
        rows = table.cells if gaps else []
        empty = [line for line, cells in rows if any(cells[k].lower() in MISSING for k in columns)]
        if empty and len(empty) < len(table.cells):
            more = f" and {len(empty) - 1} more" if len(empty) > 1 else ""
            if not report:
                _tell(table.source, f"line {empty[0]}{more} left out: a value is missing")
            table = table._replace(cells=[row for row in table.cells if row[0] not in {*empty}])
        values = table.numbers(names)
    report.refuse()
    return values, np.array([line for line, _ in table.cells])


def _wrong_unit(table: UserTable, name: str, kind: str, label: str) -> list[Mistake]:
    """The mistake of a column of another kind, in another unit than the study's, or scaled the wrong way."""
    column, (unit, own_kind) = literal(table.form.header(name)), table.unit(name, kind)
    if own_kind != kind:
        found = f"{column} in {unit} as {name}, which is a {kind}"
        allowed = f"a column with a {kind}, not a {own_kind}, whatever its scale"
        return [Mistake("", found, allowed, table.source)]
    units, own = KNOWN[kind], table.form.scale.get(name)
    if not unit or label not in units or units[unit] == units[label]:
        return []
    factor = units[unit] / units[label]
    if own is not None and not math.isclose(abs(own) * factor, 1.0):
        return []
    found = f"{column} in {unit} as {name}, while [units] has {kind} in {label}"
    found += "" if own is None else f", and scale has {name} = {own:g}"
    allowed = f"scale = {{ {name} = {factor:g} }}; {name} = 1 if the unit in the file is wrong"
    return [Mistake("", found, allowed, table.source)]


def read_table(
    path: Path,
    names: Sequence[str],
    known: Collection[str],
    form: FileTable | None,
    most: int = MOST_ROWS,
    told: Report | None = None,
) -> UserTable:
    """The table in a file; separator, header, units and decimal sign are found unless they are given.

    Parameters
    ----------
    path
        The file.
    names
        Columns that it must have.
    known
        Further columns that it may have, which tell its separator.
    form
        Its form, as far as it is given; None where there are no keys for it, so that messages propose none.
    most
        Largest number of rows.
    told
        Told a wrong encoding and the like, with which the table is read all the same; they are raised unless
        given.

    Raises
    ------
    StudyError
        A ValueError with what is wrong, and in which line.
    """
    source, keys, form = str(path), form is not None, form or FileTable()
    try:
        data = read_file(path, LARGEST_TABLE)
    except OSError as error:
        raise refused("", reason_of(error), _READABLE, source) from None
    report = Report()
    if data.startswith(b"PK\x03\x04"):
        content: str | list[Row]
        source, content = _sheet(data, form, source)
    else:
        content = _text(data, form, source, report, keys)
    separator, above = _found_header(content, names, known, form, source, report, keys)
    if separator == form.decimal == ",":
        report("separator, decimal", "both ','", "two different signs")
        form = form.model_copy(update={"decimal": None})
    try:
        rows = list(islice(_rows(content, separator, form.skip_rows), above + most + 3))
    except csv.Error as error:
        raise refused("", str(error), _READABLE, source) from None
    skipped, (line, headers), rows = rows[:above], rows[above], rows[above + 1 :]
    if wrong := _wrong_headers(headers, names, known, form):
        raise refused(f"line {line}", *wrong, source)
    notices = []
    if above:
        notices.append(f"the header is found in line {line}: {_skipped_words(skipped)}")
    needed = [headers.index(form.header(name)) for name in names]
    units = _row_of_units(rows, needed, form)
    if units and form.units_row is None:
        notices.append(f"line {rows[0][0]} is read as units: {', '.join(filter(None, units))}")
    cells = rows[bool(units) :]
    if len(cells) > most:
        raise refused("", f"more than {most} rows", f"at most {most}", source)
    for place, own in cells:
        if len(own) - (own[-1] == "") > len(headers):
            allowed = "as many as columns: a comma between cells, a point in numbers"
            allowed += "; or say separator and decimal" * keys
            raise refused(f"line {place}", f"{len(own)} cells under {len(headers)} columns", allowed, source)
        own += [""] * (len(headers) - len(own))
    if form.decimal is None:
        # A comma if numbers have commas, and none has a point.
        texts = [own[k] for _, own in cells[:WITHIN] for k in needed or range(len(headers))]
        commas, points = (
            any(re.match(rf"[+-]?\d*{sign}\d", text) for text in texts) for sign in (",", r"\.")
        )
        comma = commas and not points and separator != ","
        form = form.model_copy(update={"decimal": "," if comma else "."})
        if comma:
            notices.append("numbers with a comma are read with decimal = ','")
    if told is None:
        report.refuse()
    else:
        told += report
    for words in notices if not report else ():
        _tell(source, words)
    return UserTable(headers, units, cells, form, source, line)


def _skipped_words(rows: Sequence[Row]) -> str:
    """Which lines above a header are skipped, and what they begin with."""
    lines = f"lines {rows[0][0]} to {rows[-1][0]} are" if len(rows) > 1 else f"line {rows[0][0]} is"
    return f"{lines} skipped, {literal(' '.join(filter(None, rows[0][1])), 40)}"


def _text(data: bytes, form: FileTable, source: str, report: Report, keys: bool) -> str:
    """The text in a file, its lines ended by newlines; of a wrong encoding as in Windows'."""
    for start, what, way in FORMATS:
        if data.startswith(start):
            raise refused("", what, f"a table in a text file: {way}", source)
    if form.sheet is not None:
        found = f"{literal(form.sheet)}, and {Path(source).name}, a text file"
        raise refused("sheet", found, "a sheet of an Excel workbook only")
    has_mark = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))  # Excel's "Unicode text"
    encoding = form.encoding or ("utf-16" if has_mark else "utf-8-sig")
    try:
        text = data.decode(encoding)
    except LookupError:
        report("encoding", literal(encoding), f"the name of an encoding, such as {_ENCODING_WORDS}")
        text = data.decode(ENCODINGS[0], "replace")
    except UnicodeDecodeError as error:
        # Name the line with bytes that cannot be decoded, and what they would be in another encoding.
        line = data.count(b"\n", 0, error.start) + 1
        begin = max(data.rfind(b"\n", 0, error.start) + 1, error.start - 12)
        piece = data[begin : error.start + 8].partition(b"\n")[0]
        read = literal(piece.decode(ENCODINGS[0], "replace").strip())
        found = f"bytes in line {line} that are not {error.encoding.upper().removesuffix('-SIG')}"
        allowed = f'encoding = "{ENCODINGS[0]}", which reads {read} there, or "{ENCODINGS[1]}"; or '
        report.append(Mistake("", found, f"{allowed * keys}the file saved as UTF-8", source))
        text = data.decode(ENCODINGS[0], "replace")
    if "\0" in text:
        raise refused("", "a binary file", "a table in a text file", source)
    return io.StringIO(text, newline=None).read()


def _sheet(data: bytes, form: FileTable, source: str) -> tuple[str, list[Row]]:
    """The file, with the names of its sheets if none is given, and the rows of the sheet that is read."""
    if b"xl/" not in data:
        raise refused("", "a zip archive", "a table in a text file, or an Excel workbook", source)
    try:
        import pandas as pd

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and the like that are not read
            book = pd.ExcelFile(io.BytesIO(data), "openpyxl")
            names, sheet = book.sheet_names, form.sheet if form.sheet is not None else 1
            if sheet not in names and not (isinstance(sheet, int) and 1 <= sheet <= len(names)):
                raise refused("sheet", literal(sheet), nearest(str(sheet), map(str, names), {}))
            if form.sheet is None and len(names) > 1:
                source += f", sheet {literal(names[0])} (others: {', '.join(map(literal, names[1:]))})"
            cells = book.parse(
                sheet if sheet in names else names[int(sheet) - 1], header=None, dtype=str, na_filter=False
            )
    except ImportError:
        allowed = f"pip install openpyxl, which reads it; or {_AS_CSV}"
        raise refused("", "an Excel workbook", allowed, source) from None
    except StudyError:
        raise
    except Exception as error:  # a damaged workbook fails anywhere in openpyxl
        raise refused("", f"a workbook that cannot be read ({error})", _AS_CSV, source) from None
    return source, list(enumerate(cells.values.tolist(), 1))


def _rows(content: str | list[Row], separator: str, skipped: int) -> Iterator[Row]:
    """Rows that are not empty: the number of the last line of each, and its cells in one line each."""
    if isinstance(content, str):
        lines: Iterator[str] = islice(io.StringIO(content), skipped, None)
        if separator == " ":
            lines = (" ".join(line.split()) for line in lines)
        reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
        rows: Iterator[Row] = ((reader.line_num + skipped, cells) for cells in reader)
    else:
        rows = islice(content, skipped, None)
    stripped = ((line, [" ".join(cell.split()) for cell in cells]) for line, cells in rows)
    return ((line, cells) for line, cells in stripped if any(cells))


def _found_header(
    content: str | list[Row],
    names: Sequence[str],
    known: Collection[str],
    form: FileTable,
    source: str,
    report: Report,
    keys: bool,
) -> tuple[str, int]:
    """The separator, and the number of rows above the header: the row with most of the names asked for."""
    wanted, others = {*map(form.header, names)}, {*map(form.header, known)}
    rows_of: dict[str, list[Row]] = {}
    score: dict[str, tuple[int, ...]] = {}
    header: dict[str, int] = {}
    for separator in SEPARATORS:
        rows: list[Row] = [(form.skip_rows + 1, [])]
        try:
            rows = [*islice(_rows(content, separator, form.skip_rows), WITHIN)] or rows
        except csv.Error as error:  # a stray quote makes the rest one cell
            if separator == SEPARATORS[0]:
                raise refused("", str(error), _READABLE, source) from None
        scores = [
            (len(wanted & {*row}), len(others & {*row}), not any(map(_is_number, row)), len(row))
            for _, row in rows
        ]
        rows_of[separator], score[separator] = rows, max(scores)
        header[separator] = scores.index(max(scores))
    if any(_parts(rows_of[each], rows_of[" "][header[" "]][0]) for each in SEPARATORS if each != " "):
        del score[" "]  # blanks within names
    likely = max(score, key=lambda each: (*score[each][:2], (each != " ") * score[each][-1]))
    own: str = form.separator or likely
    line, headers = rows_of[own][header[own]]
    if headers and wanted <= {*headers}:
        return own, header[own]
    report.refuse()  # in another encoding headers may be right
    found, allowed = _missing(headers, names, form, keys)
    others_fit = score[likely][0] == len(wanted) or score[likely][-1] >= len(names) > len(headers)
    if likely != own and others_fit:
        found, allowed = f"cells parted by {likely!r}, while separator is {own!r}", f"separator = {likely!r}"
    elif above := rows_of[own][: header[own]]:
        found += f" in line {line}, which is most like the header; {_skipped_words(above)}"
    raise refused(f"line {line}", found, allowed, source)


def _parts(rows: Sequence[Row], line: int) -> bool:
    """Return whether a separator gives a line, and the next one, the same number of cells, two at least."""
    own, *below = [len(cells) for place, cells in rows if place >= line][:2] or [0]
    return own > 1 and own in below


def _missing(headers: list[str], names: Sequence[str], form: FileTable, keys: bool) -> tuple[str, str]:
    """Say which column a header lacks, and what is allowed."""
    if not headers:
        return "an empty file", f"a header{' with ' * bool(names)}{', '.join(names)}, and rows of values"
    for name in names:
        if name in form.columns and form.header(name) not in headers:
            own = form.header(name)
            return f"no column {literal(own)}, which is to be {name}", nearest(own, headers, {})
    allowed = f"a header with {', '.join(names)}"
    allowed += ", or columns = {...} that says which these are" * keys
    return f"the columns {', '.join(headers)}", allowed


def _wrong_headers(
    headers: list[str], names: Sequence[str], known: Collection[str], form: FileTable
) -> tuple[str, str] | None:
    """Found and allowed of too many columns, or of a column that is there, or is used, twice."""
    if len(headers) > MOST_COLUMNS:
        return f"more than {MOST_COLUMNS} columns", "fewer"
    lower = [header.lower() for header in headers]
    for other in map(form.header, names):
        if len(alike := [name for name in names if form.header(name) == other]) > 1:
            return f"the column {literal(other)} as {' and '.join(alike)}", "a column of its own for each"
    for name in map(form.header, (*names, *known)):
        if lower.count(name.lower()) > 1:
            return f"the column {name} twice", "each column once"
    return None


def _row_of_units(rows: Sequence[Row], needed: Sequence[int], form: FileTable) -> list[str]:
    """The first row, if it is one of units: it has no number, and numbers are beneath."""
    if not rows or form.units_row is False:
        return []
    if form.units_row:
        return rows[0][1]
    first, *below = ([cells[k] for k in needed if k < len(cells)] for _, cells in rows[:2])
    numbers = below and all(map(_is_number, below[0])) and not any(map(_is_number, rows[0][1]))
    return rows[0][1] if any(first) and numbers else []


def _is_number(cell: str) -> bool:
    return any(math.isfinite(number(cell, sign)) for sign in ".,")


def _tell(source: str, words: str) -> None:
    warnings.warn(f"{Path(source).name}: {words}", stacklevel=5)
