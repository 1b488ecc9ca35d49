"""Figures 3 and 4, and section 4.2: how much the phase matters, by itself and with the frequency ratio."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import xarray as xr

from swtstudy.paper.statements.statement import (
    Finding,
    Statement,
    at,
    even,
    listed,
    period,
    spread,
    with_dims,
)
from swtstudy.vocabulary.wording import value_words

#: Table 1's amplitude of the tangential oscillation.
_TANGENTIAL = 5 / 6


def small_amplitude_is_flat(figure3: xr.Dataset) -> Finding:
    """Ratio of the largest to the smallest s over ψ at the smallest amplitude."""
    ratios = _ratios_by_amplitude(figure3)
    smallest = ratios.isel(normal_amplitude=[0])
    return Finding(f"max/min over ψ at δA/δ0 = {listed(smallest, '.3f')}", float(smallest[0]) <= 1.1)


def phase_matters_more_with_amplitude(figure3: xr.Dataset) -> Finding:
    """The same ratio at every amplitude."""
    ratios = _ratios_by_amplitude(figure3)
    return Finding(f"max/min over ψ at δA/δ0 = {listed(ratios)}", bool((np.diff(ratios) > 0).all()))


def almost_a_factor_of_two(figure3: xr.Dataset) -> Finding:
    """The same ratio at δA/δ0 = 8/9."""
    curve = at(with_dims(figure3, "phase"), normal_amplitude=8 / 9).s
    ratio = float(spread(curve, "phase"))
    return Finding(
        f"max/min = {float(curve.max()):.4f}/{float(curve.min()):.4f} = {ratio:.2f}", 1.5 <= ratio < 2.0
    )


def oscillation_raises_and_lowers(
    figure3: xr.Dataset, figure4: xr.Dataset, tangential: xr.Dataset
) -> Finding:
    """Largest and smallest s with a normal oscillation, over s without it."""
    without = at(tangential, normal_amplitude=0).s.interp(tangential_amplitude=_TANGENTIAL).item()
    changes = [float(extreme) / without - 1 for extreme in (figure4.s.max(), figure4.s.min())]
    same = [float(extreme) / without - 1 for extreme in (figure3.s.max(), figure3.s.min())]
    measured = (
        f"s = {without:.4f} without; with: {same[0]:+.0%} to {same[1]:+.0%} at one frequency, "
        f"{changes[0]:+.0%} to {changes[1]:+.0%} at several"
    )
    return Finding(measured, max(changes) >= 0.1 and min(changes) <= -0.1)


def _ratios_by_amplitude(figure3: xr.Dataset) -> xr.DataArray:
    ordered = with_dims(figure3, "phase", "normal_amplitude").sortby("normal_amplitude")
    return spread(ordered.s, "phase")


#: The ratios for which the paper finds that the phase matters most.
PROMINENT = (0.25, 0.5, 1.5)


def prominent_among_all(figure4: xr.Dataset) -> Finding:
    """Check whether every other ratio of the figure stays below the three prominent ones."""
    ratios = _ratios_by_amplitude_and_frequency(figure4)
    chosen = ratios.frequency_ratio.isin(PROMINENT)
    others = ratios.sel(frequency_ratio=~chosen)
    holds = (others.max("frequency_ratio") < ratios.sel(frequency_ratio=chosen).min("frequency_ratio")).all()
    return Finding(_by_amplitude(ratios), bool(holds))


def prominent_among_different(figure4: xr.Dataset) -> Finding:
    """The same, without ω2 = ω1."""
    return prominent_among_all(figure4.sel(frequency_ratio=figure4.frequency_ratio != 1))


def others_matter_little(figure4: xr.Dataset, others: xr.Dataset) -> Finding:
    """The variation over ψ at further ratios, compared with the least prominent of the three."""
    ratios, few = _ratios_by_amplitude_and_frequency(others), _ratios_by_amplitude_and_frequency(figure4)
    least = few.sel(frequency_ratio=list(PROMINENT)).min("frequency_ratio")
    return Finding(
        f"{_by_amplitude(ratios)}; the three: {least.values[-1]:.2f} or more",
        bool((ratios < least.values.reshape(-1, 1)).all()),
    )


def long_cycles_matter_little(frequencies: xr.Dataset) -> Finding:
    """Variation over ψ by the denominator q of ω2/ω1, which the length 2πq/ω1 of the full cycle follows."""
    variation = _ratios_by_amplitude_and_frequency(frequencies) - 1.0
    denominators = [
        Fraction(ratio).limit_denominator(100).denominator for ratio in variation.frequency_ratio.values
    ]
    largest = variation.groupby(xr.DataArray(denominators, dims="frequency_ratio", name="q")).max()
    rows = (
        f"δA/δ0 = {float(row.normal_amplitude):g}: q = "
        + ", ".join(
            f"{q}: {value:.2f}" for q, value in zip(row.q.values.tolist(), row.values.tolist(), strict=True)
        )
        for row in largest.transpose("normal_amplitude", "q")[::-1]
    )
    measured = f"largest max/min − 1 over ψ; {'; '.join(rows)}"
    return Finding(measured, bool((largest.diff("q") < 0.0).all()))


def period_shrinks(*archives: xr.Dataset) -> Finding:
    """Periods of s(ψ) at all ratios of the archives."""
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
    ratios = _ratios_by_amplitude_and_frequency(figure4)
    return Finding(_by_amplitude(ratios), bool((np.diff(ratios, axis=0) > 0).all()))


def half_differs_most(figure4: xr.Dataset) -> Finding:
    """s(π)/s(0) at every ratio, for the larger amplitude."""
    curves = with_dims(figure4, "frequency_ratio").sortby("normal_amplitude").isel(normal_amplitude=-1)
    change = at(curves, phase=math.pi).s / at(curves, phase=0).s
    largest = float(np.abs(np.log(change)).idxmax("frequency_ratio"))
    return Finding(f"s(π)/s(0) at ω2/ω1 = {listed(change)}", largest == 0.5)


def _ratios_by_amplitude_and_frequency(archive: xr.Dataset) -> xr.DataArray:
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
        "Figure 3",
        "For small amplitudes of the normal oscillation s hardly depends on the phase.",
        "max/min over ψ at most 1.1 at the smallest δA/δ0",
        small_amplitude_is_flat,
    ),
    Statement(
        "Figure 3",
        "The dependence on the phase grows with the amplitude of the normal oscillation.",
        "max/min over ψ grows with every step of δA/δ0",
        phase_matters_more_with_amplitude,
    ),
    Statement(
        "Figure 3",
        "At δA/δ0 = 8/9 the largest and the smallest s differ by almost a factor of two.",
        "the factor rounds to 2 and is below it: from 1.5 to 2",
        almost_a_factor_of_two,
    ),
    Statement(
        "Abstract",
        "A normal oscillation can raise or lower s markedly, depending on phase and frequency ratio.",
        "by 10% or more either way, against s without it",
        oscillation_raises_and_lowers,
        ("figure3", "figure4", "tangential_amplitude"),
    ),
    Statement(
        "Figure 4",
        "The phase matters most at ω2/ω1 = 1/4, 1/2 and 3/2.",
        "max/min over ψ is larger there than at every other ratio drawn, for both δA/δ0",
        prominent_among_all,
    ),
    Statement(
        "Figure 4",
        "The same among different frequencies, ω2 = ω1 (Figure 3's subject) left aside.",
        "as above, without ω2/ω1 = 1",
        prominent_among_different,
    ),
    Statement(
        "Section 4.2",
        "At other, less simple frequency ratios the phase has little influence.",
        "max/min over ψ is smaller than at any of 1/4, 1/2 and 3/2, for both δA/δ0",
        others_matter_little,
        ("figure4", "other_frequencies"),
    ),
    Statement(
        "Section 4.2",
        "The longer the full cycle, 2πq/ω1 at ω2/ω1 = p/q, the less the phase matters.",
        "the largest max/min − 1 over ψ of all ratios with one q falls with every step of q, for both δA/δ0",
        long_cycles_matter_little,
        ("frequencies",),
    ),
    Statement(
        "Figure 4",
        "s is periodic in the phase, and the period shrinks as ω2 grows.",
        "the period never grows from one ratio drawn to the next, and is shorter at the last",
        period_shrinks,
    ),
    Statement(
        "Section 4.2",
        "The same at every ratio that was tested.",
        "as above, with the less simple ratios in between",
        period_shrinks,
        ("figure4", "other_frequencies"),
    ),
    Statement(
        "Figure 4",
        "A larger normal oscillation amplifies all of this.",
        "max/min over ψ is larger at the larger δA/δ0 for every ratio",
        amplitude_amplifies,
    ),
    Statement(
        "Section 4.3",
        "Paraboloid: the phases 0 and π differ most at ω2/ω1 = 1/2.",
        "|ln s(π)/s(0)| is largest at 1/2 (larger δA/δ0)",
        half_differs_most,
        ("figure4",),
    ),
)
