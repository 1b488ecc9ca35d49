"""Roots of monotone functions, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray

#: Newton steps fall back to bisection when they leave the bracket, so this many always suffice.
LARGEST_STEP_COUNT = 60


def monotone_roots(
    function: Callable[[FloatArray, NDArray[np.intp]], tuple[FloatArray, FloatArray]],
    low: FloatArray,
    high: FloatArray,
    tolerance: float = 1e-9,
) -> FloatArray:
    """Root of a monotone function inside each bracket: Newton's method, safeguarded by bisection.

    Parameters
    ----------
    function
        Maps abscissae, and the numbers of the brackets they belong to, to values and derivatives.
    low, high
        Shape (n,): ends of the brackets. Where the function does not change sign between them, the end
        nearer to the root is returned.
    tolerance
        Size of the last Newton step; the error of the root is about its square.

    Returns
    -------
    Roots, shape (n,).
    """
    active = np.arange(low.size)
    value_low, value_high = function(low, active)[0], function(high, active)[0]
    rising = value_high >= value_low
    span = value_high - value_low
    share = np.divide(-value_low, span, out=np.full_like(span, 0.5), where=span != 0.0)
    root = low + (high - low) * np.clip(share, 0.0, 1.0)
    result = root.copy()
    for _ in range(LARGEST_STEP_COUNT):
        value, slope = function(root, active)
        below = (value < 0.0) == rising
        low, high = np.where(below, root, low), np.where(below, high, root)
        step = np.divide(-value, slope, out=np.zeros_like(value), where=slope != 0.0)
        newton = root + step
        inside = (newton >= low) & (newton <= high) & (slope != 0.0)
        new = np.where(inside, newton, 0.5 * (low + high))
        result[active] = new
        going = np.abs(new - root) > tolerance
        if not np.any(going):
            break
        active, root, low, high, rising = (v[going] for v in (active, new, low, high, rising))
    return result
