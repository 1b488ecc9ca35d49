import contextlib
import json
import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from told import refused

from swtstudy import Study, StudyError

#: Letters that TOML takes as they are, or as JSON writes them.
LETTERS = st.characters(exclude_categories=["Cs", "Cc"])


def evaluated(*texts: str, name: str = "phase") -> tuple:
    """Texts as values of a parameter; phases may be any number."""
    values = json.dumps(texts, ensure_ascii=False)
    return Study.from_text(f'title = "t"\nsample.points.{name} = {values}\n').grid.samples[name]


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
        ("sqrt(2)", math.sqrt(2)),
        ("sqrt(1/2)", math.sqrt(0.5)),
        ("sqrt(9/4) + sqrt(0)", Fraction(3, 2)),
        ("0.00 + 10 + 00.5 + 1E-1", Fraction(106, 10)),
        ("3/2" + 38 * "+0" + "0", Fraction(3, 2)),  # 80 characters
    ],
)
def test_value(text, value):
    assert evaluated(text) == (float(value),)


def test_ratios_are_exact():
    ratios = evaluated("-(1 - 3) * 3/4", "sqrt(4/9)", "0.1", name="frequency_ratio")
    assert ratios == (Fraction(3, 2), Fraction(2, 3), Fraction(1, 10))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("3/0", r"\(division by zero\) at"),
        ("", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("2*", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("2 -", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("(", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("sqrt (2", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("sqrt  (2)2", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("2pi", "missing"),
        ("(1", "missing"),
        ("1)", "missing"),
        ("sqrt 4", "missing"),
        ("sqrt(-1)", "negative"),
        ("sqrt", r"\(not a number, as where a \* or a parenthesis is missing\) at"),
        ("2**3", "missing"),
        ("7//2", "missing"),
        ("pi(2)", "missing"),
        ("(1)(2)", "missing"),
        ("sqrt()", "missing"),
        ("1_0", "not a number"),
        ("0x1", "not a number"),
        ("1j", "not a number"),
        ("nan", "not a number"),
        ("inf", "not a number"),
        ("1e400", r"\(not a finite number\) at"),
        ("1e308*pi", r"\(not a finite number\) at"),
        ("1e308*1e308*pi", "not a finite"),
        ("__import__('os')", "not a number"),
        ("1" * 81, "more than 80 characters"),
    ],
)
def test_refused(text, reason):
    refused(f"phase: .*{reason}", evaluated, text)


@settings(max_examples=20, deadline=None)
@given(st.lists(st.text("0123456789.e+-*/() pisqrt") | st.text(LETTERS), min_size=1, max_size=20))
def test_any_text_is_a_number_or_refused(texts):
    with contextlib.suppress(StudyError):
        assert all(map(math.isfinite, evaluated(*texts)))


PAIRS = st.tuples(*[st.fractions(-30, 30, max_denominator=999)] * 2)


@settings(max_examples=10, deadline=None)
@given(st.lists(PAIRS, min_size=1, max_size=20))
def test_arithmetic_is_exact(pairs):
    found = evaluated(*(f"({a}) + ({b}) * ({a}) - ({b})" for a, b in pairs))
    assert found == tuple(float(a + b * a - b) for a, b in pairs)
