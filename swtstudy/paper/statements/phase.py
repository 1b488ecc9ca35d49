"""Figures 3 and 4, and section 4.2: how much the phase matters, by itself and with the frequency ratio."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import xarray as xr

from swtstudy.paper.statements.statement import (
    Finding,
    at,
    even,
    listed,
    period,
    spread,
    statement,
    with_dims,
)
from swtstudy.vocabulary.wording import value_words

#: Table 1's amplitude of the tangential oscillation.
_TANGENTIAL = 5 / 6


@statement("Figure 3")
def small_amplitude_is_flat(figure3: xr.Dataset) -> Finding:
    """For small amplitudes of the normal oscillation s hardly depends on the phase.

    Holds if: max/min over ψ at most 1.1 at the smallest δA/δ0
    """
    ratios = spread(figure3, "phase", "normal_amplitude")
    smallest = ratios.isel(normal_amplitude=[0])
    return Finding(f"max/min over ψ at δA/δ0 = {listed(smallest, '.3f')}", float(smallest[0]) <= 1.1)


@statement("Figure 3")
def phase_matters_more_with_amplitude(figure3: xr.Dataset) -> Finding:
    """The dependence on the phase grows with the amplitude of the normal oscillation.

    Holds if: max/min over ψ grows with every step of δA/δ0
    """
    ratios = spread(figure3, "phase", "normal_amplitude")
    return Finding(f"max/min over ψ at δA/δ0 = {listed(ratios)}", bool((np.diff(ratios) > 0).all()))


@statement("Figure 3")
def almost_a_factor_of_two(figure3: xr.Dataset) -> Finding:
    """At δA/δ0 = 8/9 the largest and the smallest s differ by almost a factor of two.

    Holds if: the factor rounds to 2 and is below it: from 1.5 to 2
    """
    curve = at(with_dims(figure3, "phase"), normal_amplitude=8 / 9).s
    low, high = float(curve.min()), float(curve.max())
    return Finding(f"max/min = {high:.4f}/{low:.4f} = {high / low:.2f}", 1.5 <= high / low < 2.0)


@statement("Abstract")
def oscillation_raises_and_lowers(
    figure3: xr.Dataset, figure4: xr.Dataset, tangential_amplitude: xr.Dataset
) -> Finding:
    """A normal oscillation can raise or lower s markedly, depending on phase and frequency ratio.

    Holds if: by 10% or more either way, against s without it
    """
    without = at(tangential_amplitude, normal_amplitude=0).s.interp(tangential_amplitude=_TANGENTIAL).item()
    changes = [float(extreme) / without - 1 for extreme in (figure4.s.max(), figure4.s.min())]
    same = [float(extreme) / without - 1 for extreme in (figure3.s.max(), figure3.s.min())]
    measured = (
        f"s = {without:.4f} without; with: {same[0]:+.0%} to {same[1]:+.0%} at one frequency, "
        f"{changes[0]:+.0%} to {changes[1]:+.0%} at several"
    )
    return Finding(measured, max(changes) >= 0.1 and min(changes) <= -0.1)


def _by_phase(archive: xr.Dataset) -> xr.DataArray:
    """Largest over smallest s over ψ, by amplitude and frequency ratio."""
    return spread(archive, "phase", "normal_amplitude", "frequency_ratio")


#: The ratios for which the paper finds that the phase matters most.
PROMINENT = (0.25, 0.5, 1.5)


@statement("Figure 4")
def prominent_among_all(figure4: xr.Dataset) -> Finding:
    """The phase matters most at ω2/ω1 = 1/4, 1/2 and 3/2.

    Holds if: max/min over ψ is larger there than at every other ratio drawn, for both δA/δ0
    """
    ratios = _by_phase(figure4)
    chosen = ratios.frequency_ratio.isin(PROMINENT)
    others = ratios.sel(frequency_ratio=~chosen)
    holds = (others.max("frequency_ratio") < ratios.sel(frequency_ratio=chosen).min("frequency_ratio")).all()
    return Finding(_by_amplitude(ratios), bool(holds))


@statement("Figure 4")
def prominent_among_different(figure4: xr.Dataset) -> Finding:
    """The same among different frequencies, ω2 = ω1 (Figure 3's subject) left aside.

    Holds if: as above, without ω2/ω1 = 1
    """
    return prominent_among_all(figure4.sel(frequency_ratio=figure4.frequency_ratio != 1))


@statement("Section 4.2")
def others_matter_little(figure4: xr.Dataset, other_frequencies: xr.Dataset) -> Finding:
    """At other, less simple frequency ratios the phase has little influence.

    Holds if: max/min over ψ is smaller than at any of 1/4, 1/2 and 3/2, for both δA/δ0
    """
    ratios, few = _by_phase(other_frequencies), _by_phase(figure4)
    least = few.sel(frequency_ratio=list(PROMINENT)).min("frequency_ratio")
    return Finding(
        f"{_by_amplitude(ratios)}; the three: {least.values[-1]:.2f} or more",
        bool((ratios < least.values.reshape(-1, 1)).all()),
    )


@statement("Section 4.2")
def long_cycles_matter_little(frequencies: xr.Dataset) -> Finding:
    """The longer the full cycle, 2πq/ω1 at ω2/ω1 = p/q, the less the phase matters.

    Holds if: the largest max/min − 1 over ψ of all ratios with one q falls with every step of q, for both
    δA/δ0
    """
    variation = _by_phase(frequencies) - 1.0
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


@statement("Figure 4")
def period_shrinks(figure4: xr.Dataset) -> Finding:
    """s is periodic in the phase, and the period shrinks as ω2 grows.

    Holds if: the period never grows from one ratio drawn to the next, and is shorter at the last
    """
    return _periods(figure4)


@statement("Section 4.2")
def period_shrinks_in_between(figure4: xr.Dataset, other_frequencies: xr.Dataset) -> Finding:
    """The same at every ratio that was tested.

    Holds if: as above, with the less simple ratios in between
    """
    return _periods(figure4, other_frequencies)


def _periods(*archives: xr.Dataset) -> Finding:
    """Periods of s(ψ) at all ratios of archives."""
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


@statement("Figure 4")
def amplitude_amplifies(figure4: xr.Dataset) -> Finding:
    """A larger normal oscillation amplifies all of this.

    Holds if: max/min over ψ is larger at the larger δA/δ0 for every ratio
    """
    ratios = _by_phase(figure4)
    return Finding(_by_amplitude(ratios), bool((np.diff(ratios, axis=0) > 0).all()))


@statement("Section 4.3")
def half_differs_most(figure4: xr.Dataset) -> Finding:
    """Paraboloid: the phases 0 and π differ most at ω2/ω1 = 1/2.

    Holds if: |ln s(π)/s(0)| is largest at 1/2 (larger δA/δ0)
    """
    curves = with_dims(figure4, "frequency_ratio").sortby("normal_amplitude").isel(normal_amplitude=-1)
    change = at(curves, phase=math.pi).s / at(curves, phase=0).s
    largest = float(np.abs(np.log(change)).idxmax("frequency_ratio"))
    return Finding(f"s(π)/s(0) at ω2/ω1 = {listed(change)}", largest == 0.5)


def _by_amplitude(ratios: xr.DataArray) -> str:
    rows = (
        f"δA/δ0 = {float(row.normal_amplitude):g}: ω2/ω1 = {listed(row.drop_vars('normal_amplitude'))}"
        for row in ratios[::-1]
    )
    return "max/min over ψ; " + "; ".join(rows)
