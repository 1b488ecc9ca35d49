"""The indentation depth at a normal force."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from swtstudy.mechanics.indenter import TabulatedProfile, length_law, make_profile, too_small
from swtstudy.mechanics.indenter.plane import MEAN_LOAD
from swtstudy.units.at_rest import Contact
from swtstudy.units.scales import least_depths, length_of
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.parameters import PARAMETERS


def depth_at(contact: Contact, force: float) -> float:
    """Indentation depth at a normal force, which rises with it."""
    from scipy.optimize import brentq

    if contact.plane:
        return force / (contact.contact_length or 1.0) / (MEAN_LOAD * contact.moduli.normal)
    if isinstance(contact.profile, TabulatedProfile):
        profile = make_profile(contact.profile, {}, np.ones(1))
        half = np.array([[0.5 * force / contact.moduli.normal]])
        return float(profile.depth(profile.radius_of_half_load(half))[0, 0])
    _refuse_at_any_depth(contact)
    assert contact.radius is not None
    (coefficient, power), log_radius = length_law(contact.profile, contact.shape), math.log(contact.radius)

    def excess(logarithm: float) -> float:
        # In logarithms: a force out of the range of numbers is too large or too small like others.
        factor = replace(contact, depth=math.exp(logarithm)).force_factor
        length = log_radius + power * (logarithm - math.log(coefficient) - log_radius)
        return math.log(factor) + math.log(contact.moduli.normal) + logarithm + length - math.log(force)

    name, least = max(least_depths(contact).items(), key=lambda item: item[1], default=("", 0.0))
    if least > 0.0 and excess(math.log(least)) > 0.0:
        row = PARAMETERS[name]
        allowed = f"a length of at most {row.upper:g} {row.scale} at this force"
        raise StudyError([Mistake(name, f"{contact.shape[name]!r} at normal_force {force!r}", allowed)])
    # Hertz's depth, and from there outwards.
    hertz = (2.0 / 3.0) * math.log(0.75 * force / (contact.moduli.normal * math.sqrt(contact.radius)))
    low = high = max(hertz, math.log(least)) if least > 0.0 else hertz
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    return math.exp(brentq(excess, low, high, xtol=1e-14)) if high > low else math.exp(low)


def refuse_beyond(table: TabulatedProfile, depth: float) -> None:
    """Raise if the contact of a table in lengths is no full disc up to a depth, or larger than the table."""
    wrong = table.refused_at(depth)
    if wrong is not None:
        raise StudyError([Mistake("profile", str(table), wrong)])


def _refuse_at_any_depth(contact: Contact) -> None:
    """Raise if the contact is not compact however small its depth."""
    limit = too_small(contact.profile, contact.shape_parameters, 0.0)
    if limit is None:
        return
    name, number = limit
    others = ", ".join(f"{other} {value!r}" for other, value in contact.shape.items() if other != name)
    found = f"{contact.shape[name]!r}{' at ' * bool(others)}{others}"
    least = f"at least {length_of(name, number, contact):.4g}"
    raise StudyError([Mistake(name, found, f"{least}: with less no contact is compact, at whatever depth")])
