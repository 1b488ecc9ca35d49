"""One value of one parameter: read from what a user wrote, checked against the table of parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from numbers import Rational
from typing import Any

from swtstudy.points.expression import evaluate
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import is_number, plain, plain_number
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS

#: A checked value: a float, an exact frequency ratio, a built-in name, or what the user has defined.
Value = float | Fraction | str | Definition

#: Units of an angle that is not in rad.
DEGREES = ("degrees", "deg", "°")

#: No definitions.
NOTHING: Mapping[str, Definition] = {}

#: Names of the parameters that are numbers: those that can have any value between two others.
NUMERIC = tuple(name for name, parameter in PARAMETERS.items() if parameter.kind == "number")

#: How far, relatively, a float may be from the small fraction that it stands for.
_FRACTION_TOLERANCE = 1e-9


def values_taken(name: str, good: Mapping[str, Sequence[Any]]) -> Sequence[Any]:
    """The values that a parameter has in a study: those that are given, or its default."""
    return good.get(name, (PARAMETERS[name].default,))


def read_value(parameter: Parameter, raw: object, known: Mapping[str, Definition] = NOTHING) -> Value:
    """The value of a parameter, from a number, a string such as "pi/2" or "3/2", or a name.

    Parameters
    ----------
    parameter
        Row of the table of parameters.
    raw
        What the user wrote.
    known
        What the user has defined, by name.

    Returns
    -------
    float, Fraction, str or Definition
        A Fraction for a frequency ratio, a built-in name or what was defined, a float otherwise.

    Raises
    ------
    ValueError
        With the reason only, if the value is not allowed; `Parameter.allowed` says what is.
    """
    raw = plain(raw)
    if parameter.kind == "name":
        return _read_name(parameter.name, raw, known)
    exact = read_angle(raw) if parameter.units == "rad" else read_exact(raw)
    if parameter.kind == "ratio":
        return _read_ratio(exact, int(parameter.upper))
    number = float(exact)
    below = number <= parameter.lower if parameter.open_lower else number < parameter.lower
    if below or number > parameter.upper:
        raise ValueError("out of range")
    return number + 0.0  # -0.0 and 0.0 are one value


def as_number(value: Value) -> float:
    """The value of a parameter that is a number."""
    if isinstance(value, Definition):
        raise TypeError(f"{value!r} is no number")
    return float(value)


def _read_name(parameter: str, raw: object, known: Mapping[str, Definition]) -> str | Definition:
    if isinstance(raw, Definition) and raw.parameter == parameter:
        return raw
    if isinstance(raw, str) and raw in PARAMETERS[parameter].names:
        return raw
    if isinstance(raw, str) and raw in known:
        return known[raw]
    raise ValueError(f"no such {parameter}" if isinstance(raw, str) else "not a name")


def read_exact(raw: object) -> Fraction | float:
    """A finite number, exact where it is rational, from a number or an expression.

    Raises
    ------
    ValueError
        With the reason only.
    """
    if isinstance(raw, str):
        return evaluate(raw)
    if not is_number(raw):
        raise ValueError("not a number")
    number = plain_number(raw)
    if not math.isfinite(number):
        raise ValueError("not a finite number")
    return Fraction(int(raw.numerator), int(raw.denominator)) if isinstance(raw, Rational) else number


def read_angle(raw: object) -> Fraction | float:
    """A finite angle in rad, from a number, an expression, or one with its unit: "90 deg", "90°", "1.5 rad".

    Raises
    ------
    ValueError
        With the reason only.

    Examples
    --------
    >>> read_angle("90 deg") == read_angle("pi/2")
    True
    """
    if not isinstance(raw, str):
        return read_exact(raw)
    words = raw.strip()
    for unit in DEGREES:
        if words.endswith(unit):
            return float(evaluate(words.removesuffix(unit)) / 180) * math.pi
    return evaluate(words.removesuffix("rad"))


def _read_ratio(exact: Fraction | float, largest: int) -> Fraction:
    if exact <= 0:
        raise ValueError("not positive")
    # limit_denominator bounds the denominator alone: a large numerator is refused below.
    ratio = Fraction(exact).limit_denominator(largest)
    if abs(ratio - Fraction(exact)) > _FRACTION_TOLERANCE * exact:
        kind = "no small fraction" if isinstance(exact, Fraction) else "irrational, or no small fraction"
        raise ValueError(f"{kind}: the common period of the two oscillations would be too long")
    if max(ratio.numerator, ratio.denominator) > largest:
        raise ValueError("numerator or denominator too large: the common period would be too long")
    return ratio
