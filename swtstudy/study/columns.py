"""Tables in files of a user, as rigs and spreadsheets write them: text with a header, or a workbook."""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import islice
from pathlib import Path
from types import MappingProxyType

import numpy as np

from swtstudy.points.reading import LONGEST_AXIS
from swtstudy.study.column_units import different_units, wrong_units
from swtstudy.study.keys import SEPARATORS, FileTable
from swtstudy.study.units.rows import Units
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.files import LARGEST_TABLE, plain_float, read_file, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, meant, nearest, refused

#: Rows are as many as values of an axis at most. More columns than this are no table recorded for a study.
MOST_ROWS, MOST_COLUMNS = LONGEST_AXIS, 1000
#: Rows in which a header is searched: loggers write a block of settings above it.
WITHIN = 200
#: Encodings that European rigs write where it is not UTF-8: Windows', and one that reads any byte.
ENCODINGS = ("cp1252", "latin-1")
_READABLE = "a CSV file that can be read"
_AS_CSV = "the sheet saved as CSV UTF-8"
#: First bytes of files that are no text, what they are, and the way to export them.
_OF_MATLAB = 'writetable(table(time, normal, tangential), "record.csv") in MATLAB'
FORMATS = (
    (b"\xd0\xcf\x11\xe0", "an Excel workbook before 2007", "saved as .xlsx, or the sheet as CSV UTF-8"),
    (b"MATLAB", "a MATLAB file", _OF_MATLAB),
    (b"\x89HDF", "an HDF5 file, as of netCDF or MATLAB", _OF_MATLAB),
    (b"TDSm", "a LabVIEW TDMS file", "nptdms.TdmsFile(path).as_dataframe().to_csv(...) in Python"),
)

#: Said of numbers with a decimal comma.
COMMA_HINT = "; a comma in numbers is decimal = ',', if all have one"
#: Said of times that are not understood.
CLOCK_HINT = ", or times in all rows, such as 23:59:05.25 or 2026-12-31 23:59:05.25"

#: Cells, in small letters, without a value: MATLAB and pandas write NaN.
MISSING = ("", "nan")
#: Number of the line of a row, and its cells.
Row = tuple[int, list[str]]


class UserTable:
    """A table in a file; its separator, header, units and decimal sign are found unless they are given.

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
    aliases
        Other headers of some columns, in small letters, where no header is given for these.

    Attributes
    ----------
    headers
        The headers of its columns.
    units
        The cells of its row of units; empty without one.
    cells
        The lines of its rows, and their cells as texts.
    form, decimal
        Its form as it was given, and the decimal sign in its numbers.
    source
        The path, for messages.
    line
        Number of the line of the header.
    report
        A wrong encoding and the like, with which the table is read all the same.

    Raises
    ------
    StudyError
        A ValueError with what is wrong, and in which line.
    """

    def __init__(
        self,
        path: Path,
        names: Sequence[str],
        known: Collection[str],
        form: FileTable | None,
        aliases: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self.source, self.names, self.known = str(path), names, known
        self.form, self.has_keys = form or FileTable(), form is not None
        self.report = Report()
        # The names by small letters, where no headers are given for them: rigs write Step or TIME.
        self._names = {name.lower(): name for name in (*names, *known) if name not in self.form.columns}
        self._aliases = {each: name for each, name in aliases.items() if name.lower() in self._names}
        try:
            data = read_file(path, LARGEST_TABLE)
        except OSError as error:
            raise self.refused("", reason_of(error), _READABLE) from None
        is_sheet = data.startswith(b"PK\x03\x04")
        text = self._sheet(data) if is_sheet else self._text(data)
        separator, above = self._found_header(text)
        self.decimal = self.form.decimal
        if separator == self.decimal == ",":
            self.report("separator, decimal", "both ','", "two different signs")
            self.decimal = None
        try:
            rows = list(islice(_rows(text, separator, self.form.skip_rows), above + MOST_ROWS + 3))
        except csv.Error as error:
            raise self.refused("", str(error), _READABLE) from None
        skipped, (self.line, headers), rows = rows[:above], rows[above], rows[above + 1 :]
        self.headers = self._named(headers)
        self._check_headers()
        notices = []
        if above:
            notices.append(f"the header is found in line {self.line}: {_skipped_words(skipped)}")
        needed, width = [*map(self.column, self.names)], len(self.headers)
        self.units = _row_of_units(rows, needed, self.form)
        if self.units and self.form.units_row is None:
            notices.append(f"line {rows[0][0]} is read as units: {', '.join(filter(None, self.units))}")
        self.cells = rows[bool(self.units) :]
        if len(self.cells) > MOST_ROWS:
            raise self.refused("", f"more than {MOST_ROWS} rows", f"at most {MOST_ROWS}")
        for place, own in self.cells:
            if len(own) - (own[-1] == "") > width:
                allowed = "as many as columns: a comma between cells, a point in numbers"
                allowed += "; or say separator and decimal" * self.has_keys
                raise self.refused(f"line {place}", f"{len(own)} cells under {width} columns", allowed)
            own += [""] * (width - len(own))
        if is_sheet and self.decimal != ".":
            if self._without_commas(needed) and self.decimal is None:
                notices.append("numbers with a comma are read with decimal = ','")
            self.decimal = "."
        elif self.decimal is None:
            self.decimal = "," if separator != "," and self._has_commas(needed) else "."
            if self.decimal == ",":
                notices.append("numbers with a comma are read with decimal = ','")
        for words in notices if not self.report else ():
            warnings.warn(f"{Path(self.source).name}: {words}", stacklevel=3)

    def _named(self, headers: list[str]) -> list[str]:
        """Headers, each as the name that it is but for capital letters, or whose only alias it is."""
        return by_aliases([self._names.get(each.lower(), each) for each in headers], self._aliases)

    def _has_commas(self, needed: Sequence[int]) -> bool:
        """Return whether numbers have decimal commas: those that are needed, or all if these are integers."""
        for columns in (needed, range(len(self.headers))):
            texts = [own[k] for _, own in self.cells[:WITHIN] for k in columns if _is_number(own[k])]
            comma, point = (any(sign in text for text in texts) for sign in ",.")
            if comma or point:
                return not point
        return False

    def _without_commas(self, needed: Sequence[int]) -> bool:
        """Return whether texts of a workbook are numbers with a decimal comma; they get a point.

        All other numbers of a workbook have a point. 1,000 has a decimal comma if another comma parts no
        thousands, or if no needed number has a point.
        """
        numbers = [cell for _, own in self.cells for cell in own if "," in cell and _is_number(cell)]
        thousands = (re.fullmatch(r"[-+]?[1-9]\d{0,2}(,\d{3})+", cell) for cell in numbers)
        if not numbers or (self.decimal is None and all(thousands) and not self._has_commas(needed)):
            return False
        known = {*numbers}
        for _, own in self.cells:
            own[:] = [cell.replace(",", ".") if cell in known else cell for cell in own]
        return True

    def column(self, name: str) -> int:
        """The place of a column."""
        return self.headers.index(self.form.header(name))

    def has(self, name: str) -> bool:
        """Return whether the table has a column."""
        return self.form.header(name) in self.headers

    def texts(self, name: str) -> list[str]:
        """The cells of a column."""
        column = self.column(name)
        return [cells[column] for _, cells in self.cells]

    def numbers(self, names: Sequence[str]) -> FloatArray:
        """Columns of numbers, scaled, shape (rows, k); a StudyError with the first mistake of each kind."""
        found, hints, report = [], set(), Report(self.source)
        for name in names:
            texts = self.texts(name)
            values = np.array([number(text, self.decimal) for text in texts])
            if texts and all(":" in text for text in texts):
                values = clock(texts)
            found.append(values * self.form.scale.get(name, 1.0))
            for row in np.flatnonzero(~np.isfinite(values))[:1]:
                text, hint = texts[row], ""  # the key that is usually missing there
                if text.lower() in MISSING:
                    timed = "time" in type(self.form).model_fields
                    hint = "; with the header of the time, time = ..., such rows are left out" * timed
                    hint = hint or "; leave such rows out"
                elif "," in text and self.decimal == ".":
                    hint = COMMA_HINT
                elif ":" in text:
                    hint = CLOCK_HINT
                elif re.fullmatch(r"[-+]?[\d.]+ ?[^\W\d]+[²³23]?", text):
                    hint = "; units stand in the header or in a row of units, not in cells"
                elif row and self._named(self.cells[row][1])[: len(self.headers)] == self.headers:
                    hint = "; the header again: each block in a file of its own"
                elif row and not np.isfinite(values[row:]).any():
                    hint = f"; a file of the rows above line {self.cells[row][0]}"
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
        found = ((text, number(text, self.decimal)) for text in self.texts(name))
        factor = self.form.scale.get(name, 1.0)
        return [factor * value if math.isfinite(value) else text for text, value in found]

    def incomplete(self, names: Iterable[str]) -> list[int]:
        """The lines of rows without a value in one of some columns."""
        columns = [*map(self.column, names)]
        return [line for line, row in self.cells if any(row[k].lower() in MISSING for k in columns)]

    def leave_out(self, lines: Iterable[int]) -> None:
        """Leave the rows of some lines out."""
        out = {*lines}
        self.cells = [(line, row) for line, row in self.cells if line not in out]

    def said_of(self, name: str) -> tuple[str, str]:
        """The header of a column, and its cell in the row of units."""
        column = self.column(name)
        return self.headers[column], (self.units[column : column + 1] or [""])[0]

    def refused(self, place: str, found: str, allowed: str) -> StudyError:
        """The error of a mistake at a place in the file."""
        return refused(place, found, allowed, self.source)

    def _text(self, data: bytes) -> str:
        """The text in the file, its lines ended by newlines; of a wrong encoding as in Windows'."""
        for start, kind, way in FORMATS:
            if data.startswith(start):
                raise self.refused("", kind, f"a table in a text file: {way}")
        if self.form.sheet is not None:
            found = f"{literal(self.form.sheet)}, and {Path(self.source).name}, a text file"
            raise self.refused("sheet", found, "a sheet of an Excel workbook only")
        has_mark = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))  # Excel's "Unicode text"
        encoding = self.form.encoding or ("utf-16" if has_mark else "utf-8-sig")
        try:
            text = data.decode(encoding)
        except LookupError:
            allowed = f"the name of an encoding, such as {' or '.join(map(literal, ENCODINGS))}"
            self.report("encoding", literal(encoding), allowed)
        except UnicodeDecodeError as error:
            # Name the line with bytes that cannot be decoded, and what they would be in another encoding.
            line = data.count(b"\n", 0, error.start) + 1
            begin = max(data.rfind(b"\n", 0, error.start) + 1, error.start - 12)
            piece = data[begin : error.start + 8].partition(b"\n")[0]
            read = literal(piece.decode(ENCODINGS[0], "replace").strip())
            found = f"bytes in line {line} that are not {error.encoding.upper().removesuffix('-SIG')}"
            allowed = f'encoding = "{ENCODINGS[0]}", which reads {read} there, or "{ENCODINGS[1]}"; or '
            allowed = f"{allowed * self.has_keys}the file saved as UTF-8"
            self.report.append(Mistake("", found, allowed, self.source))
        if self.report:
            text = data.decode(ENCODINGS[0], "replace")
        if "\0" in text:
            raise self.refused("", "a binary file", "a table in a text file")
        return io.StringIO(text, newline=None).read()

    def _sheet(self, data: bytes) -> str:
        """The text of the sheet, in tabs; the source names all sheets if none is given."""
        if b"xl/" not in data:
            raise self.refused("", "a zip archive", "a table in a text file, or an Excel workbook")
        try:
            import pandas as pd

            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of styles and the like that are not read
                book = pd.ExcelFile(io.BytesIO(data), "openpyxl")
                names, sheet = book.sheet_names, 1 if self.form.sheet is None else self.form.sheet
                name_of = dict(enumerate(names, 1)) | {name: name for name in names}
                if sheet not in name_of:
                    raise refused("sheet", literal(sheet), nearest(str(sheet), map(str, names), {}))
                if self.form.sheet is None and len(names) > 1:
                    others = ", ".join(map(literal, names[1:]))
                    self.source += f", sheet {literal(names[0])} (others: {others})"
                cells = book.parse(name_of[sheet], header=None, dtype=str, na_filter=False)
            self.form = self.form.model_copy(update={"separator": "\t"})
        except ImportError:
            allowed = f"pip install openpyxl, which reads it; or {_AS_CSV}"
            raise self.refused("", "an Excel workbook", allowed) from None
        except StudyError:
            raise
        except Exception as error:  # a damaged workbook fails anywhere in openpyxl
            raise self.refused("", f"a workbook that cannot be read ({error})", _AS_CSV) from None
        # Each line is a row. An error such as #DIV/0! is the only cell that is no text.
        cells = cells.replace(r"\s+", " ", regex=True)
        return str(cells.to_csv(sep="\t", header=False, index=False, na_rep="#ERROR"))

    def _found_header(self, text: str) -> tuple[str, int]:
        """The separator, and the number of rows above the header: the row with most of the names."""
        wanted, others = ({*map(self.form.header, names)} for names in (self.names, self.known))
        rows_of, score, header = dict[str, list[Row]](), dict[str, tuple[int, ...]](), dict[str, int]()
        for separator in SEPARATORS:
            rows: list[Row] = [(self.form.skip_rows + 1, [])]
            try:
                rows = [*islice(_rows(text, separator, self.form.skip_rows), WITHIN)] or rows
            except csv.Error as error:  # a stray quote makes the rest one cell
                if separator == SEPARATORS[0]:
                    raise self.refused("", str(error), _READABLE) from None
            scores = [
                (len(wanted & own), len(others & own), not any(map(_is_number, row)), len(row))
                for _, row in rows
                for own in [{*self._named(row)}]
            ]
            rows_of[separator], score[separator] = rows, max(scores)
            header[separator] = scores.index(max(scores))
        if any(_parts(rows_of[each], rows_of[" "][header[" "]][0]) for each in SEPARATORS if each != " "):
            del score[" "]  # blanks within names
        likely = max(score, key=lambda each: (*score[each][:2], (each != " ") * score[each][-1]))
        own: str = self.form.separator or likely
        line, headers = rows_of[own][header[own]]
        headers = self._named(headers)
        if headers and wanted <= {*headers}:
            return own, header[own]
        self.report.refuse()  # in another encoding headers may be right
        words, keys = ", ".join(self.names), ", or columns = {...} that says which these are" * self.has_keys
        found, allowed = f"the columns {', '.join(headers)}", f"a header with {words}{keys}"
        named = [name for name in self.names if name in self.form.columns]
        lacking = [name for name in named if self.form.header(name) not in headers]
        if not headers:
            found = "an empty file"
            allowed = f"a header{' with ' * bool(words)}{words}, and rows of values"
        elif lacking:
            column = self.form.header(lacking[0])
            found = f"no column {literal(column)}, which is to be {lacking[0]}"
            used = {self.form.header(name) for name in named}
            allowed = nearest(column, [each for each in headers if each and each not in used], {})
        others_fit = score[likely][0] == len(wanted) or score[likely][-1] >= len(self.names) > len(headers)
        if likely != own and others_fit:
            found = f"cells parted by {likely!r}, while separator is {own!r}"
            allowed = f"separator = {likely!r}"
        elif above := rows_of[own][: header[own]]:
            found += f" in line {line}, which is most like the header; {_skipped_words(above)}"
        raise self.refused(f"line {line}", found, allowed)

    def _check_headers(self) -> None:
        """Refuse too many columns, and a column that is there, or is used, twice."""
        header, place, lower = self.form.header, f"line {self.line}", [each.lower() for each in self.headers]
        if len(self.headers) > MOST_COLUMNS:
            raise self.refused(place, f"more than {MOST_COLUMNS} columns", "fewer")
        for other in map(header, self.names):
            if len(alike := [name for name in self.names if header(name) == other]) > 1:
                found = f"the column {literal(other)} as {' and '.join(alike)}"
                raise self.refused(place, found, "a column of its own for each")
        for name in map(header, (*self.names, *self.known)):
            if lower.count(name.lower()) > 1:
                raise self.refused(place, f"the column {name} twice", "each column once")


def clock(texts: Sequence[str]) -> FloatArray:
    """Seconds since the first cell, of times of day or dates; NaN in a cell that is neither.

    Times of day may pass midnight. Dates with dots have the day first, and a year of four digits is followed
    by the month. Day and month of other dates have the order in which times ascend, in the shorter record.
    """
    import pandas as pd

    texts = [re.sub(r"(?<=\d),(?=\d)", ".", text) for text in texts]
    texts = [re.sub(r"(\d+)(:\d+:[\d.]+) ?([ap])m$", _of_day, text, flags=re.IGNORECASE) for text in texts]
    has_hours = not any(re.fullmatch(r"\d+:\d+\.\d+", text) for text in texts)
    texts = texts if has_hours else [f"0:{text}" for text in texts]
    texts = [re.sub(r"^(\d+:\d+:\d+):(\d{3})$", r"\1.\2", text) for text in texts]
    texts = [re.sub(r"(:\d+:\d+)(?=[^.:\d]*$)", r"\1.0", text) for text in texts]  # one form for all
    date = re.search(r"(\d+)([-/.])\w+[-/.]\d", texts[0])
    orders = [True, False]
    if date and (date[2] == "." or len(date[1]) == 4):
        orders = [date[2] == "."]
    iso = partial(pd.to_datetime, format="ISO8601", utc=True)
    ways = [iso if date else pd.to_timedelta, *(partial(pd.to_datetime, dayfirst=each) for each in orders)]
    found = [np.full(len(texts), np.nan)]
    for read in ways:
        with suppress(ValueError), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of dates in an unusual order
            times = pd.Index(read(texts, errors="coerce"))
            found.append(np.asarray((times - times[0]).total_seconds()))
        if read is ways[0] and not np.isnan(found[-1]).any():
            break
    seconds = min(
        found, key=lambda own: (np.isnan(own).sum(), bool(np.any(np.diff(own) <= 0.0)), np.ptp(own))
    )
    turn = 86400.0 if has_hours else 3600.0
    if not date:
        seconds[1:] += turn * np.cumsum(np.diff(seconds) < -0.5 * turn)
    return seconds


def _of_day(found: re.Match[str]) -> str:
    """A time of day with the hours of a day, from the hours before or after noon."""
    return f"{int(found[1]) % 12 + 12 * (found[3].lower() == 'p')}{found[2]}"


def number(cell: str, decimal: str | None) -> float:
    """The number in a cell; NaN if there is none, or a point of thousands beside a decimal comma.

    Fortran writes exponents with a D, spreadsheets may write a minus that is longer than a hyphen.
    """
    if decimal == ",":
        cell = cell.replace(".", "_").replace(",", ".")
    try:
        return plain_float(cell)
    except ValueError:
        cell = re.sub(r"(\.\d*)[dD]([+-]?\d+)$", r"\1e\2", cell.replace("\u2212", "-"))
        with suppress(ValueError):
            return plain_float(cell)
    return math.nan


def read_columns(
    path: Path,
    names: Sequence[str],
    optional: Sequence[str],
    form: FileTable,
    kinds: Mapping[str, str],
    units: Units | None = None,
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
    kinds, units
        "length", "force" or "stress" by column, and the study's units: a unit of another kind is a mistake,
        and so is another unit without `scale`, or with the inverse of its factor.
    gaps
        Whether rows with an empty cell or NaN are left out, with a message; otherwise they are mistakes.

    Raises
    ------
    StudyError
        A ValueError with what is wrong in the file, and in which row.
    """
    known = dict.fromkeys((*names, *optional, *kinds))
    report = unknown_names(form, known)
    if not known.keys() >= form.columns.keys():
        report.refuse()  # which column is meant is unknown
    with report:
        table = UserTable(path, names, optional, form)
        report += table.report
        for name in (name for name in optional if not table.has(name)):
            # Such as Bulk, or bulk_stress: left alone it would count as 0.
            if alike := [each for each in table.headers if name in each.lower() or meant(each, [name], {})]:
                found = f"the column {literal(alike[0])}"
                if form.columns:
                    reads = f"columns.{name} = {literal(alike[0])} reads it"
                    warnings.warn(f"{path.name}: {found} is left alone; {reads}", stacklevel=4)
                    continue
                allowed = f"{name}, if that is meant, or another name"
                report.append(Mistake(f"line {table.line}", found, allowed, table.source))
        names = [*names, *filter(table.has, optional)]
        own = {name: kind for name, kind in kinds.items() if name in names}
        report += wrong_units(table, own, units) if units else different_units(table, own)
        empty = table.incomplete(names) if gaps else []
        if 0 < len(empty) < len(table.cells):
            more = f" and {len(empty) - 1} more" if len(empty) > 1 else ""
            if not report:
                words = f"line {empty[0]}{more} left out: a value is missing"
                warnings.warn(f"{Path(table.source).name}: {words}", stacklevel=4)
            table.leave_out(empty)
        values = table.numbers(names)
    report.refuse()
    return values, np.array([line for line, _ in table.cells])


def unknown_names(form: FileTable, known: Collection[str]) -> Report:
    """The mistakes of factors and headers of columns that are not known."""
    report = Report()
    for part in ("scale", "columns"):
        for name in (each for each in getattr(form, part) if each not in known):
            report(f"{part}.{name}", literal(name), nearest(name, known, {}))
    return report


def by_aliases(headers: Sequence[str], aliases: Mapping[str, str]) -> list[str]:
    """Headers, each as the name whose only alias, in small letters, it is, unless there is that name."""
    meant = [aliases.get(header.lower(), "") for header in headers]
    return [
        other if other and other not in headers and meant.count(other) == 1 else header
        for header, other in zip(headers, meant, strict=True)
    ]


def read_table(
    path: Path,
    names: Sequence[str],
    known: Collection[str],
    form: FileTable | None,
    aliases: Mapping[str, str] = MappingProxyType({}),
) -> UserTable:
    """The table in a file, see `UserTable`; a StudyError with all that is wrong."""
    table = UserTable(path, names, known, form, aliases)
    table.report.refuse()
    return table


def _skipped_words(rows: Sequence[Row]) -> str:
    """Which lines above a header are skipped, and what they begin with."""
    lines = f"lines {rows[0][0]} to {rows[-1][0]} are" if len(rows) > 1 else f"line {rows[0][0]} is"
    return f"{lines} skipped, {literal(' '.join(filter(None, rows[0][1])), 40)}"


def _rows(text: str, separator: str, skipped: int) -> Iterator[Row]:
    """Rows that are not empty: the number of the last line of each, and its cells in one line each."""
    lines: Iterator[str] = islice(io.StringIO(text), skipped, None)
    if separator == " ":
        lines = (" ".join(line.split()) for line in lines)
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
    for cells in reader:
        own = [" ".join(cell.split()) for cell in cells]
        if any(own):
            yield reader.line_num + skipped, own


def _parts(rows: Sequence[Row], line: int) -> bool:
    """Return whether a separator gives a line, and the next one, the same number of cells, two at least."""
    own, *below = [len(cells) for place, cells in rows if place >= line][:2] or [0]
    return own > 1 and own in below


def _row_of_units(rows: Sequence[Row], needed: Sequence[int], form: FileTable) -> list[str]:
    """The first row, if it is one of units: it has no number, and numbers are beneath."""
    if form.units_row is not None or len(rows) < 2:
        return rows[0][1] if form.units_row and rows else []
    first, second = rows[0][1], rows[1][1]
    wanted = [second[k] for k in needed if k < len(second)] or [*filter(_is_number, second)]
    has_numbers = bool(wanted) and all(map(_is_number, wanted))
    return first if has_numbers and not any(map(_is_number, first)) else []


def _is_number(cell: str) -> bool:
    return any(math.isfinite(number(cell, sign)) for sign in ".,")
