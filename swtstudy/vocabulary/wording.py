"""Names and values as they appear in figures and messages."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from numbers import Real
from typing import Any

from swtstudy.vocabulary.choices import CRITERIA, MOVED
from swtstudy.vocabulary.parameters import AXES, SHIFT

#: A float is shown as a fraction or a root if it is relatively this close to it: rounding, no other number.
_TOLERANCE = 1e-9
#: Fractions with larger denominators are harder to read than decimals.
_LARGEST_DENOMINATOR = 20
#: A decimal of so many digits at most is read more easily than a fraction that is equal to it.
_EXACT = 6

#: Numbers below this power of ten are written out; beside powers of ten, numbers between these two.
_PLAIN, _PLAIN_BESIDE = 6, (1e-2, 1e3)
_SUPERSCRIPTS = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
_RAISED = str.maketrans("-0123456789", _SUPERSCRIPTS)
#: A number with a power of ten: what its lead is without noughts behind the point.
_WITH_POWER = re.compile(r"(-?\d+(\.\d*[1-9])?)(?:\.?0*)e([+-]\d+)")

#: Attributes of a coordinate, which say the unit of results that have one.
_NONE: Mapping[Any, Any] = {}


def parameter_words(name: str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """Symbol of a parameter, or of its coordinate with these attributes, as matplotlib's math text.

    Examples
    --------
    >>> parameter_words("friction")
    '$\\\\mu$'
    """
    return f"${attributes.get('symbol', AXES[name].symbol)}$"


def axis_words(name: str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """Symbol of a parameter, or of its coordinate, with its unit, if it has one.

    Examples
    --------
    >>> axis_words("phase"), axis_words("friction")
    ('$\\\\psi$ (rad)', '$\\\\mu$')
    """
    row = AXES[name]
    units = attributes.get("units", row.units)
    words = f"{row.meaning}, " if row.part == "criterion" and row.kind == "number" else ""
    return words + parameter_words(name, attributes) + ("" if units in ("1", "") else f" ({as_text(units)})")


def as_text(words: str) -> str:
    """Words of a user's own in a figure, in which a dollar begins no formula.

    Examples
    --------
    >>> print(as_text("US$"))
    US\\$
    """
    return words.replace("$", r"\$")


def value_words(name: str, value: float | str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """A value as people write it: 0.25, 8/9, √20, π/2; a name as it is typed; decimals before a unit.

    Examples
    --------
    >>> value_words("normal_amplitude", 8 / 9), value_words("phase", 3.141592653589793)
    ('8/9', 'π')
    >>> value_words("wavelength", 20**0.5), value_words("profile", "rounded_punch")
    ('√20', 'rounded_punch')
    >>> value_words("young_modulus", 73.1e3), value_words("friction", 5e-7)
    ('73100', '5·10⁻⁷')
    >>> value_words("normal_force", 143.75), value_words("phase", 1.23456789)
    ('143.75', '1.235')
    >>> value_words("normal_force", 2600 / 9), value_words("normal_amplitude", 8 / 9, {"units": "mm"})
    ('288.9', '0.8889')
    >>> value_words("sample", 3), value_words("friction", 0.1 + 0.2)
    ('3', '0.3')
    """
    if not isinstance(value, Real):  # a text, or the date of a point
        return re.sub(r"[T ]00:00:00[.0]*$", "", str(value))
    row = AXES.get(name)  # none of the points of a sample, nor of what xarray may have joined along
    if row is not None and row.kind == "ratio":
        return str(_fraction(value, 64) or f"{value:.4g}")
    if row is not None and row.units == "rad" and value:
        multiple = _fraction(value / math.pi, _LARGEST_DENOMINATOR)
        if multiple is not None:
            return pi_words(multiple)
    if math.isclose(float(f"{value:.{_EXACT}g}"), value, rel_tol=_TOLERANCE):
        return number_words(value, _EXACT)
    # Lengths, forces and stresses have a unit, which is empty where nobody has named it.
    if attributes.get("units", "1") not in ("1", "rad") or (row is not None and row.part == "contact"):
        return number_words(value)
    if (fraction := _fraction(value, _LARGEST_DENOMINATOR)) is not None:
        return str(fraction)
    square = round(value**2)
    if value > 0 and 0 < square < 1000 and math.isclose(value**2, square, rel_tol=_TOLERANCE):
        return f"√{square}"
    return number_words(value)


def number_words(value: float, digits: int = 4) -> str:
    """A number to so many digits, a very large or small one with a power of ten.

    Examples
    --------
    >>> number_words(0.123456), number_words(73.1e3), number_words(5e7), number_words(1.25e-7)
    ('0.1235', '73100', '5·10⁷', '1.25·10⁻⁷')
    """
    text = f"{value:.{digits}g}"
    _, _, power = text.partition("e")
    return f"{float(text):.0f}" if power and 0 <= int(power) < _PLAIN else raised(text)


def plain_words(value: Any) -> str:
    """A value of any kind: a float as `number_words` to six digits, others as Python says them.

    Examples
    --------
    >>> plain_words(2e7), plain_words("pad")
    ('2·10⁷', 'pad')
    """
    return number_words(value, _EXACT) if isinstance(value, float) else str(value)


def printable(text: str) -> str:
    """A text without control characters, which a terminal would obey and a page may not hold.

    Lines and tabs stay.

    Examples
    --------
    >>> printable("a\x1b[31m title")
    'a�[31m title'
    """
    return re.sub(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", "\N{REPLACEMENT CHARACTER}", text)


def raised(text: str) -> str:
    """A number as computers write it with a power of ten as people do; other words as they are.

    Examples
    --------
    >>> raised("1.60e-05"), raised("1e+09"), raised("0.15"), raised("stick")
    ('1.6·10⁻⁵', '10⁹', '0.15', 'stick')
    """
    found = _WITH_POWER.fullmatch(text)
    if not found:
        return text
    lead, power = found[1], str(int(found[3]))
    lead = {"1": "", "-1": "-"}.get(lead, f"{lead}·")
    return f"{lead}10{power.translate(_RAISED)}"


def numbers_words(values: Iterable[float], digits: int = 4) -> list[str]:
    """Numbers side by side, as `number_words`: if one has a power of ten, all large and small ones do.

    Examples
    --------
    >>> numbers_words([130e3, 5e7], 2), numbers_words([8000, 99e3]), numbers_words([100, 1e7, 0, math.inf])
    (['1.3·10⁵', '5·10⁷'], ['8000', '99000'], ['100', '10⁷', '0', 'inf'])
    """
    numbers = [float(value) for value in values]
    words = [number_words(number, digits) for number in numbers]
    if not any(set(each) & set(_SUPERSCRIPTS) for each in words):
        return words
    low, high = _PLAIN_BESIDE
    for place, number in enumerate(numbers):
        if math.isfinite(number) and number != 0.0 and not low <= abs(number) < high:
            words[place] = raised(f"{number:.{digits - 1}e}")
    return words


def number_of(count: int, noun: str) -> str:
    """A number of things.

    Examples
    --------
    >>> number_of(1, "point"), number_of(3, "point")
    ('1 point', '3 points')
    """
    return f"{count} {noun}{'s' * (count != 1)}"


def listed(words: Sequence[str], most: int) -> str:
    """Words after commas, of many the first two and the last."""
    if len(words) <= most:
        return ", ".join(words)
    return f"{words[0]}, {words[1]} … {words[-1]} ({len(words)} values)"


def html_table(rows: Iterable[tuple[str, str, str, str]]) -> str:
    """A table of kinds, names, values and meanings."""
    from html import escape  # a millisecond, which the help of the command line does without

    body = "".join(
        f"<tr><td>{escape(kind)}</td><td><b>{escape(name)}</b></td><td>{escape(value)}</td>"
        f"<td>{escape(meaning)}</td></tr>"
        for kind, name, value, meaning in rows
    )
    return f"<table>{body}</table>"


def coordinate_words(name: str, value: float | str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """`value_words`, or the name that the attributes of a coordinate have for the value, as of a body.

    Examples
    --------
    >>> coordinate_words("body", 2, {"flag_values": [1, 2], "flag_meanings": "pad test_piece"})
    'test piece'
    """
    if "flag_meanings" not in attributes or isinstance(value, str):
        return value_words(name, value, attributes)
    flags = [int(flag) for flag in attributes["flag_values"]]
    return str(attributes["flag_meanings"]).split()[flags.index(int(value))].replace("_", " ")


def with_rad(words: str, attributes: Mapping[Any, Any]) -> str:
    """The words of a value with the unit of an angle, unless they are a multiple of π.

    Examples
    --------
    >>> [with_rad(words, {"units": "rad"}) for words in ("1.57", "π/2", "0")], with_rad("1.57", {})
    (['1.57 rad', 'π/2', '0'], '1.57')
    """
    plain = attributes.get("units") == "rad" and words != "0" and "π" not in words
    return f"{words} rad" if plain else words


def line_words(name: str, value: float | str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """`coordinate_words` with the unit of an angle, for a line without labels of units."""
    return with_rad(coordinate_words(name, value, attributes), attributes)


def place_words(name: str, value: float | str, attributes: Mapping[Any, Any] = _NONE) -> str:
    """A value of a parameter, or of its coordinate, with symbol and unit; the name alone for a profile.

    A name is as in prose, without underscores.

    Examples
    --------
    >>> place_words("friction", 0.25), place_words("profile", "rounded_punch")
    ('$\\\\mu$ = 0.25', 'rounded punch')
    >>> place_words("criterion", "findley")
    'Findley stress'
    """
    if name == "criterion":
        return CRITERIA[str(value)].values
    if name == SHIFT:
        return f"stick zone {'moved' if value == MOVED else 'in place'}"
    alone = AXES[name].kind == "name" or "flag_meanings" in attributes
    symbol = "" if alone else f"{parameter_words(name, attributes)} = "
    units = unit_words(attributes.get("units", "1"))
    return symbol + as_text(coordinate_words(name, value, attributes).replace("_", " ") + units)


def unit_words(unit: str) -> str:
    """Unit suffix of a number; empty if the unit is implied.

    Examples
    --------
    >>> unit_words("mm"), unit_words("rad"), unit_words("1")
    (' mm', '', '')
    """
    return "" if unit in ("1", "rad", "") else f" {unit}"


def pi_words(multiple: Fraction) -> str:
    """A rational multiple of π.

    Examples
    --------
    >>> [pi_words(Fraction(n, 2)) for n in range(-1, 5)]
    ['-π/2', '0', 'π/2', 'π', '3π/2', '2π']
    """
    numerator, slash, denominator = str(multiple).partition("/")
    numerator = {"1": "", "-1": "-"}.get(numerator, numerator)
    return f"{numerator}π{slash}{denominator}" if multiple else "0"


def _fraction(value: float, largest: int) -> Fraction | None:
    fraction = Fraction(value).limit_denominator(largest)
    return fraction if math.isclose(fraction, value, rel_tol=_TOLERANCE) else None


def duration(seconds: float) -> str:
    """Seconds as people say them.

    Examples
    --------
    >>> duration(0.5), duration(75), duration(7500)
    ('0.5 s', '1 min 15 s', '2 h 5 min')
    """
    if seconds < 10:
        return f"{seconds:.1f} s"
    minutes, whole = divmod(round(seconds), 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60} min"
    return f"{minutes} min {whole} s" if minutes else f"{whole} s"
