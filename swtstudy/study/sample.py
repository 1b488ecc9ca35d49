"""Samples of parameters: designs of points in given ranges, points from a CSV file, random points of a grid.

They are read from what a user wrote, with every mistake reported at once. A file has a header with names of
parameters, and a row for each point.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.points.canonical import Table, group_rows
from swtstudy.points.grid import Grid
from swtstudy.points.reading import LONGEST_AXIS, Known
from swtstudy.points.values import NOTHING, NamedValues, Value, read_value
from swtstudy.study.columns import FileTable, read_table
from swtstudy.study.design import BALANCED, Design, Distribution, read_distribution
from swtstudy.study.keys import place_of, read_keys
from swtstudy.study.tables import SampleTable
from swtstudy.vocabulary.mistakes import Report, StudyError, literal, more_like_it, nearest
from swtstudy.vocabulary.parameter import Parameter

#: Key of the file in messages.
POINTS_KEY = "sample.file"
ALLOWED_POINTS = "a CSV file: a row with names of parameters, then a row with their values for each point"


def read_points(
    path: Path, report: Report, form: FileTable, names: Collection[str], needed: Sequence[str] = ()
) -> dict[str, list[object]] | None:
    """The columns of a file by name; numbers are read, other texts are left. None if there are mistakes.

    Parameters
    ----------
    path
        The file.
    report
        Told what is wrong.
    form
        How it is written.
    names
        Parameters: names of columns.
    needed
        Names of columns that there must be.
    """
    try:
        table = read_table(path, needed, names, form, LONGEST_AXIS)
    except StudyError as error:
        for each in error.mistakes:
            report(POINTS_KEY, f"{each.found}{place_of(each)}", each.allowed)
        return None
    if not len(table.cells):
        report(POINTS_KEY, f"{path} without points", ALLOWED_POINTS)
        return None
    of_headers = {form.header(name): name for name in (*needed, *names)}
    return {
        (name := of_headers.get(header, header)): table.values(name) for header in table.headers if header
    }


_FORMS = "design, size and ranges; or file; or points"


@dataclass(frozen=True)
class Sample:
    """A sample of parameters.

    Attributes
    ----------
    values
        The values of each parameter, all of one length.
    design
        The design that they come from; None for given points.
    ranges
        How each parameter is distributed in the design.
    """

    values: NamedValues
    design: Design | None = None
    ranges: dict[str, Distribution] = field(default_factory=dict)


def read_sample(
    raw: Mapping[str, Any], folder: Path, report: Report, known: Known, rows: Mapping[str, Parameter]
) -> tuple[Sample | None, list[str]]:
    """The sample of a study's table; None if there are mistakes, which are reported.

    Parameters
    ----------
    raw
        The table, whose structure may be unsound: that is reported elsewhere.
    folder
        Where a file of points is, if its path is relative.
    report
        Called with key, found and allowed of each mistake.
    known
        What the user has defined, by parameter and name.
    rows
        The parameters that may be sampled.

    Returns
    -------
    sample
    names
        The parameters that are sampled, as far as known.
    """
    forms = [form for form in ("design", "file", "points") if form in raw]
    if len(forms) != 1:
        report("sample", " and ".join(forms) or "nothing", f"one of: {_FORMS}")
        return None, []
    if forms[0] == "design":
        return _designed(raw, report, rows)
    for name in ("size", "seed", "ranges"):
        if name in raw:
            report(f"sample.{name}", f"{literal(raw[name])} beside {forms[0]}", "only with a design")
    points, key = raw.get("points"), "sample.points"
    if forms[0] == "file":
        file, key = raw["file"], POINTS_KEY
        form, _ = read_keys(SampleTable, raw)
        points = read_points(folder / file, report, form, rows) if form is not None else None
    if not isinstance(points, Mapping):
        return None, []
    return _given(points, key, report, known, rows), [name for name in points if name in rows]


def _designed(
    raw: Mapping[str, Any], report: Report, rows: Mapping[str, Parameter]
) -> tuple[Sample | None, list[str]]:
    form, _ = read_keys(SampleTable, raw)
    design = None
    if form is not None and form.design is not None:
        kind = "power of 2" if form.design in BALANCED else "whole number"
        if form.size is None or (form.design in BALANCED and form.size & (form.size - 1)):
            found = "nothing" if form.size is None else literal(form.size)
            report("sample.size", found, f"a {kind} from 1 to {LONGEST_AXIS}")
        else:
            design = Design(form.design, form.size, form.seed)
    ranges = raw.get("ranges")
    if not isinstance(ranges, Mapping) or not ranges:
        if "ranges" not in raw or isinstance(ranges, Mapping):
            report("sample.ranges", "nothing", "at least one parameter with its range")
        return None, []
    read: dict[str, Distribution] = {}
    numeric = [name for name, row in rows.items() if row.kind == "number"]
    for name, entry in ranges.items():
        key = f"sample.ranges.{name}"
        if name in numeric:
            distribution = read_distribution(rows[name], entry, key, report)
            if distribution is not None:
                read[name] = distribution
        elif name in rows:
            report(key, f"{name}, which is not a number", "an axis, or points from a file")
        else:
            report(key, f"unknown parameter {literal(name)}", nearest(name, numeric))
    names = [name for name in ranges if name in numeric]
    if design is None or len(read) < len(ranges):
        return None, names
    if design.count(len(names)) > LONGEST_AXIS:
        report("sample.size", f"{design.count(len(names))} points", f"at most {LONGEST_AXIS} points")
        return None, names
    unit = design.points(len(names))
    values = {
        name: tuple(read[name].values(column).tolist()) for name, column in zip(names, unit.T, strict=True)
    }
    return Sample(values, design, read), names


def _given(
    points: Mapping[str, Any], key: str, report: Report, known: Known, rows: Mapping[str, Parameter]
) -> Sample | None:
    """Points given one by one."""
    values: NamedValues = {}
    lengths = {name: len(column) for name, column in points.items() if isinstance(column, Sequence)}
    if not lengths or min(lengths.values()) == 0:
        report(key, "no points", "at least one point")
        return None
    if len({*lengths.values()}) > 1:
        words = ", ".join(f"{length} of {name}" for name, length in lengths.items())
        report(key, f"{words}", "as many values of each parameter")
    if max(lengths.values()) > LONGEST_AXIS:
        report(key, f"{max(lengths.values())} points", f"at most {LONGEST_AXIS} points")
        return None
    for name, column in points.items():
        if name not in rows:
            report(f"{key}.{name}", f"unknown parameter {literal(name)}", nearest(name, rows))
        elif name in lengths:
            good = _column(rows[name], column, f"{key}.{name}", report, known)
            if good is not None:
                values[name] = good
    sound = len(values) == len(points) and len({*lengths.values()}) == 1
    return Sample(values) if sound else None


def _column(
    row: Parameter, column: Sequence[object], key: str, report: Report, known: Known
) -> tuple[Value, ...] | None:
    """Checked values of a parameter; the first that is wrong is reported, with the number of others."""
    good: list[Value] = []
    wrong: list[str] = []
    for index, raw in enumerate(column):
        try:
            good.append(read_value(row, raw, known.get(row.name, NOTHING)))
        except ValueError as error:
            wrong.append(f"{literal(raw)} ({error}) at [{index}]")
    if not wrong:
        return tuple(good)
    report(key, wrong[0] + more_like_it(len(wrong)), row.allowed)
    return None


#: The largest index that NumPy's random numbers can be.
LARGEST_SAMPLED = 2**63 - 1


def drawn_rows(grid: Grid, points: int, seed: int) -> Table:
    """Canonical rows of random points of a grid, without repetition, shape (n,).

    Raises
    ------
    ValueError
        If it has more than `LARGEST_SAMPLED` points.
    """
    if grid.size > LARGEST_SAMPLED:
        raise ValueError(f"{grid.size} points are too many to sample, at most {LARGEST_SAMPLED}")
    rng = np.random.default_rng(seed)
    # More than asked for: two points of the grid can be physically the same.
    many = 2 * points
    if grid.size <= 2 * many:
        index = rng.permutation(grid.size)
    else:
        _, first = np.unique(index := rng.integers(grid.size, size=many), return_index=True)
        index = index[np.sort(first)]
    rows, _ = grid.canonical(index)
    first, _ = group_rows(rows)
    return rows[np.sort(first)[:points]]
