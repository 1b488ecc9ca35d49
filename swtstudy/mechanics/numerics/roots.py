"""Roots of monotone functions, many at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: Steps fall back to bisection when they leave the bracket, so this many always suffice. Ten do at 56 points.
LARGEST_STEP_COUNT = 60

#: Last step of a root in time, rad. A hundred times: 4e-5 at 3 of 128 points at rtol 1e-5, no faster.
LAST_STEP = 1e-5

#: Maps abscissae, and the numbers of the brackets they belong to, to values and two derivatives.
Function = Callable[[FloatArray, NDArray[np.intp]], tuple[FloatArray, FloatArray, FloatArray]]


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


def monotone_roots(
    function: Function, goal: FloatArray, brackets: Brackets, last_step: float = LAST_STEP
) -> FloatArray:
    """Where monotone functions reach a goal: Halley's method, safeguarded by bisection.

    Parameters
    ----------
    function
        Values, first and second derivatives.
    goal
        Shape (n,).
    brackets
        n brackets. Where the goal is not between the values at the ends, the nearer end is returned.
    last_step
        No step follows a smaller one: the error is about its cube, or its square where the second derivative
        is left out.

    Returns
    -------
    Abscissae, shape (n,).
    """
    low, high = brackets.low, brackets.high
    rising = brackets.at_high >= brackets.at_low
    root = low + (high - low) * _first_guess(goal, brackets)
    active, result = np.arange(low.size), root.copy()
    for _ in range(LARGEST_STEP_COUNT):
        value, slope, bend = function(root, active)
        value = value - goal
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
        going = np.abs(new - root) > last_step
        if not np.any(going):
            break
        active, rising, goal = active[going], rising[going], goal[going]
        root, low, high = new[going], low[going], high[going]
    return result


def _first_guess(goal: FloatArray, brackets: Brackets) -> FloatArray:
    """Where the monotone rational quadratic with these values and slopes reaches the goal, in [0, 1].

    Gregory & Delbourgo, IMA J. Numer. Anal. 1982, 2, 123: its slopes may vanish, and its inverse is the
    solution of a quadratic equation.
    """
    span = brackets.at_high - brackets.at_low
    safe = np.where(span != 0.0, span, 1.0)
    level = np.clip((goal - brackets.at_low) / safe, 0.0, 1.0)
    width = brackets.high - brackets.low
    first, last = (
        np.maximum(slope * width / safe, 0.0) for slope in (brackets.slope_low, brackets.slope_high)
    )
    excess = (first + last - 2.0) * level
    a, b = 1.0 - first + excess, first - excess
    return np.clip(
        2.0 * level / np.maximum(b + np.sqrt(np.maximum(b * b + 4.0 * a * level, 0.0)), 1e-300), 0.0, 1.0
    )


def sign_changes(grid: FloatArray, values: FloatArray) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """Ranges in which smooth functions change their sign, from samples on an even grid.

    Parameters
    ----------
    grid
        Shape (k,).
    values
        Shape (n, k).

    Returns
    -------
    row, low, high
        Shape (m,): the function and the ends of each range. Two zeros within two neighbouring cells show as a
        parabola whose vertex crosses zero.
    """
    row, cell = np.nonzero((values[:, :-1] < 0.0) != (values[:, 1:] < 0.0))
    low, high = grid[cell], grid[cell + 1]
    left, middle, right = values[:, :-2], values[:, 1:-1], values[:, 2:]
    curvature = left - 2.0 * middle + right
    with np.errstate(divide="ignore", invalid="ignore"):
        offset = 0.5 * (left - right) / curvature
        vertex = middle - 0.25 * (left - right) * offset
        pair = (left * middle > 0.0) & (middle * right > 0.0) & (vertex * middle < 0.0) & (abs(offset) <= 1.0)
    pair_row, pair_cell = np.nonzero(pair)
    if not pair_row.size:
        return row, low, high
    split = grid[pair_cell + 1] + (grid[1] - grid[0]) * offset[pair_row, pair_cell]
    return (
        np.concatenate([row, pair_row, pair_row]),
        np.concatenate([low, grid[pair_cell], split]),
        np.concatenate([high, split, grid[pair_cell + 2]]),
    )
