"""What the search along the line takes for a peak, and what it samples around the extremes in time."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import random_points

from swtstudy.mechanics.events.nodes import _places
from swtstudy.mechanics.events.stretches import meet
from swtstudy.mechanics.line.first_look import local_maxima
from swtstudy.mechanics.line.look import Look, _falling
from swtstudy.mechanics.line.samples import of_extremes
from swtstudy.mechanics.stress.scene import scene_of

R = np.arange(1.0, 11.0)


def peaks(swt, angle=None, r=R):
    """Columns of the maxima of one curve on one side."""
    values = np.array(swt, dtype=float)[None, None]
    turned = np.zeros_like(values) if angle is None else np.array(angle, dtype=float)[None, None]
    point, side, column = local_maxima(values, turned, r[None])
    assert not point.any()
    assert not side.any()
    return column.tolist()


@pytest.mark.parametrize(
    ("swt", "columns"),
    [
        ([1, 2, 3, 4, 5, 4, 3, 2, 1, 0], [4]),
        ([5, 4, 3, 2, 1, 1, 2, 3, 4, 5], [0, 9]),
        # The first of equal values.
        ([3, 4, 5, 5, 5, 4, 3, 2, 1, 0], [2]),
        ([5, 5, 5, 5, 5, 5, 5, 5, 5, 5], [0]),
        # A point without tension keeps one.
        ([0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0]),
    ],
)
def test_peaks_along_the_line(swt, columns):
    assert peaks(swt) == columns


def test_a_low_peak_is_none():
    share = {top: peaks([0, top, 0, 0, 0, 0, 0, 10, 0, 0]) for top in (0.1, 9.9)}
    assert share == {0.1: [7], 9.9: [1, 7]}


def test_where_another_plane_takes_over_both_places_are_looked_at():
    rising = [9.91, 9.92, 9.93, 9.94, 9.95, 9.96, 9.97, 9.98, 9.99, 10]
    angle = np.where(R < 8.5, 0.0, 2.0)  # between the columns 7 and 8
    assert peaks(rising) == [9]
    assert peaks(rising, angle) == [7, 9]
    # An angle of 2π is none.
    assert peaks(rising, np.where(R < 8.5, 0.0, 2 * np.pi)) == [9]
    falling = rising[::-1]
    assert peaks(falling, np.where(R < 2.5, 0.0, 2.0)) == [0, 2]


def test_each_extreme_has_its_own_samples():
    """σ_n at the samples around its own maximum, ε_n at those around its largest and its least value."""
    samples = np.arange(2 * 3 * 4 * 3 * 5.0).reshape(2, 3, 4, 3, 5)  # kind, coefficient, X, extreme, sample
    stress, strain = samples[0][:, None], samples[1][:, None]
    planes = SimpleNamespace(stress=stress.reshape(3, 1, 4, 15), strain=strain.reshape(3, 1, 4, 15))
    found = of_extremes(planes)
    assert found.shape == (3, 1, 4, 3, 5)
    np.testing.assert_array_equal(found[..., 0, :], stress[..., 0, :])
    np.testing.assert_array_equal(found[..., 1, :], strain[..., 1, :])
    np.testing.assert_array_equal(found[..., 2, :], -strain[..., 2, :])


def test_nodes_where_stretches_meet_are_there_once():
    """Three stretches: the second begins where the first ends, the third does not."""
    parts = SimpleNamespace(
        low=np.array([[[0.0, 1.0, 2.5]]]),
        high=np.array([[[1.0, 2.0, 3.0]]]),
        real=np.array([[[True, True, True]]]),
        next_real=np.array([[[0, 1, 2]]]),
    )
    placed = _places(parts, 2)
    pairs = list(zip(placed.stretch.ravel().tolist(), placed.place.ravel().tolist(), strict=True))
    assert pairs == [(0, 0), (0, 1), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)]


@pytest.mark.parametrize("profile", ["paraboloid", "rounded_punch", "wavy_paraboloid"])
def test_some_rows_of_a_look_are_a_look_at_these(profile):
    batch = random_points(5, 6, profile)
    batch = replace(batch, p=np.full(6, 3), q=np.full(6, 2), normal_amplitude=np.linspace(0.3, 0.9, 6))
    scene, rows = scene_of(batch), np.array([4, 1, 1])
    r = scene.profile.radius(scene.profile.largest_depth)[:, None] * np.array([0.5, 0.9])
    some = Look.at(scene, r, 3, 6.0).take(rows)
    alone = Look.at(scene.take(rows), r[rows], 3, 6.0)
    extremes = np.array([[[5, 9, 2], [8, 0, 11]]] * 3)
    closer, same = (look.line.history(look.brackets(extremes).samples()) for look in (some, alone))
    for values, expected in zip(vars(closer).values(), vars(same).values(), strict=True):
        np.testing.assert_array_equal(values, expected)
    assert some.line.growth.count > 0


def test_stretches_meet_at_one_instant_and_over_the_end_of_the_cycle():
    period = 2.0 * np.pi
    end = np.array([1.0, period, 1.0, 0.0, 1.0])
    begin = np.array([1.0, 0.0, period - 1.0, period, 1.1])
    assert meet(end, begin).tolist() == [True, True, False, True, False]


def test_a_curve_falls_at_once_from_a_corner_but_not_from_a_smooth_maximum():
    at = np.arange(9.0) - 4.0
    corner, smooth = -np.abs(at), -(at**2)
    to_the_left = np.where(at < 0.0, corner, smooth)
    curves = np.stack([corner, smooth, to_the_left])
    # What is added to a curve says nothing of its shape.
    for offset in (0.0, 100.0, -100.0):
        sides = _falling(curves + offset, np.array([4, 4, 4]))
        assert sides.tolist() == [[True, True], [False, False], [True, False]]
