"""Arithmetic written as text, such as "2*pi", "8/9" or "sqrt(20)": exact wherever it is rational."""

from __future__ import annotations

import math
import re
from fractions import Fraction

#: Bounds the depth of the parser's recursion and the size of its exact integers.
LONGEST_EXPRESSION = 80

_TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|(pi|π|sqrt|[-+*/()]))")


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
    tokens = _tokens(text)
    try:
        value, rest = _sum(tokens)
        if not math.isfinite(value):
            raise ValueError("not a finite number")
    except ZeroDivisionError:
        raise ValueError("division by zero") from None
    except OverflowError:
        raise ValueError("not a finite number") from None
    if rest:
        raise ValueError(f"not a number: unexpected {rest[0]!r}")
    return value


def _tokens(text: str) -> list[str]:
    tokens, position, text = [], 0, text.rstrip()
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            raise ValueError("not a number or an expression of numbers, pi, sqrt(), + - * / ( )")
        tokens.append(match.group(1) or match.group(2))
        position = match.end()
    return tokens


def _sum(tokens: list[str]) -> tuple[Fraction | float, list[str]]:
    value, tokens = _product(tokens)
    while tokens and tokens[0] in "+-":
        operator = tokens[0]
        other, tokens = _product(tokens[1:])
        value = value + other if operator == "+" else value - other
    return value, tokens


def _product(tokens: list[str]) -> tuple[Fraction | float, list[str]]:
    value, tokens = _factor(tokens)
    while tokens and tokens[0] in "*/":
        operator = tokens[0]
        other, tokens = _factor(tokens[1:])
        value = value * other if operator == "*" else value / other
    return value, tokens


def _factor(tokens: list[str]) -> tuple[Fraction | float, list[str]]:
    if not tokens:
        raise ValueError("not a number: the expression ends too early")
    first, rest = tokens[0], tokens[1:]
    if first in ("+", "-"):
        value, rest = _factor(rest)
        return (-value if first == "-" else value), rest
    if first in ("pi", "π"):
        return math.pi, rest
    if first == "sqrt":
        if rest[:1] != ["("]:
            raise ValueError("sqrt needs parentheses")
        value, rest = _factor(rest)
        return _square_root(value), rest
    if first == "(":
        value, rest = _sum(rest)
        if rest[:1] != [")"]:
            raise ValueError("a parenthesis is not closed")
        return value, rest[1:]
    if first[0] in "0123456789.":
        return _number(first), rest
    raise ValueError(f"not a number: unexpected {first!r}")


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
