"""The values that a page carries: a table, packed, and what its scripts must know of the columns."""

from __future__ import annotations

import base64
import gzip
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.figures.quantity_words import flag_words
from swtstudy.figures.regimes import in_equal_ratios
from swtstudy.points.grid import SAMPLE
from swtstudy.reports.symbols import symbol_of, unit_of, value_text
from swtstudy.results.table import dims_beside, to_table
from swtstudy.vocabulary.axes import AXES

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Digits of a value in the table, and of an estimated error: more than any s is asked for.
_DIGITS, _ERROR_DIGITS = 7, 2
#: Most bytes of the packed table: pages stay below some 2 MB.
LARGEST_TABLE = 1_200_000
#: Values of a dimension that are spelled out; others are numbers of the table.
_LISTED = 60
#: Columns that say nothing in a table on its own.
_BOOKKEEPING = ("run",)


def table_of(dataset: xr.Dataset) -> pd.DataFrame:
    """The table without the columns that have one value: the page says these once."""
    table = to_table(dataset).drop(columns=[*_BOOKKEEPING], errors="ignore")
    dims = rows_of(dataset)
    single = [name for name in table if name not in (*dims, "s") and table[name].nunique(dropna=False) < 2]
    return table.drop(columns=single)


def rows_of(dataset: xr.Dataset) -> list[str]:
    """The dimensions that the rows of the table go through, the last one fastest."""
    dropped = (*dims_beside(dataset), "counted_place", "counted_cycle")
    return [str(name) for name in dataset.dims if name not in dropped]


def packed(table: pd.DataFrame) -> str:
    """The table as a compressed CSV file in a data URI; empty if it is too large for a page."""
    text = _rounded(table).to_csv(index=False, float_format=f"%.{_DIGITS}g", lineterminator="\n")
    # Without a time stamp: the same results give the same page.
    content = gzip.compress(text.encode(), 9, mtime=0)
    whole = base64.b64encode(content).decode()
    return f"data:application/gzip;base64,{whole}" if len(whole) <= LARGEST_TABLE else ""


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
    words = [] if name == SAMPLE else [value_text(name, value) for value in values.values.tolist()]
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
