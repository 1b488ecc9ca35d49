"""Prescribed forces: values against closed forms, one another and springs marched one by one."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.force_march import ForceMarch, second_round

import swtstudy

Array = NDArray[np.float64]
INDENTERS = {
    "paraboloid": oracle.paraboloid(),
    "rounded_punch": oracle.rounded_punch(0.6),
    "truncated_paraboloid": oracle.truncated_paraboloid(0.5),
    "wavy_paraboloid": oracle.wavy_paraboloid(0.03, 4.5),
    "power_law": oracle.power_law(3.0),
}
EVERY = [(normal, tangential) for normal in (False, True) for tangential in (False, True)]
QUANTITIES = ("dissipation", "force_ratio", "stick_radius", "contact_radius")


def solve(
    normal: float | Array,
    tangential: float | Array,
    forces: tuple[bool, bool] = (True, True),
    rtol: float = 1e-6,
    **given: Any,
) -> xr.Dataset:
    """Points with amplitudes of the normal and the tangential load, which are forces or displacements."""
    names = [
        f"{way}_force_amplitude" if is_force else f"{way}_amplitude"
        for way, is_force in zip(("normal", "tangential"), forces, strict=True)
    ]
    own = {"poisson_ratio": 0.3, "friction": 0.5, "phase": 0.0, "frequency_ratio": 1}
    quantities = QUANTITIES if given.pop("all", False) else ()
    amplitudes = dict(zip(names, (normal, tangential), strict=True))
    return swtstudy.solve(**own | amplitudes | given, rtol=rtol, quantities=quantities)


@pytest.mark.parametrize("name", INDENTERS)
def test_at_constant_normal_load_both_controls_give_the_same(name: str) -> None:
    given = {"profile": name, **INDENTERS[name].shape, "all": True}
    u = np.array([0.2, 0.6, 0.9])
    moved = solve(0.0, u, (False, False), **given)
    # The largest tangential force is that which makes the same when it is prescribed.
    force = moved.force_ratio.values
    for normal in (False, True):
        carried = solve(0.0, force, (normal, True), **given)
        for quantity in ("s", *QUANTITIES):
            np.testing.assert_allclose(carried[quantity].values, moved[quantity].values, rtol=1e-5)
        np.testing.assert_allclose(carried.force_ratio.values, force, rtol=1e-9)


def test_a_prescribed_force_makes_the_known_value() -> None:
    found = solve(0.5, 0.35, phase=1.1)
    # By another code, to some 2e-5.
    assert float(found.s) == pytest.approx(0.1238493, rel=4e-5)
    # By springs whose offsets are clipped at the turning points of T ± N one by one, integrated over 4,000
    # cells of the angle, and searched with ever closer instants, to 3e-8.
    assert float(found.s) == pytest.approx(0.12384632, rel=1e-6)
    assert float(found.critical_x) == pytest.approx(-0.959599, abs=5e-5)


@pytest.mark.parametrize(
    "given", [{}, {"profile": "truncated_paraboloid", "flat_radius": 1.5, "friction": 0.95}]
)
def test_incipient_sliding_is_the_same_in_both_controls(given: dict[str, Any]) -> None:
    """Next to the edge of a flat face, too, where s is made in the second case."""
    by_force, by_displacement = (solve(0.0, 1.0, forces, 1e-5, **given) for forces in (EVERY[3], EVERY[0]))
    assert float(by_force.s) == pytest.approx(float(by_displacement.s), rel=2e-5)
    assert abs(float(by_force.critical_x)) == pytest.approx(abs(float(by_displacement.critical_x)), rel=1e-4)


def test_dissipated_work_is_mindlins() -> None:
    u = np.array([1e-3, 0.1, 0.5, 5 / 6, 1.0, 1.3])
    stick = np.maximum(1.0 - u, 0.0)
    expected = 4.0 * u * (1.0 + stick**1.5) - 3.2 * (1.0 - stick**2.5)
    expected = np.where(u <= 1.0, expected, 0.8 + 4.0 * (u - 1.0))
    found = solve(0.0, u, (False, False), all=True)
    np.testing.assert_allclose(found.dissipation, expected, rtol=1e-6, atol=1e-13)
    assert (np.abs(found.dissipation - expected) <= found.dissipation_error + 1e-13).all()
    np.testing.assert_allclose(found.stick_radius[:-1], np.sqrt(stick[:-1]), rtol=1e-9, atol=1e-9)
    assert not found.stick_radius[-1] > 0.0
    np.testing.assert_allclose(found.contact_radius, 1.0)
    np.testing.assert_allclose(found.force_ratio, 1.0 - stick**1.5, rtol=1e-9)
    straight = swtstudy.LoadPath("straight", [[0.0, 1.0], [0.0, -1.0]])
    given = {"normal_amplitude": 0.0, "tangential_amplitude": u, "load": straight}
    looped = swtstudy.solve(**given, quantities=["dissipation"])
    np.testing.assert_allclose(looped.dissipation, expected, rtol=1e-6, atol=1e-13)


@pytest.mark.parametrize("forces", EVERY)
def test_work_and_largest_force_are_those_of_the_marched_springs(forces: tuple[bool, bool]) -> None:
    found = solve(0.4, 0.42, forces, phase=0.8, frequency_ratio="3/2", all=True)
    edges = np.linspace(0.0, 1.02 * float(found.contact_radius), 301)
    radius = 0.5 * (edges[1:] + edges[:-1])
    t = 2.0 * np.pi * np.arange(600) / 600
    springs = ForceMarch(radius**2, np.diff(edges))
    # The common period of the two sines.
    normal, tangential = 1.0 + 0.4 * np.sin(2.0 * t + 0.8), 0.42 * np.sin(3.0 * t)
    moved = np.empty(len(t))
    tau = second_round(springs, normal, tangential, *forces, moved)
    force = tau @ springs.width / springs.unit
    depth = np.array([springs.depth_at(value, forces[0]) for value in normal])
    carried = np.maximum(depth[:, None] - radius**2, 0.0) @ springs.width / springs.unit
    work = 0.5 * (force + np.roll(force, 1)) @ (moved - np.roll(moved, 1))
    assert float(found.dissipation) == pytest.approx(work, rel=3e-3)
    assert float(found.force_ratio) == pytest.approx(np.abs(force / carried).max(), rel=1e-3)
    assert work > 0.01


def test_what_cannot_be_carried_is_told() -> None:
    def is_lost(
        normal: float, tangential: float, forces: tuple[bool, bool] = (True, True), **given: Any
    ) -> bool:
        found = solve(normal, tangential, forces, 1e-3, **given)
        return str(found.regime.attrs["flag_meanings"]).split()[int(found.regime)] == "no_equilibrium"

    # In phase and out of phase: Q² + F² + 2 Q F |cos ψ| ≤ 1 for two forces.
    cases = [(0.5, 0.5), (0.5, 0.5 + 1e-9), (0.5, 0.49), (1.0, 0.0), (1.2, 0.0), (0.0, 1.0)]
    assert [is_lost(*each) for each in cases] == [False, True, False, False, True, False]
    assert [is_lost(*each, (True, False)) for each in cases] == [False] * 4 + [True, False]
    assert not any(is_lost(*each, (False, False)) for each in cases)
    for psi in (0.5, 2.0):
        limit = -0.6 * abs(np.cos(psi)) + np.sqrt(1.0 - 0.36 * np.sin(psi) ** 2)
        for share, lost in ((1.0 - 1e-9, False), (1.0 + 1e-9, True)):
            assert is_lost(0.6, share * limit, phase=psi) == lost
    # A depth that lifts off.
    assert is_lost(1.1, 0.1, (False, True), phase=0.3)
