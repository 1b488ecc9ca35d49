"""Tables of smooth functions: Chebyshev series on [−1, 1] with their running integrals, and even cells.

A table holds the series of ∫_{−1}^{y} f dy′ along its first axis, so that any number of upper limits cost a
short recurrence each, whatever the integrand cost. On even cells nothing has to be searched for, and values
are as exact as their derivatives at the nodes.
"""

from __future__ import annotations

from copy import copy
from functools import lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebint, chebvander

from swtstudy.mechanics.points import FloatArray, IndexArray

#: Upper limits that are evaluated together, for the processor's cache. Half: 1.2 times the time; twice: as
#: fast; all at once: 1.5 times.
BLOCK = 8_000


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
    return _combined(values, _series_matrix(values.shape[-1]))


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
    return _combined(values, _integration_matrix(values.shape[-1]))


def _combined(values: FloatArray, matrix: FloatArray) -> FloatArray:
    """Values (…, count) times the matrix (count, k), shape (k, …), whose first axis is the slowest."""
    functions = np.ascontiguousarray(values.reshape(-1, len(matrix)).T)
    # Not a matrix product: its rounding depends on the batch's size, and so would every tie that it decides.
    combined = np.einsum("im,ij->jm", functions, matrix)
    return combined.reshape(len(combined), *values.shape[:-1])


def evaluate(series: FloatArray, y: FloatArray, column: IndexArray | None = None) -> FloatArray:
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


class RunningIntegrals:
    """The running integrals of m functions with c components each, up to any limits.

    Parameters
    ----------
    values
        Shape (c, …, count): the functions at `nodes`.
    """

    def __init__(self, values: FloatArray) -> None:
        #: Shape (count + 1, c, m).
        self._series = running_integral(values.reshape(len(values), -1, values.shape[-1]))

    @property
    def components(self) -> int:
        """c."""
        return self._series.shape[1]

    @property
    def whole(self) -> FloatArray:
        """The integrals from −1 to 1, shape (c, m)."""
        return np.asarray(self._series.sum(axis=0))

    def component(self, number: int) -> RunningIntegrals:
        """One of the components alone."""
        taken = copy(self)
        taken._series = self._series[:, [number]]
        return taken

    def up_to(self, y: FloatArray) -> FloatArray:
        """The integrals of each function from −1 to as many limits y, shape (m, …): (c, m, …)."""
        _, c, m = self._series.shape
        limits = y.reshape(m, -1)
        result = np.empty((c, *limits.shape))
        size = -(-BLOCK // limits.shape[1])
        for begin in range(0, m, size):
            some = slice(begin, begin + size)
            # Functions last: there are many, and their coefficients are in a row.
            found = evaluate(self._series[:, :, None, some], np.ascontiguousarray(limits[some].T))
            result[:, some] = found.swapaxes(1, 2)
        return result.reshape(c, *y.shape)

    def single(self, y: FloatArray, column: IndexArray) -> FloatArray:
        """The integrals of the functions number ``column`` from −1 to one limit y each, (c, len(y))."""
        result = np.empty((self.components, y.size))
        for begin in range(0, y.size, BLOCK):
            some = slice(begin, begin + BLOCK)
            result[:, some] = evaluate(self._series, y[some], column[some])
        return result


def _with_slope(c: list[FloatArray], share: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A polynomial and its derivative by Horner's scheme."""
    slope, value = c[5], c[5] * share + c[4]
    for each in c[3::-1]:
        slope = slope * share + value
        value = value * share + each
    return value, slope
