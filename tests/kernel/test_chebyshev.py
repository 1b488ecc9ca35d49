"""Chebyshev series through values at Gauss and at Lobatto points, against NumPy's."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev as of_numpy

from swtstudy.kernel import chebyshev
from swtstudy.kernel.chebyshev import FINEST, GAUSS, LOBATTO, MEANS, ORDER, RUN

pytestmark = pytest.mark.xdist_group("kernel")
INTERVALS = (2, 4, 8, 16, FINEST)


def lobatto(intervals):
    """Lobatto points of a part, (intervals + 1,)."""
    return LOBATTO[:: FINEST // intervals]


def series_through(values):
    """Coefficients of the polynomial through values at Lobatto points."""
    return of_numpy.chebfit(lobatto(len(values) - 1), values, len(values) - 1)


def padded(values):
    """Values in an array of FINEST + 1 places: the kernel's functions find the rest of these unused."""
    return np.append(values, np.full(FINEST + 1 - len(values), np.nan))


def highest(series, first, last):
    """Place and height of the maximum of a series between two places, by a dense look."""
    y = np.linspace(first, last, 100_001)
    values = of_numpy.chebval(y, series)
    return y[values.argmax()], values.max()


def test_quadrature_of_gauss():
    for count in (1, 2, 7, 40):
        node, weight = chebyshev.gauss_legendre(count)
        expected = np.polynomial.legendre.leggauss(count)
        np.testing.assert_allclose([node, weight], expected, rtol=1e-13, atol=1e-14)


def test_series_through_values_at_gauss_points():
    series, values = np.empty(ORDER), np.exp(GAUSS)
    chebyshev.fit(values, series)
    for y in np.linspace(-1.0, 1.0, 7):
        assert chebyshev.clenshaw(series, y) == pytest.approx(of_numpy.chebval(y, series), rel=1e-14)
        assert chebyshev.clenshaw(series, y) == pytest.approx(np.exp(y), abs=2e-9)
        assert chebyshev.clenshaw(RUN @ values, y) == pytest.approx(np.exp(y) - np.exp(-1.0), abs=2e-9)


@pytest.mark.parametrize("j", range(3))
def test_means_of_what_lies_beneath(j):
    """∫_0^1 t^j W(ts) dt, with W = y + 1 of [-1, 1] and s in [0, 2]."""
    for y in (-0.9, 0.2, 1.0):
        found = of_numpy.chebval(y, MEANS[j] @ (GAUSS + 1.0))
        assert found == pytest.approx((y + 1.0) / (j + 2.0), rel=1e-12)


@pytest.mark.parametrize("intervals", INTERVALS)
def test_interpolation_at_lobatto_points(intervals):
    values, weight = np.random.default_rng(intervals).normal(size=intervals + 1), np.empty(FINEST + 1)
    for y in (*np.linspace(-1.0, 1.0, 9), *lobatto(intervals)):
        chebyshev.barycentric(y, intervals, weight)
        assert weight[: intervals + 1] @ values == pytest.approx(
            of_numpy.chebval(y, series_through(values)), abs=1e-11
        )


@pytest.mark.parametrize("intervals", INTERVALS)
def test_last_coefficients(intervals):
    values = np.random.default_rng(intervals).normal(size=intervals + 1)
    last, before = series_through(values)[[-1, -2]]
    assert chebyshev.tail(padded(values), intervals) == pytest.approx(abs(last) + abs(before), rel=1e-10)


def test_vertex_of_a_parabola():
    top, height, bend = 0.3, 1.7, 2.5
    y = np.array([-0.5, 0.125, 0.5])
    assert chebyshev.vertex(*y, *(height - bend * (y - top) ** 2)) == pytest.approx((top, height))
    straight = 1.0 + 0.5 * y
    assert chebyshev.vertex(*y, *straight) == (y[1], straight[1])
    hollow = height + bend * (y - top) ** 2
    assert chebyshev.vertex(*y, *hollow) == (y[1], hollow[1])


@pytest.mark.parametrize("intervals", [4, FINEST])
@pytest.mark.parametrize("side", [-1, 1])
def test_vertex_beside_an_end(intervals, side):
    """Of a parabola, which the interpolation has exactly."""
    end, y = (0 if side < 0 else intervals), lobatto(intervals)
    width = abs(y[1] - y[0])
    for inwards, expected in ((0.3, 0.3), (1.5, 1.0), (-0.2, 0.0)):
        values = -((y - side * (1.0 - inwards * width)) ** 2)
        found = chebyshev.vertex_at_end(padded(values), intervals, end)
        assert found == pytest.approx(side * (1.0 - expected * width), abs=1e-9)
    hollow = (y + side) ** 2
    assert chebyshev.vertex_at_end(padded(hollow), intervals, end) == side


@pytest.mark.parametrize("intervals", INTERVALS)
@pytest.mark.parametrize("seed", range(6))
def test_peak_of_a_series(intervals, seed):
    """The largest value between the points beside the largest one at a Lobatto point."""
    rng = np.random.default_rng(seed)
    series = rng.normal(size=min(intervals, 6) + 1) * 0.6 ** np.arange(min(intervals, 6) + 1)
    values = of_numpy.chebval(lobatto(intervals), series)
    node = int(values.argmax())
    place, height = highest(series, *lobatto(intervals)[[max(node - 1, 0), min(node + 1, intervals)]])
    found = chebyshev.peak(padded(values), intervals, node, np.empty(FINEST + 1), 1e-12)
    assert found[1] == pytest.approx(height, abs=1e-9)
    assert found[0] == pytest.approx(place, abs=1e-4)
