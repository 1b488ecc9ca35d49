"""A real contact from what is known of it, with every mistake in that."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from swtstudy.families import family_of, is_plane, is_profile
from swtstudy.grid.reading import given_twice, read_grid
from swtstudy.grid.values import read_value
from swtstudy.mechanics.indenter import TabulatedProfile, length_law, make_profile, too_small
from swtstudy.mechanics.indenter.plane import MEAN_LOAD
from swtstudy.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.named import Named
from swtstudy.parameters import LOOP_AMPLITUDE, PARAMETERS
from swtstudy.prescribed import PAIRS, replaced_by
from swtstudy.units.bulk import ends_of_bulk, mean_of_bulk
from swtstudy.units.contact import Contact
from swtstudy.units.given import (
    in_own_values,
    pair,
    pair_of_numbers,
    with_unknown,
    wrong_bodies,
    wrong_bulk,
    wrong_load,
    wrong_sizes,
)
from swtstudy.units.moduli import Moduli
from swtstudy.units.scales import least_depths, length_of
from swtstudy.units.strips import LENGTH, check_lengths, still_load

#: A kind of contact.
C = TypeVar("C", bound=Contact)

#: Parameters of a contact with what they are unless given, None for those that must be: a real contact has
#: no usual friction and tangential amplitude. The Poisson ratio is that of the bodies.
_DEFAULTS: dict[str, Any] = {
    **{name: row.default for name, row in PARAMETERS.items() if name not in ("poisson_ratio", *PAIRS)},
    **{"friction": None, "tangential_amplitude": None, "normal_amplitude": 0.0},
}
#: Those that are no lengths, whatever the profile.
_PURE = [name for name in _DEFAULTS if not PARAMETERS[name].scale and PARAMETERS[name].part != "shape"]


def contact_from(
    kind: type[C],
    parameters: Mapping[str, Any],
    *,
    young_modulus: object,
    poisson_ratio: object,
    radius: object,
    depth: object,
    normal_force: object,
    similar: object,
    bulk_stress_ratio: object,
    bulk_stress_body: object,
    contact_length: object = None,
) -> C:
    """A contact of a kind, from what `swtstudy.physical` takes.

    Raises
    ------
    StudyError
        A ValueError with every mistake.
    """
    own = {"young_modulus": young_modulus, "poisson_ratio": poisson_ratio}
    if radius is not None or not isinstance(parameters.get("profile"), TabulatedProfile):
        own["radius"] = radius
    given: dict[str, Any] = {
        **own,
        **_defaults_beside(parameters),
        **{name: value for name, value in parameters.items() if name in (*_DEFAULTS, *PAIRS)},
        **{"depth": depth, "normal_force": normal_force, "similar": similar},
    }
    if contact_length is not None:
        given[LENGTH] = contact_length
    needed = [*own, *(name for name, default in _DEFAULTS.items() if default is None and name in given)]
    needed += [name for name in PAIRS if name in given and given[name] is None]
    lacking = [name for name in needed if given[name] is None]
    unknown = [name for name in parameters if name not in given]
    mistakes = [*_mistakes(given), *wrong_bulk(bulk_stress_ratio, parameters, bulk_stress_body)]
    mistakes = with_unknown(unknown, [*given, *PAIRS], lacking, mistakes)
    if mistakes:
        raise StudyError(mistakes)
    if bulk_stress_ratio is not None:
        ratio, amplitude = plain_number(bulk_stress_ratio), plain_number(given["bulk_stress_amplitude"])
        given["bulk_stress_mean"] = mean_of_bulk(ratio, amplitude, *ends_of_bulk(given["load"]))
    contact = replace(_contact(kind, given), bulk_stress_body=int(plain_number(bulk_stress_body)))
    if normal_force is not None:
        contact = replace(contact, depth=depth_at(contact, plain_number(normal_force)))
    if isinstance(contact.profile, TabulatedProfile):
        refuse_beyond(contact.profile, contact.depth + (contact.normal_amplitude or 0.0))
    _, mistakes = read_grid(contact.parameters(), {})
    if mistakes:
        raise StudyError(in_own_values(mistake, _sizes(given)) for mistake in mistakes)
    return contact


def _defaults_beside(parameters: Mapping[str, object]) -> dict[str, Any]:
    """The defaults of what has nothing given in its place."""
    replaced, load = replaced_by(parameters), parameters.get("load")
    if is_plane(parameters.get("profile")):
        still = still_load([parameters["profile"]], parameters)
        forces = (
            {}
            if replaced_by(["tangential_force_amplitude"]) & {*parameters, *replaced}
            else {"tangential_force_amplitude": None}
        )
        return _defaults_beside({**parameters, **still, **forces, "profile": None}) | still | forces
    defaults = {name: default for name, default in _DEFAULTS.items() if name not in replaced}
    if isinstance(load, Named) and "bulk_stress_amplitude" in load.scaled_by:
        defaults["bulk_stress_amplitude"] = LOOP_AMPLITUDE
    return defaults


def _sizes(given: Mapping[str, Any]) -> dict[str, Any]:
    """The lengths and forces, and the shape of any profile."""
    names = [name for name in given if name in (*_DEFAULTS, *PAIRS) and name not in (*_PURE, "profile")]
    return {name: given[name] for name in ("radius", LENGTH, *names) if name in given}


def _mistakes(given: Mapping[str, Any]) -> list[Mistake]:
    """What is wrong with each of the keywords."""
    is_table = isinstance(given["profile"], TabulatedProfile)
    profile = given["profile"] if is_table or is_profile(given["profile"]) else None
    pure = {name: given[name] for name in _PURE}
    _, mistakes = read_grid(pure if profile else {**pure, "profile": given["profile"]}, {})
    young, poisson = pair(given["young_modulus"]), pair(given["poisson_ratio"])
    mistakes += wrong_bodies(young, poisson, given["similar"])
    mistakes += wrong_load(given["depth"], given["normal_force"])
    mistakes += wrong_sizes(_sizes(given), None if profile is None else str(profile))
    named = {name for name in ("depth", LENGTH) if given.get(name) is not None}
    check_lengths([profile], named, str, lambda *found: mistakes.append(Mistake(*found)))
    if is_table and "radius" in given:
        found, allowed = literal(given["radius"]), "nothing: the table of the profile has lengths"
        mistakes.append(Mistake("radius", found, allowed))
    mistakes += [Mistake(*parts) for parts in given_twice(given)]
    moves = [name for name in ("tangential_amplitude", "tangential_force_amplitude") if given.get(name)]
    if not mistakes and plain_number(given["friction"]) == 0.0 and moves:
        found, allowed = f"{literal(given[moves[0]])} without friction", "0, since the contact slides at once"
        mistakes.append(Mistake(moves[0], found, allowed))
    return mistakes


def _contact(kind: type[C], given: Mapping[str, Any]) -> C:
    """The contact from what has no mistakes, at the depth 1 if that is not given."""
    values: dict[str, Any] = dict.fromkeys((*PAIRS.values(), "radius"))
    values |= {name: plain_number(value) for name, value in _sizes(given).items()}
    values |= {name: read_value(PARAMETERS[name], given[name]) for name in _PURE}
    young, poisson = (pair_of_numbers(pair(given[name])) for name in ("young_modulus", "poisson_ratio"))
    return kind(
        Moduli(young, poisson),
        depth=1.0 if given["depth"] is None else plain_number(given["depth"]),
        profile=given["profile"],
        shape={name: values[name] for name in family_of(given["profile"]).shape},
        **{n: value for n, value in values.items() if n not in PARAMETERS or PARAMETERS[n].part != "shape"},
    )


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
