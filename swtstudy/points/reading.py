"""A grid read from what a user wrote, with every mistake reported at once; shared by studies and `solve`.

Single values, sequences and ranges span it; the values of a list of points vary together.
"""

from __future__ import annotations

import itertools
import math
import re
import sys
import warnings
from collections.abc import Callable, Collection, Hashable, Iterator, Mapping, Sequence, Set
from contextlib import suppress
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Literal, Protocol, runtime_checkable

import numpy as np

from swtstudy.points import rules
from swtstudy.points.grid import SAMPLE, Grid, canonical_number, complete
from swtstudy.points.values import (
    NamedValues,
    Value,
    as_number,
    hint_at_degrees,
    read_angle,
    read_exact,
    read_value,
)
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.derived import NAMES
from swtstudy.vocabulary.mistakes import Report, literal, meant, more_like_it, nearest, plain_number
from swtstudy.vocabulary.parameters import (
    AXES,
    CONTACT_AXES,
    MANY_TURNS,
    PAIRS,
    PARAMETERS,
    SYMBOLS,
    Parameter,
    spelled,
)
from swtstudy.vocabulary.quantities import ATTRIBUTES, COUNTED_SIZES, DISTANCE, EVERY_VARIABLE

#: Definitions of the user, by parameter and name.
Known = Mapping[str, Mapping[str, Definition]]
NOTHING_KNOWN: Known = {}

#: Classes of the values that users define themselves.
OWN = {"load": "LoadPath", "profile": "TabulatedProfile"}

#: More points than this along one axis are taken for a slip of the pen.
LONGEST_AXIS = 1_000_000


#: A number with a comma, for which there is a key where numbers come from files.
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
#: What is wrong with critical distances along a list of points, and what is allowed.
OF_POINTS = ("a value for each point", "a single value, or an axis of its own")
#: Names that results have of their own: no list of points may be along one of them.
OF_RESULTS = {*AXES, *COUNTED_SIZES, *ATTRIBUTES, *EVERY_VARIABLE, "control", "rank"}
OF_RESULTS |= {name + end for name in NAMES for end in ("", "_error")}
#: Words for an end of a range.
END = 'a number, or text such as "2*pi"'


@runtime_checkable
class Range(Protocol):
    """`num` values from `start` to `stop`, in equal steps or ("log") ratios; those of `also` among them."""

    start: Any
    stop: Any
    num: int
    spacing: Literal["linear", "log"]
    also: list[Any]


#: Values along axes, by name; None for a wrong one, which is reported elsewhere.
GivenAxes = Mapping[str, Sequence[object] | Range | None]


def read_grid(
    fixed: Mapping[str, object],
    axes: GivenAxes,
    keys: Callable[[str], str] = str,
    source: str = "",
    others: Sequence[str] = (),
    samples: Mapping[str, tuple[Value, ...] | None] | None = None,
    known: Known = NOTHING_KNOWN,
) -> tuple[Grid | None, Report]:
    """The grid spanned by fixed values and axes.

    Parameters
    ----------
    fixed, axes
        Raw values by name, as the user wrote them; None for an axis whose mistake is already reported.
    keys
        The key of a parameter in messages, from its name.
    source
        Where the input comes from, for messages.
    others
        Names that are known beside the parameters: they are read elsewhere, and may be meant by an unknown
        one.
    samples
        Checked values of the sampled parameters; None for parameters whose mistake is already reported.
    known
        Definitions of the user, by parameter and name.

    Returns
    -------
    grid
        None if there are mistakes.
    mistakes
        All that was found wrong.
    """
    report, samples = Report(source, keys), samples or {}
    good_fixed, good_axes = read_values(fixed, axes, report, others, samples, known)
    good_samples = {name: values for name, values in samples.items() if values is not None}
    good = good_axes | good_samples | {name: (value,) for name, value in good_fixed.items()}
    given = {*fixed, *axes, *samples}
    rules.check_amplitudes(given, good, report)
    rules.check_shapes_given(fixed, {**axes, **samples}, good, report)
    rules.check_forces(given, good, report)
    rules.check_criteria(given, good, report)
    if report or len(good_samples) < len(samples):
        rules.check_loops_alone(good, report)
        return None, report
    grid = complete(good_fixed, good_axes, good_samples)
    rules.check_sizes(grid, given, report)
    rules.check_loops(grid, report)
    rules.check_shapes(grid, report)
    return (None if report else grid), report


def read_values(
    fixed: Mapping[str, object],
    axes: GivenAxes,
    report: Report,
    others: Sequence[str] = (),
    samples: Mapping[str, object] = MappingProxyType({}),
    known: Known = NOTHING_KNOWN,
    rows: Mapping[str, Parameter] = PARAMETERS,
) -> tuple[dict[str, Value], NamedValues]:
    """Return the fixed values and axes that are sound one by one; see `read_grid`."""
    for name in (name for name in (*fixed, *axes) if name not in rows and name not in others):
        found, allowed = f"unknown parameter {literal(name)}", nearest(name, [*rows, *others])
        own = name if name in CONTACT_AXES else SYMBOLS.get(spelled(name), ("",))[0]
        if own in CONTACT_AXES and own not in rows:
            found = "a parameter of real contacts"
            allowed = f"{'this' if own == name else own} in a study with [units], or swtstudy.physical"
        report.of(name, found, allowed)
    several = (fixed, "a fixed value"), (axes, "an axis"), (samples, "sampled")
    for (one, first), (other, second) in itertools.combinations(several, 2):
        for name in sorted(one.keys() & other.keys()):
            report.of(name, f"both {first} and {second}", "one of the two")
    for name, raw in (*fixed.items(), *axes.items(), *samples.items()):
        if name in rows and rows[name].units == "rad":
            warn_of_degrees(report.key(name), raw)
    read = {n: _read(rows[n], raw, report.key(n), report, known) for n, raw in fixed.items() if n in rows}
    known_axes = {name: raw for name, raw in axes.items() if name in rows and raw is not None}
    sizes = [raw.num + len(raw.also) if isinstance(raw, Range) else len(raw) for raw in known_axes.values()]
    # Axes that are not too long one by one may be so together: to read them takes a minute.
    if sum(sizes) > LONGEST_AXIS >= max(sizes) and min(sizes) > 0:
        found = f"{sum(sizes)} values, {math.prod(sizes):.0g} points"
        report.of(axes, found, f"at most {LONGEST_AXIS} values along all axes")
        known_axes = {}
    good_axes = {n: _read_axis(rows[n], raw, report, known) for n, raw in known_axes.items()}
    check_pairs((*fixed, *axes, *samples), report)
    return {name: value for name, value in read.items() if value is not None}, good_axes


def warn_of_degrees(key: str, raw: object) -> None:
    """Warn of an angle that is probably meant in degrees."""
    several = (raw.start, raw.stop) if isinstance(raw, Range) else raw
    for each in several if isinstance(several, list | tuple) else (several,):
        with suppress(ValueError, TypeError, OverflowError):  # reported where it is read
            number = float(read_angle(each))
            if abs(number) > MANY_TURNS and (hint := hint_at_degrees(each)):
                warnings.warn(f"{key}: {number:g} is in radians; {hint}", stacklevel=2)
                return


def read_distances(
    fixed: Mapping[str, object], axes: GivenAxes, report: Report, row: Parameter = AXES[DISTANCE]
) -> tuple[tuple[float, ...], bool]:
    """The critical distances among fixed values and axes, and whether they are an axis; see `read_grid`."""
    if (raw := axes.get(DISTANCE)) is not None:
        return tuple(map(as_number, _read_axis(row, raw, report))), True
    single = _read(row, fixed[DISTANCE], report.key(DISTANCE), report) if DISTANCE in fixed else None
    return (() if single is None else (as_number(single),)), False


def check_pairs(names: Collection[str], report: Report) -> None:
    """Report both parameters of a pair, of which one is to be given."""
    for name, other in PAIRS.items():
        if name in names and other in names:
            report.of((other, name), "both", "one of the two: it says what is prescribed")


def _read(
    row: Parameter, raw: object, key: str, report: Report, known: Known = NOTHING_KNOWN
) -> Value | None:
    names = known.get(row.name, {})
    try:
        return read_value(row, raw, names)
    except ValueError as error:
        allowed = _allowed_name(row, raw, names) if row.kind == "name" else row.allowed
        # As TOML gives what is meant for an axis.
        if isinstance(raw, list | dict) and key == f"fixed.{row.name}":
            allowed += "; several values under [axes]"
        report(key, f"{literal(raw)} ({error})", allowed)
        return None


def _allowed_name(row: Parameter, raw: object, names: Mapping[str, Definition]) -> str:
    """Which names there are; unless one of them is meant, how one of the user's own is defined."""
    known = [*row.names, *names]
    if isinstance(raw, str) and meant(raw, known):
        return nearest(raw, known)
    allowed = f"one of {', '.join(known)}"
    if row.name not in OWN:
        return allowed
    table = raw if isinstance(raw, str) and re.fullmatch(r"[A-Za-z0-9_-]+", raw) else "NAME"
    return f"{allowed}; your own: [{row.name}s.{table}] in a study, swtstudy.{OWN[row.name]} in Python"


def _read_axis(
    row: Parameter, raw: Sequence[object] | Range, report: Report, known: Known = NOTHING_KNOWN
) -> tuple[Value, ...]:
    key, also = report.key(row.name), raw.also if isinstance(raw, Range) else ()
    elements = _expand(raw, key, report, row.units) if isinstance(raw, Range) else list(raw)
    if not elements and not isinstance(raw, Range):
        report(key, "an empty axis", "at least one value")
    keys = [f"{key}[{k}]" for k in range(len(elements))] + [f"{key}.also[{k}]" for k in range(len(also))]
    if len(keys) > LONGEST_AXIS:
        report(key, f"{len(keys)} values", f"at most {LONGEST_AXIS} values")
        return ()
    values: list[Value] = []
    seen: dict[float | str | Fraction, str] = {}
    for own_key, element in zip(keys, [*elements, *also], strict=True):
        value = _read(row, element, own_key, report, known)
        if value is None:
            continue
        values.append(value)
        # Definitions with the same name cannot be distinguished in results.
        own = str(value) if isinstance(value, Definition) else value
        first = seen.setdefault(canonical_number(own) if isinstance(own, float) else own, own_key)
        if first != own_key and isinstance(value, Definition) and value not in values[:-1]:
            found = f"{literal(element)}, another {row.name} with the name of {first}"
            report(own_key, found, "a name of its own")
        elif first != own_key:
            report(own_key, f"{literal(element)}, the same as {first}", "distinct values")
    if also:
        descending = len(values) > 1 and as_number(values[0]) > as_number(values[1])
        values.sort(key=as_number, reverse=descending)
    return tuple(values)


def _expand(axis: Range, key: str, report: Report, units: str) -> list[object]:
    """The values of a range: exact where its ends are rational."""
    ends: list[Fraction | float] = []
    for part in ("start", "stop"):
        raw = getattr(axis, part)
        try:
            # The decimal number that a float is written as, not the binary one that it is.
            text = raw if isinstance(raw, str) else str(read_exact(raw))
            ends.append(read_angle(text) if units == "rad" else read_exact(text))
        except ValueError as error:
            report(f"{key}.{part}", f"{literal(raw)} ({error})", END)
    if not 2 <= axis.num <= LONGEST_AXIS:
        report(f"{key}.num", literal(axis.num), f"a whole number from 2 to {LONGEST_AXIS}")
        return []
    if len(ends) < 2:
        return []
    start, stop = ends
    step = (stop - start) / (axis.num - 1)
    if step == 0:
        report(key, f"start and stop are both {literal(axis.start)}", "two different ends")
        return []
    if axis.spacing == "linear":
        return [start + index * step for index in range(axis.num - 1)] + [stop]
    first, last = float(start), float(stop)
    if min(first, last) <= 0.0:
        found = f"equal ratios from {literal(axis.start)} to {literal(axis.stop)}"
        report(key, found, "two positive ends")
        return []
    parts = [index / (axis.num - 1) for index in range(1, axis.num - 1)]
    if sys.float_info.min < last / first < math.inf:
        return [start, *(first * (last / first) ** part for part in parts), stop]
    return [start, *(first ** (1.0 - part) * last**part for part in parts), stop]


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
