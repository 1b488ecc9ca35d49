"""Maxima of functions known at a few places: vertices of parabolas and of higher polynomials."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.arrays import gather, pick
from swtstudy.mechanics.points import FloatArray

#: Newton steps from a parabola's vertex to a polynomial's maximum. One: 1e-7 at rtol 1e-4, hardly
#: faster; four: 1e-10.
NEWTON_STEPS = 2


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


def near_maximum(curve: FloatArray, share: float) -> NDArray[np.bool_]:
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
    c: FloatArray, values: FloatArray, best: NDArray[np.intp], is_corner: NDArray[np.bool_]
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
