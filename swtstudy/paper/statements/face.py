"""Figures 5 and 6: the radius of the punch face, by itself and with the frequency ratio."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.paper.statements.statement import (
    Finding,
    at,
    coupling,
    even,
    largest_change,
    listed,
    statement,
    with_dims,
)
from swtstudy.vocabulary.wording import value_words

#: Largest share of the variance of ln s for a coupling that is called weak, or negligible.
WEAK, NEGLIGIBLE = 0.1, 0.01


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


@statement("Figure 5")
def rounded_punch_falls(figure5: xr.Dataset) -> Finding:
    """Rounded punch: s falls with b/a_H at every phase, and so lies below the full paraboloid.

    Holds if: no step of b/a_H raises s beyond its error at any phase
    """
    return _monotone(figure5, "rounded_punch", -1)


@statement("Figure 5")
def truncated_paraboloid_rises(figure5: xr.Dataset) -> Finding:
    """Truncated paraboloid: s rises with b/a_H at every phase, and so lies above the full paraboloid.

    Holds if: no step of b/a_H lowers s beyond its error at any phase
    """
    return _monotone(figure5, "truncated_paraboloid", 1)


def coupling_with(dataset: xr.Dataset, dim: str, largest: float) -> Finding:
    """Coupling of a shape parameter with the load, and whether it is within a bound."""
    share = coupling(with_dims(dataset, dim).s, dim)
    return Finding(f"{share:.1%} of the variance of ln s is coupling", share <= largest)


@statement("Figure 5")
def rounded_punch_uncoupled(figure5: xr.Dataset) -> Finding:
    """Rounded punch: b/a_H and phase are practically not coupled.

    Holds if: at most 1% of the variance of ln s is left over by a product f(b)·g(ψ)
    """
    return coupling_with(even(at(figure5, profile="rounded_punch"), "phase"), "flat_radius", NEGLIGIBLE)


@statement("Figure 5")
def truncated_paraboloid_weakly_coupled(figure5: xr.Dataset) -> Finding:
    """Truncated paraboloid: b/a_H and phase are weakly coupled.

    Holds if: at most 10% of the variance of ln s is left over by a product f(b)·g(ψ)
    """
    return coupling_with(even(at(figure5, profile="truncated_paraboloid"), "phase"), "flat_radius", WEAK)


#: Largest distance of two curves that look like one in a figure, as a fraction of its height.
_LINE = 0.02


@statement("Figure 6")
def all_curves_fall(figure6: xr.Dataset) -> Finding:
    """Rounded punch: s falls with b/a_H for every frequency ratio and phase.

    Holds if: no step of b/a_H raises s beyond its error
    """
    rise = largest_change(with_dims(figure6, "flat_radius"), "flat_radius", 1)
    ordered = figure6.s.sortby("flat_radius")
    end = ordered.isel(flat_radius=-1) / ordered.isel(flat_radius=0)
    words = f"rises by up to {rise:.1e} from one b to the next" if rise else "rises nowhere"
    measured = (
        f"s {words}; at b/a_H = {float(ordered.flat_radius[-1]):g} it is {float(end.min()):.2f} to "
        f"{float(end.max()):.2f} of s at 0"
    )
    return Finding(measured, rise == 0)


@statement("Figure 6")
def curves_are_alike(figure6: xr.Dataset) -> Finding:
    """All curves fall in exactly the same way: no coupling of load and profile can be seen.

    Holds if: the curves s/s(b = 0) are nowhere further apart than 2% of the figure's height
    """
    normalised = with_dims(figure6, "phase", "frequency_ratio").s / at(figure6, flat_radius=0).s
    by_phase = _distance(normalised, ["frequency_ratio"])
    height = float(normalised.max() - normalised.min())
    share = float(_distance(normalised, ["frequency_ratio", "phase"])) / height
    words = ", ".join(
        f"ψ = {value_words('phase', phase)}: {distance / height:.0%}"
        for phase, distance in zip(by_phase.phase.values.tolist(), by_phase.values.tolist(), strict=True)
    )
    return Finding(
        f"largest distance of the curves, of the figure's height, {words}; all: {share:.0%}", share <= _LINE
    )


def _distance(normalised: xr.DataArray, over: list[str]) -> xr.DataArray:
    return (normalised.max(over) - normalised.min(over)).max("flat_radius")


@statement("Figure 6")
def loads_do_not_couple(figure6: xr.Dataset) -> Finding:
    """Rounded punch: the coupling of b/a_H with the load is negligible.

    Holds if: at most 1% of the variance of ln s is left over by a product f(b)·g(ψ, ω2/ω1)
    """
    return coupling_with(figure6, "flat_radius", NEGLIGIBLE)


@statement("Section 4.3")
def sharp_edges_are_worst(stability_thin_annulus: xr.Dataset) -> Finding:
    """Rounded punch: as R → 0 at fixed b and δ0, the sharp punch, SWT grows without bound.

    Holds if: SWT/E* = s δ0/R grows beyond its error with every step of R towards 0
    """
    curves = at(stability_thin_annulus, profile="rounded_punch")
    curves = with_dims(curves, "flat_radius").sortby("flat_radius")
    b = curves.flat_radius
    swt, error = curves.s * b**2, curves.s_error * b**2
    steps = swt.diff("flat_radius") - error.rolling(flat_radius=2).sum().isel(flat_radius=slice(1, None))
    last = np.log(swt.isel(flat_radius=[-2, -1])).diff("flat_radius").squeeze() / np.log(
        b.values[-1] / b.values[-2]
    )
    grows = bool((steps > 0.0).all())
    words = "at every step" if grows else f"at {float((steps > 0.0).mean()):.0%} of the steps"
    low, high = 0.5 * float(last.min()), 0.5 * float(last.max())
    measured = (
        f"SWT grows {words} while R falls to {float((b[0] / b[-1]) ** 2):.0e} of its first value, on "
        f"{curves.s.size // b.size} curves; at the end like R^-{low:.2f} to R^-{high:.2f}"
    )
    return Finding(measured, grows)
