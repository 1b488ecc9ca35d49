"""Closed polygons of load: the diagram with lines of any slope, and what a loop's s must not depend on."""

from __future__ import annotations

import numpy as np
import pytest
from memory import tangential_force
from numpy.typing import NDArray
from oracles.springs import polygon, spring_forces
from scenes import prescribed_scene

from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.contact.memory import GrowthTimes, Memory
from swtstudy.mechanics.contact.slip_front import slip_states
from swtstudy.mechanics.line.look import Accuracy
from swtstudy.mechanics.line.maximum import Maximum, maximum
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.load.polygon import PolygonLoad, without_collinear
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]
DISPLACEMENTS, FORCES = Control(), Control(True, True)


def s_of(load: Load, control: Control = DISPLACEMENTS, mu: float = 0.3) -> Maximum:
    many = np.ones(len(load))
    scene = prescribed_scene(load, control, 0.3 * many, mu * many)
    return maximum(scene, Accuracy.for_tolerance(1e-6))


def random_loop(rng: np.random.Generator, corners: int, low: float = -0.2) -> Array:
    return np.stack([rng.uniform(low, 1.8, corners), rng.uniform(-0.9, 0.9, corners)], axis=1)


def sampled(k: int, normal: float = 0.75, tangential: float = 5 / 6, phase: float = 2.3) -> Array:
    """The harmonic cycle at k instants."""
    t = 2.0 * np.pi * np.arange(k) / k
    return np.stack([1.0 + normal * np.sin(t + phase), tangential * np.sin(t)], axis=1)


def test_growth_slope_of_a_side_is_its_slope_within_the_bounds_of_stick() -> None:
    """−du/dδ of each rising side; ±1 where the tangential load is faster, 0 where the depth stands still."""
    for across, expected in ((0.3, -0.6), (-0.2, 0.4), (0.7, -1.0), (-0.9, 1.0)):
        load = PolygonLoad.of([np.array([(0.5, 0.0), (1.0, across), (1.5, 0.0)])])
        assert load.growth_slope(np.array([[0.7]]), np.array([0])).item() == pytest.approx(expected)
    level = PolygonLoad.of([np.array([(1.0, 0.0), (1.0, 0.5)])])
    assert level.growth_slope(np.array([[1.0]]), np.array([0])).item() == 0.0


@pytest.mark.parametrize("seed", range(12))
def test_memory_diagram_of_a_polygon_is_the_clip_rule(seed: int) -> None:
    rng = np.random.default_rng(seed)
    loops = [random_loop(rng, corners, low) for corners, low in ((3, 0.1), (9, 0.05), (6, -0.4), (2, 0.2))]
    load = PolygonLoad.of(loops)
    cycle = solve_cycle(load)
    depths = np.sort(rng.uniform(0.0, 1.8, 150))
    for k, loop in enumerate(loops):
        sides = len(loop)
        instants = np.sort(rng.uniform(0.0, PERIOD, 30))
        # The tangential load comes after the first indentation; then round and round.
        path = np.concatenate([[[loop[0, 0], 0.0]], loop, loop, loop, loop[:1]])
        place = 1.0 + sides * (instants / PERIOD + 2.0)
        expected = spring_forces(polygon(*path.T), depths, place)
        found = tangential_force(cycle.take(np.array([k])), depths, instants)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-11)


def test_sides_along_the_slip_lines_are_ties() -> None:
    loop = np.array([[1.0, 0.0], [1.5, 0.5], [1.2, 0.2], [1.4, 0.0], [0.8, -0.6], [0.8, -0.4]])
    load = PolygonLoad.of([loop])
    cycle = solve_cycle(load)
    depths, instants = np.linspace(0.0, 1.5, 301), np.linspace(0.01, 6.27, 60)
    path = np.concatenate([[[1.0, 0.0]], loop, loop, loop, loop[:1]])
    expected = spring_forces(polygon(*path.T), depths, 1.0 + 6.0 * (instants / PERIOD + 2.0))
    np.testing.assert_allclose(tangential_force(cycle, depths, instants), expected, rtol=0.0, atol=1e-12)


def test_both_components_are_exact_at_the_vertices() -> None:
    rng = np.random.default_rng(4)
    load = PolygonLoad.of([random_loop(rng, k) for k in (7, 11, 49)])
    for row, sides in enumerate(load.sides):
        one = load.take(np.array([row]))
        at = 2.0 * np.pi / sides * np.arange(sides + 1)[None]
        np.testing.assert_array_equal(one.normal(at), load.corner_normal[[row], : sides + 1])
        np.testing.assert_array_equal(one.tangential(at), load.corner_tangential[[row], : sides + 1])


@pytest.mark.quick(2)
@pytest.mark.parametrize("less", [1e-15, 3e-15, 1e-14, 1e-13, 1e-12])
def test_growth_nearly_along_the_slip_line(less: float) -> None:
    rng = np.random.default_rng(6)
    for _ in range(12):
        a, b, c, d = rng.uniform(0.05, 0.3, 4)
        step = [[0.0, 0.0], [a, 0.2 * a], [b, b * (1.0 - less)], [c, -0.3 * c], [-0.05, 0.2 * d], [0.0, d]]
        loop = np.array([0.7, 0.013]) + np.cumsum(step, axis=0)
        load = PolygonLoad.of([loop])
        depths, instants = np.linspace(0.0, 1.6, 401), np.sort(rng.uniform(0.0, PERIOD, 60))
        path = np.concatenate([[[0.7, 0.0]], loop, loop, loop, loop[:1]])
        place = 1.0 + load.sides[0] * (instants / PERIOD + 2.0)
        expected = spring_forces(polygon(*path.T), depths, place)
        found = tangential_force(solve_cycle(load), depths, instants)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-11)


@pytest.mark.slow
def test_sampled_cycles_converge_to_the_harmonic_one() -> None:
    one = np.ones(1)
    exact = s_of(BimodalLoad(0.75 * one, 5 / 6 * one, 2.3 * one, 1, 1)).swt[0]
    count = np.array([16, 32, 64, 128, 256])
    error = s_of(PolygonLoad.of([sampled(k) for k in count])).swt / exact - 1.0
    # As another code found them, to its own accuracy.
    np.testing.assert_allclose(error, [-9.7e-3, -2.2e-3, 3.1e-4, 4.5e-4, 1.5e-4], rtol=0.0, atol=3e-5)
    # The envelope, which is harmonic.
    assert np.all(np.abs(error) < 11.0 / count**2)


@pytest.mark.parametrize("control", [DISPLACEMENTS, FORCES])
def test_s_does_not_depend_on_the_first_vertex_nor_on_more_of_them(control: Control) -> None:
    rng = np.random.default_rng(5)
    loop = random_loop(rng, 7, 0.3)
    if control == FORCES:
        loop[:, 1] *= 0.9 * loop[:, 0]
    more = np.concatenate([loop[:3], [0.5 * (loop[2] + loop[3])], [loop[3]], loop[3:]])
    loops = [*(np.roll(loop, k, axis=0) for k in range(7)), more]
    found = s_of(PolygonLoad.of(loops), control)
    np.testing.assert_allclose(found.swt, found.swt[0], rtol=1e-6)
    np.testing.assert_allclose(found.position, found.position[0], rtol=1e-4)


def test_a_reversed_tangential_load_mirrors_x_and_a_reversed_loop_is_another_one() -> None:
    rng = np.random.default_rng(8)
    loop = random_loop(rng, 5, 0.3)
    found = s_of(PolygonLoad.of([loop, loop * [1.0, -1.0], loop[::-1]]))
    assert found.swt[1] == pytest.approx(found.swt[0], rel=1e-9)
    assert found.position[1] == pytest.approx(-found.position[0], rel=1e-6)
    assert abs(found.swt[2] / found.swt[0] - 1.0) > 0.01


def test_a_value_does_not_depend_on_the_other_loops() -> None:
    rng = np.random.default_rng(9)
    loops = [random_loop(rng, corners, 0.2) for corners in (3, 12, 5)]
    together = s_of(PolygonLoad.of(loops))
    alone = [s_of(PolygonLoad.of([loop])).swt[0] for loop in loops]
    np.testing.assert_allclose(together.swt, alone, rtol=1e-12)


def test_only_vertices_on_a_straight_line_are_left_out() -> None:
    square = np.array([[1.0, 0.0], [1.2, 0.0], [1.2, 0.1], [1.0, 0.1]])
    share = np.linspace(0.0, 1.0, 4)[:3, None]
    more = np.concatenate([a + share * (b - a) for a, b in zip(square, np.roll(square, -1, 0), strict=True)])
    np.testing.assert_array_equal(without_collinear(np.repeat(more, 2, axis=0)), square)
    # Where it turns back on the same line, and where it bends ever so slightly, a vertex stays.
    there_and_back = np.array([[1.0, 0.0], [1.0, 0.3], [1.0, 0.2], [1.0, 0.5]])
    np.testing.assert_array_equal(without_collinear(there_and_back), there_and_back)
    bent = square.copy()
    bent = np.insert(bent, 1, [1.1, -1e-12], axis=0)
    np.testing.assert_array_equal(without_collinear(bent), bent)
    np.testing.assert_array_equal(without_collinear(np.ones((3, 2))), np.ones((1, 2)))


def test_a_load_at_rest_makes_no_damage() -> None:
    assert s_of(PolygonLoad.of([np.array([[1.0, 0.2]])])).swt[0] == pytest.approx(0.0, abs=1e-9)


def test_passages_are_where_the_loads_have_the_values() -> None:
    rng = np.random.default_rng(3)
    load = PolygonLoad.of([random_loop(rng, k) for k in (4, 7, 5)])
    turns = load.turning_instants()
    begin, end = turns[:, :-1], turns[:, 1:]
    share = rng.uniform(0.05, 0.95, begin.shape)
    instant = begin + share * (end - begin)
    found = load.passage(load.normal(instant), begin, end)
    own = found[:, np.arange(begin.shape[1]), np.arange(begin.shape[1])]
    np.testing.assert_allclose(own, instant, rtol=0.0, atol=1e-12)
    for sense in (1.0, -1.0):
        goal = sense * load.tangential(instant) - load.normal(instant)
        for i in range(begin.shape[1]):
            brackets = load.slip_line_brackets(sense, begin[:, i], end[:, i])
            at = load.slip_line_instant(sense, goal[:, i], brackets)
            np.testing.assert_allclose(at, instant[:, i], rtol=0.0, atol=1e-11)


def test_a_front_in_a_line_as_steep_as_the_slip_line_stays_in_its_piece() -> None:
    # Its distance is a quotient of roundings: 2, beyond the edge.
    tiny = 2.0**-52
    tangential = 0.5 - tiny
    load = PolygonLoad.of([np.array([[1.5, tangential], [1.5, 0.1]])])
    memory = Memory.empty(1, 1, 2)
    memory.start[...], memory.offset[...], memory.slope[...] = (
        [0.0, 0.5],
        [-1.0, -0.5 - tiny],
        [1.0 - 0.5 * tiny, 0.0],
    )
    yes, no = np.ones((1, 1), dtype=bool), np.zeros((1, 1), dtype=bool)
    none, first = (
        GrowthTimes(np.zeros(1, dtype=np.intp), np.zeros((2, 6, 1, 1))),
        np.zeros((1, 1), dtype=np.intp),
    )
    states = slip_states(load, memory, (yes, no), none, first, np.zeros((1, 1)))
    assert states.front[0, 0] == 0.5
