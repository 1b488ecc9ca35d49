"""Values in a page: symbols and numbers as HTML, and the table that it carries, packed.

Everything that an archive says is escaped. Scripts are told what they must know of the columns.
"""

from __future__ import annotations

import base64
import gzip
import math
import re
import unicodedata
from collections.abc import Iterator, Mapping
from html import escape
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from swtstudy.archive.describe import unsaid
from swtstudy.figures.lines import in_equal_ratios
from swtstudy.figures.quantity_words import flag_words
from swtstudy.points.grid import SAMPLE
from swtstudy.results.evaluate import dims_beside, to_table
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import coordinate_words, number_words

_TOKENS = re.compile(r"\\([a-zA-Z]+|.)|([{}_^])|(\s+)|([A-Za-z])|(.)", re.DOTALL)
_SIGNS = {"ell": "<i>ℓ</i>", "cdot": "·", "infty": "∞", "approx": "≈", ",": " ", ";": " ", " ": " "}
#: Of what has none.
_NONE: Mapping[Any, Any] = {}
#: What has another letter in Unicode's names than in LaTeX.
_GREEK = {"lambda": "lamda", "varphi": "phi", "varepsilon": "epsilon", "vartheta": "theta"}


def symbol_html(latex: str) -> str:
    """A symbol in LaTeX's notation as HTML.

    Examples
    --------
    >>> symbol_html(r"\\delta_A/\\delta_0")
    '<i>δ</i><sub><i>A</i></sub>/<i>δ</i><sub>0</sub>'
    >>> symbol_html(r"a_\\mathrm{max}")
    '<i>a</i><sub>max</sub>'
    """
    return "".join(_run(_tokens(latex), False))


def _tokens(latex: str) -> Iterator[tuple[str | None, ...]]:
    return (found.groups() for found in _TOKENS.finditer(latex))


def _run(tokens: Iterator[tuple[str | None, ...]], upright: bool) -> Iterator[str]:
    """The pieces up to the end of a group."""
    for token in tokens:
        if token[1] == "}":
            return
        yield _piece(token, tokens, upright)


def _piece(token: tuple[str | None, ...], rest: Iterator[tuple[str | None, ...]], upright: bool) -> str:
    """One letter, command or group, with what belongs to it."""
    command, brace, blank, letter, other = token
    if command:
        return _command(command, rest, upright)
    if brace == "{":
        return "".join(_run(rest, upright))
    if brace in ("_", "^"):
        name = "sub" if brace == "_" else "sup"
        after = next(rest, None)
        return f"<{name}>{_piece(after, rest, upright)}</{name}>" if after else ""
    if letter:
        return letter if upright else f"<i>{letter}</i>"
    return "" if blank or brace else escape("−" if other == "-" else str(other))


def _command(name: str, rest: Iterator[tuple[str | None, ...]], upright: bool) -> str:
    if name in _SIGNS:
        return _SIGNS[name]
    if name in ("mathrm", "text", "sqrt"):
        after = next(rest, None)
        inner = _piece(after, rest, upright or name != "sqrt") if after else ""
        return f"√({inner})" if name == "sqrt" else inner
    small = name.lower()
    kind = "CAPITAL" if name[0].isupper() else "SMALL"
    try:
        return f"<i>{unicodedata.lookup(f'GREEK {kind} LETTER {_GREEK.get(small, small).upper()}')}</i>"
    except KeyError:
        return f"{escape(name)} "  # a function, such as max


def symbol_of(values: xr.DataArray) -> str:
    """The symbol of a coordinate or data variable as HTML; its name in words if it has none."""
    latex = _latex(values)
    return tied(symbol_html(latex)) if latex else _words(values)


def _latex(values: xr.DataArray) -> str:
    name = str(values.name)
    return str(values.attrs.get("symbol", AXES[name].symbol if name in AXES else ""))


def _words(values: xr.DataArray) -> str:
    return escape(str(values.name).replace("_", " "))


def tied(words: str) -> str:
    """HTML that keeps to one line."""
    return f'<span class="tied">{words}</span>'


def unit_of(values: xr.DataArray) -> str:
    """The unit of a coordinate or data variable; empty if it has none, or if its values say it."""
    unit = str(values.attrs.get("units", ""))
    return "" if unit in ("", "1", "rad") else {"degree": "°"}.get(unit, unit)


def value_text(name: str, value: Any, attributes: Mapping[Any, Any] = _NONE) -> str:
    """A value as people say it, by the attributes of its coordinate, and every angle in π.

    Examples
    --------
    >>> value_text("phase", 2.7052603405912108), value_text("normal_amplitude", 8 / 9)
    ('0.861π', '8/9')
    >>> value_text("body", 2, {"flag_values": [1, 2], "flag_meanings": "pad rod"}), value_text("phase", -0.5)
    ('rod', '−0.159π')
    """
    if isinstance(value, float) and not math.isfinite(value):
        return "–"
    if name not in AXES or isinstance(value, bool):
        return number_words(value).replace("-", "−") if isinstance(value, float) else str(value)
    words = coordinate_words(name, value, attributes).replace("_", " ")
    if AXES[name].units == "rad" and "π" not in words and value:
        words = f"{value / math.pi:.3g}π"
    return words.replace("-", "−") if _is_number(value, attributes) else words


def is_number(values: xr.DataArray) -> bool:
    """Return whether a single value is a number of its own, not a name or what stands for one."""
    return _is_number(values.item(), values.attrs)


def _is_number(value: Any, attributes: Mapping[Any, Any]) -> bool:
    return not isinstance(value, str) and "flag_meanings" not in attributes


def with_unit(words: str, values: xr.DataArray) -> str:
    """A value in words with the unit of its coordinate, as HTML."""
    unit = unit_of(values)
    return escape(f"{words}{unit}" if unit == "°" else f"{words} {unit}".rstrip())


def place_html(values: xr.DataArray) -> str:
    """A single value with symbol and unit; the value alone of a name."""
    words = with_unit(value_text(str(values.name), values.item(), values.attrs), values)
    symbol = symbol_html(_latex(values)) or _words(values)
    return tied(f"{symbol} = {words}") if is_number(values) else words


def share(part: float) -> str:
    """A share in per cent.

    Examples
    --------
    >>> share(0.5), share(0.9996), share(9e-5), share(1.2)
    ('50 %', '99.96 %', '0.009 %', '120 %')
    """
    percent = 100.0 * part
    inside = 0.0 < percent < 100.0
    digits = max(0, -math.floor(math.log10(min(percent, 100 - percent)))) if inside else 0
    return f"{percent:.{digits}f} %"


#: Digits of a value in the table, and of an estimated error: more than any s is asked for.
_DIGITS, _ERROR_DIGITS = 7, 2
#: Most bytes of the packed table: pages stay below some 2 MB.
LARGEST_TABLE = 1_200_000
#: Values of a dimension that are spelled out; others are numbers of the table.
_LISTED = 60
#: Columns that say nothing in a table on its own.
_BOOKKEEPING = ("run",)


def table_of(dataset: xr.Dataset) -> pd.DataFrame:
    """The table, of several points without the columns that have one value: the page says these once."""
    table = to_table(dataset).drop(columns=[*_BOOKKEEPING, *unsaid(dataset)], errors="ignore")
    if len(table) == 1:
        return table
    dims = rows_of(dataset)
    single = [name for name in table if name not in (*dims, "s") and table[name].nunique(dropna=False) < 2]
    return table.drop(columns=single)


def rows_of(dataset: xr.Dataset) -> list[str]:
    """The dimensions that the rows of the table go through, the last one fastest."""
    dropped = (*dims_beside(dataset), "counted_place", "counted_cycle")
    return [str(name) for name in dataset.dims if name not in dropped]


#: First letters of what spreadsheets run.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def packed(table: pd.DataFrame) -> str:
    """The table as a compressed CSV file in a data URI; empty if it is too large for a page."""
    text = _inert(_rounded(table)).to_csv(index=False, float_format=f"%.{_DIGITS}g", lineterminator="\n")
    # Without a time stamp: the same results give the same page.
    content = gzip.compress(text.encode(), 9, mtime=0)
    whole = base64.b64encode(content).decode()
    return f"data:application/gzip;base64,{whole}" if len(whole) <= LARGEST_TABLE else ""


def _inert(table: pd.DataFrame) -> pd.DataFrame:
    """The table with an apostrophe before words that a spreadsheet would run as formulae."""
    return table.map(lambda cell: f"'{cell}" if isinstance(cell, str) and cell[:1] in _FORMULA else cell)


def _rounded(table: pd.DataFrame) -> pd.DataFrame:
    """Errors to the digits that an estimate has."""
    table = table.copy()
    for name in table:
        if "_error" in str(name):
            values = table[name].to_numpy(float)
            with np.errstate(divide="ignore"):
                unit = 10.0 ** (np.floor(np.log10(np.abs(values))) - _ERROR_DIGITS + 1)
            good = np.isfinite(values) & (values != 0.0)
            table[name] = np.where(good, np.round(values / np.where(good, unit, 1.0)) * unit, values)
    return table


def about(dataset: xr.Dataset, table: pd.DataFrame) -> dict[str, Any]:
    """Data for the scripts of a page: the dimensions of the rows, and the columns; symbols as HTML."""
    dims = rows_of(dataset)
    return {
        "dims": [_dimension(dataset, name) for name in dims],
        "columns": {str(name): _column(dataset, str(name)) for name in table if name not in dims},
    }


def _dimension(dataset: xr.Dataset, name: str) -> dict[str, Any]:
    values = dataset[name]
    numbers = values.dtype.kind in "fiu"
    known = np.sort(values.values) if numbers else values.values
    words = [] if name == SAMPLE else [value_text(name, one, values.attrs) for one in values.values.tolist()]
    return {
        "name": name,
        "size": values.size,
        "words": words if len(words) <= _LISTED else [],
        "log": numbers and in_equal_ratios(known),
        **_labels(values),
    }


def _column(dataset: xr.Dataset, name: str) -> dict[str, Any]:
    own, _, place = name.partition("[")
    values = dataset[own]
    flags = [words.replace(" ", "_") for words in flag_words(values)]
    kinds: dict[str, Any] = {"flags": flags} if flags else {}
    kinds |= {"sampled": True} if values.dims == (SAMPLE,) and own in AXES else {}
    labels = _labels(values)
    if place:
        labels["symbol"] += f" ({place.rstrip(']').replace('_', ' ')})"
    return labels | kinds


def _labels(values: xr.DataArray) -> dict[str, Any]:
    """Symbol, meaning and unit."""
    name = str(values.name)
    meaning = AXES[name].meaning if name in AXES else str(values.attrs.get("long_name", name))
    rad = name in AXES and AXES[name].units == "rad"
    return {
        "symbol": symbol_of(values),
        "meaning": meaning.replace("_", " "),
        "unit": unit_of(values),
        **({"rad": True} if rad else {}),
    }
