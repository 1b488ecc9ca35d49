"""Figures 5 and 6: the radius of the punch face, by itself and with the frequency ratio."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.paper.statements.measures import at, coupling, even, largest_change, listed, with_dims
from swtstudy.paper.statements.statement import Measured
from swtstudy.vocabulary.wording import value_words


def monotone(figure5: xr.Dataset, profile: str, sense: int) -> Measured:
    """Changes of s with b against a sense, rising (1) or falling (-1), beyond its error at any phase."""
    curves = with_dims(at(figure5, profile=profile), "flat_radius", "phase").sortby("flat_radius")
    curves = curves.transpose("flat_radius", "phase")
    s, error = curves.s.values, curves.s_error.values
    against = sense * (s[:-1] - s[1:]) - error[1:] - error[:-1]
    means, wrong = even(curves, "phase").s.mean("phase"), against > 0
    others = f"likewise at each of {s.shape[1]} phases"
    if wrong.any():
        relative, b = against / s[:-1], curves.flat_radius.values
        step, column = np.unravel_index(relative.argmax(), against.shape)
        phase = np.degrees(curves.phase.values[column])
        others = (
            f"the opposite at {wrong.any(axis=0).sum()} of {s.shape[1]} phases, by up to "
            f"{relative.max():.1%} (b/a_H = {b[step]:g} to {b[step + 1]:g}, ψ = {phase:.1f}°)"
        )
    return not wrong.any(), {"means": listed(means / means[0].item()), "others": others}


def weakly_coupled(
    archive: xr.Dataset, dim: str, at_most: float, profile: str = "", regular: str = ""
) -> Measured:
    """Coupling of a shape parameter with the load, of one profile, at the regular steps of one axis."""
    chosen = at(archive, profile=profile) if profile else archive
    chosen = even(chosen, regular) if regular else chosen
    share = coupling(with_dims(chosen, dim).s, dim)
    return share <= at_most, {"share": share}


def all_curves_fall(figure6: xr.Dataset) -> Measured:
    """Largest rise of s from one b to the next."""
    rise = largest_change(with_dims(figure6, "flat_radius"), "flat_radius", 1)
    s = figure6.s.sortby("flat_radius")
    end, b = s.isel(flat_radius=-1) / s.isel(flat_radius=0), s.flat_radius[-1]
    words = f"rises by up to {rise:.1e} from one b to the next" if rise else "rises nowhere"
    return rise == 0, {"rises": words, "b": b, "low": end.min(), "high": end.max()}


def curves_are_alike(figure6: xr.Dataset, at_most: float) -> Measured:
    """Distances of the curves s/s(b = 0), at one phase and at all, over the height of the figure."""
    normalised = with_dims(figure6, "phase", "frequency_ratio").s / at(figure6, flat_radius=0).s
    height = normalised.max() - normalised.min()
    by_phase, whole = (
        (normalised.max(over) - normalised.min(over)).max("flat_radius") / height
        for over in (["frequency_ratio"], ["frequency_ratio", "phase"])
    )
    words = (f"ψ = {value_words('phase', each.phase.item())}: {each:.0%}" for each in by_phase)
    return whole <= at_most, {"distances": ", ".join(words), "share": whole}


def grows_without_bound(stability_thin_annulus: xr.Dataset) -> Measured:
    """Growth of SWT/E* = s δ0/R while R goes to 0."""
    curves = at(stability_thin_annulus, profile="rounded_punch")
    curves = with_dims(curves, "flat_radius").sortby("flat_radius")
    b = curves.flat_radius
    swt, error = curves.s * b**2, curves.s_error * b**2
    steps = swt.diff("flat_radius") - error.rolling(flat_radius=2).sum().isel(flat_radius=slice(1, None))
    grows = (steps > 0.0).all()
    last = np.log(swt.isel(flat_radius=[-2, -1])).diff("flat_radius") / np.log(b.values[-1] / b.values[-2])
    words = "at every step" if grows else f"at {(steps > 0.0).mean():.0%} of the steps"
    power = {"low": 0.5 * last.min(), "high": 0.5 * last.max()}
    return grows, {"steps": words, "fall": (b[0] / b[-1]) ** 2, "curves": curves.s.size // b.size, **power}
