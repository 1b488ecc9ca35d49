import contextlib
import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swtstudy.points.values import evaluate


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("8/9", Fraction(8, 9)),
        ("3/2", Fraction(3, 2)),
        (" 0.1 ", Fraction(1, 10)),
        ("0.1234567890123456789", Fraction(1234567890123456789, 10**19)),
        ("1e-3", Fraction(1, 1000)),
        (".5", Fraction(1, 2)),
        ("2.", Fraction(2)),
        ("-(1 - 3) * 2/4", Fraction(1)),
        ("1 - 2 - 3", Fraction(-4)),
        ("8/2/2", Fraction(2)),
        ("sqrt(4/9)", Fraction(2, 3)),
        ("pi/2", math.pi / 2),
        ("2*pi", 2 * math.pi),
        ("2*π", 2 * math.pi),
        ("-+-1", Fraction(1)),
        ("007 - 0.05 +\n00", Fraction(139, 20)),
        ("sqrt(20)", math.sqrt(20)),
    ],
)
def test_value(text, value):
    result = evaluate(text)
    assert type(result) is type(value)
    assert result == value


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("3/0", "division by zero"),
        ("", "an empty text"),
        ("2pi", "unexpected"),
        ("(1", "not closed"),
        ("1)", "unexpected"),
        ("sqrt 4", "parentheses"),
        ("sqrt(-1)", "negative"),
        ("sqrt", "parentheses"),
        ("2**3", "unexpected"),
        ("7//2", "unexpected"),
        ("pi(2)", "unexpected"),
        ("(1)(2)", "unexpected"),
        ("sqrt()", "unexpected"),
        ("1_0", "not a number"),
        ("0x1", "not a number"),
        ("1j", "not a number"),
        ("nan", "not a number"),
        ("inf", "not a number"),
        ("1e400", "not a"),
        ("1e308*1e308*pi", "not a finite"),
        ("__import__('os')", "not a number"),
        ("1" * 100, "more than"),
    ],
)
def test_refused(text, reason):
    with pytest.raises(ValueError, match=reason):
        evaluate(text)


@given(st.text(alphabet="0123456789.e+-*/() pisqrt", max_size=30) | st.text(max_size=100))
def test_any_text_is_a_number_or_refused(text):
    with contextlib.suppress(ValueError):
        assert math.isfinite(evaluate(text))


@given(st.fractions(-999, 999, max_denominator=999), st.fractions(-999, 999, max_denominator=999))
def test_arithmetic_is_exact(a, b):
    assert evaluate(f"({a}) + ({b}) * ({a}) - ({b})") == a + b * a - b
