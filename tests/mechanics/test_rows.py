"""Rows: what is an array, what are rows within, and what all have in common."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.points import Rows, Solution


@dataclass(frozen=True)
class Inner(Rows):
    value: np.ndarray
    none: np.ndarray | None = None


@dataclass(frozen=True)
class Outer(Rows):
    one: np.ndarray
    inner: Inner
    factor: float
    table: list[float]
    none: np.ndarray | None = None


def outer() -> Outer:
    return Outer(np.arange(12.0).reshape(4, 3), Inner(np.arange(4) * 10), 0.5, [1.0, 2.0])


def test_arrays_and_rows_are_taken_and_all_else_is_common() -> None:
    whole, index = outer(), np.array([2, 0, 2])
    taken = whole.take(index)
    np.testing.assert_array_equal(taken.one, whole.one[[2, 0, 2]])
    np.testing.assert_array_equal(taken.inner.value, [20, 0, 20])
    assert taken.table is whole.table
    assert (taken.factor, taken.none) == (0.5, None)
    np.testing.assert_array_equal(whole.take(np.array([False, True, False, True])).inner.value, [10, 30])


def test_an_index_may_be_of_several_axes() -> None:
    rows = Solution(*(np.arange(6.0).reshape(2, 3),) * 6)
    np.testing.assert_array_equal(rows.take((np.array([1, 0]), np.array([2, 1]))).s, [5.0, 1.0])


def test_rows_are_joined_in_their_order() -> None:
    found = Inner.joined([Inner(np.array([3])), Inner(np.array([1, 2]))])
    np.testing.assert_array_equal(found.value, [3, 1, 2])
    assert found.none is None


def test_rows_are_written_in_place_where_they_belong() -> None:
    rows = Solution(*(np.zeros((2, 3)) for _ in range(6)))
    rows.write((np.array([1, 0]), np.array([2, 1])), Solution(*(np.array([5.0, 7.0]) + k for k in range(6))))
    np.testing.assert_array_equal(rows.s, [[0.0, 7.0, 0.0], [0.0, 0.0, 5.0]])
    np.testing.assert_array_equal(rows.s_error, rows.s + (rows.s > 0.0))


@pytest.mark.parametrize("family", ["paraboloid", "power_law", "rounded_punch", "cylinder", "rounded_flat"])
def test_a_profile_taken_is_the_one_of_its_row(family: str) -> None:
    depth = np.array([1.0, 1.5, 1.75])
    names = {"power_law": "exponent", "rounded_punch": "flat_radius", "rounded_flat": "flat_half_width"}
    own = {names[family]: np.array([1.2, 2.0, 4.0])} if family in names else {}
    r = np.linspace(0.1, 1.5, 7)
    some = make_profile(family, own, depth).take(np.array([2, 1]))
    alone = [make_profile(family, {name: v[[k]] for name, v in own.items()}, depth[[k]]) for k in (2, 1)]
    expected = np.concatenate([each.half_load(r[None]) for each in alone])
    np.testing.assert_array_equal(some.half_load(np.stack([r, r])), expected)
