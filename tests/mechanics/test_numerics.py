"""The small numerical tools, each against NumPy's slow way or a closed form."""

from __future__ import annotations

import numpy as np
import pytest

from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import (
    RowTable,
    align,
    as_rows,
    between,
    count_below,
    distinct,
    filled_rows,
    gather,
    hemisphere,
    packed,
    pick,
)
from swtstudy.mechanics.numerics.roots import (
    near_maximum,
    parabola,
    parabola_maximum,
    polynomial_maximum,
    sign_changes,
    vertex_near,
)

RNG = np.random.default_rng(7)


def test_entries_that_are_listed_row_by_row_are_rows():
    index, real = as_rows(np.array([0, 0, 2, 3, 3, 3]), np.array([3, 0, 2]))
    assert index.tolist() == [[3, 4, 5], [0, 1, 1], [2, 2, 2]]
    assert real.tolist() == [[True] * 3, [True, True, False], [True, False, False]]


def test_gather_and_pick_are_numpys() -> None:
    values = RNG.normal(size=(4, 3, 5))
    index = RNG.integers(5, size=(4, 3, 2))
    np.testing.assert_array_equal(gather(values, index), np.take_along_axis(values, index, axis=-1))
    more = RNG.integers(5, size=(6, 4, 3, 2))
    for found, each in zip(gather(values, more), more, strict=True):
        np.testing.assert_array_equal(found, np.take_along_axis(values, each, axis=-1))
    one = index[..., 0]
    np.testing.assert_array_equal(pick(values, one), gather(values, one[..., None])[..., 0])


def test_tables_of_many_rows_are_numpys_interpolation() -> None:
    abscissa, value = np.sort(RNG.normal(size=(5, 8)), axis=1), RNG.normal(size=(5, 8))
    row, at = np.array([3, 0, 3, 4])[:, None], RNG.normal(size=(4, 60))
    at[:, :8] = abscissa[row[:, 0]]
    expected = [np.interp(x, abscissa[k], value[k]) for k, x in zip(row[:, 0], at, strict=True)]
    np.testing.assert_allclose(RowTable(abscissa, value).interpolated(row, at), expected, rtol=1e-13)


def test_values_below_a_level_are_counted() -> None:
    values = np.where(RNG.random((4, 3, 5)) < 0.2, np.inf, RNG.integers(6, size=(4, 3, 5)))
    row, level = RNG.integers(12, size=40), RNG.integers(6, size=40).astype(float)
    expected = [np.sum(values.reshape(12, 5)[k] < at) for k, at in zip(row, level, strict=True)]
    np.testing.assert_array_equal(count_below(values, row, level), expected)


def test_rows_are_packed_and_filled() -> None:
    keep = np.array([[True, False, True, True], [False, True, False, False]])
    values = np.arange(8.0).reshape(2, 4)
    found, other = packed(keep, values, 10.0 * values)
    assert found.tolist() == [[0.0, 2.0, 3.0], [5.0, 5.0, 5.0]]
    assert other.tolist() == [[0.0, 20.0, 30.0], [50.0, 50.0, 50.0]]
    row, ragged = np.array([2, 0, 2, 2]), np.array([1.0, 2.0, 3.0, 4.0])
    assert filled_rows(row, ragged, 4, -1.0).tolist() == [
        [2.0, -1.0, -1.0],
        [-1.0, -1.0, -1.0],
        [1.0, 3.0, 4.0],
        [-1.0, -1.0, -1.0],
    ]
    assert filled_rows(np.array([], int), np.array([]), 2, 7.0).tolist() == [[7.0], [7.0]]
    assert align(np.zeros((2, 3)), np.zeros((2, 3, 4, 5))).shape == (2, 3, 1, 1)


def test_distinct_values_of_each_row() -> None:
    values = np.array([[3.0, 1.0, 3.0, 2.0], [5.0, 5.0, 5.0, 5.0]])
    found, number = distinct(values)
    assert found.tolist() == [[1.0, 2.0, 3.0], [5.0, 5.0, 5.0]]
    assert number.tolist() == [[2, 0, 2, 1], [0, 0, 0, 0]]
    np.testing.assert_array_equal(np.take_along_axis(found, number, axis=1), values)


def test_running_integrals() -> None:
    """Of eˣ and x³ from −1 on; 16 nodes have them to rounding."""
    nodes = chebyshev.nodes(16)
    assert np.all(np.diff(nodes) > 0.0)
    assert nodes[0] == pytest.approx(-np.cos(np.pi / 32))
    series = chebyshev.running_integral(np.stack([np.exp(nodes), nodes**3]))
    assert series.shape == (17, 2)
    y = np.array([-1.0, -0.4, 0.3, 1.0])
    expected = np.stack([np.exp(y) - np.exp(-1.0), (y**4 - 1.0) / 4.0], axis=-1)
    np.testing.assert_allclose(chebyshev.evaluate(series, y[:, None]), expected, rtol=0.0, atol=1e-14)
    chosen = np.array([1, 0, 0, 1])
    found = chebyshev.evaluate(series, y, chosen)
    np.testing.assert_allclose(found, expected[np.arange(4), chosen], rtol=0.0, atol=1e-14)
    line = chebyshev.running_integral(np.ones((1, 1)))
    np.testing.assert_allclose(chebyshev.evaluate(line, y[:, None])[:, 0], y + 1.0, atol=1e-15)


@pytest.mark.parametrize("limits", [3, 2 * chebyshev.BLOCK // 5])
def test_running_integrals_of_many_functions(limits: int) -> None:
    """Two components of five functions up to many limits, in blocks, to the bit as one at a time."""
    rng = np.random.default_rng(limits)
    values, y = rng.uniform(size=(2, 5, 9)), rng.uniform(-1.0, 1.0, size=(5, 1, limits))
    y[2, 0, :2] = -1.0, 1.0
    series, integrals = chebyshev.running_integral(values), chebyshev.RunningIntegrals(values)
    expected = np.stack([chebyshev.evaluate(series[:, :, m, None], y[m, 0]) for m in range(5)], axis=1)
    found = integrals.up_to(y)
    assert found.shape == (2, 5, 1, limits)
    np.testing.assert_array_equal(found[:, :, 0], expected)
    np.testing.assert_array_equal(integrals.component(1).up_to(y)[0], found[1])
    column = np.repeat(np.arange(5), limits)[::-1]
    single = integrals.single(y.ravel()[::-1], column)
    np.testing.assert_array_equal(single[:, ::-1], found.reshape(2, -1))


def test_places_are_dense_at_both_ends() -> None:
    found = between(np.array(2.0), np.array(6.0), np.pi * np.array([0.0, 1 / 3, 0.5, 1.0]))
    np.testing.assert_allclose(found, [2.0, 3.0, 4.0, 6.0])


def test_normals_are_evenly_spread() -> None:
    normals = hemisphere(400)
    assert normals.shape == (400, 3)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
    assert np.all(normals[:, 2] > 0.0)
    # Moments of the even half sphere: ⟨z⟩ = 1/2, ⟨x²⟩ = ⟨y²⟩ = ⟨z²⟩ = 1/3, the others 0.
    np.testing.assert_allclose(normals.mean(axis=0), [0.0, 0.0, 0.5], atol=2e-3)
    np.testing.assert_allclose(normals.T @ normals / 400, np.eye(3) / 3.0, atol=2e-3)
    cosine = np.abs(normals @ normals.T) - 2.0 * np.eye(400)
    nearest = np.arccos(np.minimum(cosine.max(axis=1), 1.0))
    spacing = np.sqrt(2.0 * np.pi / 400)
    assert 0.4 * spacing < nearest.min()
    assert nearest.max() < 1.3 * spacing


@pytest.mark.parametrize(
    ("values", "shift", "rise"),
    [
        ((0.0, 1.0, 0.0), 0.0, 0.0),
        ((0.0, 1.0, 1.0), 0.5, 0.125),
        ((1.0, 1.0, 0.0), -0.5, 0.125),
        ((0.0, 3.0, 4.0), 1.0, 1.0),
        ((0.0, 2.0, 3.0), 0.0, 0.0),  # its vertex, 1.5 away, is out of reach
        ((1.0, 0.0, 1.0), 0.0, 0.0),
        ((1.0, 1.0, 1.0), 0.0, 0.0),
    ],
)
def test_vertices_within_a_step(values, shift, rise) -> None:
    found = parabola(*map(np.array, values))
    assert (float(found[0]), float(found[1])) == pytest.approx((shift, rise))


def test_near_the_maximum_is_a_share_of_the_range() -> None:
    curve = np.array([[1.0, 4.49, 4.51, 5.0, 3.0], [-1.0, -1.0, -1.0, -1.0, -1.0]])
    found = near_maximum(curve, 0.125)
    assert found.tolist() == [[False, False, True, True, False], [True] * 5]


def test_the_top_of_a_cubic() -> None:
    """x − x³/3 has its maximum at 1; a curve that bends upwards has none, and stays."""
    series = np.array([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1 / 3, 0.0]])
    start, low, high = np.array([0.9, 0.2]), np.array([-2.0, -2.0]), np.array([2.0, 2.0])
    found = polynomial_maximum(series, start, low, high)
    assert found[0] == pytest.approx(1.0, abs=2e-5)  # two steps of Newton's: 0.1 → 0.0056 → 1.5e-5
    assert found[1] == 0.2
    once = polynomial_maximum(series[:, :1], np.array([0.9]), np.array([0.0]), np.array([0.95]))
    assert once[0] == 0.95


def test_the_top_between_uneven_places() -> None:
    c = np.array([[0.0, 1.0, 1.5, 3.0]])
    for top in (0.9, 1.2, 1.4):
        values = 2.0 - (c - top) ** 2
        place, height = vertex_near(c, values, values.argmax(axis=1), np.array([False]))
        assert place[0] == pytest.approx(top)
        assert height[0] == pytest.approx(2.0)
    # At an end, the last parabola within its range.
    values = 2.0 - (c - 4.0) ** 2
    place, height = vertex_near(c, values, values.argmax(axis=1), np.array([False]))
    assert (place[0], height[0]) == (3.0, 1.0)


@pytest.mark.parametrize("roots", [(1.33, 1.71), (1.51, 1.56), (1.47, 1.53), (1.33, 3.0), (3.0, 4.0)])
def test_sign_changes_find_two_zeros_of_one_cell_too(roots) -> None:
    """Every zero is in a range, and every range has one."""
    grid = np.linspace(1.0, 2.0, 11)
    values = (grid - roots[0]) * (grid - roots[1])
    row, low, high = sign_changes(grid, np.stack([np.ones(11), values, -values]))
    assert np.all(row > 0)
    inside = (low[:, None] < roots) & (roots < high[:, None])
    assert np.all(inside.sum(axis=1) == 1)
    for function in (1, 2):
        assert inside[row == function].any(axis=0).tolist() == [root < 2.0 for root in roots]
    assert np.all(high - low < 0.2)


def test_a_parabola_through_places_that_coincide_is_its_largest_value() -> None:
    x = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 2.0]])
    y = np.array([[1.0, 3.0, 2.0], [1.0, 2.0, 3.0], [0.0, 3.0, 2.0]])
    with np.errstate(all="raise"):
        place, height = parabola_maximum(x, y)
    # The last is y = 5 x − 2 x².
    np.testing.assert_allclose(place, [0.0, 1.0, 1.25])
    np.testing.assert_allclose(height, [3.0, 3.0, 3.125])
