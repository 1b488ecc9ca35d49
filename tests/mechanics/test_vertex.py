"""Maxima between known values: of parabolas, of polynomials, of curves sampled around an extreme."""

from __future__ import annotations

import numpy as np
import pytest

from swtstudy.mechanics.events.zoom import OFFSETS, STEPS, TimeBrackets
from swtstudy.mechanics.numerics.roots import parabola, polynomial_maximum, powers_from_values, vertex_near


def test_vertex_of_a_parabola_is_exact() -> None:
    x = np.array([-1.0, 0.0, 1.0])
    left, middle, right = 5.0 - 3.0 * (x - 0.2) ** 2
    shift, rise = parabola(left, middle, right)
    assert shift == pytest.approx(0.2, abs=1e-15)
    assert middle + rise == pytest.approx(5.0, abs=1e-15)


def test_a_corner_has_a_parabola_on_each_side() -> None:
    c = np.array([[-0.75, -0.25, 0.0, 0.25, 0.75]])
    left, right = 1.0 + c, 1.0 - (c - 0.1) ** 2 + 0.01
    values = np.where(c <= 0.0, left, right)
    best = values.argmax(axis=1)
    position, top = vertex_near(c, values, best, np.array([True]))
    assert best == [2]
    assert position[0] == pytest.approx(0.1, abs=1e-12)
    assert top[0] == pytest.approx(1.01, abs=1e-12)


def test_maximum_of_a_polynomial() -> None:
    nodes = np.linspace(-1.0, 1.0, 5)
    # x − x⁴ has its maximum at 4^(−1/3).
    series = powers_from_values(nodes) @ (nodes - nodes**4)
    np.testing.assert_allclose(series, [0.0, 1.0, 0.0, 0.0, -1.0], rtol=0.0, atol=1e-14)
    place = 4.0 ** (-1.0 / 3.0)
    found = polynomial_maximum(series[:, None], np.array([0.6]), np.array([0.0]), np.array([1.0]))
    assert found[0] == pytest.approx(place, abs=1e-5)
    # It stays within the range that it is given.
    found = polynomial_maximum(series[:, None], np.array([0.4]), np.array([0.3]), np.array([0.5]))
    assert found[0] == 0.5


def brackets(corner: bool) -> TimeBrackets:
    """One bracket, −1 ≤ c ≤ 1."""
    side = np.zeros((1, 1, 1, 2))
    flags = np.full((1, 1, 1), corner)
    return TimeBrackets(side, side, side.astype(int), side, 1.0, side, flags, np.zeros((1, 1, 1)), 1.0)


def peak(corner: bool, curve: np.ndarray) -> float:
    """Interpolated maximum of the samples of one bracket."""
    weights = brackets(corner).weights_at_peak(curve[None, None, None])
    assert weights.sum() == pytest.approx(1.0, abs=1e-12)
    return float((weights * curve).sum())


@pytest.mark.parametrize("place", [-0.71, -0.2, 0.0, 0.43, 0.9])
def test_a_smooth_peak_between_samples(place: float) -> None:
    curve = np.cos(OFFSETS - place)
    assert curve.max() < 1.0 - 1e-4 or place == 0.0
    assert peak(False, curve) == pytest.approx(1.0, abs=1e-5)


def test_a_corner_itself_is_not_rounded_off() -> None:
    assert peak(True, 1.0 - np.abs(OFFSETS)) == 1.0


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_peak_beside_a_corner_is_that_of_its_own_side(side: float) -> None:
    here = side * OFFSETS >= 0.0
    curve = np.where(here, np.cos(OFFSETS - 0.45 * side), np.cos(0.45) - 2.0 * np.abs(OFFSETS))
    assert peak(True, curve) == pytest.approx(1.0, abs=2e-3)


def test_a_curve_that_is_flat_up_to_a_corner_is_not_overshot() -> None:
    curve = np.where(OFFSETS > 0.0, -0.01 * np.abs(OFFSETS) ** 3, 0.0)
    assert peak(True, curve) == pytest.approx(0.0, abs=1e-4)
    assert peak(True, curve[::-1]) == pytest.approx(0.0, abs=1e-4)
    # Rounding decides which of the equal samples is the largest.
    for largest in range(STEPS + 1):
        assert peak(True, curve + 1e-17 * (np.arange(len(curve)) == largest)) == pytest.approx(0.0, abs=1e-4)
