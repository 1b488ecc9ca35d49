"""Quantities on request: their values and errors."""

from __future__ import annotations

import numpy as np
import pytest
from asking import EVERY, VARIABLES
from scenes import each_profile, random_points
from scenes import points as batch

import swtstudy
from swtstudy.mechanics import quantities
from swtstudy.mechanics.body.nonlocal_swt import NonlocalSwt
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.bimodal import load_of
from swtstudy.mechanics.points import Solution
from swtstudy.mechanics.stress import work
from swtstudy.vocabulary.quantities import NAMED, NONLOCAL, QUANTITIES, attributes_of


def computed(points, names):
    """Quantities that need no solution."""
    return quantities.quantities_of(points, names, Solution.blank(len(points)))


def test_the_table_is_complete() -> None:
    assert all(
        callable(getattr(work, row.function)) for row in NAMED.values() if row.function != "largest_von_mises"
    )
    assert all(row.function in NonlocalSwt.__annotations__ for row in NONLOCAL.values())
    for row in QUANTITIES.values():
        assert len(row.meaning) <= 30
        for name in row.variables:
            attributes = attributes_of(name)
            assert {"long_name", "comment", "units", "symbol"} <= attributes.keys()
            for other in attributes.get("ancillary_variables", "").split():
                assert other in row.variables


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


def marched(points, index: int, springs: int = 3000, steps: int = 6000) -> tuple[float, float, float]:
    """Work, largest force ratio and contact radius from springs that are marched through two periods."""
    one = points.take(np.array([index]))
    load, shape = load_of(one), {name: float(values[0]) for name, values in one.shape.items()}
    profile = make_profile(one.profile, {k: np.array([v]) for k, v in shape.items()}, load.largest_normal)
    largest = float(profile.radius(load.largest_normal[:, None])[0, 0])
    edges = largest * np.linspace(0.0, 1.0, springs + 1)
    width, g = np.diff(edges), profile.depth(0.5 * (edges[1:] + edges[:-1])[None])[0]
    instant = np.linspace(0.0, 4.0 * np.pi, 2 * steps + 1)
    depth, u = load.normal(instant[None])[0], load.tangential(instant[None])[0]
    unit = np.maximum(1.0 - g, 0.0) @ width
    tau, before, force, normal = np.zeros(springs), 1.0, [0.0], [1.0]
    for k in range(1, len(instant)):
        compression = np.maximum(depth[k] - g, 0.0)
        # A spring that touches within the step takes part in what is moved from then on.
        part = np.where(before > g, 1.0, np.clip((depth[k] - g) / max(depth[k] - before, 1e-300), 0.0, 1.0))
        tau = np.clip(tau + part * (u[k] - u[k - 1]), -compression, compression)
        before = depth[k]
        force.append(tau @ width / unit)
        normal.append(compression @ width / unit)
    force, normal, moved = np.array(force), np.array(normal), np.diff(u)[steps:]
    done = 0.5 * (force[steps:-1] + force[steps + 1 :]) @ moved
    ratio = np.divide(np.abs(force), normal, out=np.zeros_like(force), where=normal > 1e-3)
    return float(done), float(ratio[steps:].max()), largest


@pytest.mark.parametrize("profile", each_profile())
def test_they_are_those_of_marched_springs(profile: str) -> None:
    points = random_points(41, 2, profile, largest_term=3)
    found = computed(points, EVERY)
    for index in range(2):
        work_done, ratio, largest = marched(points, index)
        assert found["dissipation"][index] == pytest.approx(work_done, rel=3e-3, abs=3e-6)
        assert found["force_ratio"][index] == pytest.approx(ratio, rel=2e-3)
        assert found["contact_radius"][index] == pytest.approx(largest, rel=1e-12)


@pytest.mark.parametrize("profile", each_profile())
def test_errors_are_honest(profile: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points = random_points(42, 10, profile)
    found = computed(points, ["dissipation", "force_ratio"])
    monkeypatch.setattr(work, "NODES", 32)
    monkeypatch.setattr(work, "TOLERANCE", 3e-7)
    monkeypatch.setattr(work, "SAMPLES", 100)
    finer = computed(points, ["dissipation", "force_ratio"])
    error = np.abs(found["dissipation"] - finer["dissipation"])
    assert (error <= found["dissipation_error"]).all()
    assert (found["dissipation_error"] <= 1.1e-5 * finer["dissipation"] + 1e-12).all()
    np.testing.assert_allclose(found["force_ratio"], finer["force_ratio"], rtol=2e-5)


def test_the_work_of_a_long_growth_is_refined_and_its_error_told(monkeypatch: pytest.MonkeyPatch) -> None:
    # Five tangential oscillations while the contact grows once: sixteen nodes are wrong by 7e-4.
    hard = batch(normal_amplitude=0.78839, tangential_amplitude=0.07473, phase=6.04323, p=5)
    found = computed(hard, ["dissipation"])
    monkeypatch.setattr(work, "NODES", 256)
    (exact,) = computed(hard, ["dissipation"])["dissipation"]
    (value,), (error,) = found["dissipation"], found["dissipation_error"]
    assert value == pytest.approx(exact, rel=2e-6)
    assert abs(value - exact) <= error <= 1.1e-5 * exact


@pytest.mark.slow
def test_they_do_not_depend_on_what_is_computed_together(monkeypatch: pytest.MonkeyPatch) -> None:
    points = random_points(43, 30, "rounded_punch")
    whole = computed(points, EVERY)
    monkeypatch.setattr(work, "LARGEST_SIZE", 5_000)
    for part in (np.arange(7), np.array([29, 3])):
        for name, values in computed(points.take(part), EVERY).items():
            np.testing.assert_allclose(values, whole[name][part], rtol=1e-9, atol=1e-14)


def test_mirrored_points_have_the_same_and_are_computed_once() -> None:
    phase = np.array([0.7, 0.7 + np.pi])
    found = swtstudy.solve(phase=phase, quantities=EVERY, rtol=1e-2)
    assert found.critical_x[0] == -found.critical_x[1]
    # Computed as given, not as their canonical point.
    own = computed(batch(phase=phase), EVERY)
    for name in EVERY:
        assert found[name].values[0] == pytest.approx(found[name].values[1], rel=0, nan_ok=True)
        np.testing.assert_allclose(own[name], found[name], rtol=1e-6)


def test_a_stick_zone_there_is_not_is_nan() -> None:
    found = swtstudy.solve(tangential_amplitude=[0.2, 1.5], quantities=["stick_radius"], rtol=1e-2)
    assert np.isfinite(found.stick_radius[0])
    assert np.isnan(found.stick_radius[1])
