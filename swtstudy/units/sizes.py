"""Bounds on the size of numbers with a unit."""

from __future__ import annotations

from swtstudy.vocabulary.mistakes import Mistake, literal, plain_number

#: No unit makes a quantity smaller or larger; the product of three of them, and a square, is still a number.
SMALLEST, LARGEST = 1e-100, 1e100


def wrong_size(
    name: str, value: object, allowed: str, sign: float = 1.0, zero: bool = False
) -> list[Mistake]:
    """The mistake of a value that is no number of this sign, or of no size that can be computed with."""
    number = sign * plain_number(value)
    if SMALLEST <= number <= LARGEST or (zero and number == 0.0):
        return []
    if number > 0.0:
        allowed += f", in magnitude from {SMALLEST:g} to {LARGEST:g}"
    return [Mistake(name, literal(value), allowed)]
