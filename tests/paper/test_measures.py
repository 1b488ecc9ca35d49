"""Measures of how curves vary."""

import math

import numpy as np
import pytest

from swtstudy.paper.measures import period

TURN = np.linspace(0.0, 2 * np.pi, 65)


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-7])
def test_period_of_a_curve_however_little_it_varies(size):
    assert period(1.0 + size * (np.sin(4 * TURN) + 0.3 * np.sin(6 * TURN))) == pytest.approx(math.pi)
    assert period(1.0 + size * (np.sin(4 * TURN) + 0.01 * np.sin(6 * TURN))) == pytest.approx(math.pi / 2)


def test_a_curve_that_varies_by_rounding_alone_is_constant():
    assert period(1.0 + 1e-13 * np.sin(3 * TURN)) == math.inf
