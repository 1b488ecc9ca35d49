"""Loops of many vertices: the same values from few looks, at a cost that hardly grows faster than they do."""

from __future__ import annotations

from unittest import mock

import numpy as np
import pytest

import swtstudy
from swtstudy import LoadPath
from swtstudy.mechanics.contact import cycle
from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.line import first_look
from swtstudy.mechanics.load.polygon import PolygonLoad

FORCES = {"normal_force_amplitude": 1.0, "tangential_force_amplitude": 1.0, "friction": 0.5}


def noisy(count: int, noise: float, seed: int, bulk: bool = False) -> LoadPath:
    """A smooth cycle in samples with noise, that of the sum of both loads in their shares."""
    t = 2.0 * np.pi * np.arange(count) / count
    columns = [0.3 * np.sin(t + 1.0), np.sin(t) + 0.2 * np.sin(5.0 * t), 0.5 * np.sin(t - 0.4)]
    values = 0.5 * np.stack(columns[: 3 if bulk else 2], axis=1)
    return LoadPath("noisy", values + 0.5 * noise * np.random.default_rng(seed).normal(size=values.shape))


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("noise", "bulk", "profile"),
    [(0.0, False, "cylinder"), (0.02, True, "paraboloid"), (0.1, False, "paraboloid")],
)
def test_runs_of_pieces_that_are_joined_hide_no_maximum(noise: float, bulk: bool, profile: str) -> None:
    loop = noisy(130, noise, 1, bulk)
    parameters = {"load": loop, "profile": profile, **FORCES} | (
        {"bulk_stress_amplitude": 0.1} if bulk else {}
    )
    found = swtstudy.solve(**parameters)
    with mock.patch.object(first_look, "MANY", 10**9):
        every = swtstudy.solve(**parameters)
    assert abs(found.s - every.s).item() <= (found.s_error + every.s_error).item()
    assert found.critical_x.item() == pytest.approx(every.critical_x.item(), rel=1e-3)


def test_few_places_are_looked_at_however_many_vertices_there_are() -> None:
    """Of 4 and more for each vertex without a choice; with it the logarithm of their number counts."""
    looked = {}
    for count in (125, 500):
        places: list[int] = []

        def counted(scene, position, resolution, planes, look=first_look.first_look, places=places):
            places.append(position.size)
            return look(scene, position, resolution, planes)

        with mock.patch.object(first_look, "first_look", counted):
            swtstudy.solve(load=noisy(count, 0.02, 2), **FORCES, rtol=1e-3)
        looked[count] = sum(places)
    assert looked[500] < 2.2 * looked[125] < 1500


@pytest.mark.slow
def test_strain_cycles_are_counted_where_they_would_be_without_a_choice() -> None:
    contact = swtstudy.physical(
        young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, friction=0.5, body=1,
        load=LoadPath("rig", noisy(150, 0.05, 4).vertices * [40.0, 100.0], 200.0),
    )  # fmt: skip
    aluminium = swtstudy.FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
    found = contact.solve(constants=aluminium, rtol=1e-3)
    with mock.patch.object(first_look, "MANY", 10**9):
        every = contact.solve(constants=aluminium, rtol=1e-3)
    assert found.counted_number.sum() > 3.0
    np.testing.assert_allclose(found.cycles, every.cycles, rtol=0.01)


def test_a_place_is_looked_at_the_same_in_any_part() -> None:
    loop, found = noisy(100, 0.02, 3), []
    for size, least in ((10**9, 1), (1000, 7)):
        with mock.patch.multiple(first_look, LOOK_SIZE=size, LEAST_PART=least):
            found.append(swtstudy.solve(load=loop, **FORCES).s.item())
    assert found[0] == found[1]


def test_a_stack_has_room_for_as_many_pieces_as_there_are() -> None:
    """Ever smaller strokes leave a piece each."""
    size = 0.8 * 0.93 ** np.arange(60)
    stroke = np.stack([0.0 * size, size * (-1.0) ** np.arange(60)], axis=1)
    load = PolygonLoad.of([stroke + np.array([1.0, 0.0])])
    with mock.patch.object(cycle, "DEPTH", 1000):
        whole = solve_cycle(load).memory
    assert np.isfinite(whole.start).sum(axis=-1).max() > 45
    for depth in (4, 32):
        with mock.patch.object(cycle, "DEPTH", depth):
            found = solve_cycle(load).memory
        for name, values in vars(found).items():
            np.testing.assert_array_equal(values, getattr(whole, name))
