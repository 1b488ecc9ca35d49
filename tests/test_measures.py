"""Measures of how curves vary."""

import math

import numpy as np
import pytest
from made_up import PHASES, made_up

from swtstudy.statements.measures import coupling, largest_fall, largest_rise, period, turning_points


def test_measures():
    curve = made_up(lambda friction: friction**2, friction=[0.1, 0.2, 0.3])
    assert largest_fall(curve, "friction") == 0
    assert largest_rise(curve, "friction") == pytest.approx(3, abs=1e-3)
    assert largest_fall(curve.isel(friction=[2, 0, 1]), "friction") == 0
    product = made_up(
        lambda friction, phase: friction * (2 + np.cos(phase)), friction=[1.0, 2.0], phase=PHASES
    )
    assert coupling(product.s, "friction") < 1e-20
    coupled = made_up(lambda friction, phase: 2 + np.cos(friction * phase), friction=[1.0, 2.0], phase=PHASES)
    assert coupling(coupled.s, "friction") > 0.3


@pytest.mark.parametrize("waves", [1, 2, 3, 4, 6])
def test_the_period_is_found_with_kinks_and_without(waves):
    assert period(2 + np.cos(waves * PHASES)) == pytest.approx(2 * np.pi / waves)
    assert period(2 + abs(np.cos(waves * PHASES / 2 - 0.3))) == pytest.approx(2 * np.pi / waves)


def test_a_constant_has_no_period():
    assert period(np.ones(49)) == math.inf


def test_turning_points_leave_out_ripples_and_ends():
    x = np.linspace(0, 6 * np.pi, 601)
    curve = np.sin(x) + 0.01 * np.sin(40 * x)
    assert x[turning_points(curve, 0.2)] == pytest.approx(np.pi * np.arange(0.5, 6), abs=0.1)
    assert turning_points(x, 0.2) == []
