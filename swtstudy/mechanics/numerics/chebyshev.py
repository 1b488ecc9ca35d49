"""Running integrals of smooth functions, as Chebyshev series on [−1, 1].

A table holds the series of ∫_{−1}^{y} f dy′ along its first axis, so that any number of upper limits cost a
short recurrence each, whatever the integrand cost.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebint, chebvander
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray


@lru_cache(maxsize=16)
def nodes(count: int) -> FloatArray:
    """The ``count`` Chebyshev points of the first kind, ascending, shape (count,)."""
    return -np.cos(np.pi * (np.arange(count) + 0.5) / count)


@lru_cache(maxsize=16)
def _series_matrix(count: int) -> FloatArray:
    """Matrix from values at `nodes` to coefficients, (count, count)."""
    return np.ascontiguousarray(np.linalg.inv(chebvander(nodes(count), count - 1)).T)


@lru_cache(maxsize=16)
def _integration_matrix(count: int) -> FloatArray:
    """Matrix from values at `nodes` to the coefficients of the running integral, (count, count + 1)."""
    integral = chebint(_series_matrix(count).T, lbnd=-1.0, axis=0)
    return np.ascontiguousarray(integral.T)


def series(values: FloatArray) -> FloatArray:
    """Series of functions given by their values at `nodes`, shape (…, count): (count, …)."""
    return np.einsum("...i,ij->j...", values, _series_matrix(values.shape[-1]))


def running_integral(values: FloatArray) -> FloatArray:
    """Series of the running integral of functions given by their values at `nodes`.

    Parameters
    ----------
    values
        Shape (…, count).

    Returns
    -------
    Shape (count + 1, …), coefficients of T_0, T_1, …
    """
    # Not a matrix product: its rounding depends on the batch's size, and so would every tie that it decides.
    return np.einsum("...i,ij->j...", values, _integration_matrix(values.shape[-1]))


def evaluate(series: FloatArray, y: FloatArray, column: NDArray[np.intp] | None = None) -> FloatArray:
    """Value of the series at y by Clenshaw's recurrence.

    Parameters
    ----------
    series
        Shape (k, …), k ≥ 2; its other axes broadcast against y.
    y
        Abscissae in [−1, 1].
    column
        Which series along the last axis belongs to each y; all of them, in order, by default.
    """

    def coefficient(k: int) -> FloatArray:
        return series[k] if column is None else series[k].take(column, axis=-1)

    twice = 2.0 * y
    last = coefficient(-1)
    later = np.broadcast_to(last, np.broadcast_shapes(last.shape, y.shape)).copy()
    latest, spare = np.zeros_like(later), np.empty_like(later)
    for k in range(len(series) - 2, 0, -1):
        np.multiply(twice, later, out=spare)
        spare -= latest
        spare += coefficient(k)
        latest, later, spare = later, spare, latest
    np.multiply(y, later, out=spare)
    spare -= latest
    spare += coefficient(0)
    return spare
