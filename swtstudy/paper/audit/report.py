"""The report of an audit."""

from __future__ import annotations

import itertools

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import defined_in
from swtstudy.paper.audit.dataset import TOLERANCE, VERDICTS, canonical_rows
from swtstudy.paper.rendered import rendered
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
#: How many of the points whose maximum the solver misses are listed one by one.
_LISTED = 20


def report(dataset: xr.Dataset) -> str:
    """The report of an audit as Markdown.

    Parameters
    ----------
    dataset
        From `swtstudy.audit_study`.
    """
    excess, remainder, verdict, ν, s = (
        dataset[name].values for name in ("excess", "remainder", "verdict", "poisson_ratio", "s")
    )
    verdicts = []
    for code, name in enumerate(VERDICTS):
        here = verdict == code
        known = name not in ("none", "not_finite") and here.any()
        ends = (_percent(excess[here].max(), 1), f"{ν[here].min():.2f}") if known else ("", "")
        verdicts.append((_WORDS[name], here.sum(), *ends))
    ranges = itertools.pairwise(_POISSON_ENDS)
    groups = {"ν": {f"{low:g}–{high:g}": ((ν > low) | (low == 0.0)) & (ν <= high) for low, high in ranges}}
    regime = np.array(REGIMES)[dataset["regime"].values]
    for title, values in (("profile", dataset["profile"].values), ("regime", regime)):
        groups[title] = {str(each).replace("_", " "): values == each for each in np.unique(values)}
    finite = np.isfinite(excess)
    above, beyond = finite & (excess > TOLERANCE), finite & (remainder > TOLERANCE)
    enough: tuple[object, ...] = ()
    if any(dataset[name].values.any() for name in ("bulk_stress_mean", "bulk_stress_amplitude")):
        groups["bulk stress"] = _of_bulk_stress(dataset)
        name, inside = next(iter(groups["bulk stress"].items()))
        enough = name, (finite & inside & ~(excess > TOLERANCE)).sum(), (finite & inside).sum()
    shares = {
        title: [
            (
                name,
                here.sum(),
                (here & above).sum(),
                *(_percent(max(v[here].max(), 0.0), 2) for v in (excess, remainder)),
            )
            for name, here in ((name, finite & group) for name, group in own.items())
            if here.any()
        ]
        for title, own in groups.items()
    }
    flagged = finite & (dataset["s_surface"].values > (1.0 + TOLERANCE) * s)
    rows, known = canonical_rows(dataset), defined_in(dataset.attrs)
    definitions = {each.code: each for own in known.values() for each in own.values()}
    places = np.flatnonzero(beyond)[np.argsort(-remainder[beyond])][:_LISTED]
    some = finite & (s > 0.0)  # nothing, by either route, has no relative difference
    away = np.abs(dataset["s_all_planes"].values[some] / s[some] - 1.0)
    short = dataset["shortfall"].values
    return rendered(
        "audit/audit.md",
        title=dataset.attrs["title"],
        points=len(excess),
        tolerance=f"{TOLERANCE:.1%}",
        verdicts=verdicts,
        shares=shares,
        enough=enough,
        flagged=[each.sum() for each in (flagged, flagged & above, flagged & ~above)],
        exceeded=above.sum(),
        beyond=beyond.sum(),
        most=f"{remainder[beyond].max(initial=0.0):.2%}",
        listed=[
            f"{remainder[i]:.2%} ({VERDICTS[verdict[i]]}): {describe_point(rows[i], definitions)}"
            for i in places
        ],
        away=[f"{each:.0e}" for each in (np.median(away), np.quantile(away, 0.99), away.max())]
        if some.any()
        else [],
        dense=(np.isfinite(short).sum(), (short > 0.0).sum(), f"{np.nanmax(short):.1e}")
        if np.isfinite(short).any()
        else (),
    )


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
    return f"{share:.{digits}%}" if share <= 10.0 else "over 1000%"
