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
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

import numpy as np

from swtstudy.study.keys import Allowed, Table, key
from swtstudy.units.rows import KNOWN
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.files import LARGEST_TABLE, plain_float, read_file, reason_of
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, meant, nearest

if TYPE_CHECKING:
    import pandas as pd

#: More rows than this are no table that someone recorded for a study, nor are more columns.
MOST_ROWS, MOST_COLUMNS = 1_000_000, 1000
#: What may stand between cells; a blank stands for any number of them.
SEPARATORS = (",", ";", "\t", "|", " ")
#: Lines in which a header is searched: loggers write a block of settings above it.
WITHIN = 200
#: Encodings that European rigs write where it is not UTF-8: Windows', and one that reads any byte.
ENCODINGS = ("cp1252", "latin-1")
#: First bytes of files that are no text, what they are, and the way to export them.
_OF_MATLAB = 'writetable(table(time, normal, tangential), "record.csv") in MATLAB'
FORMATS = (
    (b"PK\x03\x04", "an Excel workbook", "the sheet saved as CSV UTF-8"),
    (b"\xd0\xcf\x11\xe0", "an Excel workbook before 2007", "saved as .xlsx, or the sheet as CSV UTF-8"),
    (b"MATLAB", "a MATLAB file", _OF_MATLAB),
    (b"\x89HDF", "an HDF5 file, as of MATLAB", _OF_MATLAB),
    (b"TDSm", "a LabVIEW TDMS file", "nptdms.TdmsFile(path).as_dataframe().to_csv(...) in Python"),
)


class FileTable(Table):
    """The form of a table in a file."""

    columns: Annotated[
        dict[str, str], Allowed('a table of headers, such as { normal = "Fn [N]" }', whole=True)
    ] = key("Headers of the file's columns, where they are not the names that they have here.", {})
    separator: Annotated[
        Literal[",", ";", "\t", "|", " "] | None, Allowed(f"one of {', '.join(map(repr, SEPARATORS))}")
    ] = key("Between cells; a blank for any number of blanks. Found from the header unless given.", None)
    decimal: Annotated[Literal[".", ","] | None, Allowed("one of '.', ','")] = key(
        "The decimal sign in numbers. Found from the first rows unless given.", None
    )
    encoding: Annotated[str | None, Allowed('the name of an encoding, such as "cp1252"')] = key(
        'Encoding of the text, UTF-8 unless given; "cp1252" or "latin-1" for older programs.', None
    )
    scale: Annotated[
        dict[str, float], Allowed("a table of numbers, such as { normal = 1000 }", whole=True)
    ] = key("Factors of columns, such as { normal = 1000 } for kN, or -1 for the other sign.", {})
    skip_rows: Annotated[int, Allowed("a whole number of lines, 0 or more")] = key(
        "Lines above the header. Found unless given, and told.", 0, ge=0
    )
    units_row: Annotated[bool | None, Allowed("true or false")] = key(
        "Whether a row of units follows the header. Found unless given, and told.", None
    )
    sheet: Annotated[
        str | int | None, Allowed("the name of a sheet, or its number from 1 on", whole=True)
    ] = key("Sheet of a workbook; the first one unless given.", None)

    def header(self, name: str) -> str:
        """The header of a column."""
        return _plain(self.columns.get(name, name))


PLAIN = FileTable()


class UserTable(NamedTuple):
    """A table from a file.

    Attributes
    ----------
    headers
        The headers of its columns.
    units
        The cells of its row of units; empty without one.
    cells
        Its cells as texts, by the number of the column, indexed by the number of the line.
    form
        How it is written, with what was found out.
    source
        The path, for messages.
    line
        Number of the line of the header.
    """

    headers: list[str]
    units: list[str]
    cells: pd.DataFrame
    form: FileTable
    source: str
    line: int

    def has(self, name: str) -> bool:
        """Return whether the table has a column."""
        return self.form.header(name) in self.headers

    def texts(self, name: str) -> list[str]:
        """The cells of a column."""
        return self.cells[self.headers.index(self.form.header(name))].tolist()

    def numbers(self, names: Sequence[str]) -> FloatArray:
        """Columns of numbers, scaled, shape (rows, k)."""
        return np.stack([self._numbers(name) * self.form.scale.get(name, 1.0) for name in names], axis=1)

    def _numbers(self, name: str) -> FloatArray:
        texts = self.texts(name)
        values = np.array([number(text, self.form.decimal) for text in texts])
        if (wrong := np.flatnonzero(~np.isfinite(values))).size:
            text, hint = texts[wrong[0]], ""
            if not text:
                hint = "; with the header of the time, time = ..., such rows are left out"
            elif "," in text and self.form.decimal == ".":
                hint = "; a comma in numbers is decimal = ','"
            elif wrong[0] == 0:
                hint = "; lines above the header are skip_rows, a row of units is units_row = true"
            place = f"line {self.cells.index[wrong[0]]}, {self.form.header(name)}"
            found = literal(text) if text else "nothing"
            raise _refused(self.source, found, f"a finite number{hint}", place)
        return values

    def values(self, name: str) -> list[object]:
        """The cells of a column, numbers where they are, scaled, and texts."""
        found = ((text, number(text, self.form.decimal)) for text in self.texts(name))
        factor = self.form.scale.get(name, 1.0)
        return [factor * value if math.isfinite(value) else text for text, value in found]

    def unit(self, name: str, kind: str) -> str | None:
        """The unit of a column that its header or the row of units says; None without a known one."""
        column = self.headers.index(self.form.header(name))
        for text in (self.units[column : column + 1] or [""])[0], self.headers[column]:
            words = re.findall(r"[A-Za-zµμ]+", text)
            if words and words[-1] in KNOWN[kind] and (words[-1] != "in" or "[" in text or "(" in text):
                return words[-1]
        return None


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
) -> FloatArray:
    """Columns of numbers of a table, shape (rows, k), in the order of the names.

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
    kinds, labels
        "length", "force" or "stress" by column, and the study's label by kind: a header with another unit,
        and without `scale`, is a mistake.
    gaps
        Whether rows with an empty cell are left out, and told: others say where they are.

    Raises
    ------
    StudyError
        A ValueError with what is wrong in the file, and in which row.
    """
    known = (*names, *optional, *(kinds or ()))
    strange = [
        Mistake(f"{part}.{name}", literal(name), nearest(name, known, {}))
        for part in ("columns", "scale")
        for name in getattr(form, part)
        if name not in known
    ]
    if strange:
        raise StudyError(strange)
    table = read_table(path, names, optional, form)
    for name in () if form.columns else (name for name in optional if not table.has(name)):
        # Such as Bulk, or bulk_stress: left alone it would count as 0.
        if alike := [each for each in table.headers if name in each.lower() or meant(each, [name], {})]:
            found, allowed = f"the column {literal(alike[0])}", f"{name}, if that is meant, or another name"
            raise _refused(table.source, found, allowed, f"line {table.line}")
    names = [*names, *filter(table.has, optional)]
    for name, kind in (kinds or {}).items():
        if name not in names or name in form.scale or not labels:
            continue
        unit, label, units = table.unit(name, kind), str(labels.get(kind)), KNOWN[kind]
        if unit and label in units and units[unit] != units[label]:
            found = f"{literal(form.header(name))} in {unit} as {name}, while [units] has {kind} in {label}"
            allowed = f"scale = {{ {name} = {units[unit] / units[label]:g} }}"
            raise _refused(table.source, found, f"{allowed}; {name} = 1 if the unit in the file is wrong")
    empty = (table.cells[[table.headers.index(form.header(name)) for name in names]] == "").any(axis=1)
    if gaps and empty.any() and not empty.all():
        more = f" and {empty.sum() - 1} more" if empty.sum() > 1 else ""
        _tell(table.source, f"line {empty.idxmax()}{more} left out: a value is missing")
        table = table._replace(cells=table.cells[~empty])
    return table.numbers(names)


def read_table(
    path: Path, names: Sequence[str], known: Collection[str], form: FileTable, most: int = MOST_ROWS
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
        What is given of its form.
    most
        Largest number of rows.

    Raises
    ------
    StudyError
        A ValueError with what is wrong, and in which line.
    """
    source = str(path)
    try:
        data = read_file(path, LARGEST_TABLE)
    except OSError as error:
        raise _refused(source, reason_of(error), _READABLE) from None
    content = _workbook(data, form, source) if data.startswith(b"PK") else _text(data, form, source)
    form, ((line, headers), *below) = _header(content, names, known, form, source)
    needed = [headers.index(form.header(name)) for name in names]
    units: list[str] = []
    if below and form.units_row is not False:
        # One of units has no number, and numbers are beneath.
        first, *others = ([cells[k] for k in needed if k < len(cells)] for _, cells in below)
        numbers = others and all(map(_is_number, others[0])) and not any(map(_is_number, below[0][1]))
        units = below[0][1] if form.units_row or (any(first) and numbers) else []
    if units and form.units_row is None:
        _tell(source, f"line {below[0][0]} is read as units: {', '.join(filter(None, units))}")
    cells = _cells(content, below[0][0] if units else line, len(headers), form, most, source)
    if form.separator == form.decimal == ",":
        raise StudyError([Mistake("separator, decimal", "both ','", "two different signs")])
    if form.decimal is None:
        # A comma if numbers have commas, and none has a point.
        texts = cells[needed or [*range(len(headers))]].head(WITHIN).to_numpy().ravel().tolist()
        commas, points = (
            any(re.match(rf"[+-]?\d*{sign}\d", text) for text in texts) for sign in (",", r"\.")
        )
        comma = commas and not points and form.separator != ","
        form = form.model_copy(update={"decimal": "," if comma else "."})
        if comma:
            _tell(source, "numbers with a comma are read with decimal = ','")
    return UserTable(headers, units, cells, form, source, line)


def _text(data: bytes, form: FileTable, source: str) -> str:
    """The text in a file, its lines ended by newlines."""
    for start, what, way in FORMATS:
        if data.startswith(start):
            raise _refused(source, what, f"a table in a text file: {way}")
    if form.sheet is not None:
        found = f"{literal(form.sheet)}, and {Path(source).name}, a text file"
        raise StudyError([Mistake("sheet", found, "a sheet of an Excel workbook only")])
    has_mark = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))  # Excel's "Unicode text"
    encoding = form.encoding or ("utf-16" if has_mark else "utf-8-sig")
    try:
        text = data.decode(encoding)
    except LookupError:
        allowed = f"the name of an encoding, such as {' or '.join(map(literal, ENCODINGS))}"
        raise StudyError([Mistake("encoding", literal(encoding), allowed)]) from None
    except UnicodeDecodeError as error:
        # Name the line with bytes that cannot be decoded, and what they would be in another encoding.
        line = data.count(b"\n", 0, error.start) + 1
        begin = max(data.rfind(b"\n", 0, error.start) + 1, error.start - 12)
        piece = data[begin : error.start + 8].partition(b"\n")[0]
        read = literal(piece.decode(ENCODINGS[0], "replace").strip())
        found = f"bytes in line {line} that are not {error.encoding.upper().removesuffix('-SIG')}"
        allowed = f'encoding = "{ENCODINGS[0]}", which reads {read} there, or "{ENCODINGS[1]}"'
        raise _refused(source, found, f"{allowed}; or the file saved as UTF-8") from None
    if "\0" in text:
        raise _refused(source, "a binary file", "a table in a text file")
    return io.StringIO(text, newline=None).read()


def _workbook(data: bytes, form: FileTable, source: str) -> pd.DataFrame:
    """The cells of a sheet as texts."""
    import pandas as pd

    if b"xl/" not in data:
        raise _refused(source, "a zip archive", "a table in a text file, or an Excel workbook")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and the like that are not read
            book = pd.ExcelFile(io.BytesIO(data), engine="openpyxl")
            names = list(map(str, book.sheet_names))
            sheet = form.sheet if form.sheet is not None else 1
            if sheet not in names and not (isinstance(sheet, int) and 1 <= sheet <= len(names)):
                raise StudyError([Mistake("sheet", literal(sheet), nearest(str(sheet), names, {}))])
            cells = book.parse(sheet if isinstance(sheet, str) else sheet - 1, header=None, dtype=object)
    except ImportError:
        allowed = f"pip install openpyxl, which reads it; or {FORMATS[0][2]}"
        raise _refused(source, "an Excel workbook", allowed) from None
    except StudyError:
        raise
    except Exception as error:  # a damaged workbook fails anywhere in openpyxl
        raise _refused(source, f"a workbook that cannot be read ({error})", FORMATS[0][2]) from None
    texts = cells.map(lambda cell: "" if pd.isna(cell) else str(cell).strip())
    texts.index = texts.index + 1
    return texts


def _rows(content: str | pd.DataFrame, separator: str, skipped: int) -> Iterator[tuple[int, list[str]]]:
    """Rows that are not empty: the number of the last line of each, and its cells."""
    if isinstance(content, str):
        lines: Iterator[str] = islice(io.StringIO(content), skipped, None)
        if separator == " ":
            lines = (" ".join(line.split()) for line in lines)
        reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
        rows: Iterator[tuple[int, list[str]]] = ((reader.line_num + skipped, cells) for cells in reader)
    else:
        rows = ((number, cells) for number, *cells in content.iloc[skipped:].itertuples())
    return ((number, [*map(_plain, cells)]) for number, cells in rows if any(map(str.strip, cells)))


def _plain(cell: str) -> str:
    """A cell in one line, as a header may be given."""
    return " ".join(cell.split())


def _is_number(cell: str) -> bool:
    return any(math.isfinite(number(cell, sign)) for sign in ".,")


def _header(
    content: str | pd.DataFrame, names: Sequence[str], known: Collection[str], form: FileTable, source: str
) -> tuple[FileTable, list[tuple[int, list[str]]]]:
    """The form with its separator, the row of the header and at most two rows beneath it."""
    wanted, others = {*map(form.header, names)}, {*map(form.header, known)}
    first: dict[str, list[str]] = {}
    found: dict[str, list[tuple[int, list[str]]]] = {}
    for separator in SEPARATORS:
        rows: list[tuple[int, list[str]]] = []
        try:
            rows.extend(islice(_rows(content, separator, form.skip_rows), WITHIN))
        except csv.Error as error:  # a stray quote makes the rest one cell
            if not rows and separator == SEPARATORS[0]:
                raise _refused(source, str(error), _READABLE) from None
        first[separator] = rows[0][1] if rows else []
        place = next((k for k, (_, cells) in enumerate(rows) if wanted <= {*cells}), None)
        if place is not None:
            found[separator] = rows[place:]
    likely = max(first, key=lambda each: (each != " ") * len(first[each]))
    if found:
        likely = max(found, key=lambda each: len((wanted | others) & {*found[each][0][1]}))
    separator = form.separator or likely
    if separator not in found:
        wrong = _missing(first[separator], names, form)
        if likely in found or len(first[likely]) >= len(names) > len(first[separator]):
            wrong = f"cells parted by {likely!r}, while separator is {separator!r}", f"separator = {likely!r}"
        raise _refused(source, *wrong, f"line {form.skip_rows + 1}")
    rows = found[separator][:3]
    line, headers = rows[0]
    if len(headers) > MOST_COLUMNS:
        raise _refused(source, f"more than {MOST_COLUMNS} columns", "fewer", f"line {line}")
    for other in map(form.header, names):
        if len(alike := [name for name in names if form.header(name) == other]) > 1:
            found_twice = f"the column {literal(other)} as {' and '.join(alike)}"
            raise _refused(source, found_twice, "a column of its own for each", f"line {line}")
    lower = [header.lower() for header in headers]
    for name in map(form.header, (*names, *known)):
        if lower.count(name.lower()) > 1:
            raise _refused(source, f"the column {name} twice", "each column once", f"line {line}")
    for below, cells in rows[1:]:
        if len(cells) - (cells[-1] == "") > len(headers):
            raise _too_long(source, len(cells), len(headers), below)
    if first[separator] != headers:
        _tell(source, f"the header is found in line {line}: what is above it is skipped")
    return form.model_copy(update={"separator": separator}), rows


def _missing(headers: list[str], names: Sequence[str], form: FileTable) -> tuple[str, str]:
    """Say which column a header lacks, and what is allowed."""
    for name in names:
        if name in form.columns and form.header(name) not in headers:
            own = form.header(name)
            return f"no column {literal(own)}, which is to be {name}", nearest(own, headers, {})
    if not headers:
        return "an empty file", f"a header{' with ' * bool(names)}{', '.join(names)}, and rows of values"
    allowed = f"a header with {', '.join(names)}, or columns = {{...}} that says which these are"
    return f"the columns {', '.join(headers)}", allowed


def _cells(
    content: str | pd.DataFrame, line: int, width: int, form: FileTable, most: int, source: str
) -> pd.DataFrame:
    """The cells below a line as texts, by column from 0 on and by the number of their line."""
    import pandas as pd

    if isinstance(content, str):
        stream = io.StringIO(content)
        for _ in range(line):
            stream.readline()
        options: dict[str, Any] = {"header": None, "dtype": str, "keep_default_na": False}
        options |= {"skip_blank_lines": False, "skipinitialspace": True, "index_col": False}
        options["sep"] = r"\s+" if form.separator == " " else form.separator
        try:
            table = pd.read_csv(stream, names=range(width + 1), **options)
        except (pd.errors.ParserError, ValueError) as error:
            counts = re.search(r"Expected \d+ fields in line (\d+), saw (\d+)", str(error))
            if counts:
                raise _too_long(source, int(counts[2]), width, line + int(counts[1])) from None
            raise _refused(source, str(error).rpartition("C error: ")[2].strip(), _READABLE) from None
        table = table.fillna("").apply(lambda column: column.str.strip())
        table.index = table.index + line + 1
    else:
        table = content.iloc[line:].reindex(columns=range(width + 1), fill_value="")
    if len(table) > most + 1:
        raise _refused(source, f"{len(table)} rows", f"at most {most}")
    table = table[(table != "").any(axis=1)]
    if (table[width] != "").any():
        raise _too_long(source, width + 1, width, int((table[width] != "").idxmax()))
    return table


_READABLE = "a CSV file that can be read"


def _refused(source: str, found: str, allowed: str, place: str = "") -> StudyError:
    return StudyError([Mistake(place, found, allowed, source)])


def _too_long(source: str, found: int, width: int, line: int) -> StudyError:
    allowed = "as many as columns: a comma between cells, a point in numbers; or say separator and decimal"
    return _refused(source, f"{found} cells under {width} columns", allowed, f"line {line}")


def _tell(source: str, words: str) -> None:
    warnings.warn(f"{Path(source).name}: {words}", stacklevel=5)
