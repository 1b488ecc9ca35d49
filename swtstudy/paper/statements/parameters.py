"""Section 4.1: friction, amplitude of the tangential oscillation, Poisson ratio."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swtstudy.paper.statements.measures import largest_fall
from swtstudy.paper.statements.select import listed, with_dims
from swtstudy.paper.statements.statement import Finding, Statement

if TYPE_CHECKING:
    import xarray as xr

#: Poisson ratios of most metals.
_METALS = slice(0.25, 0.35)


def rises_with_friction(friction: xr.Dataset) -> Finding:
    """Largest fall of s over μ."""
    return _rises(friction, "friction", "μ")


def rises_with_tangential_amplitude(tangential: xr.Dataset) -> Finding:
    """Largest fall of s over G*uA/(μE*δ0)."""
    return _rises(tangential, "tangential_amplitude", "G*uA/(μE*δ0)")


def _rises(archive: xr.Dataset, dim: str, symbol: str) -> Finding:
    fall = largest_fall(with_dims(archive, dim), dim)
    low, high = float(archive[dim].min()), float(archive[dim].max())
    curves = archive.s.size // archive.sizes[dim]
    words = f"falls by up to {fall:.1e} from one value to the next" if fall else "falls nowhere"
    return Finding(f"s {words}, {symbol} from {low:g} to {high:g} on {curves} curves", fall == 0)


def poisson_ratio_is_weak(poisson: xr.Dataset) -> Finding:
    """Relative change of s over ν, for every friction coefficient."""
    s = with_dims(poisson, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    metals = s.sel(poisson_ratio=_METALS)
    change = (metals.max("poisson_ratio") - metals.min("poisson_ratio")) / metals.mean("poisson_ratio")
    whole = s.isel(poisson_ratio=-1) / s.isel(poisson_ratio=0)
    measured = (
        f"change over ν = 0.25…0.35, μ = {listed(change, '.0%')}; s(ν = {float(s.poisson_ratio[-1]):g})/"
        f"s({float(s.poisson_ratio[0]):g}), μ = {listed(whole)}"
    )
    return Finding(measured, bool((change <= 0.05).all()))


def poisson_ratio_is_intricate(poisson: xr.Dataset) -> Finding:
    """Measure whether s(ν) is anything but monotone in one sense at every friction coefficient."""
    s = with_dims(poisson, "poisson_ratio", "friction").s.sortby("poisson_ratio")
    rising = (s.diff("poisson_ratio") > 0).mean("poisson_ratio")
    return Finding(
        f"share of the steps of ν over which s rises, μ = {listed(rising)}",
        bool(((rising > 0) & (rising < 1)).any() or np.ptp(rising.values) > 0),
    )


STATEMENTS = (
    Statement(
        "Section 4.1",
        "s rises with the coefficient of friction.",
        "s never falls beyond its error, on any curve",
        ("friction",),
        rises_with_friction,
    ),
    Statement(
        "Section 4.1",
        "s rises with the amplitude of the tangential oscillation.",
        "s never falls beyond its error, on any curve",
        ("tangential_amplitude",),
        rises_with_tangential_amplitude,
    ),
    Statement(
        "Section 4.1",
        "The dependence on the Poisson ratio is very weak.",
        "s changes by at most 5% over ν = 0.25…0.35, for every μ",
        ("poisson_ratio",),
        poisson_ratio_is_weak,
    ),
    Statement(
        "Section 4.1",
        "The dependence on the Poisson ratio is intricate.",
        "s(ν) is not simply monotone in the same sense for every μ",
        ("poisson_ratio",),
        poisson_ratio_is_intricate,
    ),
)
