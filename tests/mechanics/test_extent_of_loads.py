"""What loads say of their extent and symmetry, against samples of their cycles."""

from __future__ import annotations

import numpy as np
import pytest

from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.harmonic_sum import HarmonicSum
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.load.polygon import PolygonLoad
from swtstudy.mechanics.load.smooth import SmoothLoad

AMPLITUDES = np.array([0.4, 0.7]), np.array([0.3, 0.9])


def harmonics(*rows: tuple[int, float, float]) -> HarmonicSum:
    order, amplitude, phase = np.array(rows).T
    return HarmonicSum(order.astype(np.int64), amplitude, phase)


EVEN, ODD = harmonics((2, 0.8, 0.3), (4, 0.3, 1.0)), harmonics((1, 0.9, 0.0), (3, 0.5, 2.0))
SUMS = {
    "even, odd": SmoothLoad(EVEN, ODD, *AMPLITUDES),
    "even, even": SmoothLoad(EVEN, EVEN, *AMPLITUDES),
    "odd, odd": SmoothLoad(ODD, ODD, *AMPLITUDES),
    "mean, odd": SmoothLoad(harmonics((0, 0.2, 1.0), (2, 0.7, 0.0)), ODD, *AMPLITUDES),
}
LOADS = {
    **SUMS,
    "3/2": BimodalLoad(*AMPLITUDES, np.array([0.4, 2.0]), 3, 2),
    "2/3": BimodalLoad(*AMPLITUDES, np.array([0.4, 2.0]), 2, 3),
    "polygon": PolygonLoad.of([np.array([[1.5, 0.2], [0.4, -0.3], [0.9, 0.8]]), np.eye(2)]),
}


@pytest.mark.parametrize("load", LOADS.values(), ids=LOADS.keys())
def test_ends_and_motion_are_those_of_the_cycle(load: Load) -> None:
    instant = np.repeat(np.linspace(0.0, 2.0 * np.pi, 6001)[None], 2, axis=0)
    normal, tangential = load.normal(instant), load.tangential(instant)
    np.testing.assert_allclose(load.least_normal, normal.min(axis=1), atol=1e-5)
    np.testing.assert_allclose(load.largest_normal, normal.max(axis=1), atol=1e-5)
    motion = 0.5 * (np.ptp(normal, axis=1) + np.ptp(tangential, axis=1))
    np.testing.assert_allclose(load.motion, motion, atol=1e-5)
    np.testing.assert_allclose(load.normal_motion, 0.5 * np.ptp(normal, axis=1), atol=1e-5)
    assert load.moves_tangentially.all()


@pytest.mark.parametrize("name", [name for name in LOADS if name != "polygon"])
def test_the_second_half_mirrors_the_first_where_it_says_so(name: str) -> None:
    load = LOADS[name]
    instant = np.repeat(np.linspace(0.0, np.pi, 101)[None], 2, axis=0)
    later = instant + np.pi
    same = np.allclose(load.normal(later), load.normal(instant), atol=1e-12)
    turned = np.allclose(load.tangential(later), -load.tangential(instant), atol=1e-12)
    assert load.mirrored_half == (same and turned)
    assert load.mirrored_half == (name in ("even, odd", "mean, odd", "3/2"))


def test_a_sum_without_motion_ends_where_it_is() -> None:
    still = harmonics((0, 0.7, 0.5 * np.pi), (2, 0.0, 0.3))
    assert still.ends == pytest.approx((0.7, 0.7), rel=1e-15)
    np.testing.assert_array_equal(still.stretch(np.linspace(0.0, 6.0, 4)), 0)


def test_the_inverse_of_a_sum_of_many_harmonics_has_all_digits() -> None:
    one = harmonics((1, 1.0, 0.2), (5, 0.15, 1.0), (7, 0.04, 2.0))
    for stretch, begin in enumerate(one.turns):
        end = np.append(one.turns, one.turns[0] + 2.0 * np.pi)[stretch + 1]
        instant = begin + (end - begin) * np.linspace(0.05, 0.95, 40)
        found = one.inverse(one.value(instant), np.full(40, stretch))
        np.testing.assert_allclose(found, instant, rtol=0.0, atol=1e-11)
