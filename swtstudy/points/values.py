"""One value of one parameter: read from what a user wrote, checked against the table of parameters.

Arithmetic written as text, such as "2*pi", "8/9" or "sqrt(20)", is exact wherever it is rational.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from numbers import Rational
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import is_number, plain, plain_number
from swtstudy.vocabulary.parameters import DEGREES, PARAMETERS, Parameter
from swtstudy.vocabulary.wording import unit_words

if TYPE_CHECKING:
    import xarray as xr

#: Bounds the depth of the parser's recursion and the size of its exact integers.
LONGEST_EXPRESSION = 80

_NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_WRITTEN = re.compile(rf"\s*(?:(?:{_NUMBER}|pi|π|sqrt|[-+*/()])\s*)*")
_OPERATORS: dict[type[ast.AST], Callable[..., Fraction | float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}


def evaluate(text: str) -> Fraction | float:
    """Value of an expression of numbers, pi, sqrt(), + - * / and parentheses.

    Parameters
    ----------
    text
        The expression.

    Returns
    -------
    Fraction or float
        A Fraction if the value is rational by construction, else a float.

    Raises
    ------
    ValueError
        If the text is not such an expression, or has no finite value; the message says why.

    Examples
    --------
    >>> evaluate("3/2"), evaluate("0.25"), evaluate("sqrt(4)")
    (Fraction(3, 2), Fraction(1, 4), Fraction(2, 1))
    >>> evaluate("2*pi")
    6.283185307179586
    """
    if len(text) > LONGEST_EXPRESSION:
        raise ValueError(f"an expression of more than {LONGEST_EXPRESSION} characters")
    if not _WRITTEN.fullmatch(text):
        raise ValueError("not a number or an expression of numbers, pi, sqrt(), + - * / ( )")
    # Python's numbers do not begin with zeros, and its lines end.
    text = re.sub(r"(?<![\w.])0+(?=[0-9])", "", " ".join(text.split()))
    try:
        value = _value(ast.parse(text, mode="eval").body, text)
        if not math.isfinite(value):
            raise OverflowError
    except SyntaxError:
        raise ValueError("not a number, as where a * or a parenthesis is missing") from None
    except ZeroDivisionError:
        raise ValueError("division by zero") from None
    except OverflowError:
        raise ValueError("not a finite number") from None
    return value


def _value(node: ast.expr, text: str) -> Fraction | float:
    match node:
        case ast.Constant():
            return _number(ast.get_source_segment(text, node) or "")
        case ast.Name(id="pi" | "π"):
            return math.pi
        case ast.UnaryOp(op=op, operand=operand):
            return _OPERATORS[type(op)](_value(operand, text))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_value(left, text), _value(right, text))
        case ast.Call(func=ast.Name(id="sqrt"), args=[argument]):
            return _square_root(_value(argument, text))
    raise SyntaxError


def _number(digits: str) -> Fraction:
    if "e" not in digits.lower():
        return Fraction(digits)
    # By way of a float: Fraction("1e999999999") would fill the memory.
    value = float(digits)
    if not math.isfinite(value):
        raise OverflowError
    return Fraction(repr(value))


def _square_root(value: Fraction | float) -> Fraction | float:
    if value < 0:
        raise ValueError("square root of a negative number")
    if isinstance(value, Fraction):
        numerator, denominator = math.isqrt(value.numerator), math.isqrt(value.denominator)
        if numerator**2 == value.numerator and denominator**2 == value.denominator:
            return Fraction(numerator, denominator)
    return math.sqrt(value)


#: A checked value: a float, an exact frequency ratio, a built-in name, or what the user has defined.
Value = float | Fraction | str | Definition
#: Values of axes or samples, by parameter.
NamedValues = dict[str, tuple[Value, ...]]

#: No definitions.
UNDEFINED: Mapping[str, Definition] = {}

#: Names of the parameters that are numbers: they can have any value between two others.
NUMERIC = tuple(name for name, parameter in PARAMETERS.items() if parameter.kind == "number")

#: How far, relatively, a float may be from the small fraction that it stands for.
_FRACTION_TOLERANCE = 1e-9


def values_taken(name: str, good: Mapping[str, Sequence[Any]]) -> Sequence[Any]:
    """The values that a parameter has in a study: the given values, or its default."""
    return good.get(name, (PARAMETERS[name].default,))


def amplitudes_of(loads: Iterable[object]) -> set[str]:
    """Names of the amplitudes that scale some of the loads that are loops."""
    return {name for load in loads if isinstance(load, Definition) for name in load.scaled_by}


def press_steadily(loads: Iterable[object]) -> bool:
    """Return whether all loads are loops in which the normal load is the mean one at every instant."""
    return all(getattr(load, "normal_ends", None) == (0.0, 0.0) for load in loads)


def read_value(parameter: Parameter, raw: object, known: Mapping[str, Definition] = UNDEFINED) -> Value:
    """The value of a parameter, from a number, a string such as "pi/2" or "3/2", or a name.

    Parameters
    ----------
    parameter
        Row of the table of parameters.
    raw
        The value that the user wrote.
    known
        Definitions of the user, by name.

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
        if isinstance(raw, Definition) and raw.parameter == parameter.name:
            return raw
        if not isinstance(raw, str):
            raise ValueError("not a name")
        if raw in parameter.names:
            return raw
        if raw not in known:
            raise ValueError(f"no such {parameter.name}")
        return known[raw]
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
    assert not isinstance(value, Definition)
    return float(value)


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


def hint_at_degrees(raw: object) -> str:
    """The words for an angle that may be meant in degrees; empty for one with a unit, or a multiple of π.

    Examples
    --------
    >>> hint_at_degrees("90"), hint_at_degrees("pi/2")
    ('for degrees write "90 deg"', '')
    """
    said = isinstance(raw, str) and any(word in raw for word in ("pi", "π", "rad", *DEGREES))
    number = f"{raw:g}" if isinstance(raw, float) else raw
    return "" if said else f'for degrees write "{number} deg"'


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


#: Largest relative distance of a typed value from the value of an axis that it means: "3.141593" is π.
AXIS_TOLERANCE = 1e-6
#: Largest distance where one of the two is 0, which nothing is relatively close to: rounding of a phase.
_ROUNDING = 1e-14


def index_of(value: Value, axis: Sequence[Value], tolerance: float = AXIS_TOLERANCE) -> int | None:
    """Index of the value of an axis that a value means; None if there is none.

    Parameters
    ----------
    value
        A checked value.
    axis
        The values of the axis.
    tolerance
        Largest distance of numbers, relative to the larger of the two.

    Examples
    --------
    >>> index_of(3.141593, (0.0, 3.141592653589793)), index_of(3.1416, (0.0, 3.141592653589793))
    (1, None)
    """
    if isinstance(value, str | Definition):
        names = [str(each) for each in axis]
        return names.index(str(value)) if str(value) in names else None
    known, asked = np.array(axis, float), float(value)
    distance, scale = np.abs(known - asked), np.maximum(np.abs(known), abs(asked))
    near = distance <= np.where((known == 0.0) | (asked == 0.0), _ROUNDING, tolerance * scale)
    # An axis is empty if its values are wrong, which is reported.
    return int(np.where(near, distance, np.inf).argmin()) if near.any() else None


def index_at(values: xr.DataArray | xr.Variable, flat: int) -> dict[str, int]:
    """Index along each dimension of a place among the flattened values."""
    return dict(zip(map(str, values.dims), map(int, np.unravel_index(flat, values.shape)), strict=True))


def unit_of(values: xr.DataArray) -> str:
    """The unit of values as it stands behind one of them."""
    return unit_words(str(values.attrs.get("units", "")))
