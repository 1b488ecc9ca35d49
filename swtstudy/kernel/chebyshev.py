"""Chebyshev series: at Gauss points for panels over radius, at Lobatto points over time; Gauss quadrature."""

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
#: Shape (ORDER + 1, ORDER): values at the Gauss points → coefficients of the integral from -1.
RUN = _RUN @ FIT


def gauss_legendre(count):
    """Ascending nodes and weights of Gauss's quadrature on [-1, 1], by Newton's method.

    NumPy asks LAPACK for them, whose threads take longer to begin than all of these sums.
    """
    node = np.cos(np.pi * (np.arange(count, 0, -1) - 0.25) / (count + 0.5))
    for _ in range(5):
        before, value = np.ones(count), node
        for k in range(2, count + 1):
            before, value = value, ((2 * k - 1) * node * value - (k - 1) * before) / k
        slope = count * (before - node * value) / (1.0 - node * node)
        node = node - value / slope
    return node, 2.0 / ((1.0 - node * node) * slope * slope)


def _means():
    """Shape (3, ORDER, ORDER): values W at Gauss points → coefficients of ∫_0^1 tʲ W(ts) dt."""
    t, weight = gauss_legendre(ORDER)
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
    total = 1.0 / total
    for j in range(intervals + 1):
        weight[j] *= total


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


@jit
def vertex(y0, y1, y2, f0, f1, f2):
    """Place of the maximum of the parabola through three points, and its height; y1, f1 where it has none."""
    left, right = (f1 - f0) / (y1 - y0), (f2 - f1) / (y2 - y1)
    bend = (right - left) / (y2 - y0)
    if bend >= 0.0:
        return y1, f1
    slope = left + bend * (y1 - y0)  # at y1
    move = -0.5 * slope / bend
    return y1 + move, f1 - 0.25 * slope * slope / bend


@jit
def vertex_at_end(values, intervals, end):
    """Place of the maximum of a parabola from end 0 or `intervals` on; the end where it falls.

    The parabola has the series' value and slope at the end, and its value at the point beside it.
    """
    step = FINEST // intervals
    y, f = LOBATTO[end * step], values[end]
    sign, inwards = 1.0, 0.0  # the slope inwards
    for i in range(1, intervals + 1):
        j = i if end == 0 else intervals - i
        sign = -sign
        share = 1.0 if i == intervals else 2.0
        inwards += sign * share * (f - values[j]) / abs(LOBATTO[j * step] - y)
    if inwards <= 0.0:
        return y
    beside = 1 if end == 0 else intervals - 1
    width = LOBATTO[beside * step] - y
    drop = f - values[beside] + inwards * abs(width)  # bend times width² is minus that
    if drop <= 0.0:
        return y
    share = 0.5 * inwards * abs(width) / drop
    return y + min(share, 1.0) * width


@jit
def peak(values, intervals, node, weight, tolerance):
    """Place and value of the local maximum of the series through values at the Lobatto points.

    Newton's method for the root of the slope next to the largest value, that at `node`, until a step promises
    a rise by no more than the tolerance. weight has FINEST + 1 places.
    """
    step = FINEST // intervals
    best_y, best = LOBATTO[node * step], values[node]
    if node == 0 or node == intervals:
        y = vertex_at_end(values, intervals, node)
        if y == best_y:
            return best_y, best
        beside = LOBATTO[(1 if node == 0 else intervals - 1) * step]
        low, high = min(beside, best_y), max(beside, best_y)
    else:
        low, high = LOBATTO[(node - 1) * step], LOBATTO[(node + 1) * step]
        y = vertex(low, best_y, high, values[node - 1], best, values[node + 1])[0]
    for _ in range(12):
        barycentric(y, intervals, weight)
        f, slope, of_slope, of_chords = 0.0, 0.0, 0.0, 0.0
        for j in range(intervals + 1):
            f += weight[j] * values[j]
        if f > best:
            best_y, best = y, f
        for j in range(intervals + 1):
            gap = y - LOBATTO[j * step]
            if gap == 0.0:
                return best_y, best
            inverse = 1.0 / gap
            chord = (f - values[j]) * inverse
            slope += weight[j] * chord
            of_slope += weight[j] * inverse
            of_chords += weight[j] * inverse * chord
        bend = 2.0 * (slope * of_slope - of_chords)
        if slope > 0.0:
            low = y
        else:
            high = y
        move = -slope / bend if bend < 0.0 else high - low
        if 0.5 * abs(slope * move) <= tolerance:
            break
        y += move
        if not low < y < high:
            y = 0.5 * (low + high)
    return best_y, best
