"""Quantities on request: their values and errors."""

from fractions import Fraction

import numpy as np
import pytest
from asking import EVERY, VARIABLES
from scipy.integrate import trapezoid

import swtstudy


def test_without_equilibrium_there_are_none() -> None:
    forces = {"normal_force_amplitude": 0, "tangential_force_amplitude": 1.1}
    lost = swtstudy.solve(**forces, quantities=EVERY, rtol=1e-2)
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


PASSED = {"profile": "rounded_punch", "flat_radius": 0.5}
FORCES = {"normal_force_amplitude": 0.4, "tangential_force_amplitude": 0.35}
LOOPED = swtstudy.LoadPath("five corners", [[0, 0.5], [0.5, 0.5], [0.5, -0.5], [0, -0.5], [-0.6, 0.2]])
TWICE = swtstudy.LoadPath.harmonic_sum(
    "a cycle twice in a period", [(4, 0.7, 0.3)], [(2, 0.8, 0.0), (6, 0.2, 0.4)]
)
CURVES = {
    "displacements": {"phase": 0.7},
    "gross slip": {"phase": 1.4, "tangential_amplitude": 1.2},
    "its own mirror image": {"frequency_ratio": "3/2", "phase": 0.4, "normal_amplitude": 0.3},
    "lift-off": {"normal_amplitude": 1.5, "phase": 0.6},
    "rounded punch": {**PASSED, "phase": 0.5},
    "forces": {**FORCES, "phase": 1.0},
    "forces on a rounded punch": {**PASSED, **FORCES, "phase": 1.0},
    "a force and a displacement": {"normal_force_amplitude": 0.5, "tangential_amplitude": 0.3, "phase": 2.0},
    "a loop with corners": {"load": LOOPED, "normal_amplitude": 1.4, "tangential_amplitude": 0.7},
    "a loop of harmonics": {"load": TWICE, "normal_amplitude": 0.6, "tangential_amplitude": 0.4},
}


@pytest.mark.quick(3)
@pytest.mark.parametrize("given", CURVES.values(), ids=CURVES)
def test_they_are_those_of_the_curves_that_are_drawn(given: dict[str, object]) -> None:
    """The work is the area of the loop of force and displacement: the quantity sums up what slips instead."""
    drawn = swtstudy.inspect_point(**given)
    force, way, normal = drawn.tangential_force.values, drawn.displacement.values, drawn.normal_force.values
    found = swtstudy.solve(**given, quantities=EVERY, rtol=1e-2)
    assert float(found.dissipation) == pytest.approx(trapezoid(force, way), rel=2e-3)
    touching = normal > 1e-3
    largest = float(np.max(np.abs(force[touching]) / normal[touching]))
    assert largest - 1e-9 <= float(found.force_ratio) <= largest + 1e-3
    assert float(found.contact_radius) == pytest.approx(float(drawn.contact_radius.max()), rel=1e-9)
    stick = float(drawn.slip_radius.where(drawn.contact_radius > 0.0, 0.0).min())
    if np.isfinite(found.stick_radius):
        assert float(found.stick_radius) == pytest.approx(stick, rel=1e-3)


@pytest.mark.parametrize(
    ("amplitudes", "ratio", "phase"),
    [((0.237, 0.00785), "3", 1.0785), ((0.042, 0.00118), "2", 0.826), ((0.0186, 0.00147), "3/2", 0.4623)],
)
def test_a_prescribed_force_ratio_is_largest_between_any_instants(
    amplitudes: tuple[float, float], ratio: str, phase: float
) -> None:
    normal, tangential = amplitudes
    names = {"normal_force_amplitude": normal, "tangential_force_amplitude": tangential}
    found = swtstudy.solve(**names, frequency_ratio=ratio, phase=phase, rtol=1e-2)
    p, q = Fraction(ratio).as_integer_ratio()
    t = np.linspace(0.0, 2.0 * np.pi, 200_001)
    exact = np.max(np.abs(tangential * np.sin(p * t)) / (1.0 + normal * np.sin(q * t + phase)))
    assert float(found.prescribed_force_ratio) == pytest.approx(exact, rel=1e-7)


def test_waves_that_are_just_followed_have_a_map_of_mixed_control() -> None:
    """587 panels: half waves of which the edge passes 160."""
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 3e-5, "wavelength": 3.6}
    asked = ["dissipation", "contact_radius"]
    found = swtstudy.solve(**waves, normal_amplitude=0.9, tangential_force_amplitude=0.02, quantities=asked)
    smooth = swtstudy.solve(normal_amplitude=0.9, tangential_force_amplitude=0.02, quantities=asked)
    assert np.isfinite(found.s)
    assert float(found.contact_radius) == pytest.approx(float(smooth.contact_radius), rel=1e-3)
    assert float(found.dissipation) == pytest.approx(float(smooth.dissipation), rel=1e-2)
