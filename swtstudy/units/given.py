"""What is wrong with what is known of a real contact."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import Any

from swtstudy.families import families_with, family_of
from swtstudy.mistakes import Mistake, literal, meant, nearest, plain_number
from swtstudy.parameter import spelled
from swtstudy.parameters import PARAMETERS, SYMBOLS
from swtstudy.units.moduli import Moduli
from swtstudy.units.rows import MEAN_LOADS, wrong_mean_load
from swtstudy.units.scales import SCALES, may_vanish
from swtstudy.units.sizes import LARGEST, wrong_size

#: Dundurs' |β| up to which the bodies count as similar.
SIMILAR = 0.05

#: Name and letter by what may be typed for it.
_SYMBOLS = SYMBOLS | {
    spelled(letter): (name, letter)
    for name, letter in (("young_modulus", "E"), ("radius", "R"), ("depth", "δ0"), ("depth", "δ"))
}


def pair(value: Any) -> tuple[Any, Any]:
    """One value for each body."""
    several = (isinstance(value, list | tuple) and len(value) == 2) or getattr(value, "shape", None) == (2,)
    one, two = value if several else (value, value)
    return one, two


def pair_of_numbers(values: tuple[object, object]) -> tuple[float, float]:
    """The values as floats."""
    return plain_number(values[0]), plain_number(values[1])


def with_unknown(
    unknown: Iterable[str], known: Iterable[str], lacking: Collection[str], mistakes: Iterable[Mistake]
) -> list[Mistake]:
    """The unknown keywords, and the other mistakes; what is lacking since it is misspelt counts once."""
    known = list(known)
    found = [
        Mistake(name, f"unknown parameter {literal(name)}", nearest(name, known, _SYMBOLS))
        for name in unknown
    ]
    intended = {meant(name, known, _SYMBOLS) for name in unknown}
    for mistake in mistakes:
        if mistake.key not in lacking:
            found.append(mistake)
        elif mistake.key not in intended:
            found.append(replace(mistake, found="nothing"))
    return found


def wrong_bodies(young: tuple[Any, Any], poisson: tuple[Any, Any], similar: object) -> list[Mistake]:
    """Elastic constants that are none, and bodies that are not similar."""
    mistakes: list[Mistake] = []
    for value in young:
        mistakes += wrong_size("young_modulus", value, "a positive number, or a pair of them")
    mistakes += [
        Mistake("poisson_ratio", literal(value), "a number in [0, 0.5], or a pair of them")
        for value in poisson
        if not 0.0 <= plain_number(value) <= 0.5
    ]
    if not 0.0 <= plain_number(similar) < math.inf:
        mistakes.append(Mistake("similar", literal(similar), "a number ≥ 0"))
    beta = 0.0 if mistakes else Moduli(pair_of_numbers(young), pair_of_numbers(poisson)).mismatch
    if abs(beta) > plain_number(similar):
        found = f"bodies that are not similar: Dundurs' β = {beta:.3f}"
        allowed = f"|β| ≤ {plain_number(similar):g}, since (1 − 2ν1)/G1 = (1 − 2ν2)/G2 is assumed (eq. 1)"
        mistakes.append(Mistake("young_modulus, poisson_ratio", found, allowed))
    return list(dict.fromkeys(mistakes))  # one value stands for both bodies


def wrong_load(depth: object, normal_force: object) -> list[Mistake]:
    """A load that is not given once."""
    load = dict(zip(MEAN_LOADS, (depth, normal_force), strict=True))
    given = {name: value for name, value in load.items() if value is not None}
    if wrong := wrong_mean_load(given):
        return [Mistake(", ".join(MEAN_LOADS), *wrong)]
    ((name, value),) = given.items()
    return wrong_size(name, value, "a positive number")


def wrong_sizes(sizes: Mapping[str, object], profile: str | None) -> list[Mistake]:
    """Sizes that are none, or shapes that the profile does not have; None stands for a wrong profile."""
    mistakes: list[Mistake] = []
    needed = family_of(profile).shape if profile else ()
    for name, value in sizes.items():
        row = PARAMETERS.get(name)  # R is no parameter
        if row is not None and row.part == "shape" and name not in needed:
            if value is not None and profile:
                found = f"{literal(value)}, which the profile does not have ({profile})"
                allowed = f"only with the profile {' or '.join(families_with(name))}"
                mistakes.append(Mistake(name, found, allowed))
            continue
        zero = row is not None and may_vanish(row)
        kind = "length" if row is None else SCALES[row.scale].kind if row.scale else "number"
        allowed = f"a {kind} ≥ 0" if zero else f"a positive {kind}"
        allowed += " (this profile needs it)" * (name in needed)
        either = row is not None and row.lower < 0.0
        if either and plain_number(value) < 0.0:
            mistakes += wrong_size(name, value, f"a {kind}", sign=-1.0)
        else:
            mistakes += wrong_size(name, value, f"a {kind}" if either else allowed, zero=zero)
    return mistakes


def wrong_bulk(ratio: object, parameters: Mapping[str, object], body: object) -> list[Mistake]:
    """A stress ratio of a bulk stress that is none, or given beside the mean, and no body that carries it."""
    mistakes = []
    if ratio is not None:
        if "bulk_stress_mean" in parameters:
            found = "both"
            mistakes.append(Mistake("bulk_stress_mean, bulk_stress_ratio", found, "one of the two"))
        if not -LARGEST < plain_number(ratio) < 1.0:
            allowed = "a number below 1: the least over the largest stress"
            mistakes.append(Mistake("bulk_stress_ratio", literal(ratio), allowed))
    return mistakes + wrong_carrier(body)


def wrong_carrier(body: object) -> list[Mistake]:
    """No body that carries a bulk stress."""
    if plain_number(body) in (0.0, 1.0):
        return []
    return [Mistake("bulk_stress_body", literal(body), "0 or 1, the body that carries it")]


def in_own_values(mistake: Mistake, lengths: Mapping[str, object]) -> Mistake:
    """A mistake in non-dimensional parameters with the lengths that they come from."""
    own = [literal(lengths[name]) for name in mistake.key.split(", ") if name in lengths]
    return replace(mistake, found=f"{', '.join(own)}, non-dimensional {mistake.found}") if own else mistake
