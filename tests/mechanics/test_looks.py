"""What the search along the line takes for a peak, and what it samples around the extremes in time."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import points, random_points

from swtstudy.mechanics import solve_points
from swtstudy.mechanics.events.stretches import _places, meet, split_at_layers, stretches
from swtstudy.mechanics.line import climb, first_look
from swtstudy.mechanics.line.first_look import Seen, _predicted, high_positions, resolved
from swtstudy.mechanics.line.look import Look, _falling, reach
from swtstudy.mechanics.line.positions import Pieces
from swtstudy.mechanics.line.refine import of_extremes
from swtstudy.mechanics.stress.scene import scene_of


def _even(point):
    """Positions of points, each as far from the one before it as from the next."""
    even = np.full(len(point), True)
    return SimpleNamespace(point=point, is_even=even, is_corner=~even)


def peaks(swt, highest=None):
    """Numbers of the candidates among values on one side, of one point."""
    values = np.array(swt, dtype=float)[:, None]
    most = values if highest is None else np.array(highest, dtype=float)[:, None]
    place, side = high_positions(_even(np.zeros(len(values), int)), Seen(values, values, most))
    assert not side.any()
    return place.tolist()


@pytest.mark.parametrize(
    ("swt", "places"),
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
def test_peaks_along_the_line(swt, places):
    assert peaks(swt) == places


def test_a_low_peak_is_none_unless_it_may_be_higher_between_the_instants():
    share = {top: peaks([0, top, 0, 0, 0, 0, 0, 10, 0, 0]) for top in (0.1, 8.4, 8.6)}
    assert share == {0.1: [7], 8.4: [7], 8.6: [1, 7]}
    may_be = [0, 0, 0, 9, 10.1, 9, 0, 10, 0, 0]
    assert peaks([0, 0, 0, 6, 6, 6, 0, 10, 0, 0], may_be) == [4, 7]
    assert peaks([0, 0, 0, 6, 6, 6, 0, 10, 0, 0], np.minimum(may_be, 9.9)) == [7]


def test_each_point_has_its_own_peaks():
    seen = np.array([1.0, 2.0, 3.0, 9.0, 8.0, 1.0])[:, None]
    point = np.array([0, 0, 0, 1, 1, 1])
    assert high_positions(_even(point), Seen(seen, seen, seen))[0].tolist() == [2, 3]


def test_what_lies_between_is_predicted_as_by_a_cubic_or_a_parabola():
    for count, power in ((3, 2), (5, 3), (9, 3)):
        x = np.linspace(-1.0, 2.0, 2 * count - 1)
        for exponent in range(power + 2):
            values = (x**exponent)[None, :, None]
            off = np.abs(_predicted(values[:, ::2]) - values[:, 1::2]).max()
            assert (off < 1e-14) == (exponent <= power)


@pytest.mark.parametrize("width", [0.4, 0.3, 0.2])
def test_a_flank_leads_to_a_ring_wherever_it_is_in_its_piece(monkeypatch, width):
    """A narrow maximum with flanks like those of a root, of which the first positions see little."""

    def look(scene, pieces, piece, share, *_):
        r = pieces.radius(piece, np.pi * share)
        swt = 1.0 / (1.0 + np.abs((r - at) / (0.3 * width)) ** 1.5) + np.exp(-(((r - at) / width) ** 2))
        return Seen(swt[:, None], 0.0 * swt[:, None], swt[:, None])

    monkeypatch.setattr(first_look, "look_at", look)
    pieces = Pieces.between(np.array([[0.5, 1.0, 2.0]]), np.array([np.inf]))
    for at in np.linspace(1.05, 1.95, 31):
        positions, seen = resolved([None], pieces)
        assert np.all(np.diff(positions.r) > 0.0)
        nearest = np.abs(positions.r - at).min()
        assert nearest < 0.2 * width
        assert seen.swt.max() > 2.0 * 0.75
        assert len(positions.r) < 150


def test_a_long_piece_has_a_position_where_the_layer_of_its_short_neighbour_ends(monkeypatch):
    monkeypatch.setattr(first_look, "look_at", lambda _, __, piece, *___: Seen(*np.ones((3, piece.size, 1))))
    pieces = Pieces.between(np.array([[1.0, 2.0, 2.0 + 1e-6, 4.0]]), np.array([np.inf]))
    r = resolved([None], pieces)[0].r
    for place, inside in ((2.0, -1.0), (2.0 + 1e-6, 1.0)):
        away = np.sort(inside * (r - place))
        assert away[away > 1e-9][0] == pytest.approx(1e-6, rel=0.01)
    # 2 steps a piece, 4 in the two long ones, one end and two layers.
    assert r.size == 13


def test_pieces_leave_no_gap_and_none_is_longer_than_a_wave():
    ends = np.array([[0.1, 0.1, 0.4, 0.4 + 4e-16, 2.0], [0.3, 0.4, 0.4, 0.4, 1.0]])
    pieces = Pieces.between(ends, np.array([0.4, np.inf]))
    assert np.bincount(pieces.point).tolist() == [1 + 4, 2]
    assert np.all((pieces.high - pieces.low)[pieces.point == 0] <= 0.4 + 1e-12)
    for point, rows in enumerate(ends):
        low, high = (values[pieces.point == point] for values in (pieces.low, pieces.high))
        np.testing.assert_array_equal(high[:-1], low[1:])
        assert (low[0], high[-1]) == (rows[0], rows[-1])


def test_each_extreme_has_its_own_samples():
    """σ_n at the samples around its own maximum, ε_n at those around its largest and its least value."""
    samples = np.arange(2 * 3 * 4 * 3 * 5.0).reshape(2, 3, 4, 3, 5)  # kind, coefficient, X, extreme, sample
    stress, strain = samples[0][:, None], samples[1][:, None]
    planes = SimpleNamespace(stress=stress.reshape(3, 1, 4, 15), swing=strain.reshape(3, 1, 4, 15))
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


def test_a_curve_may_rise_beside_the_end_of_a_stretch():
    """1 + 0.1 k − 0.11 k² after the end, whose vertex is 0.01/0.44 above it."""
    curve = np.array([0.0, 0.5, 1.0, 0.99, 0.76, 0.31])
    inside = np.array([True, True, False, True, True, True])
    for some, where in ((curve, inside), (curve[::-1], inside[::-1])):
        assert reach(some, where) == pytest.approx(1.0 + 0.01 / 0.44)


def test_a_curve_falls_at_once_from_a_corner_but_not_from_a_smooth_maximum():
    at = np.arange(9.0) - 4.0
    corner, smooth = -np.abs(at), -(at**2)
    to_the_left = np.where(at < 0.0, corner, smooth)
    curves = np.stack([corner, smooth, to_the_left])
    # What is added to a curve says nothing of its shape.
    for offset in (0.0, 100.0, -100.0):
        sides = _falling(curves + offset, np.array([4, 4, 4]))
        assert sides.tolist() == [[True, True], [False, False], [True, False]]


def test_thin_layers_of_the_cycle_end_at_cuts() -> None:
    """One after the other, round the closed cycle: each as long as the short stretch beside it."""
    # The first stretch is much shorter than the last one, much longer, and neither.
    some = points(
        friction=0.3,
        phase=[0.722, 3.895, 0.7364701381659569],
        normal_amplitude=[0.662, 0.896, 0.19],
        tangential_amplitude=[0.931, 0.951, 0.122],
        q=2,
    )
    scene = scene_of(some).split_at_breakpoints()
    thin = 0.2
    at = scene.coordinate.of(np.array([[1.274], [0.868], [0.9345]]))[:, 0]
    cut = split_at_layers(scene.cycle, at, thin)
    parts = stretches(scene.cycle, at[:, None])
    count = 0
    for row in range(len(at)):
        ends = [
            (low, high)
            for low, high in zip(parts.low[row, 0], parts.high[row, 0], strict=True)
            if high - low > 1e-12
        ]
        own = scene.cycle.begin[row][scene.cycle.end[row] > scene.cycle.begin[row]]
        expected = {*own.tolist()}
        for number, (low, high) in enumerate(ends):
            before, after = ends[number - 1], ends[(number + 1) % len(ends)]
            # Of α in cos α the time goes like the square.
            longest = (high - low) * (0.5 * math.pi * thin) ** 2
            if before[1] - before[0] < longest:
                expected.add(low + (before[1] - before[0]))
            if after[1] - after[0] < longest:
                expected.add(high - (after[1] - after[0]))
        count += len(expected) - own.size
        begins = cut.begin[row][cut.end[row] > cut.begin[row]]
        assert np.unique(begins.round(9)).tolist() == np.unique(np.array([*expected]).round(9)).tolist()
    assert count >= 4


@pytest.mark.parametrize(
    "point",
    [
        # The largest of a curve is between two instants, of which one is in the next interval.
        points(phase=np.radians(85.0)),
        # Another interval is high where the climb ends.
        points(normal_amplitude=0.25, phase=np.radians(357.5), p=1, q=4),
    ],
)
def test_what_climbs_leave_out_of_the_cycle_does_not_matter(point, monkeypatch) -> None:
    some, kept = climb._high_intervals, []

    def all_intervals(*arguments):
        kept.append(some(*arguments))
        return np.ones_like(kept[-1])

    found = solve_points(point).s
    monkeypatch.setattr(climb, "_high_intervals", all_intervals)
    np.testing.assert_allclose(found, solve_points(point).s, rtol=1e-8)
    assert np.mean(kept[0]) < 0.8


def test_some_intervals_of_a_cycle_are_those_of_the_whole_one() -> None:
    scene = scene_of(points(phase=[0.3, 2.0], p=3, q=2))
    cycle = scene.cycle
    kept = np.zeros(cycle.begin.shape, dtype=bool)
    kept[0, [1, 4, 5]] = kept[1, [0, 3]] = True
    less = cycle.only(kept)
    assert less.begin.shape == (2, 3)
    for row in range(2):
        some, real = np.flatnonzero(kept[row]), kept[row].sum()
        for name in ("begin", "end", "forward", "backward"):
            np.testing.assert_array_equal(getattr(less, name)[row, :real], getattr(cycle, name)[row, some])
        np.testing.assert_array_equal(less.memory.start[row, :real], cycle.memory.start[row, some])
    assert less.begin[1, 2] == less.end[1, 2]
