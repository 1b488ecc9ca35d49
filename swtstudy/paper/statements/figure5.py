"""Figure 5: the radius of the punch face."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.paper.statements.measures import coupling
from swtstudy.paper.statements.select import at, even, listed, with_dims
from swtstudy.paper.statements.statement import Finding, Statement

if TYPE_CHECKING:
    import xarray as xr

#: Largest share of the variance of ln s for a coupling that is called weak, or negligible.
WEAK, NEGLIGIBLE = 0.1, 0.01


def rounded_punch_falls(figure5: xr.Dataset) -> Finding:
    """Check whether s of the rounded punch falls with b at every phase."""
    return _monotone(figure5, "rounded_punch", -1)


def truncated_paraboloid_rises(figure5: xr.Dataset) -> Finding:
    """Check whether s of the truncated paraboloid rises with b at every phase."""
    return _monotone(figure5, "truncated_paraboloid", 1)


def _monotone(figure5: xr.Dataset, profile: str, sense: int) -> Finding:
    """Check whether s rises (sense 1) or falls (-1) with b at every phase, up to its estimated error."""
    curves = with_dims(at(figure5, profile=profile), "flat_radius", "phase").sortby("flat_radius")
    curves = curves.transpose("flat_radius", "phase")
    s, error = curves.s.values, curves.s_error.values
    against = sense * (s[:-1] - s[1:]) - error[1:] - error[:-1]
    means = even(curves, "phase").s.mean("phase")
    measured = f"mean over ψ, against b = 0, at b/a_H = {listed(means / means[0].item())}"
    wrong = against > 0
    if wrong.any():
        step, phase = np.unravel_index(np.argmax(against / s[:-1]), against.shape)
        b = curves.flat_radius.values
        measured += (
            f"; the opposite at {wrong.any(axis=0).sum()} of {s.shape[1]} phases, by up to "
            f"{(against / s[:-1]).max():.1%} (b/a_H = {b[step]:g} to {b[step + 1]:g}, "
            f"ψ = {np.degrees(curves.phase.values[phase]):.1f}°)"
        )
    else:
        measured += f"; likewise at each of {s.shape[1]} phases"
    return Finding(measured, not wrong.any())


def rounded_punch_uncoupled(figure5: xr.Dataset) -> Finding:
    """Coupling of b and ψ for the rounded punch."""
    return coupling_with(even(at(figure5, profile="rounded_punch"), "phase"), "flat_radius", NEGLIGIBLE)


def truncated_paraboloid_weakly_coupled(figure5: xr.Dataset) -> Finding:
    """Coupling of b and ψ for the truncated paraboloid."""
    return coupling_with(even(at(figure5, profile="truncated_paraboloid"), "phase"), "flat_radius", WEAK)


def coupling_with(dataset: xr.Dataset, dim: str, largest: float) -> Finding:
    """Coupling of a shape parameter with the load, and whether it is within a bound."""
    share = coupling(with_dims(dataset, dim).s, dim)
    return Finding(f"{share:.1%} of the variance of ln s is coupling", share <= largest)


STATEMENTS = (
    Statement(
        "Figure 5",
        "Rounded punch: s falls with b/a_H at every phase, and so lies below the full paraboloid.",
        "no step of b/a_H raises s beyond its error at any phase",
        ("figure5",),
        rounded_punch_falls,
    ),
    Statement(
        "Figure 5",
        "Truncated paraboloid: s rises with b/a_H at every phase, and so lies above the full paraboloid.",
        "no step of b/a_H lowers s beyond its error at any phase",
        ("figure5",),
        truncated_paraboloid_rises,
    ),
    Statement(
        "Figure 5",
        "Rounded punch: b/a_H and phase are practically not coupled.",
        "at most 1% of the variance of ln s is left over by a product f(b)·g(ψ)",
        ("figure5",),
        rounded_punch_uncoupled,
    ),
    Statement(
        "Figure 5",
        "Truncated paraboloid: b/a_H and phase are weakly coupled.",
        "at most 10% of the variance of ln s is left over by a product f(b)·g(ψ)",
        ("figure5",),
        truncated_paraboloid_weakly_coupled,
    ),
)
