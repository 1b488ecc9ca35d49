"""Formulae of the pages, as browsers are given them."""

import re

import pytest

# Sphinx is of the extra ``docs``.
formulae = pytest.importorskip("build_steps.mathml")
pytestmark = pytest.mark.pages


def plain(formula):
    """Without the indentation, and with a mark for each thin space."""
    found = re.sub(r">\s+<", "><", formulae.mathml(formula))
    found = found.replace('<mspace width="0.1667em"></mspace>', "~")
    found = found.replace(' lspace="0" rspace="0"', "").replace("<mo>&ApplyFunction;</mo>", "")
    return re.sub(r"</?(?:math|mrow)[^>]*>", "", found)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (r"(b)\sin^2\alpha", ")</mo>~<msup><mi>sin</mi><mn>2</mn></msup>~<mi>α</mi>"),
        (r"C\sin 2\theta", "<mi>C</mi>~<mi>sin</mi>~<mn>2</mn>"),
        (r"-\cos kx", "</mo><mi>cos</mi>~<mi>k</mi>"),
        (r"\ln(x)", "<mi>ln</mi><mo"),
        (r"\sin^2(x)", "<msup><mi>sin</mi><mn>2</mn></msup><mo"),
        ("g'(x)", "<mi>g</mi><mo>′</mo><mo"),
        ("f''", "<mi>f</mi><mo>″</mo>"),
        ("d := x", "<mi>d</mi><mo>:=</mo><mi>x</mi>"),
        ("f' g''", "<mi>f</mi><mo>′</mo><mi>g</mi><mo>″</mo>"),
    ],
)
def test_spaces_and_primes(formula, expected):
    assert expected in plain(formula)


def test_bars_and_primes_are_set_close():
    assert formulae.mathml("|x'|").count(' lspace="0" rspace="0"') == 3


@pytest.mark.parametrize("formula", [r"\tfrac12 x", r"\frac{1}2 x"])
def test_a_fraction_that_would_be_another_is_refused(formula):
    with pytest.raises(ValueError, match="both parts of a fraction in braces"):
        formulae.mathml(formula)


def test_a_full_stop_stays_with_its_formula():
    first, second, alone = formulae.mathml("x"), formulae.mathml("y"), formulae.mathml("z")
    block = formulae.mathml("w", as_block=True)
    assert formulae.tied(f"<p>Of ({first}), {second}. And {alone} is</p>") == (
        f'<p>Of <span class="tied">({first}),</span> <span class="tied">{second}.</span> And {alone} is</p>'
    )
    assert formulae.tied(f"{block}.") == f"{block}."
