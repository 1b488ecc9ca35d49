"""A real contact from what is known of it, with every mistake in that."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from swtstudy.grid.reading import read_grid
from swtstudy.mistakes import Mistake, StudyError, literal
from swtstudy.parameters import PROFILE_SHAPES
from swtstudy.units.contact import PhysicalContact
from swtstudy.units.moduli import Moduli

#: Dundurs' |β| up to which the bodies count as similar.
SIMILAR = 0.05


def physical(
    *,
    young_modulus: float | tuple[float, float],
    poisson_ratio: float | tuple[float, float],
    radius: float,
    friction: float,
    tangential_amplitude: float,
    depth: float | None = None,
    normal_force: float | None = None,
    normal_amplitude: float = 0.0,
    frequency_ratio: object = 1,
    phase: object = 0.0,
    profile: str = "paraboloid",
    flat_radius: float | None = None,
    waviness_amplitude: float | None = None,
    wavelength: float | None = None,
    similar: float = SIMILAR,
) -> PhysicalContact:
    """A real contact, in any consistent set of units: with N, mm and MPa, SWT comes in MPa.

    Parameters
    ----------
    young_modulus, poisson_ratio
        Of both bodies: one value for two equal bodies, or a pair.
    radius
        R of the relative curvature, 1/R = 1/R1 + 1/R2.
    friction
        μ.
    tangential_amplitude
        uA, amplitude of the relative tangential displacement of the bodies far from the contact.
    depth, normal_force
        One of them: the mean indentation depth δ0, or the normal force at that depth.
    normal_amplitude
        δA, amplitude of the indentation depth.
    frequency_ratio, phase, profile
        As for `swtstudy.solve`.
    flat_radius, waviness_amplitude, wavelength
        b, h, λ: lengths of profiles that have them.
    similar
        Largest magnitude of Dundurs' β at which the bodies count as similar (eq. 1).

    Returns
    -------
    PhysicalContact

    Raises
    ------
    StudyError
        A ValueError with every mistake; also if the bodies are not similar.

    Examples
    --------
    >>> import swtstudy
    >>> contact = swtstudy.physical(
    ...     young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, normal_force=200.0,
    ...     friction=0.5, tangential_amplitude=0.002,
    ... )
    >>> round(contact.peak_pressure), round(contact.contact_radius, 3)
    (296, 0.568)
    """
    moduli = Moduli(_pair(young_modulus), _pair(poisson_ratio))
    shape = {"flat_radius": flat_radius, "waviness_amplitude": waviness_amplitude, "wavelength": wavelength}
    mistakes = _mistakes(moduli, similar, {"radius": radius, "depth": depth, "normal_force": normal_force})
    names = PROFILE_SHAPES.get(profile, ())
    for name in names:
        if shape[name] is None:
            mistakes.append(Mistake(name, "nothing", f"a length ({profile} needs it)"))
    if mistakes:
        raise StudyError(mistakes)
    lengths = {name: float(shape[name]) for name in names}  # type: ignore[arg-type]
    contact = PhysicalContact(
        moduli,
        float(radius),
        1.0 if depth is None else float(depth),
        friction,
        normal_amplitude,
        tangential_amplitude,
        frequency_ratio,  # type: ignore[arg-type]
        phase,  # type: ignore[arg-type]
        profile,
        lengths,
    )
    if normal_force is not None and profile in PROFILE_SHAPES:
        contact = replace(contact, depth=_depth_at(contact, float(normal_force)))
    grid, mistakes = read_grid(contact.parameters(), {})
    if grid is None:
        raise StudyError(mistakes)
    ratio, angle = Fraction(grid.fixed["frequency_ratio"]), float(grid.fixed["phase"])
    return replace(contact, frequency_ratio=ratio, phase=angle)


def _pair(value: Any) -> tuple[float, float]:
    return (value[0], value[1]) if isinstance(value, list | tuple) and len(value) == 2 else (value, value)


def _mistakes(moduli: Moduli, similar: float, lengths: dict[str, float | None]) -> list[Mistake]:
    def number(value: object) -> bool:
        return (
            isinstance(value, int | float | np.number)
            and not isinstance(value, bool)
            and math.isfinite(value)
        )

    mistakes = [
        Mistake(name, literal(value), "a positive number")
        for name, value in [("young_modulus", e) for e in moduli.young] + list(lengths.items())
        if value is not None and not (number(value) and value > 0)
    ]
    for nu in moduli.poisson:
        if not (number(nu) and 0.0 <= nu <= 0.5):
            mistakes.append(Mistake("poisson_ratio", literal(nu), "a number in [0, 0.5]"))
    if (lengths["depth"] is None) == (lengths["normal_force"] is None):
        found = "neither" if lengths["depth"] is None else "both"
        mistakes.append(Mistake("depth, normal_force", found, "one of the two"))
    if not mistakes and abs(moduli.mismatch) > similar:
        found = f"bodies that are not similar: Dundurs' β = {moduli.mismatch:.3f}"
        allowed = f"|β| ≤ {similar:g}, since (1 − 2ν1)/G1 = (1 − 2ν2)/G2 is assumed (eq. 1)"
        mistakes.append(Mistake("young_modulus, poisson_ratio", found, allowed))
    return mistakes


def _depth_at(contact: PhysicalContact, force: float) -> float:
    """Indentation depth at a normal force, which rises with it."""
    from scipy.optimize import brentq

    def excess(logarithm: float) -> float:
        return math.log(replace(contact, depth=math.exp(logarithm)).normal_force / force)

    # Hertz's depth, and from there outwards.
    low = high = (2.0 / 3.0) * math.log(0.75 * force / (contact.moduli.normal * math.sqrt(contact.radius)))
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    return math.exp(brentq(excess, low, high, xtol=1e-14)) if high > low else math.exp(low)
