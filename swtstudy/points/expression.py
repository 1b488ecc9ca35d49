"""Arithmetic written as text, such as "2*pi", "8/9" or "sqrt(20)": exact wherever it is rational."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable
from fractions import Fraction

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
        raise ValueError(_what_is_wrong(text)) from None
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


def _what_is_wrong(text: str) -> str:
    if not text or text[-1] in "+-*/(":
        return "not a number: the expression ends too early"
    if re.search(r"sqrt(?! ?\()", text):
        return "sqrt needs parentheses"
    if text.count("(") > text.count(")"):
        return "a parenthesis is not closed"
    return "not a number: unexpected text, as where a * is missing"


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
