"""Figure 6: punch face and frequency ratio."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.paper.statements.figure5 import NEGLIGIBLE, coupling_with
from swtstudy.paper.statements.measures import largest_rise
from swtstudy.paper.statements.select import at, with_dims
from swtstudy.paper.statements.statement import Finding, Statement
from swtstudy.vocabulary.wording import value_words

if TYPE_CHECKING:
    import xarray as xr

#: Largest distance of two curves that look like one in a figure, as a fraction of its height.
_LINE = 0.02


def all_curves_fall(figure6: xr.Dataset) -> Finding:
    """Check whether s falls with b for every load."""
    rise = largest_rise(with_dims(figure6, "flat_radius"), "flat_radius")
    ordered = figure6.s.sortby("flat_radius")
    end = ordered.isel(flat_radius=-1) / ordered.isel(flat_radius=0)
    words = f"rises by up to {rise:.1e} from one b to the next" if rise else "rises nowhere"
    measured = (
        f"s {words}; at b/a_H = {float(ordered.flat_radius[-1]):g} it is {float(end.min()):.2f} to "
        f"{float(end.max()):.2f} of s at 0"
    )
    return Finding(measured, rise == 0)


def curves_are_alike(figure6: xr.Dataset) -> Finding:
    """Largest distance of the curves once each is divided by its value at b = 0."""
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


def loads_do_not_couple(figure6: xr.Dataset) -> Finding:
    """Coupling of b with phase and frequency ratio."""
    return coupling_with(figure6, "flat_radius", NEGLIGIBLE)


STATEMENTS = (
    Statement(
        "Figure 6",
        "Rounded punch: s falls with b/a_H for every frequency ratio and phase.",
        "no step of b/a_H raises s beyond its error",
        ("figure6",),
        all_curves_fall,
    ),
    Statement(
        "Figure 6",
        "All curves fall in exactly the same way: no coupling of load and profile can be seen.",
        "the curves s/s(b = 0) are nowhere further apart than 2% of the figure's height",
        ("figure6",),
        curves_are_alike,
    ),
    Statement(
        "Figure 6",
        "Rounded punch: the coupling of b/a_H with the load is negligible.",
        "at most 1% of the variance of ln s is left over by a product f(b)·g(ψ, ω2/ω1)",
        ("figure6",),
        loads_do_not_couple,
    ),
)
