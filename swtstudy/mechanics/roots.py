"""Roots of monotone functions, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from swtstudy.mechanics.points import FloatArray

#: Newton steps fall back to bisection when they leave the bracket, so this many always suffice.
LARGEST_STEP_COUNT = 60


def monotone_roots(
    function: Callable[[FloatArray], tuple[FloatArray, FloatArray]],
    low: FloatArray,
    high: FloatArray,
    tolerance: float = 1e-9,
) -> FloatArray:
    """Root of a monotone function inside each bracket: Newton's method, safeguarded by bisection.

    Parameters
    ----------
    function
        Maps abscissae to values and derivatives, all of the brackets' shape.
    low, high
        Ends of the brackets. Where the function does not change sign between them, the end nearer to
        the root is returned.
    tolerance
        Size of the last Newton step; the error of the root is about its square.

    Returns
    -------
    Roots, of the brackets' shape.
    """
    value_low, _ = function(low)
    value_high, _ = function(high)
    rising = value_high >= value_low
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    span = value_high - value_low
    share = np.divide(-value_low, span, out=np.full_like(span, 0.5), where=span != 0.0)
    root = low + (high - low) * np.clip(share, 0.0, 1.0)
    for _ in range(LARGEST_STEP_COUNT):
        value, slope = function(root)
        below = (value < 0.0) == rising
        low = np.where(below, root, low)
        high = np.where(below, high, root)
        step = np.divide(-value, slope, out=np.zeros_like(value), where=slope != 0.0)
        newton = root + step
        inside = (newton >= low) & (newton <= high) & (slope != 0.0)
        new = np.where(inside, newton, 0.5 * (low + high))
        moved = np.abs(new - root)
        root = new
        if np.all(moved <= tolerance):
            break
    return root
