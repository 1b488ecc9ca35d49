"""A real contact from what is known of it, with every mistake in that."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from swtstudy.grid.canonical import SHAPE_COLUMNS
from swtstudy.grid.reading import read_grid
from swtstudy.mechanics.profiles.wavy_paraboloid import smallest_compact_wavelength
from swtstudy.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.parameters import PROFILE_SHAPES, profiles_with
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
    lengths = {
        "radius": radius,
        "normal_amplitude": normal_amplitude,
        "tangential_amplitude": tangential_amplitude,
        "flat_radius": flat_radius,
        "waviness_amplitude": waviness_amplitude,
        "wavelength": wavelength,
    }
    known = isinstance(profile, str) and profile in PROFILE_SHAPES
    plain = {"friction": friction, "frequency_ratio": frequency_ratio, "phase": phase}
    grid, mistakes = read_grid(plain if known else {**plain, "profile": profile}, {})
    mistakes += _wrong_bodies(_pair(young_modulus), _pair(poisson_ratio), similar)
    mistakes += _wrong_load(depth, normal_force)
    mistakes += _wrong_lengths(lengths, profile if known else None)
    if grid is None or mistakes:
        raise StudyError(mistakes)
    if float(grid.fixed["friction"]) == 0.0 and tangential_amplitude:
        found = f"{literal(tangential_amplitude)} without friction"
        raise StudyError([Mistake("tangential_amplitude", found, "0, since the contact slides at once")])
    contact = PhysicalContact(
        Moduli(_pair(young_modulus), _pair(poisson_ratio)),
        float(radius),
        1.0 if depth is None else float(depth),
        float(grid.fixed["friction"]),
        float(normal_amplitude),
        float(tangential_amplitude),
        Fraction(grid.fixed["frequency_ratio"]),
        float(grid.fixed["phase"]),
        profile,
        {name: float(lengths[name]) for name in PROFILE_SHAPES[profile]},  # type: ignore[arg-type]
    )
    if normal_force is not None:
        contact = replace(contact, depth=_depth_at(contact, float(normal_force)))
    _, mistakes = read_grid(contact.parameters(), {})
    if mistakes:
        raise StudyError(_in_own_values(mistake, lengths) for mistake in mistakes)
    return contact


def _pair(value: Any) -> tuple[Any, Any]:
    return (value[0], value[1]) if isinstance(value, list | tuple) and len(value) == 2 else (value, value)


def _wrong_bodies(young: tuple[Any, Any], poisson: tuple[Any, Any], similar: object) -> list[Mistake]:
    mistakes = [
        Mistake("young_modulus", literal(value), "a positive number, or a pair of them")
        for value in young
        if not 0.0 < plain_number(value) < math.inf
    ]
    mistakes += [
        Mistake("poisson_ratio", literal(value), "a number in [0, 0.5], or a pair of them")
        for value in poisson
        if not 0.0 <= plain_number(value) <= 0.5
    ]
    if not 0.0 <= plain_number(similar) < math.inf:
        mistakes.append(Mistake("similar", literal(similar), "a number ≥ 0"))
    if not mistakes and abs(beta := Moduli(young, poisson).mismatch) > float(similar):  # type: ignore[arg-type]
        found = f"bodies that are not similar: Dundurs' β = {beta:.3f}"
        allowed = f"|β| ≤ {similar:g}, since (1 − 2ν1)/G1 = (1 − 2ν2)/G2 is assumed (eq. 1)"
        mistakes.append(Mistake("young_modulus, poisson_ratio", found, allowed))
    return list(dict.fromkeys(mistakes))  # one value stands for both bodies


def _wrong_load(depth: object, normal_force: object) -> list[Mistake]:
    load = {"depth": depth, "normal_force": normal_force}
    given = {name: value for name, value in load.items() if value is not None}
    if len(given) != 1:
        return [Mistake("depth, normal_force", "both" if given else "neither", "one of the two")]
    return [
        Mistake(name, literal(value), "a positive number")
        for name, value in given.items()
        if not 0.0 < plain_number(value) < math.inf
    ]


def _wrong_lengths(lengths: Mapping[str, object], profile: str | None) -> list[Mistake]:
    """Lengths that are none, or that the profile does not have; it is None if it is a mistake itself."""
    mistakes = []
    needed = PROFILE_SHAPES[profile] if profile else ()
    for name, value in lengths.items():
        if name in SHAPE_COLUMNS and name not in needed:
            if value is not None and profile:
                found = f"{literal(value)}, which the profile does not have ({profile})"
                allowed = f"only with the profile {' or '.join(profiles_with(name))}"
                mistakes.append(Mistake(name, found, allowed))
            continue
        zero = name in ("normal_amplitude", "tangential_amplitude", "flat_radius")
        number = plain_number(value)
        if not (0.0 < number < math.inf or (zero and number == 0.0)):
            allowed = "a length ≥ 0" if zero else "a positive length"
            if name in needed:
                allowed += " (this profile needs it)"
            mistakes.append(Mistake(name, "nothing" if value is None else literal(value), allowed))
    return mistakes


def _in_own_values(mistake: Mistake, lengths: Mapping[str, object]) -> Mistake:
    """A mistake in non-dimensional parameters with the lengths that they come from."""
    own = [literal(lengths[name]) for name in mistake.key.split(", ") if name in lengths]
    return replace(mistake, found=f"{', '.join(own)}, non-dimensional {mistake.found}") if own else mistake


def _depth_at(contact: PhysicalContact, force: float) -> float:
    """Indentation depth at a normal force, which rises with it."""
    from scipy.optimize import brentq

    if "wavelength" in contact.shape:
        h, wavelength = contact.shape["waviness_amplitude"], contact.shape["wavelength"]
        least = float(smallest_compact_wavelength(np.array(math.pi))) * math.sqrt(h * contact.radius)
        if wavelength < least:
            found = f"{wavelength!r} at waviness_amplitude {h!r}"
            allowed = (
                f"at least {least:.4g}: with shorter waves no contact is compact, however small its depth"
            )
            raise StudyError([Mistake("wavelength", found, allowed)])

    def excess(logarithm: float) -> float:
        return math.log(replace(contact, depth=math.exp(logarithm)).normal_force / force)

    # Hertz's depth, and from there outwards.
    low = high = (2.0 / 3.0) * math.log(0.75 * force / (contact.moduli.normal * math.sqrt(contact.radius)))
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    return math.exp(brentq(excess, low, high, xtol=1e-14)) if high > low else math.exp(low)
