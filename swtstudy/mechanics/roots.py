"""Roots of monotone functions, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray

#: Steps fall back to bisection when they leave the bracket, so this many always suffice.
LARGEST_STEP_COUNT = 60

#: Maps abscissae, and the numbers of the brackets they belong to, to values and two derivatives.
Function = Callable[[FloatArray, NDArray[np.intp]], tuple[FloatArray, FloatArray, FloatArray]]


def monotone_roots(
    function: Function, low: FloatArray, high: FloatArray, tolerance: float = 1e-5
) -> FloatArray:
    """Root of a monotone function inside each bracket: Halley's method, safeguarded by bisection.

    Parameters
    ----------
    function
        Values, first and second derivatives.
    low, high
        Shape (n,): ends of the brackets. Where the function does not change sign between them, the end
        nearer to the root is returned.
    tolerance
        Size of the last step; the error of the root is about its cube.

    Returns
    -------
    Roots, shape (n,).
    """
    active = np.arange(low.size)
    at_low, at_high = function(low, active), function(high, active)
    rising = at_high[0] >= at_low[0]
    root = low + (high - low) * _first_guess(low, high, at_low, at_high)
    result = root.copy()
    for _ in range(LARGEST_STEP_COUNT):
        value, slope, bend = function(root, active)
        below = (value < 0.0) == rising
        low, high = np.where(below, root, low), np.where(below, high, root)
        denominator = 2.0 * slope * slope - value * bend
        step = np.divide(
            -2.0 * value * slope, denominator, out=np.full_like(value, np.inf), where=denominator > 0.0
        )
        step = np.where(value == 0.0, 0.0, step)
        new = root + step
        new = np.where((new >= low) & (new <= high), new, 0.5 * (low + high))
        result[active] = new
        going = np.abs(new - root) > tolerance
        if not np.any(going):
            break
        active, rising = active[going], rising[going]
        root, low, high = new[going], low[going], high[going]
    return result


def _first_guess(
    low: FloatArray,
    high: FloatArray,
    at_low: tuple[FloatArray, FloatArray, FloatArray],
    at_high: tuple[FloatArray, FloatArray, FloatArray],
) -> FloatArray:
    """Root of the monotone rational quadratic that has the values and slopes at both ends, in [0, 1].

    Gregory & Delbourgo, IMA J. Numer. Anal. 1982, 2, 123: its slopes may vanish, and its inverse is the
    solution of a quadratic equation.
    """
    span = at_high[0] - at_low[0]
    safe = np.where(span != 0.0, span, 1.0)
    level = np.clip(-at_low[0] / safe, 0.0, 1.0)
    first, last = (np.maximum(end[1] * (high - low) / safe, 0.0) for end in (at_low, at_high))
    excess = (first + last - 2.0) * level
    a, b = 1.0 - first + excess, first - excess
    return np.clip(
        2.0 * level / np.maximum(b + np.sqrt(np.maximum(b * b + 4.0 * a * level, 0.0)), 1e-300), 0.0, 1.0
    )
