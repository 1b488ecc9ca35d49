"""Chebyshev series: at Gauss points for panels over radius, at Lobatto points over time."""

import numpy as np

from swtstudy.kernel.compiled import jit

#: Coefficients of a series over one panel.
ORDER = 10
_k, _z = np.arange(ORDER), np.arange(ORDER) + 0.5
#: Shape (ORDER,): Gauss points on [-1, 1], descending.
GAUSS = np.cos(np.pi * _z / ORDER)
#: Shape (ORDER, ORDER): values at the Gauss points → coefficients.
FIT = 2.0 / ORDER * np.cos(np.pi * np.outer(_k, _z) / ORDER)
FIT[0] /= 2.0
_RUN = np.polynomial.chebyshev.chebint(np.eye(ORDER), lbnd=-1, axis=0)
#: Shape (ORDER, ORDER + 1): values at the Gauss points → coefficients of the integral from -1.
RUN = np.ascontiguousarray((_RUN @ FIT).T)


def _means():
    """Shape (3, ORDER, ORDER): values W at Gauss points → coefficients of ∫_0^1 tʲ W(ts) dt."""
    t, weight = np.polynomial.legendre.leggauss(ORDER)
    t, weight = 0.5 * (1.0 + t), 0.5 * weight
    series_at = np.polynomial.chebyshev.chebvander(t * (GAUSS[:, None] + 1.0) - 1.0, ORDER - 1)
    means = [FIT @ np.einsum("q,iqk->ik", weight * t**j, series_at) @ FIT for j in range(3)]
    return np.ascontiguousarray(means)


#: With W the density over s^j, sʲ⁺¹ times this mean is its integral from s = 0, exact to rounding at any s.
MEANS = _means()

#: Most intervals of a smooth part of the load cycle; the Lobatto points of fewer intervals are among these.
FINEST = 32
#: Shape (FINEST + 1,): Lobatto points on [-1, 1], ascending.
LOBATTO = -np.cos(np.pi * np.arange(FINEST + 1) / FINEST)


@jit
def clenshaw(series, y):
    """Sum of a Chebyshev series at y in [-1, 1]."""
    b1 = 0.0
    b2 = 0.0
    twice = 2.0 * y
    for k in range(series.shape[0] - 1, 0, -1):
        b1, b2 = series[k] + twice * b1 - b2, b1
    return series[0] + y * b1 - b2


@jit
def fit(values, series):
    """Write the coefficients of the series through values at the Gauss points."""
    for i in range(ORDER):
        total = 0.0
        for j in range(ORDER):
            total += FIT[i, j] * values[j]
        series[i] = total


@jit
def panel_of(edges, first, last, s):
    """Index of the panel in [first, last) that holds s; edges[p] is the lower end of panel p."""
    while last - first > 1:
        middle = (first + last) >> 1
        if s < edges[middle]:
            last = middle
        else:
            first = middle
    return first


@jit
def barycentric(y, intervals, weight):
    """Write the weights that interpolate values at the Lobatto points at y; weight has FINEST + 1 places."""
    step = FINEST // intervals
    total = 0.0
    sign = 1.0
    for j in range(intervals + 1):
        gap = y - LOBATTO[j * step]
        if gap == 0.0:
            for i in range(intervals + 1):
                weight[i] = 0.0
            weight[j] = 1.0
            return
        weight[j] = sign / gap
        if j == 0 or j == intervals:
            weight[j] *= 0.5
        total += weight[j]
        sign = -sign
    for j in range(intervals + 1):
        weight[j] /= total


@jit
def tail(values, intervals):
    """Size of the last two coefficients of the series through values at the Lobatto points."""
    step = FINEST // intervals
    last, before, sign = 0.0, 0.0, 1.0
    for j in range(intervals + 1):
        term = sign * values[j]
        if j == 0 or j == intervals:
            term *= 0.5
        last += term
        before -= LOBATTO[j * step] * term
        sign = -sign
    return (abs(last) + 2.0 * abs(before)) / intervals
