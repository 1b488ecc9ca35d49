"""Arguments of a call: single values, sequences that span a grid, and lists of points, read here."""

from __future__ import annotations

import math
import re
from collections.abc import Hashable, Iterator, Mapping, Sequence, Set
from typing import Any

import numpy as np

from swtstudy.points.grid import SAMPLE
from swtstudy.points.reading import LONGEST_AXIS, NOTHING_KNOWN, Known
from swtstudy.points.values import Value, read_value
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.derived import NAMES
from swtstudy.vocabulary.mistakes import Report, literal, more_like_it, nearest, plain_number
from swtstudy.vocabulary.parameters import AXES, PARAMETERS, Parameter
from swtstudy.vocabulary.quantities import ATTRIBUTES, COUNTED_SIZES, DISTANCE, EVERY_VARIABLE

#: A number with a comma, for which there is a key where numbers come from files.
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
#: What is wrong with critical distances along a list of points, and what is allowed.
OF_POINTS = ("a value for each point", "a single value, or an axis of its own")
#: Names that results have of their own: no list of points may be along one of them.
OF_RESULTS = {*AXES, *COUNTED_SIZES, *ATTRIBUTES, *EVERY_VARIABLE, "control", "rank"}
OF_RESULTS |= {name + end for name in NAMES for end in ("", "_error")}


def listed(
    parameters: Mapping[str, object], report: Report, rows: Mapping[str, Parameter] = PARAMETERS
) -> tuple[dict[str, tuple[Value, ...] | None], str, tuple[Hashable, ...], dict[str, object]]:
    """Parameters that vary together, since they are DataArrays over a dimension that they share.

    Parameters
    ----------
    parameters
        What was given, by name.
    report
        Called with key, found and allowed of each mistake.
    rows
        The parameters that may be given.

    Returns
    -------
    samples
        Their values, as of `read_points`; none if no DataArrays share a dimension.
    dim
        The dimension.
    labels
        Its coordinate, if they have one.
    others
        The other parameters, as they were given.
    """
    over: dict[str, dict[str, Any]] = {}
    for name, raw in parameters.items():
        for dim in getattr(raw, "dims", ()) if dimensions_of(raw) == 1 else ():
            over.setdefault(str(dim), {})[name] = raw
    shared = {dim: arrays for dim, arrays in over.items() if len(arrays) > 1}
    if not shared:
        return {}, SAMPLE, (), dict(parameters)
    import pandas as pd
    import xarray as xr

    (dim, arrays), *more = shared.items()
    for other, several in more:
        report(", ".join(several), f"another list of points, over {other}", f"one list, over {dim}")
    if DISTANCE in arrays:
        report(DISTANCE, *OF_POINTS)
        return {}, dim, (), dict(parameters)
    if dim in {"", *OF_RESULTS} - {*arrays}:
        report(", ".join(arrays), f"DataArrays over {literal(dim)}, a name in results", "another dimension")
    try:
        one, *_ = xr.align(*map(xr.DataArray, arrays.values()), join="exact")
    except ValueError:
        report(", ".join(arrays), f"lengths or coordinates that differ along {dim}", "the same ones")
        return {}, dim, (), dict(parameters)
    labels = tuple(one.indexes[dim]) if dim in one.indexes and dim not in arrays else ()
    for label in labels:
        if not (isinstance(label, str | bool | pd.Timestamp) or math.isfinite(plain_number(label))):
            found = f"{literal(label)} along {dim}"
            report(", ".join(arrays), found, "coordinates of numbers, texts or dates")
            break
    # As plain numbers, but of dates and durations, which are no values.
    columns = {n: [*v.values] if v.dtype.kind in "mM" else v.values.tolist() for n, v in arrays.items()}
    others = {name: raw for name, raw in parameters.items() if name not in arrays}
    return read_points(columns, report, rows), dim, labels, others


def read_points(
    points: Mapping[str, Sequence[object]],
    report: Report,
    rows: Mapping[str, Parameter] = PARAMETERS,
    known: Known = NOTHING_KNOWN,
    points_key: str = "",
    comma_hint: str = "",
) -> dict[str, tuple[Value, ...] | None]:
    """Values of points given one by one; the first wrong value of each parameter is told.

    Parameters
    ----------
    points
        A sequence of raw values of each parameter, a value for each point.
    report
        Called with key, found and allowed of each mistake.
    rows
        The parameters that may be given.
    known
        Definitions of the user, by parameter and name.
    points_key
        The key of all points; without it the keys are the names of the parameters.
    comma_hint
        Said of values with a decimal comma.

    Returns
    -------
    dict
        The values of each parameter; None of all of them if there is a mistake.
    """
    nothing = dict.fromkeys(name for name in points if name in rows)
    before, lengths = len(report), {name: len(column) for name, column in points.items()}
    every = points_key or ", ".join(points)
    if not lengths or min(lengths.values()) == 0:
        report(every, "no points", "at least one point")
        return nothing
    if len({*lengths.values()}) > 1:
        words = ", ".join(f"{length} of {name}" for name, length in lengths.items())
        report(every, words, "as many values of each parameter")
    if max(lengths.values()) > LONGEST_AXIS:
        report(every, f"{max(lengths.values())} points", f"at most {LONGEST_AXIS} points")
        return nothing
    values: dict[str, tuple[Value, ...] | None] = {}
    for name, column in points.items():
        key = f"{points_key}.{name}" if points_key else name
        if name not in rows:
            report(key, f"unknown parameter {literal(name)}", nearest(name, rows))
            continue
        good: list[Value] = []
        wrong: list[str] = []
        for index, raw in enumerate(column):
            try:
                good.append(read_value(rows[name], raw, known.get(name, {})))
            except ValueError as error:
                wrong.append(f"{literal(raw)} ({error}) at [{index}]")
        if wrong:
            comma = any(isinstance(raw, str) and DECIMAL_COMMA.fullmatch(raw) for raw in column)
            allowed = rows[name].allowed + comma_hint * comma
            report(key, wrong[0] + more_like_it(len(wrong)), allowed)
        values[name] = tuple(good)
        named = {str(each): each for each in reversed(good) if isinstance(each, Definition)}
        if twice := [each for each in good if named.get(str(each), each) != each]:
            found = f"another {name} with the name of {literal(twice[0])}"
            report(key, found, "a name of its own")
    return nothing if len(report) > before else values


def spanned(
    parameters: Mapping[str, object], report: Report
) -> tuple[dict[str, object], dict[str, Sequence[object] | None]]:
    """Single values and sequences; None for what is neither, which is reported."""
    fixed: dict[str, object] = {}
    axes: dict[str, Sequence[object] | None] = {}
    for name, raw in parameters.items():
        dimensions = dimensions_of(raw)
        if dimensions == 0:
            fixed[name] = raw
        elif dimensions == 1:
            axes[name] = list(np.asarray(raw) if getattr(raw, "chunks", None) else raw)  # type: ignore[call-overload]
        else:
            axes[name] = None
            report(name, literal(raw), "a single value or a one-dimensional sequence")
    return fixed, axes


def dimensions_of(raw: object) -> int:
    """Number of dimensions of a value; 0 for text and bytes, although they are sequences."""
    if isinstance(raw, str | bytes | bytearray | memoryview):
        return 0
    if isinstance(raw, Iterator | Mapping | Set):
        return 2  # several values without an order that can be read twice
    try:
        return np.ndim(raw)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return 2  # ragged, or not an array at all
