"""Quantities on request: their values and errors."""

from __future__ import annotations

import numpy as np
import pytest
from asking import EVERY, VARIABLES

import swtstudy


def test_under_a_constant_normal_load_they_are_those_of_cattaneo_and_mindlin() -> None:
    u = np.array([0.1, 0.4, 0.9, 1.4])
    found = swtstudy.solve(normal_amplitude=0, tangential_amplitude=u, quantities=EVERY, rtol=1e-2)
    stick = np.maximum(1.0 - u, 0.0)
    expected = np.where(
        u <= 1.0, 4.0 * u * (1.0 + stick**1.5) - 3.2 * (1.0 - stick**2.5), 0.8 + 4.0 * (u - 1.0)
    )
    np.testing.assert_allclose(found.dissipation, expected, rtol=1e-9)
    assert (np.abs(found.dissipation - expected) <= found.dissipation_error).all()
    np.testing.assert_allclose(found.stick_radius, np.where(u < 1.0, np.sqrt(stick), np.nan), rtol=1e-12)
    np.testing.assert_allclose(found.contact_radius, 1.0)
    np.testing.assert_allclose(found.force_ratio, 1.0 - stick**1.5, rtol=1e-9)
    assert found.dissipation.attrs["ancillary_variables"] == "dissipation_error"


def test_under_a_prescribed_force_they_are_those_of_the_displacement_that_belongs_to_it() -> None:
    u = np.array([0.2, 0.6])
    force = 1.0 - (1.0 - u) ** 1.5
    own = swtstudy.solve(normal_amplitude=0, tangential_amplitude=u, quantities=EVERY, rtol=1e-2)
    asked = {"quantities": EVERY, "rtol": 1e-2, "normal_force_amplitude": 0}
    found = swtstudy.solve(tangential_force_amplitude=force, **asked)
    for name in EVERY:
        np.testing.assert_allclose(found[name], own[name], rtol=1e-6)
    lost = swtstudy.solve(tangential_force_amplitude=1.1, **asked)
    assert lost.regime.attrs["flag_meanings"].split()[int(lost.regime)] == "no_equilibrium"
    for name in VARIABLES:
        assert np.isnan(lost[name])


def test_a_loop_on_a_line_has_those_of_the_harmonic_load() -> None:
    line = swtstudy.LoadPath("line", [[0, 1], [0, -1]])
    found = swtstudy.solve(load=line, tangential_amplitude=0.6, quantities=EVERY, rtol=1e-2)
    harmonic = swtstudy.solve(normal_amplitude=0, tangential_amplitude=0.6, quantities=EVERY, rtol=1e-2)
    for name in EVERY:
        assert float(found[name]) == pytest.approx(float(harmonic[name]), rel=1e-6)


def test_the_force_ratio_of_two_prescribed_forces_is_known_at_every_instant() -> None:
    """Between the samples, by a parabola: those alone are up to 1e-5 too low."""
    phase = np.linspace(0.3, 1.3, 9)
    loads = {"normal_force_amplitude": 0.5, "tangential_force_amplitude": 0.35}
    found = swtstudy.solve(phase=phase, quantities=["force_ratio"], rtol=1e-2, **loads)
    for ratio, ψ in zip(found.force_ratio.values, phase, strict=True):
        t = np.linspace(0.0, 2.0 * np.pi, 400_001)
        exact = np.max(np.abs(0.35 * np.sin(t)) / (1.0 + 0.5 * np.sin(t + ψ)))
        assert ratio == pytest.approx(exact, rel=4e-6)


def test_a_stick_zone_there_is_not_is_nan() -> None:
    found = swtstudy.solve(tangential_amplitude=[0.2, 1.5], quantities=["stick_radius"], rtol=1e-2)
    assert np.isfinite(found.stick_radius[0])
    assert np.isnan(found.stick_radius[1])
