"""Roots of monotone functions and maxima of smooth ones, many at once.

A maximum is the vertex of a parabola, or of a higher polynomial, through values at a few places.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.numerics.arrays import TINY, gather, pick
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows

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
    for _ in range(MOST_STEPS):
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
        2.0 * level / np.maximum(b + np.sqrt(np.maximum(b * b + 4.0 * a * level, 0.0)), TINY), 0.0, 1.0
    )


def sign_changes(grid: FloatArray, values: FloatArray) -> tuple[IndexArray, FloatArray, FloatArray]:
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


def near_maximum(curve: FloatArray, share: float) -> BoolArray:
    """Where curves along the last axis come near to their maximum, within a share of their range."""
    high, low = curve.max(axis=-1, keepdims=True), curve.min(axis=-1, keepdims=True)
    return np.asarray(curve >= high - share * (high - low))


def powers_from_values(abscissae: FloatArray) -> FloatArray:
    """Matrix from values at k abscissae to the coefficients of 1, x, …, x^(k − 1), shape (k, k)."""
    return np.asarray(np.linalg.inv(np.vander(abscissae, increasing=True)), dtype=np.float64)


def polynomial_maximum(
    series: FloatArray, start: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Where Σ series_p xᵖ has its maximum near ``start``, within [low, high].

    Parameters
    ----------
    series
        Shape (k, …).
    start, low, high
        Shape (…).
    """
    x = start
    for _ in range(NEWTON_STEPS):
        slope, bend = np.zeros_like(x), np.zeros_like(x)
        for power in range(len(series) - 1, 0, -1):
            bend = bend * x + slope
            slope = slope * x + power * series[power]
        step = np.divide(-slope, bend, out=np.zeros_like(x), where=bend < 0.0)
        x = np.clip(x + step, low, high)
    return x


def vertex_near(
    c: FloatArray, values: FloatArray, best: IndexArray, is_corner: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Abscissa and value of the maximum of a parabola through the ``best`` value and its neighbours.

    At a corner each side has its own parabola, through the corner and the next two values.
    """
    last = c.shape[1] - 1
    corner = is_corner & (pick(c, best) == 0.0)
    position, top = pick(c, best), pick(values, best)
    for toward in (-1, 1):
        middle = np.where(corner, best + toward, best)
        middle = np.clip(middle, 1, last - 1)
        index = middle[:, None] + np.array([-1, 0, 1])
        x, y = gather(c, index), gather(values, index)
        vertex, height = parabola_maximum(x, y)
        higher = height > top
        position, top = np.where(higher, vertex, position), np.where(higher, height, top)
    return position, top


def parabola_maximum(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maximum of the parabolas through three points within their range, shapes (m, 3); else the largest y."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    proper = (left > 0.0) & (right > 0.0)
    left, right = np.where(proper, left, 1.0), np.where(proper, right, 1.0)
    rise, fall = (y[:, 1] - y[:, 0]) / left, (y[:, 2] - y[:, 1]) / right
    bend = (fall - rise) / (left + right)
    proper &= bend < 0.0
    slope = (rise * right + fall * left) / (left + right)
    shift = np.where(proper, -0.5 * slope / np.where(proper, bend, 1.0), 0.0)
    proper &= (shift >= -left) & (shift <= right)
    best = y.argmax(axis=1)
    return (
        np.where(proper, x[:, 1] + shift, pick(x, best)),
        np.where(proper, y[:, 1] + 0.5 * slope * shift, pick(y, best)),
    )
