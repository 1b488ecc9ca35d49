"""A real contact from what is known of it, with every mistake in that."""

from __future__ import annotations

import inspect
import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

import numpy as np

from swtstudy.contacts.contact import PhysicalContact
from swtstudy.contacts.given import (
    SIMILAR,
    in_own_values,
    pair,
    pair_of_numbers,
    with_unknown,
    wrong_bodies,
    wrong_lengths,
    wrong_load,
)
from swtstudy.grid.grid import Grid
from swtstudy.grid.reading import read_grid
from swtstudy.mechanics.indenter.wavy_paraboloid import smallest_compact_wavelength
from swtstudy.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.parameters import PARAMETERS, family_of, is_profile
from swtstudy.units.moduli import Moduli


def physical(
    *,
    young_modulus: float | tuple[float, float] | None = None,
    poisson_ratio: float | tuple[float, float] | None = None,
    radius: float | None = None,
    friction: float | None = None,
    tangential_amplitude: float | None = None,
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
    **unknown: object,
) -> PhysicalContact:
    """A real contact, in any consistent set of units: with N, mm and MPa, SWT comes in MPa.

    Parameters
    ----------
    young_modulus, poisson_ratio
        Of both bodies: one value for two equal bodies, or a pair. These, radius, friction and
        tangential_amplitude must be given.
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
    **unknown
        A mistake that names the keyword that was meant.

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
    young, poisson = pair(young_modulus), pair(poisson_ratio)
    known = is_profile(profile)
    pure = {"friction": friction, "frequency_ratio": frequency_ratio, "phase": phase}
    grid, mistakes = read_grid(pure if known else {**pure, "profile": profile}, {})
    mistakes += wrong_bodies(young, poisson, similar)
    mistakes += wrong_load(depth, normal_force)
    mistakes += wrong_lengths(lengths, profile if known else None)
    own = {"young_modulus": young_modulus, "poisson_ratio": poisson_ratio, "friction": friction}
    lacking = [name for name, value in {**own, **lengths}.items() if value is None]
    mistakes = with_unknown(unknown, list(inspect.signature(physical).parameters), lacking, mistakes)
    if grid is None or mistakes:
        raise StudyError(mistakes)
    if float(grid.fixed["friction"]) == 0.0 and tangential_amplitude:
        found = f"{literal(tangential_amplitude)} without friction"
        raise StudyError([Mistake("tangential_amplitude", found, "0, since the contact slides at once")])
    bodies = Moduli(pair_of_numbers(young), pair_of_numbers(poisson))
    contact = _contact(bodies, grid, profile, lengths, 1.0 if depth is None else plain_number(depth))
    if normal_force is not None:
        contact = replace(contact, depth=_depth_at(contact, plain_number(normal_force)))
    _, mistakes = read_grid(contact.parameters(), {})
    if mistakes:
        raise StudyError(in_own_values(mistake, lengths) for mistake in mistakes)
    return contact


def _contact(
    bodies: Moduli, grid: Grid, profile: str, lengths: Mapping[str, object], depth: float
) -> PhysicalContact:
    """The contact at a depth, from what has no mistakes."""
    return PhysicalContact(
        bodies,
        plain_number(lengths["radius"]),
        depth,
        float(grid.fixed["friction"]),
        plain_number(lengths["normal_amplitude"]),
        plain_number(lengths["tangential_amplitude"]),
        Fraction(grid.fixed["frequency_ratio"]),
        float(grid.fixed["phase"]),
        profile,
        {name: plain_number(lengths[name]) for name in family_of(profile).shape},
    )


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
        # In logarithms: a force out of the range of numbers is too large or too small like others.
        factor = replace(contact, depth=math.exp(logarithm)).force_factor
        scale = math.log(contact.moduli.normal) + 0.5 * math.log(contact.radius) + 1.5 * logarithm
        return math.log(factor) + scale - math.log(force)

    least = _least_depth(contact)
    if least > 0.0 and excess(math.log(least)) > 0.0:
        (name, length) = next(iter(contact.shape.items()))
        most = PARAMETERS[name].upper
        allowed = f"a length of at most {most:g} {'a_H' if name == 'flat_radius' else 'δ0'} at this force"
        raise StudyError([Mistake(name, f"{length!r} at normal_force {force!r}", allowed)])
    # Hertz's depth, and from there outwards.
    hertz = (2.0 / 3.0) * math.log(0.75 * force / (contact.moduli.normal * math.sqrt(contact.radius)))
    low = high = max(hertz, math.log(least)) if least > 0.0 else hertz
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    return math.exp(brentq(excess, low, high, xtol=1e-14)) if high > low else math.exp(low)


def _least_depth(contact: PhysicalContact) -> float:
    """The depth below which b/a_H or h/δ0 is out of its range."""
    b, h = (contact.shape.get(name, 0.0) for name in ("flat_radius", "waviness_amplitude"))
    face = (b / PARAMETERS["flat_radius"].upper) ** 2 / contact.radius
    return max(face, h / PARAMETERS["waviness_amplitude"].upper)
