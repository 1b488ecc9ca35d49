"""Reports in Markdown, from the templates in this folder: of an audit, and of Sobol indices."""

from __future__ import annotations

import itertools
from typing import Any

import jinja2
import numpy as np
import pandas as pd
import xarray as xr

from swtstudy.paper.audit import TOLERANCE, VERDICTS, canonical_rows
from swtstudy.points.grid import describe_point
from swtstudy.study.writing import defined_in
from swtstudy.vocabulary.choices import REGIMES, SHARP
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.wording import unit_words, value_words


def rendered(template: str, **content: Any) -> str:
    """A report from a template."""
    look: dict[str, Any] = {"trim_blocks": True, "lstrip_blocks": True, "keep_trailing_newline": True}
    loader = jinja2.PackageLoader("swtstudy.paper", ".")
    room = jinja2.Environment(loader=loader, undefined=jinja2.StrictUndefined, **look)
    return room.get_template(template).render(**content)


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
    points, groups = dataset.to_dataframe(), ["ν", "profile", "regime"]
    ranges = [f"{low:g}–{high:g}" for low, high in itertools.pairwise(_POISSON_ENDS)]
    points["ν"] = pd.cut(points["poisson_ratio"], _POISSON_ENDS, labels=ranges, include_lowest=True)
    points["regime"] = np.array(REGIMES)[points["regime"]]
    if points[["bulk_stress_mean", "bulk_stress_amplitude"]].any(axis=None):
        groups.append("bulk stress")
        points["bulk stress"] = _of_bulk_stress(points)
    points["above"], points["beyond"] = points["excess"] > TOLERANCE, points["remainder"] > TOLERANCE
    finite = points[np.isfinite(points["excess"])]
    # Nothing, by either route, has no relative difference.
    some = finite[finite["s"] > 0.0]
    higher = some["s_all_planes"] / some["s"] - 1.0  # at the line's maximum
    beyond = finite[finite["beyond"]].sort_values("remainder", ascending=False)
    rows, known = canonical_rows(dataset), defined_in(dataset.attrs)
    definitions = {each.code: each for own in known.values() for each in own.values()}
    return rendered(
        "audit.md",
        title=dataset.attrs["title"],
        tolerance=f"{TOLERANCE:.1%}",
        points=points,
        finite=finite,
        flagged=finite[finite["s_surface"] > (1.0 + TOLERANCE) * finite["s"]],
        beyond=beyond,
        groups={title: finite.groupby(title, observed=True) for title in groups},
        verdicts={name: points[points["verdict"] == number] for number, name in enumerate(VERDICTS)},
        listed=[
            f"{share:.2%} ({VERDICTS[verdict]}): {describe_point(rows[number], definitions)}"
            for number, share, verdict in beyond[["remainder", "verdict"]][:_LISTED].itertuples()
        ],
        higher=higher[higher > TOLERANCE],
        away=higher[higher <= TOLERANCE].abs(),
        short=points["shortfall"].dropna(),
        percent=_percent,
    )


def _of_bulk_stress(points: pd.DataFrame) -> pd.Categorical:
    """The reason why a bulk stress makes the surface line doubtful at each point; none in the first group."""
    from swtstudy.kernel.circle import SAFE_POISSON_RATIO  # with the compiler, which takes half a second

    presses, hard = points["bulk_stress_mean"] < 0.0, points["poisson_ratio"] > SAFE_POISSON_RATIO
    edge = (points["profile"] == SHARP) & (points["regime"] == "gross_slip")
    limit = f"{SAFE_POISSON_RATIO:g}"
    groups = [
        f"mean ≥ 0, ν ≤ {limit}, no truncated paraboloid that slides",
        f"mean ≥ 0, ν ≤ {limit}, a truncated paraboloid that slides",
        f"mean ≥ 0, ν > {limit}",
        f"mean < 0, ν ≤ {limit}",
        f"mean < 0, ν > {limit}",
    ]
    number = np.where(presses, 3 + hard, np.where(hard, 2, 1 * edge))
    return pd.Categorical.from_codes(number, groups)


def _percent(share: float, digits: int) -> str:
    """A share in per cent; that over next to nothing is a large one, whatever its digits."""
    return f"{share:.{digits}%}" if share <= 10.0 else "over 1000%"


def table(indices: xr.Dataset, of_paper: bool = False) -> str:
    """Sobol indices as Markdown.

    Parameters
    ----------
    indices
        From `swtstudy.sensitivity`.
    of_paper
        Whether they belong to a study of the paper, with the paper's words.
    """
    axes = [str(dim) for dim in indices.first_order.dims if dim not in ("quantity", "parameter")]
    units = {name: unit_words(indices[name].attrs.get("units", "1")) for name in axes}
    places, parts = indices.stack(place=["quantity", *axes]), []
    for number in range(places.sizes["place"]):
        one = places.isel(place=number)
        where = [f"{name} = {value_words(name, one[name].item())}{unit}" for name, unit in units.items()]
        parts.append((", ".join([one.quantity.item(), *where]), one))
    letters = {name: AXES[name].letter for name in indices["parameter"].values}
    return rendered("indices.md", indices=indices, parts=parts, letters=letters, of_paper=of_paper)
