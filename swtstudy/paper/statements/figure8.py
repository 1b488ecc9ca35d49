"""Figure 8: waviness and frequency ratio."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.paper.statements.figure5 import WEAK, coupling_with
from swtstudy.paper.statements.figure7 import oscillations
from swtstudy.paper.statements.oscillations import as_a_rule, larger_swings, longer_periods
from swtstudy.paper.statements.select import at, even, listed, with_dims
from swtstudy.paper.statements.statement import Finding, Statement

if TYPE_CHECKING:
    import xarray as xr


def half_differs_most(figure8: xr.Dataset) -> Finding:
    """Mean over h of |ln s(π)/s(0)| at every frequency ratio."""
    curves = even(with_dims(figure8, "phase", "frequency_ratio"), "waviness_amplitude")
    change = np.abs(np.log(at(curves, phase=math.pi).s / at(curves, phase=0).s)).mean("waviness_amplitude")
    largest = float(change.idxmax("frequency_ratio"))
    return Finding(f"mean over h of |ln s(π)/s(0)| at ω2/ω1 = {listed(change)}", largest == 0.5)


def loads_couple_weakly(figure8: xr.Dataset) -> Finding:
    """Coupling of h with phase and frequency ratio."""
    return coupling_with(even(figure8, "waviness_amplitude"), "waviness_amplitude", WEAK)


def trends_are_similar(figure8: xr.Dataset) -> Finding:
    """Check whether every curve oscillates with periods and swings that grow with h."""
    found = oscillations(with_dims(figure8, "phase", "frequency_ratio"))
    alike = sum(as_a_rule(longer_periods([one])) and as_a_rule(larger_swings([one])) for one in found)
    curves = figure8.s.transpose(..., "waviness_amplitude").values.reshape(len(found), -1)
    correlation = np.corrcoef(curves)[np.triu_indices(len(curves), 1)]
    measured = (
        f"periods and swings grow with h on {alike} of {len(found)} curves; correlation of two curves: "
        f"median {np.median(correlation):.2f}, from {correlation.min():.2f} to {correlation.max():.2f}"
    )
    return Finding(measured, alike == len(found))


STATEMENTS = (
    Statement(
        "Figure 8",
        "Wavy paraboloid: the phases 0 and π differ most at ω2/ω1 = 1/2.",
        "the mean over h of |ln s(π)/s(0)| is largest at 1/2",
        ("figure8",),
        half_differs_most,
    ),
    Statement(
        "Figure 8",
        "All curves show similar trends.",
        "every curve oscillates, with periods and swings that grow with h in 4 of 5 cases",
        ("figure8",),
        trends_are_similar,
    ),
    Statement(
        "Figure 8",
        "Waviness and load are weakly coupled.",
        "at most 10% of the variance of ln s is left over by a product f(h)·g(ψ, ω2/ω1)",
        ("figure8",),
        loads_couple_weakly,
    ),
)
