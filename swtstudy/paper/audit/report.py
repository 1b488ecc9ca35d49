"""The report of an audit."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in
from swtstudy.paper.audit.dataset import TOLERANCE, VERDICTS, canonical_rows
from swtstudy.points.canonical import describe_point
from swtstudy.vocabulary.arrays import BoolArray
from swtstudy.vocabulary.choices import REGIMES, SHARP

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
#: How many of the points whose maximum the solver misses are listed one by one.
_LISTED = 20


def report(dataset: xr.Dataset) -> str:
    """The report of an audit as Markdown.

    Parameters
    ----------
    dataset
        From `swtstudy.audit_study`.
    """
    excess, verdict, ν = (dataset[name].values for name in ("excess", "verdict", "poisson_ratio"))
    lines = [
        f"# {dataset.attrs['title']}",
        "",
        f"{len(excess)} points, each solved in the whole body and for all plane orientations. Excess of swt "
        f"over s counts from {TOLERANCE:.1%}. A ring around the edge r = b of a flat face is left out: 0.002 "
        "of the largest contact radius wide, or narrower where the line's maximum would be inside it.",
        "",
        "| the maximum of swt is | points | exceeds s by up to | at ν from |",
        "|---|---|---|---|",
    ]
    for code, name in enumerate(VERDICTS):
        here = verdict == code
        cells = "|"
        if name not in ("none", "not_finite") and here.any():
            cells = f"{_percent(excess[here].max(), 1)} | {ν[here].min():.2f}"
        lines.append(f"| {_WORDS[name]} | {here.sum()} | {cells} |")
    ranges = itertools.pairwise(_POISSON_ENDS)
    of_ν = {f"{low:g}–{high:g}": ((ν > low) | (low == 0.0)) & (ν <= high) for low, high in ranges}
    lines += ["", *_shares("ν", of_ν, dataset)]
    profile, regime = dataset["profile"].values, np.array(REGIMES)[dataset["regime"].values]
    for title, values in (("profile", profile), ("regime", regime)):
        groups = {str(value).replace("_", " "): values == value for value in np.unique(values)}
        lines += _shares(title, groups, dataset)
    if any(dataset[name].values.any() for name in ("bulk_stress_mean", "bulk_stress_amplitude")):
        groups = _of_bulk_stress(dataset)
        lines += _shares("bulk stress", groups, dataset)
        name, inside = next(iter(groups.items()))
        enough = np.isfinite(excess) & inside
        on_line = f"{(enough & ~(excess > TOLERANCE)).sum()} of {enough.sum()}"
        lines += [f"With {name}, the surface line is enough at {on_line} points.", ""]
    return "\n".join([*lines, *_of_the_solver(dataset)]) + "\n"


def _of_the_solver(dataset: xr.Dataset) -> Iterator[str]:
    """The section on s_surface, and on other routes to s."""
    excess, remainder, s = (dataset[name].values for name in ("excess", "remainder", "s"))
    finite = np.isfinite(excess)
    exceeded, beyond = finite & (excess > TOLERANCE), finite & (remainder > TOLERANCE)
    flagged = finite & (dataset["s_surface"].values > (1.0 + TOLERANCE) * s)
    yield "## What the solver knows"
    yield ""
    yield (
        f"The solver's s_surface is more than {TOLERANCE:.1%} above s at {flagged.sum()} points: "
        f"{(flagged & exceeded).sum()} of the {exceeded.sum()} at which the body's maximum is, and "
        f"{(flagged & ~exceeded).sum()} others. The body's maximum exceeds s_surface at {beyond.sum()} points"
        + (f", by up to {remainder[beyond].max():.2%}:" if beyond.any() else ".")
    )
    yield ""
    rows, known = canonical_rows(dataset), defined_in(dataset.attrs)
    definitions = {each.code: each for own in known.values() for each in own.values()}
    for i in np.flatnonzero(beyond)[np.argsort(-remainder[beyond])][:_LISTED]:
        verdict = VERDICTS[dataset["verdict"].values[i]]
        yield f"* {remainder[i]:.2%} ({verdict}): {describe_point(rows[i], definitions)}"
    some = finite & (s > 0.0)  # nothing, by either route, has no relative difference
    if some.any():
        away = np.abs(dataset["s_all_planes"].values[some] / s[some] - 1.0)
        yield ""
        yield (
            "At the line's maximum the solver and the field beneath the contact, two routes to one value, "
            f"differ by {np.median(away):.0e} (median), {np.quantile(away, 0.99):.0e} (99 %), "
            f"{away.max():.0e} (largest)."
        )
    short = dataset["shortfall"].values
    if np.isfinite(short).any():
        low = short > 0.0
        yield ""
        yield "## Was a maximum overlooked?"
        yield ""
        yield (
            f"A dense look at the surface line, at {np.isfinite(short).sum()} points: at {low.sum()} of them "
            "it is higher than s by more than s_error"
            + (f", by up to {short[low].max():.1e}." if low.any() else ".")
        )


def _shares(title: str, groups: dict[str, BoolArray], dataset: xr.Dataset) -> Iterator[str]:
    """A table of how often and by how much s and s_surface are exceeded in groups of points."""
    excess, remainder = dataset["excess"].values, dataset["remainder"].values
    yield f"| {title} | points | above s | by up to | above s_surface by up to |"
    yield "|---|---|---|---|---|"
    for name, group in groups.items():
        inside = np.isfinite(excess) & group
        if inside.any():
            most = " | ".join(_percent(max(values[inside].max(), 0.0), 2) for values in (excess, remainder))
            yield f"| {name} | {inside.sum()} | {(inside & (excess > TOLERANCE)).sum()} | {most} |"
    yield ""


def _of_bulk_stress(dataset: xr.Dataset) -> dict[str, BoolArray]:
    """Points by what makes the surface line doubtful with a bulk stress; the first group has none of it."""
    from swtstudy.kernel.circle import SAFE_POISSON_RATIO  # with the compiler, which takes half a second

    edge = (dataset["profile"].values == SHARP) & (dataset["regime"].values == REGIMES.index("gross_slip"))
    hard = dataset["poisson_ratio"].values > SAFE_POISSON_RATIO
    presses = dataset["bulk_stress_mean"].values < 0.0
    limit = f"{SAFE_POISSON_RATIO:g}"
    return {
        f"mean ≥ 0, ν ≤ {limit}, no truncated paraboloid that slides": ~presses & ~hard & ~edge,
        f"mean ≥ 0, ν ≤ {limit}, a truncated paraboloid that slides": ~presses & ~hard & edge,
        f"mean ≥ 0, ν > {limit}": ~presses & hard,
        f"mean < 0, ν ≤ {limit}": presses & ~hard,
        f"mean < 0, ν > {limit}": presses & hard,
    }


def _percent(share: float, digits: int) -> str:
    """A share in per cent; that over next to nothing is a large one, whatever its digits."""
    return f"{share:.{digits}%}" if share <= _LARGE else f"over {_LARGE:.0%}"
