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


class EvenTable:
    """n functions on [0, end], each as quintic polynomials with its values and two derivatives at even nodes.

    Parameters
    ----------
    end
        Shape (n,).
    value, slope, bend
        Shape (n, k + 1): at the nodes.
    """

    def __init__(self, end: FloatArray, value: FloatArray, slope: FloatArray, bend: FloatArray) -> None:
        self._cells = value.shape[1] - 1
        #: Cells in a unit of the abscissa.
        self._density = self._cells / end
        first, second = slope / self._density[:, None], bend / self._density[:, None] ** 2
        rise, f, g = np.diff(value), first[:, :-1], first[:, 1:]
        p, q = 0.5 * second[:, :-1], 0.5 * second[:, 1:]
        powers = (
            value[:, :-1],
            f,
            p,
            10.0 * rise - 6.0 * f - 4.0 * g - 3.0 * p + q,
            -15.0 * rise + 8.0 * f + 7.0 * g + 3.0 * p - 2.0 * q,
            6.0 * rise - 3.0 * (f + g) - p + q,
        )
        #: Coefficients of each cell, in powers of the share of it that is passed.
        self._coefficients = np.stack(powers, axis=-1).reshape(-1, len(powers))

    def __call__(self, row: IndexArray, at: FloatArray) -> FloatArray:
        """The functions number ``row`` at (…)."""
        c, share, _ = self._cell(row, at)
        value = c[5] * share
        for each in c[4:0:-1]:
            value += each
            value *= share
        value += c[0]
        return value

    def with_slope(self, row: IndexArray, at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The functions and their derivatives."""
        c, share, density = self._cell(row, at)
        value, slope = _with_slope(c, share)
        return value, slope * density

    def with_derivatives(self, row: IndexArray, at: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The functions and two derivatives."""
        c, share, density = self._cell(row, at)
        value, slope = _with_slope(c, share)
        bend = ((20.0 * c[5] * share + 12.0 * c[4]) * share + 6.0 * c[3]) * share + 2.0 * c[2]
        return value, slope * density, bend * density * density

    def _cell(self, row: IndexArray, at: FloatArray) -> tuple[list[FloatArray], FloatArray, FloatArray]:
        """Coefficients of the cells, the shares of them that are passed, and the density of cells."""
        density = self._density.take(row)
        place = at * density
        cell = np.minimum(place.astype(np.intp), self._cells - 1)
        own = self._coefficients.take(row * self._cells + cell, axis=0)
        return [own[..., k] for k in range(own.shape[-1])], place - cell, density


def _with_slope(c: list[FloatArray], share: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A polynomial and its derivative by Horner's scheme."""
    slope, value = c[5], c[5] * share + c[4]
    for each in c[3::-1]:
        slope = slope * share + value
        value = value * share + each
    return value, slope
