"""Roots of monotone functions and maxima of smooth ones, many at once.

A maximum is the vertex of a parabola, or of a higher polynomial, through values at a few places.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray, IndexArray, Rows

#: Iterations that converge, or fall back to bisection, need fewer steps than these.
MOST_STEPS = 60
#: Newton's method squares the error: so many steps lead from a hundredth to rounding.
NEWTON_STEPS = 3

#: Last step of a root in time, rad. A hundred times: 4e-5 at 3 of 128 points at rtol 1e-5, no faster.
LAST_STEP = 1e-5

#: Maps abscissae, and the numbers of the brackets they belong to, to values and two derivatives.
Function = Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray, FloatArray]]


@dataclass(frozen=True)
class Brackets(Rows):
    """Ranges in which functions are monotone, arrays of shape (n,).

    Attributes
    ----------
    low, high
        Ends of the ranges.
    at_low, at_high
        The functions' values there.
    slope_low, slope_high
        Their derivatives there.
    """

    low: FloatArray
    high: FloatArray
    at_low: FloatArray
    at_high: FloatArray
    slope_low: FloatArray
    slope_high: FloatArray

    @classmethod
    def of(cls, function: Function, low: FloatArray, high: FloatArray) -> Brackets:
        """The brackets [low, high], each of shape (n,)."""
        every = np.arange(low.size)
        (at_low, slope_low, _), (at_high, slope_high, _) = function(low, every), function(high, every)
        return cls(low, high, at_low, at_high, slope_low, slope_high)


def parabola(left: FloatArray, middle: FloatArray, right: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Vertex of the parabola through three equally spaced values whose middle one is not the least.

    Returns
    -------
    shift, rise
        Abscissa of the vertex in steps from the middle, within [−1, 1], and its value above the middle;
        0 where there is no maximum.
    """
    bend = left - 2.0 * middle + right
    peaked = bend < 0.0
    shift = np.where(peaked, 0.5 * (left - right) / np.where(peaked, bend, 1.0), 0.0)
    inside = np.abs(shift) <= 1.0
    return np.where(inside, shift, 0.0), np.where(inside, -0.25 * (left - right) * shift, 0.0)
