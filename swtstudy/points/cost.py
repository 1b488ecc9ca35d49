"""Computing times of points, and such times in words."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import IntArray
from swtstudy.points.canonical import Table
from swtstudy.vocabulary.definition import CONTENT_BITS
from swtstudy.vocabulary.quantities import YIELD, Request

#: Rough cost of a point by its weight, before any has been timed.
SECONDS_PER_WEIGHT = 4e-3
#: The same of the nonlocal values of a point, whatever its weight and the number of distances.
SECONDS_NONLOCAL = 0.2
#: The same of the largest von Mises stress.
SECONDS_YIELD = 0.05
#: How much more counting the strain cycles of a point costs than its s.
COUNTING = 2.5


def weights(table: Table) -> IntArray:
    """Rough relative cost of points: long cycles cost more."""
    frequencies = (table["p"] + table["q"]).astype(np.int64)
    # The cost of a loop is part of its code.
    return frequencies + table["load"].astype(np.int64) // 2**CONTENT_BITS


def rough_seconds(weight: float, points: int, asked: Request) -> float:
    """Rough computing time of points of this weight together, before any has been timed."""
    beside = SECONDS_NONLOCAL * bool(asked.distances) + SECONDS_YIELD * (YIELD in asked.names)
    return float(weight * SECONDS_PER_WEIGHT * (1.0 + COUNTING * asked.counts) + points * beside)


def duration(seconds: float) -> str:
    """Seconds as people say them.

    Examples
    --------
    >>> duration(0.5), duration(75), duration(7500)
    ('0.5 s', '1 min 15 s', '2 h 5 min')
    """
    if seconds < 10:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
