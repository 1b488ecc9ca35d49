"""Loads of the compiled kernel: what they are at each instant, and what follows from them."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from swtstudy.kernel.load import bulk_at, largest_bulk, load_at, rates_at, smallest_bulk
from swtstudy.kernel.loads import bimodal, polygon

pytestmark = pytest.mark.xdist_group("kernel")


@pytest.mark.parametrize("ratio", ["1", "3/2", "2/3"])
def test_bulk_stress_oscillates_with_the_tangential_load(ratio: str) -> None:
    p, q = Fraction(ratio).as_integer_ratio()
    load = bimodal(0.4, Fraction(ratio), 0.3, 1.1, bulk_amplitude=0.02, bulk_mean=-0.01, bulk_phase=0.7)
    for t in np.linspace(0.0, 9.0, 7):
        assert bulk_at(load, t) == pytest.approx(-0.01 + 0.02 * np.sin(p * t + 0.7), abs=1e-15)
        n, v = load_at(load, t)
        assert n == pytest.approx(1.0 + 0.4 * np.sin(q * t + 1.1), abs=1e-14)
        assert v == pytest.approx(0.3 * np.sin(p * t), abs=1e-14)
    assert (smallest_bulk(load), largest_bulk(load)) == pytest.approx((-0.03, 0.01))
    assert not load["mirrored"]


def test_bulk_stress_of_a_polygon() -> None:
    load = polygon([1.0, 1.5, 1.0], [0.0, 0.2, -0.3], [0.01, 0.03, -0.02])
    assert [bulk_at(load, t) for t in (0.0, 0.5, 1.0, 2.5, 3.5)] == pytest.approx(
        [0.01, 0.02, 0.03, -0.005, 0.02]
    )
    assert (smallest_bulk(load), largest_bulk(load)) == (-0.02, 0.03)
    assert rates_at(load, 0.5)[2:4] == pytest.approx((0.5, 0.2))
