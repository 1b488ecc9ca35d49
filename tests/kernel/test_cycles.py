"""Strain cycles that the kernel counts, against a library and by hand."""

import numpy as np
import pytest
import rainflow

from swtstudy import LoadPath
from swtstudy.kernel import count, cycles
from swtstudy.kernel.batch import count_batch, solve_batch
from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.criterion import ask

pytestmark = pytest.mark.xdist_group("kernel")
ROOM = new_record(cycles.COUNTING)


def counted(swing, stress, **criterion):
    """Values of the cycles of a history, descending; ν is 0, so that swt is σ_n times the amplitude."""
    ROOM.points = len(swing)
    ROOM.swing[: len(swing)], ROOM.stress[: len(swing)] = swing, stress
    count.count_cycles(ROOM, ask(0.0, 0.3, 1e-4, **criterion))
    return -np.sort(-ROOM.value[: ROOM.cycles])


@pytest.mark.parametrize("seed", range(20))
def test_ranges_are_those_of_a_library(seed: int) -> None:
    rng = np.random.default_rng(seed)
    swing = rng.normal(size=rng.integers(2, 200))
    closed = np.roll(swing, -int(swing.argmax()))
    closed = np.append(closed, closed[0])
    ranges = [size for size, count in rainflow.count_cycles(closed) for _ in range(round(2 * count))]
    expected = 0.5 * -np.sort(-np.array(ranges))[::2]
    found = counted(swing, np.ones(swing.size))
    expected = expected[expected > 0.5 * count.LEAST_RANGE * np.ptp(swing)]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_each_cycle_has_the_largest_stress_within_its_time() -> None:
    swing = [3.0, 0.0, 2.0, 1.0, 2.5, -1.0]
    # 2 → 1 → 2 closes with the stress 4; 0 → 2.5 → 0 holds it; the outermost one is the whole round.
    assert counted(swing, [1.0, 1.0, 1.0, 4.0, 1.0, 1.0]).tolist() == [8.0, 5.0, 2.0]
    # A shift in time changes nothing.
    for shift in range(6):
        found = counted(np.roll(swing, shift), np.roll([1.0, 1.0, 1.0, 4.0, 1.0, 1.0], shift))
        assert found.tolist() == [8.0, 5.0, 2.0]


def test_turning_back_by_next_to_nothing_is_no_cycle() -> None:
    swing = [1.0, -1.0, 0.5, 0.4999, 0.6]
    assert len(counted(swing, np.ones(5), criterion="findley", normal_sensitivity=0.3)) == 1


@pytest.mark.parametrize(
    "given",
    [
        {"loops": [LoadPath("thrice", [[0.0, 1.0, 1.0], [0.0, -1.0, -1.0]] * 3)]},
        {"frequency_ratio": ["3/2"], "phase": [0.4], "bulk_phase": [1.0]},
    ],
)
@pytest.mark.parametrize(("criterion", "angle"), [("swt", 0.0), ("findley", 1.0)])
def test_far_from_the_contact_the_bulk_stress_is_counted(given, criterion: str, angle: float) -> None:
    sizes = {"poisson_ratio": [0.3], "friction": [0.3], "normal_amplitude": [0.3]}
    sizes |= {"tangential_amplitude": [0.1], "bulk_amplitude": [0.3], "bulk_mean": [0.1]}
    own = {"criterion": criterion, "normal_sensitivity": [0.3]}
    (places,) = count_batch(np.array([np.nan]), np.array([angle]), "paraboloid", **sizes, **given, **own)
    (shares,) = places
    np.testing.assert_allclose(shares, np.ones(3), rtol=1e-4)


def test_without_a_critical_plane_nothing_is_counted() -> None:
    sizes = {"poisson_ratio": [0.3], "friction": [0.3], "normal_amplitude": [0.3]}
    nothing = np.array([np.nan])
    assert count_batch(nothing, nothing, "paraboloid", **sizes, tangential_amplitude=[0.1]) == [[]]


@pytest.mark.slow
def test_a_polygon_of_short_sides_has_the_cycles_of_its_curve() -> None:
    """Between the ends of a short side there are no instants."""
    found = []
    for vertices in (200, 1600):
        t = 2.0 * np.pi * np.arange(vertices) / vertices
        way = np.stack([np.sin(t), 0.6 * np.sin(t) + 0.5 * np.sin(3.0 * t)], axis=1)
        given = {"loops": [LoadPath("three", way)]}
        own = "paraboloid", [0.3], [0.5], [0.3], [0.4]
        solved = solve_batch(*own, **given)
        angle = 2.0 * np.deg2rad(solved["critical_angle"])
        found.append(count_batch(solved["critical_x"], angle, *own, **given)[0][0])
    assert len(found[0]) == 2
    np.testing.assert_allclose(found[1], found[0], rtol=0.05)
