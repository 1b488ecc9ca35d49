"""Rainflow counting, against a library and against the definition."""

from __future__ import annotations

import numpy as np
import pytest
import rainflow
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from swtstudy.mechanics.planes.rainflow import closed_cycles

RNG = np.random.default_rng(29)


def histories(count: int, instants: int) -> list[tuple[NDArray, NDArray]]:
    """Random strains and stresses: rough, in few levels with ties and plateaus, and smooth."""
    found = []
    for k in range(count):
        strain, stress = RNG.normal(size=(2, RNG.integers(2, instants)))
        if k % 3 == 0:
            strain, stress = np.round(2.0 * strain), np.round(2.0 * stress)
        elif k % 3 == 1:
            strain = np.cumsum(strain - strain.mean())
        found.append((strain, stress))
    return found


def counted(strain: NDArray, stress: NDArray) -> NDArray:
    """Amplitudes and tensions of the cycles of one history, (k, 2), in ascending order."""
    found = closed_cycles(strain[None], stress[None])
    both = np.stack([found.amplitude[0], found.tension[0]], axis=1)
    return np.array(sorted(both[both[:, 0] > 0.0].tolist())).reshape(-1, 2)


def by_definition(strain: NDArray, stress: NDArray) -> NDArray:
    """As `counted`: the smallest excursion of all is taken out of the turning points until one is left.

    Its time goes from its first turning point to where the strain is back there, looked for afresh in the
    whole history.
    """
    start = int(strain.argmax())
    strain, stress = np.roll(strain, -start), np.roll(stress, -start)
    strain, stress = np.append(strain, strain[0]), np.append(stress, stress[0])
    left = list(range(len(strain)))
    k = 1
    while k < len(left) - 1:  # turning points alone
        a, b, c = strain[left[k - 1 : k + 2]]
        if (b - a) * (c - b) > 0.0 or a == b:
            del left[k]
        else:
            k += 1
    if len(left) > 2 and strain[left[-2]] == strain[left[-1]]:
        del left[-2]
    found = []
    while len(left) > 3:
        ranges = np.abs(np.diff(strain[left]))
        # The last two excursions are those of the outermost cycle, unless a smaller one is among them.
        inner = [k for k in range(1, len(ranges) - 1) if ranges[k] <= min(ranges[k - 1], ranges[k + 1])]
        k = min(inner, key=lambda k: ranges[k])
        found.append(_cycle(strain, stress, left[k], left[k + 1]))
        del left[k : k + 2]
    if len(left) == 3 and np.ptp(strain) > 0.0:
        found.append((0.5 * np.ptp(strain), stress.max()))
    return np.array(sorted(found)).reshape(-1, 2)


def _cycle(strain: NDArray, stress: NDArray, first: int, turn: int) -> tuple[float, float]:
    """Half the range and the largest stress of a cycle, its time searched on a straight line's fine grid."""
    level, sign = strain[first], np.sign(strain[first] - strain[turn])
    end = turn
    while sign * (strain[end] - level) < 0.0:
        end += 1
    share = (level - strain[end - 1]) / (strain[end] - strain[end - 1])
    there = (1.0 - share) * stress[end - 1] + share * stress[end]
    return 0.5 * abs(level - strain[turn]), max(stress[first:end].max(), there)


def test_ranges_are_those_of_the_library() -> None:
    for strain, stress in histories(600, 60):
        at = int(strain.argmax())
        closed = np.append(np.roll(strain, -at), strain[at])
        theirs: dict[float, float] = {}
        for reach, number in rainflow.count_cycles(closed):
            theirs[round(0.5 * reach, 12)] = theirs.get(round(0.5 * reach, 12), 0.0) + number
        own, numbers = np.unique(counted(strain, stress)[:, 0].round(12), return_counts=True)
        known = {amplitude: number for amplitude, number in theirs.items() if amplitude > 0.0}
        assert dict(zip(own.tolist(), numbers.tolist(), strict=True)) == known


def test_cycles_and_their_tension_are_those_of_the_definition() -> None:
    for strain, stress in histories(900, 40):
        if len(np.unique(strain)) == len(strain):  # of equal excursions either may be the nested one
            assert_allclose(counted(strain, stress), by_definition(strain, stress), atol=1e-12)


def test_many_at_once_are_as_one_by_one() -> None:
    strain, stress = RNG.normal(size=(2, 50, 30))
    together = closed_cycles(strain, stress)
    for row in range(50):
        alone = closed_cycles(strain[row : row + 1], stress[row : row + 1])
        size = alone.amplitude.shape[1]
        assert_allclose(together.amplitude[row, :size], alone.amplitude[0], rtol=0, atol=0)
        assert_allclose(together.tension[row, :size], alone.tension[0], rtol=0, atol=0)
        assert (together.amplitude[row, size:] == 0.0).all()


def test_the_outermost_cycle_has_the_whole_range_and_the_largest_stress_of_all() -> None:
    for strain, stress in histories(600, 40):
        found = closed_cycles(strain[None], stress[None])
        swt = (found.amplitude * np.maximum(found.tension, 0.0))[0]
        assert swt.max() == pytest.approx(0.5 * np.ptp(strain) * max(stress.max(), 0.0), abs=1e-15)


def test_where_it_begins_and_which_way_is_up_do_not_matter() -> None:
    for strain, stress in histories(300, 40):
        if len(np.unique(strain)) < len(strain):
            continue
        expected = counted(strain, stress)
        shift = int(RNG.integers(len(strain)))
        assert_allclose(counted(np.roll(strain, shift), np.roll(stress, shift)), expected, atol=1e-12)
        assert_allclose(counted(-strain, stress), expected, atol=1e-12)


@pytest.mark.parametrize("number", [1, 2, 5, 10])
def test_equal_cycles_are_so_many(number: int) -> None:
    φ = np.linspace(0.0, 2.0 * np.pi, 20 * number, endpoint=False)
    found = counted(np.sin(number * φ), np.cos(number * φ))
    assert_allclose(found, [[1.0, 1.0]] * number, atol=1e-12)


def test_a_strain_that_rests_has_no_cycle() -> None:
    assert counted(np.full(7, 2.0), np.arange(7.0)).size == 0
    assert counted(np.array([1.0]), np.array([1.0])).size == 0


def test_a_small_cycle_within_a_large_one() -> None:
    strain = np.array([1.0, 0.0, 0.5, -1.0])
    stress = np.array([0.1, 0.2, 0.3, 0.4])
    # From the turning point at 0, up to 0.5, and back to 0, a third of the way to −1.
    assert_allclose(counted(strain, stress), [[0.25, 0.3 + 0.1 / 3.0], [1.0, 0.4]])
