"""Where monotone functions reach a goal."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.roots import Brackets, monotone_roots
from swtstudy.mechanics.points import FloatArray

LOW, HIGH = np.array([0.0, -1.0, 0.2]), np.array([0.5 * np.pi, 1.2, 1.4])


def sine(x: FloatArray, _: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, FloatArray]:
    return np.sin(x), np.cos(x), -np.sin(x)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_goals_are_reached(sign: float) -> None:
    def function(x: FloatArray, active: NDArray[np.intp]) -> tuple[FloatArray, ...]:
        return tuple(sign * values for values in sine(x, active))

    goal = np.array([0.999999, -0.3, 0.5])
    found = monotone_roots(function, sign * goal, Brackets.of(function, LOW, HIGH))
    np.testing.assert_allclose(found, np.arcsin(goal), rtol=0.0, atol=1e-12)


def test_what_is_not_reached_is_at_the_nearer_end() -> None:
    found = monotone_roots(sine, np.array([2.0, -2.0, 0.0]), Brackets.of(sine, LOW, HIGH))
    np.testing.assert_allclose(found, [HIGH[0], LOW[1], LOW[2]], rtol=0.0, atol=1e-4)


def test_brackets_can_be_used_again() -> None:
    some = Brackets.of(sine, LOW, HIGH).take(np.array([1, 1, 2]))
    goal = np.array([-0.5, 0.5, 0.6])
    found = monotone_roots(sine, goal, some)
    np.testing.assert_allclose(np.sin(found), goal, rtol=0.0, atol=1e-12)
