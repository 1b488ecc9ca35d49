"""Values in a page: symbols and numbers as HTML, and the table that it carries, packed."""

from __future__ import annotations

import base64
import gzip
import math
import re
import unicodedata
from collections.abc import Mapping
from typing import Any

import jinja2
import pandas as pd
import xarray as xr
from markupsafe import Markup, escape

from swtstudy.archive import describe
from swtstudy.figures.lines import in_equal_ratios
from swtstudy.figures.words import flag_words
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside_words, validity_lines
from swtstudy.results.evaluate import dims_beside, to_table
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import coordinate_words, number_words, printable

_TOKEN = re.compile(r"\\(?:mathrm|text)\{([^{}]*)\}|\\([a-zA-Z]+)|(&#?\w+;)|([A-Za-z])|\\?\s+|\\.")
_RAISED = re.compile(r"([_^])(?:\{((?:[^{}]|\{[^{}]*\})*)\}|(<i>.</i>|&#?\w+;|.))")
_SIGNS = {"ell": "<i>ℓ</i>", "cdot": "·", "infty": "∞", "approx": "≈", "sqrt": "√"}
#: Letters with another name in Unicode than in LaTeX.
_GREEK = {"lambda": "lamda", "varphi": "phi", "varepsilon": "epsilon", "vartheta": "theta"}
_NONE: Mapping[Any, Any] = {}
#: Values that keep to one line.
_TIED = Markup('<span class="tied">{}</span>')


def symbol_html(latex: str) -> Markup:
    """A symbol in LaTeX's notation as HTML.

    Examples
    --------
    >>> print(symbol_html(r"\\delta_A/\\delta_0"))
    <i>δ</i><sub><i>A</i></sub>/<i>δ</i><sub>0</sub>
    >>> print(symbol_html(r"a_\\mathrm{max}"))
    <i>a</i><sub>max</sub>
    """
    text = _TOKEN.sub(_token, str(escape(latex)).replace("-", "−"))
    text = re.sub(r"√\{([^{}]*)\}", r"√(\1)", text)
    text = _RAISED.sub(_under, text)
    return Markup(re.sub(r"[\\{}^_$]", "", text))


def _token(found: re.Match[str]) -> str:
    upright, command, entity, letter = found.groups()
    if not command:
        return f"{{{upright}}}" if upright else entity or (f"<i>{letter}</i>" if letter else "")
    kind, small = "CAPITAL" if command[0].isupper() else "SMALL", command.lower()
    try:
        name = f"GREEK {kind} LETTER {_GREEK.get(small, small)}"
        return _SIGNS.get(command) or f"<i>{unicodedata.lookup(name)}</i>"
    except KeyError:
        return f"{command} "  # a function, such as max


def _under(found: re.Match[str]) -> str:
    name = "sub" if found[1] == "_" else "sup"
    return f"<{name}>{_RAISED.sub(_under, found[2] or found[3])}</{name}>"


def symbol_of(values: xr.DataArray) -> Markup:
    """The symbol of a coordinate or data variable as HTML; its name in words if it has none."""
    return _TIED.format(symbol) if (symbol := _symbol(values)) else escape(str(values.name).replace("_", " "))


def _symbol(values: xr.DataArray) -> Markup:
    name = str(values.name)
    return symbol_html(str(values.attrs.get("symbol", AXES[name].symbol if name in AXES else "")))


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
    return words if isinstance(value, str) or "flag_meanings" in attributes else words.replace("-", "−")


def is_number(values: xr.DataArray) -> bool:
    """Return whether a single value is a number of its own, not a name or what stands for one."""
    return not isinstance(values.item(), str) and "flag_meanings" not in values.attrs


def with_unit(words: str, values: xr.DataArray) -> str:
    """A value in words with the unit of its coordinate."""
    unit = unit_of(values)
    return f"{words}{unit}" if unit == "°" else f"{words} {unit}".rstrip()


def along(values: xr.DataArray) -> str:
    """A single value of a coordinate or data variable with its unit."""
    return with_unit(value_text(str(values.name), values.item(), values.attrs), values)


def place_html(values: xr.DataArray) -> Markup:
    """A single value with symbol and unit; the value alone of a name."""
    if not is_number(values):
        return escape(along(values))
    name = _symbol(values) or str(values.name).replace("_", " ")
    return _TIED.format(Markup("{} = {}").format(name, along(values)))


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


#: Most bytes of the packed table: pages stay below some 2 MB.
LARGEST_TABLE = 1_200_000
#: Values of a dimension that are spelled out; others are numbers of the table.
_LISTED = 60
#: First letters of what spreadsheets run.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def table_of(dataset: xr.Dataset) -> pd.DataFrame:
    """The table, of several points without the columns that have one value: the page says these once."""
    table = to_table(dataset).drop(columns=["run", *describe.unsaid(dataset)], errors="ignore")
    kept = (*rows_of(dataset), "s")
    few = [name for name in table if name not in kept and table[name].nunique(dropna=False) < 2]
    return table.drop(columns=few) if len(table) > 1 else table


def rows_of(dataset: xr.Dataset) -> list[str]:
    """The dimensions that the rows of the table go through, the last one fastest."""
    dropped = (*dims_beside(dataset), "counted_place", "counted_cycle")
    return [str(name) for name in dataset.dims if name not in dropped]


def packed(table: pd.DataFrame) -> str:
    """The table as a compressed CSV file in a data URI; empty if it is too large for a page.

    Errors have two digits. An apostrophe stands before words that a spreadsheet would run as formulae.
    """
    table = table.map(lambda cell: f"'{cell}" if isinstance(cell, str) and cell[:1] in _FORMULA else cell)
    for name in table:
        if "_error" in str(name):
            table[name] = table[name].map(lambda error: float(f"{error:.2g}"))
    text = table.to_csv(index=False, float_format="%.7g", lineterminator="\n")
    # Without a time stamp: the same results give the same page.
    whole = base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
    return f"data:application/gzip;base64,{whole}" if len(whole) <= LARGEST_TABLE else ""


def about(dataset: xr.Dataset, table: pd.DataFrame) -> dict[str, Any]:
    """Data for the scripts of a page: the dimensions of the rows, and the columns; symbols as HTML."""
    dims = rows_of(dataset)
    columns = {}
    for name in (str(name) for name in table if name not in dims):
        own, _, place = name.partition("[")
        columns[name] = labels = _labels(dataset[own])
        if place:
            labels["symbol"] += f" ({escape(place.rstrip(']').replace('_', ' '))})"
        if flags := flag_words(dataset[own]):
            labels["flags"] = [words.replace(" ", "_") for words in flags]
        if dataset[own].dims == (SAMPLE,) and own in AXES:
            labels["sampled"] = True
    return {"dims": [_dimension(dataset[name]) for name in dims], "columns": columns}


def _dimension(values: xr.DataArray) -> dict[str, Any]:
    name, numbers = str(values.name), values.dtype.kind in "fiu"
    spelled = name != SAMPLE and values.size <= _LISTED
    words = [value_text(name, one, values.attrs) for one in values.values.tolist()] if spelled else []
    log = numbers and in_equal_ratios(values.sortby(values).values)
    return {"name": name, "size": values.size, "words": words, "log": log, **_labels(values)}


def _labels(values: xr.DataArray) -> dict[str, Any]:
    """Symbol, meaning and unit."""
    name = str(values.name)
    meaning = AXES[name].meaning if name in AXES else str(values.attrs.get("long_name", name))
    rad = {"rad": True} if name in AXES and AXES[name].units == "rad" else {}
    own = {"symbol": str(symbol_of(values)), "meaning": meaning.replace("_", " "), "unit": unit_of(values)}
    return own | rad


#: The templates of this folder, each compiled when it is first used, and what they may call.
_LOOK: dict[str, Any] = {"autoescape": True, "trim_blocks": True, "lstrip_blocks": True}
_LOOK |= {"loader": jinja2.PackageLoader("swtstudy.faces", "."), "undefined": jinja2.StrictUndefined}
_TEMPLATES = jinja2.Environment(**_LOOK)
_CALLED: tuple[Any, ...] = (along, is_number, number_words, outside_words, place_html, share, symbol_of)
_CALLED += (unit_of, validity_lines, value_text)
_TEMPLATES.globals |= {"describe": describe} | {each.__name__: each for each in _CALLED}


def rendered(template: str, **content: Any) -> str:
    """A page that needs no other file, from a template of this folder."""
    return printable(_TEMPLATES.get_template(template).render(**content))
