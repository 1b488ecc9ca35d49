"""The audited points as a Dataset, and back, and the report of an audit."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.archive.attributes import defined_in, definitions_text
from swtstudy.paper.audit.point import TOLERANCE, VERDICTS, AuditedPoint
from swtstudy.points.canonical import (
    COLUMNS,
    COST,
    ROW,
    Definitions,
    Table,
    code_of,
    describe_point,
    value_of,
)
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.parameters import PARAMETERS, STRAIN_SHARE

_LENGTH = "in units of a_H = sqrt(R delta0)"
_MEANINGS = {
    "s": "maximum of swt/SWT0 on the surface line, by the solver",
    "s_error": "estimated absolute error of s",
    "s_dense": "maximum of swt/SWT0 on the surface line, by a dense look",
    "shortfall": "how far s and its error are below s_dense, relative",
    "s_surface": "maximum of swt/SWT0 on the circle through the critical point, by the solver",
    "critical_x": f"where that is, {_LENGTH}",
    "s_all_planes": "swt/SWT0 there over all plane orientations",
    "s_body": "maximum of swt/SWT0 in the body over all plane orientations",
    "excess": "s_body/s - 1",
    "remainder": "s_body/s_surface - 1",
    **{f"body_{axis}": f"position of the body's maximum, {_LENGTH}" for axis in "xyz"},
    **{f"normal_{axis}": "unit normal of its critical plane" for axis in "xyz"},
}
_STORED = ("s", "s_error", "s_surface", "critical_x", "s_dense", "s_all_planes", "s_body")
_SCALARS = (*_STORED, "excess", "remainder", "shortfall")
#: What an older audit lacks.
_LATER = {"s_error", "s_dense", "shortfall"}
#: Parameters whose values are names: their columns hold codes.
_WITH_NAMES = {name for name, row in PARAMETERS.items() if row.kind == "name"}


def audit_dataset(rows: Table, points: Sequence[AuditedPoint], definitions: Definitions) -> xr.Dataset:
    """The Dataset of an audit.

    Parameters
    ----------
    rows
        Shape (n,): their canonical rows.
    points
        The audited points, one for each row.
    definitions
        What the user has defined, by its code.

    Returns
    -------
    xarray.Dataset
        One dimension, ``sample``; the parameters are coordinates along it.
    """
    # What loops cost is known with them.
    coordinates: dict[str, Any] = {name: ("sample", rows[name]) for name in COLUMNS if name != COST}
    for name in _WITH_NAMES & {*COLUMNS}:
        names = [str(value_of(code, definitions, name)) for code in rows[name]]
        coordinates[name] = ("sample", np.array(names, dtype=object))
    columns = {name: np.array([getattr(each, name) for each in points], float) for name in _SCALARS}
    for group, prefix in (("position", "body"), ("normal", "normal")):
        values = np.array([getattr(each, group) for each in points], float).reshape(-1, 3)
        columns |= {f"{prefix}_{label}": column for label, column in zip("xyz", values.T, strict=True)}
    variables: dict[str, Any] = {
        name: ("sample", values, {"long_name": _MEANINGS[name], "units": "1"})
        for name, values in columns.items()
    }
    for name, meaning, words in (
        ("regime", "regime of the contact over the stationary cycle", REGIMES),
        ("verdict", "the first assumption of the surface line that the body's maximum breaks", VERDICTS),
    ):
        codes = np.array([words.index(getattr(each, name)) for each in points], dtype=np.int8)
        flags = {"flag_values": np.arange(len(words), dtype=np.int8), "flag_meanings": " ".join(words)}
        variables[name] = ("sample", codes, {"long_name": meaning, **flags})
    dataset = xr.Dataset(variables, coordinates)
    return (
        dataset.assign_attrs(definitions=definitions_text(definitions.values())) if definitions else dataset
    )


def open_audit(path: str | PathLike[str]) -> xr.Dataset:
    """The audit in a file, loaded.

    Raises
    ------
    ValueError
        If the file holds no audit, or is damaged.
    """
    from swtstudy.archive.netcdf import load_file

    dataset = load_file(Path(path))
    if not {"profile", "p", "q"} <= {*dataset.coords} or not {*_MEANINGS, "regime", "verdict"} - _LATER <= {
        *dataset.data_vars
    }:
        raise ValueError(f"{path}: a netCDF file, but not an audit of swtstudy")
    return dataset


def canonical_rows(dataset: xr.Dataset) -> Table:
    """The canonical rows of an audit's points, shape (n,)."""
    known = defined_in(dataset.attrs)
    rows = np.zeros(dataset.sizes["sample"], ROW)
    for name in COLUMNS:
        # What an older audit lacks is what it did not have: forces, loops, bulk stresses, other criteria, a
        # stick zone that moves, for which a strain share of 0 stands.
        if name in dataset.coords:
            values = dataset[name].values
            own = known.get(name, {})
            codes = name in _WITH_NAMES
            rows[name] = [code_of(own.get(value, value), name) for value in values] if codes else values
            if name == "load":
                rows[COST] = [own[value].cost if value in own else 0 for value in values]
        elif (
            name != STRAIN_SHARE
            and name in PARAMETERS
            and PARAMETERS[name].kind == "number"
            and PARAMETERS[name].optional
        ):
            rows[name] = PARAMETERS[name].default
    return rows


def audited_points(dataset: xr.Dataset) -> dict[tuple[float, ...], AuditedPoint]:
    """The points of an audit, by canonical row."""
    unknown = np.full(dataset.sizes["sample"], np.nan)
    values = {name: dataset[name].values if name in dataset else unknown for name in _MEANINGS}
    points = {}
    for i, row in enumerate(canonical_rows(dataset).tolist()):
        position, normal = (
            np.array([values[f"{prefix}_{axis}"][i] for axis in "xyz"]) for prefix in ("body", "normal")
        )
        stored = {name: float(values[name][i]) for name in _STORED}
        regime = REGIMES[int(dataset["regime"].values[i])]
        points[row] = AuditedPoint(**stored, regime=regime, position=position, normal=normal)
    return points


_WORDS = {
    "none": "on the surface line, where the solver found it",
    "line_search": "on the surface line, elsewhere",
    "plane_through_y": "on the surface line, on a plane that is not through y",
    "symmetry_line": "on the surface, off the line",
    "surface": "beneath the surface",
    "not_finite": "not searched: s is not finite, or at the edge r = b of the truncated paraboloid",
}
#: Ends of the ranges of ν in the report: closer where the surface line begins not to be enough.
_POISSON_ENDS = (0.0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5)
#: Excesses beyond this are over an s that is rounding.
_LARGE = 10.0
_BULK = ("bulk_stress_mean", "bulk_stress_amplitude")
#: How many of the points whose maximum the solver misses are listed one by one.
_LISTED = 20


def report(dataset: xr.Dataset) -> str:
    """The report of an audit as Markdown.

    Parameters
    ----------
    dataset
        From `swtstudy.audit_study`.
    """
    return "\n".join(_lines(dataset)) + "\n"


def _lines(dataset: xr.Dataset) -> Iterator[str]:
    excess, verdict = dataset["excess"].values, dataset["verdict"].values
    finite = np.isfinite(excess)
    exceeded = finite & (excess > TOLERANCE)
    ν = dataset["poisson_ratio"].values

    yield f"# {dataset.attrs['title']}"
    yield ""
    yield (
        f"{len(excess)} points, each solved in the whole body and for all plane orientations. Excess of swt "
        f"over s counts from {TOLERANCE:.1%}. A ring around the edge r = b of a flat face is left out: 0.002 "
        "of the largest contact radius wide, or narrower where the line's maximum would be inside it."
    )
    yield ""
    yield "| the maximum of swt is | points | exceeds s by up to | at ν from |"
    yield "|---|---|---|---|"
    for code, name in enumerate(VERDICTS):
        here = verdict == code
        if name in ("none", "not_finite") or not here.any():
            yield f"| {_WORDS[name]} | {here.sum()} | | |"
        else:
            most = _percent(excess[here].max(), 1)
            yield f"| {_WORDS[name]} | {here.sum()} | {most} | {ν[here].min():.2f} |"
    yield ""
    yield from _shares("ν", _ranges(ν), dataset)
    yield from _shares("profile", _values(dataset["profile"].values), dataset)
    regime = np.array(REGIMES)[dataset["regime"].values]
    yield from _shares("regime", _values(regime), dataset)
    # An older audit has no such columns.
    if any(name in dataset.coords and dataset[name].values.any() for name in _BULK):
        groups = _bulk_groups(dataset)
        yield from _shares("bulk stress", groups, dataset)
        name, inside = groups[0]
        enough = finite & inside
        on_line = f"{(enough & ~exceeded).sum()} of {enough.sum()}"
        yield f"With {name}, the surface line is enough at {on_line} points."
        yield ""
    yield from _of_the_solver(dataset, exceeded)
    if "s_dense" in dataset and np.isfinite(dataset["s_dense"].values).any():
        yield from _overlooked(dataset)


def _of_the_solver(dataset: xr.Dataset, exceeded: BoolArray) -> Iterator[str]:
    """Report how far the solver's own s_surface finds what exceeds s."""
    remainder, verdict = dataset["remainder"].values, dataset["verdict"].values
    finite = np.isfinite(dataset["excess"].values)
    flagged = finite & (dataset["s_surface"].values > (1.0 + TOLERANCE) * dataset["s"].values)
    beyond = finite & (remainder > TOLERANCE)
    yield "## What the solver knows"
    yield ""
    yield (
        f"The solver's s_surface is more than {TOLERANCE:.1%} above s at {flagged.sum()} points: "
        f"{(flagged & exceeded).sum()} of the {exceeded.sum()} at which the body's maximum is, and "
        f"{(flagged & ~exceeded).sum()} others. The body's maximum exceeds s_surface at {beyond.sum()} points"
        + (", by up to " + f"{remainder[beyond].max():.2%}:" if beyond.any() else ".")
    )
    yield ""
    rows, known = canonical_rows(dataset), defined_in(dataset.attrs)
    definitions = {each.code: each for own in known.values() for each in own.values()}
    for i in np.flatnonzero(beyond)[np.argsort(-remainder[beyond])][:_LISTED]:
        yield f"* {remainder[i]:.2%} ({VERDICTS[verdict[i]]}): {describe_point(rows[i], definitions)}"
    # Nothing, by either route, has no relative difference.
    some = dataset.isel(sample=finite & (dataset["s"].values > 0.0))
    away = np.abs(some["s_all_planes"].values / some["s"].values - 1.0)
    if away.size:
        yield ""
        yield (
            "At the line's maximum the solver and the field beneath the contact, two routes to one value, "
            f"differ by {np.median(away):.0e} (median), {np.quantile(away, 0.99):.0e} (99 %), "
            f"{away.max():.0e} (largest)."
        )


def _overlooked(dataset: xr.Dataset) -> Iterator[str]:
    """Report how the search compares with a dense look at the surface line."""
    short = dataset["shortfall"].values
    low = short > 0.0
    yield ""
    yield "## Was a maximum overlooked?"
    yield ""
    yield (
        f"A dense look at the surface line, at {np.isfinite(short).sum()} points: at {low.sum()} of them it "
        "is higher than s by more than s_error"
        + (f", by up to {short[low].max():.1e}." if low.any() else ".")
    )


def _shares(title: str, groups: list[tuple[str, BoolArray]], dataset: xr.Dataset) -> Iterator[str]:
    """A table of how often and by how much s and s_surface are exceeded in groups of points."""
    excess, remainder = dataset["excess"].values, dataset["remainder"].values
    finite, exceeded = np.isfinite(excess), excess > TOLERANCE
    yield f"| {title} | points | above s | by up to | above s_surface by up to |"
    yield "|---|---|---|---|---|"
    for name, group in groups:
        inside = finite & group
        if inside.any():
            most = " | ".join(_percent(max(values[inside].max(), 0.0), 2) for values in (excess, remainder))
            yield f"| {name} | {inside.sum()} | {(inside & exceeded).sum()} | {most} |"
    yield ""


def _bulk_groups(dataset: xr.Dataset) -> list[tuple[str, BoolArray]]:
    """Points by what makes the surface line doubtful with a bulk stress; the first group has none of it."""
    from swtstudy.kernel.circle import SAFE_POISSON_RATIO  # with the compiler, which takes half a second

    mean, ν = dataset["bulk_stress_mean"].values, dataset["poisson_ratio"].values
    edge = (dataset["profile"].values == "truncated_paraboloid") & (
        dataset["regime"].values == REGIMES.index("gross_slip")
    )
    hard, presses = ν > SAFE_POISSON_RATIO, mean < 0.0
    limit = f"{SAFE_POISSON_RATIO:g}"
    return [
        (f"mean ≥ 0, ν ≤ {limit}, no truncated paraboloid that slides", ~presses & ~hard & ~edge),
        (f"mean ≥ 0, ν ≤ {limit}, a truncated paraboloid that slides", ~presses & ~hard & edge),
        (f"mean ≥ 0, ν > {limit}", ~presses & hard),
        (f"mean < 0, ν ≤ {limit}", presses & ~hard),
        (f"mean < 0, ν > {limit}", presses & hard),
    ]


def _percent(share: float, digits: int) -> str:
    """A share in per cent; that over next to nothing is a large one, whatever its digits."""
    return f"{share:.{digits}%}" if share <= _LARGE else f"over {_LARGE:.0%}"


def _ranges(ν: FloatArray) -> list[tuple[str, BoolArray]]:
    pairs = itertools.pairwise(_POISSON_ENDS)
    return [(f"{low:g}–{high:g}", ((ν > low) | (low == 0.0)) & (ν <= high)) for low, high in pairs]


def _values(values: NDArray) -> list[tuple[str, BoolArray]]:
    return [(str(value).replace("_", " "), values == value) for value in np.unique(values)]
