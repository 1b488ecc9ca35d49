"""Measures of how curves vary."""

import math

import numpy as np
import pytest
from made_up import PHASES, made_up

from swtstudy.paper.statements.measures import (
    NotInArchiveError,
    coupling,
    even,
    largest_change,
    period,
    turning_points,
)


def test_measures():
    curve = made_up(lambda friction: friction**2, friction=[0.1, 0.2, 0.3])
    assert largest_change(curve, "friction", -1) == 0
    assert largest_change(curve, "friction", 1) == pytest.approx(3, abs=1e-3)
    assert largest_change(curve.isel(friction=[2, 0, 1]), "friction", -1) == 0
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


@pytest.mark.parametrize(
    ("places", "more"),
    [
        (np.linspace(0.0, 2 * np.pi, 145), [1.5517, 2.6308, 2.6308 + np.pi, 2.631]),
        (np.geomspace(0.002, 0.05, 201), [0.002377, 0.028078]),
        (np.linspace(1.0, 4.0, 4), []),
        (np.array([0.3, 0.1]), []),
    ],
)
def test_values_put_in_among_equal_steps_or_ratios_are_told_from_these(places, more):
    curve = made_up(lambda phase: 2 + phase, phase=[*more, *places])
    np.testing.assert_array_equal(even(curve, "phase").phase, np.sort(places) if more else places)
    with pytest.raises(NotInArchiveError, match="no axis friction"):
        even(curve, "friction")


def test_an_axis_without_equal_steps_is_left_as_it_is():
    curve = made_up(lambda phase: 2 + phase, phase=[0.0, 0.3, 1.0, 1.1])
    assert even(curve, "phase") is curve


def test_a_constant_has_no_period():
    assert period(np.ones(49)) == math.inf


def test_turning_points_leave_out_ripples_and_ends():
    x = np.linspace(0, 6 * np.pi, 601)
    curve = np.sin(x) + 0.01 * np.sin(40 * x)
    assert x[turning_points(curve, 0.2)] == pytest.approx(np.pi * np.arange(0.5, 6), abs=0.1)
    assert turning_points(x, 0.2) == []
