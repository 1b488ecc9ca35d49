"""Figure 4: phase and frequency ratio together."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.paper.statements.measures import period, spread
from swtstudy.paper.statements.select import at, even, listed, with_dims
from swtstudy.paper.statements.statement import Finding, Statement
from swtstudy.vocabulary.wording import value_words

if TYPE_CHECKING:
    import xarray as xr

#: The ratios for which the paper finds that the phase matters most.
PROMINENT = (0.25, 0.5, 1.5)


def prominent_among_all(figure4: xr.Dataset) -> Finding:
    """Check whether every other ratio of the figure stays below the three prominent ones."""
    return _prominent(figure4)


def prominent_among_different(figure4: xr.Dataset) -> Finding:
    """The same, without ω2 = ω1."""
    return _prominent(figure4.sel(frequency_ratio=figure4.frequency_ratio != 1))


def _prominent(figure4: xr.Dataset) -> Finding:
    ratios = _ratios(figure4)
    chosen = ratios.frequency_ratio.isin(PROMINENT)
    others = ratios.sel(frequency_ratio=~chosen)
    holds = (others.max("frequency_ratio") < ratios.sel(frequency_ratio=chosen).min("frequency_ratio")).all()
    return Finding(_by_amplitude(ratios), bool(holds))


def others_matter_little(figure4: xr.Dataset, others: xr.Dataset) -> Finding:
    """The variation over ψ at further ratios, compared with the least prominent of the three."""
    ratios, few = _ratios(others), _ratios(figure4)
    least = few.sel(frequency_ratio=list(PROMINENT)).min("frequency_ratio")
    return Finding(
        f"{_by_amplitude(ratios)}; the three: {least.values[-1]:.2f} or more",
        bool((ratios < least.values.reshape(-1, 1)).all()),
    )


def period_shrinks(figure4: xr.Dataset) -> Finding:
    """Periods of s(ψ) at the ratios of the figure."""
    return _periods(figure4)


def period_shrinks_everywhere(figure4: xr.Dataset, others: xr.Dataset) -> Finding:
    """Periods of s(ψ) at all ratios tested."""
    return _periods(figure4, others)


def _periods(*archives: xr.Dataset) -> Finding:
    found: dict[float, float] = {}
    for archive in archives:
        curves = even(with_dims(archive, "frequency_ratio"), "phase").s.isel(normal_amplitude=-1)
        for ratio in curves.frequency_ratio.values.tolist():
            found[ratio] = period(curves.sel(frequency_ratio=ratio).sortby("phase").values)
    ratios = sorted(found)
    periods = [found[ratio] for ratio in ratios]
    words = ", ".join(
        f"{value_words('frequency_ratio', r)}: {value_words('phase', p)}"
        for r, p in zip(ratios, periods, strict=True)
    )
    never_longer = all(b <= a or math.isclose(a, b) for a, b in itertools.pairwise(periods))
    return Finding(f"period of s(ψ) at ω2/ω1 = {words}", never_longer and periods[-1] < periods[0])


def amplitude_amplifies(figure4: xr.Dataset) -> Finding:
    """The variation over ψ at each amplitude, for every ratio."""
    ratios = _ratios(figure4)
    return Finding(_by_amplitude(ratios), bool((np.diff(ratios, axis=0) > 0).all()))


def half_differs_most(figure4: xr.Dataset) -> Finding:
    """s(π)/s(0) at every ratio, for the larger amplitude."""
    curves = with_dims(figure4, "frequency_ratio").sortby("normal_amplitude").isel(normal_amplitude=-1)
    change = at(curves, phase=math.pi).s / at(curves, phase=0).s
    largest = float(np.abs(np.log(change)).idxmax("frequency_ratio"))
    return Finding(f"s(π)/s(0) at ω2/ω1 = {listed(change)}", largest == 0.5)


def _ratios(archive: xr.Dataset) -> xr.DataArray:
    """Largest over smallest s over ψ, by amplitude and frequency ratio, both ascending."""
    archive = with_dims(archive, "phase", "normal_amplitude", "frequency_ratio")
    ordered = archive.s.sortby("normal_amplitude").sortby("frequency_ratio")
    return spread(ordered, "phase").transpose("normal_amplitude", "frequency_ratio")


def _by_amplitude(ratios: xr.DataArray) -> str:
    rows = (
        f"δA/δ0 = {float(row.normal_amplitude):g}: ω2/ω1 = {listed(row.drop_vars('normal_amplitude'))}"
        for row in ratios[::-1]
    )
    return "max/min over ψ; " + "; ".join(rows)


STATEMENTS = (
    Statement(
        "Figure 4",
        "The phase matters most at ω2/ω1 = 1/4, 1/2 and 3/2.",
        "max/min over ψ is larger there than at every other ratio drawn, for both δA/δ0",
        ("figure4",),
        prominent_among_all,
    ),
    Statement(
        "Figure 4",
        "The same among different frequencies, ω2 = ω1 (Figure 3's subject) left aside.",
        "as above, without ω2/ω1 = 1",
        ("figure4",),
        prominent_among_different,
    ),
    Statement(
        "Section 4.2",
        "At other, less simple frequency ratios the phase has little influence.",
        "max/min over ψ is smaller than at any of 1/4, 1/2 and 3/2, for both δA/δ0",
        ("figure4", "other_frequencies"),
        others_matter_little,
    ),
    Statement(
        "Figure 4",
        "s is periodic in the phase, and the period shrinks as ω2 grows.",
        "the period never grows from one ratio drawn to the next, and is shorter at the last",
        ("figure4",),
        period_shrinks,
    ),
    Statement(
        "Section 4.2",
        "The same at every ratio that was tested.",
        "as above, with the less simple ratios in between",
        ("figure4", "other_frequencies"),
        period_shrinks_everywhere,
    ),
    Statement(
        "Figure 4",
        "A larger normal oscillation amplifies all of this.",
        "max/min over ψ is larger at the larger δA/δ0 for every ratio",
        ("figure4",),
        amplitude_amplifies,
    ),
    Statement(
        "Section 4.3",
        "Paraboloid: the phases 0 and π differ most at ω2/ω1 = 1/2.",
        "|ln s(π)/s(0)| is largest at 1/2 (larger δA/δ0)",
        ("figure4",),
        half_differs_most,
    ),
)
