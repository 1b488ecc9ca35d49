"""Bulk stress: closed forms, superposition, symmetries, the far field, and brute force."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray
from scenes import PROFILE_NAMES, each_profile, points, random_points, take
from scipy.integrate import trapezoid
from scipy.spatial.transform import Rotation
from solved import Points, Solution, solve_points
from test_critical_plane_3d import rotated
from test_values import ALIGNED
from told import RIG, refused

import swtstudy
from studies.accuracy_speed.textbook import textbook_s
from swtstudy import Study, swt_of_history
from swtstudy.points.solve import solve_grid
from swtstudy.study.writing import to_toml
from swtstudy.vocabulary.quantities import NOTHING

Array = NDArray[np.float64]
COMPONENTS = tuple(f"sigma_{name}" for name in ("xx", "yy", "zz", "yz", "xz", "xy"))


def with_bulk(
    batch: Points, amplitude: Any = 0.0, mean: Any = 0.0, phase: Any = 0.0, exponent: Any = 0.5
) -> Points:
    columns = {"bulk_stress_amplitude": amplitude, "bulk_stress_mean": mean}
    columns |= {"bulk_stress_phase": phase, "walker_exponent": exponent}
    full = {n: np.broadcast_to(v, (len(batch),)).astype(float) for n, v in columns.items()}
    return replace(batch, **full)


def random_bulk(seed: int, batch: Points) -> Points:
    rng = np.random.default_rng(seed)
    low, high = np.array([(0.01, 0.3), (-0.1, 0.2), (0.0, 2.0 * np.pi), (0.3, 0.8)]).T[..., None]
    return with_bulk(batch, *rng.uniform(low, high, (4, len(batch))))


def swt(tension: Array, swing: Array, nu: Array | float, exponent: Array | float) -> Array:
    """Walker's parameter from the largest σ_xx and the amplitude of (1 − ν²) ε_xx."""
    high = np.maximum(tension, 0.0)
    return high ** (2.0 - 2.0 * exponent) * swing ** (2.0 * exponent) / (1.0 - nu**2)


@pytest.mark.quick(3)
@pytest.mark.parametrize("exponent", [0.3, 0.5, 0.8])
@pytest.mark.parametrize(("nu", "mean"), [(0.0, 0.0), (0.3, 0.15), (0.45, -0.04)])
def test_at_rest_the_edge_has_a_closed_form(nu: float, mean: float, exponent: float) -> None:
    """The pressure's own tension at |x| = a, (1 − 2ν) P/(2π a²), and the bulk stress that oscillates."""
    at_rest = points("paraboloid", nu, 0.5, 0.0, 0.0)
    found = solve_points(with_bulk(at_rest, 0.1, mean, 1.0, exponent), 1e-7)
    tension = mean + 0.1 + (1.0 - 2.0 * nu) * 2.0 / (3.0 * np.pi)
    assert found.s[0] == pytest.approx(swt(np.array(tension), np.array(0.1), nu, exponent), rel=1e-6)
    assert abs(found.critical_x[0]) == pytest.approx(1.0, rel=1e-9)
    assert abs(found.critical_angle[0]) < 1e-4


def frictionless_s(nu: float, amplitude: float, bulk: tuple[float, float, float], exponent: float) -> float:
    """Hertz's pressure that oscillates and the bulk stress: brute force over time, x and planes."""
    time = np.linspace(0.0, 2.0 * np.pi, 361)
    edges = np.sqrt(1.0 + amplitude * np.array([-1.0, 1.0]))
    x = np.concatenate(
        [np.linspace(1e-3, edges[0], 200), np.linspace(*edges, 500), edges[1] * np.geomspace(1, 60, 100)]
    )[:, None]
    depth = 1.0 + amplitude * np.sin(time)
    inside = np.maximum(1.0 - x**2 / depth, 0.0)
    pressure = 2.0 / np.pi * np.sqrt(depth * inside)
    spread = (1.0 - 2.0 * nu) * (2.0 / 3.0) * depth**1.5 * (1.0 - inside**1.5) / (np.pi * x**2)
    mean, swing, phase = bulk
    xx, yy, zz = (
        mean + swing * np.sin(time + phase) + spread - pressure,
        -spread - 2 * nu * pressure,
        -pressure,
    )
    best = 0.0
    for angle in np.linspace(0.0, 0.5 * np.pi, 31):
        stress = xx * np.cos(angle) ** 2 + zz * np.sin(angle) ** 2
        strain = (1.0 + nu) * stress - nu * (xx + yy + zz)
        best = max(best, float(swt(stress.max(1), 0.5 * np.ptp(strain, axis=1), nu, exponent).max()))
    return best


@pytest.mark.quick(2)
@pytest.mark.parametrize("exponent", [0.5, pytest.param(0.3, marks=pytest.mark.slow), 0.8])
@pytest.mark.parametrize(
    ("nu", "amplitude", "bulk"),
    [
        (0.3, 0.5, (0.0, 0.1, 0.0)),
        (0.3, 0.5, (0.1, 0.05, 2.0)),
        (0.1, 0.8, (-0.05, 0.2, 4.0)),
        # So much tension that the largest swing counts, inside of the contact.
        (0.3, 0.5, (1.5, 0.02, 1.0)),
    ],
)
def test_without_friction_against_brute_force(
    nu: float, amplitude: float, bulk: tuple[float, float, float], exponent: float
) -> None:
    mean, swing, phase = bulk
    batch = with_bulk(points("paraboloid", nu, 0.0, amplitude, 0.5), swing, mean, phase, exponent)
    found = solve_points(batch, 1e-6)
    # Depth and bulk stress are smooth in time; the edges' cusps are missed by a little.
    assert frictionless_s(nu, amplitude, bulk, exponent) == pytest.approx(found.s[0], rel=2e-3)
    assert frictionless_s(nu, amplitude, bulk, exponent) < found.s[0] * (1.0 + 1e-5)


@pytest.mark.quick(1)
@pytest.mark.parametrize("exponent", [0.3, 0.5, 0.8])
def test_where_the_far_field_is_all_there_is_no_point_is_critical(exponent: float) -> None:
    """At ν = 1/2 a pressure makes no tension outside of the contact."""
    batch = points("paraboloid", 0.5, 0.0, [0.0, 0.3, 0.3], 0.0)
    found = solve_points(with_bulk(batch, 0.1, [0.05, 0.05, -0.02], 1.0, exponent))
    tension = np.array([0.15, 0.15, 0.08])
    np.testing.assert_allclose(found.s, swt(tension, np.array(0.1), 0.5, exponent), rtol=1e-12)
    assert np.isnan(found.critical_x).all()
    np.testing.assert_array_equal(found.critical_angle, 0.0)
    np.testing.assert_array_equal(found.s_surface, found.s)


@pytest.mark.slow
def test_no_s_is_below_the_far_field() -> None:
    for profile in PROFILE_NAMES:
        batch = random_bulk(1, random_points(1, 3, profile, largest_term=2))
        high, γ = batch.bulk_stress_mean + batch.bulk_stress_amplitude, batch.walker_exponent
        far = swt(high, batch.bulk_stress_amplitude, batch.poisson_ratio, γ)
        assert np.all(solve_points(batch, 1e-3).s >= far)


@pytest.mark.quick(1)
@pytest.mark.parametrize("profile", each_profile())
def test_the_aligned_textbook_method_agrees(profile: str) -> None:
    batch = random_bulk(5, random_points(5, 2, profile, largest_term=2))
    point = take(batch, 1)
    ratio = textbook_s(point, **{**ALIGNED, "positions": 200}).s / solve_points(point).s[0]
    # From below, as without bulk stress; from above where a front is next to the edge, between springs.
    assert 1.0 - 2e-2 < ratio < 1.0 + 4e-3


@pytest.mark.slow
def test_a_maximum_outside_of_the_contact_is_found() -> None:
    at = points("paraboloid", 0.4354, 0.1805, 0.3087, 1.0453, 3.6127, 2, 1)
    point = with_bulk(at, 0.395, -0.0686, 5.3333, 0.4)
    found = solve_points(point, 1e-6)
    outside = abs(found.critical_x[0]) / np.sqrt(1.3087)
    assert 1.005 < outside < 1.02
    dense = textbook_s(point, **{**ALIGNED, "positions": 200})
    # The maximum is narrow, and the positions are 2 % apart.
    assert 1.0 - 1e-2 < dense.s / found.s[0] < 1.0 + 1e-3
    assert dense.critical_x == pytest.approx(found.critical_x[0], rel=2e-2)


PARAMETERS: dict[str, Any] = {"normal_amplitude": 0.5, "phase": 0.7, "frequency_ratio": "3/2"}


def stress_of(x: Array, y: Array, z: Array, time: Array, **bulk: float) -> Array:
    place = [xr.DataArray(v, dims="place") for v in (x, y, z)]
    field = swtstudy.stress_field(*place, time=time, **PARAMETERS, **bulk)
    return np.stack([field[name].values for name in COMPONENTS], axis=-1)


def test_a_bulk_stress_is_added_to_sigma_xx_and_to_nothing_else() -> None:
    rng = np.random.default_rng(3)
    x, y, z, time = (
        rng.normal(size=10),
        rng.normal(size=10),
        rng.uniform(0.0, 2.0, 10),
        rng.uniform(0, 12.0, 7),
    )
    own = {"bulk_stress_amplitude": 0.2, "bulk_stress_mean": -0.07, "bulk_stress_phase": 0.4}
    difference = stress_of(x, y, z, time, **own) - stress_of(x, y, z, time)
    # ω2 t = (3/2) ω1 t.
    bulk = -0.07 + 0.2 * np.sin(1.5 * time + 0.4)
    np.testing.assert_allclose(difference[..., 0], np.broadcast_to(bulk[:, None], (7, 10)), atol=1e-14)
    # Without a bulk stress half of the cycle is the mirror image of the other one.
    np.testing.assert_allclose(difference[..., 1:], 0.0, atol=1e-15)


def test_the_history_at_the_critical_point_has_s_however_it_is_turned() -> None:
    own = {"bulk_stress_amplitude": 0.1, "bulk_stress_mean": 0.05, "bulk_stress_phase": 2.0}
    solved = swtstudy.solve(**PARAMETERS, **own)
    field = swtstudy.stress_field(float(solved.critical_x), 0.0, 0.0, **PARAMETERS, **own)
    history = np.stack([field[name].values for name in COMPONENTS], axis=-1)
    rotation = Rotation.random(20, random_state=1).as_matrix()
    turned = rotated(np.broadcast_to(history, (20, *history.shape)), rotation)
    np.testing.assert_allclose(swt_of_history(turned, 0.3, 0.91).swt, float(solved.s), rtol=2e-5)
    local = swtstudy.swt_field(float(solved.critical_x), 0.0, 0.0, **PARAMETERS, **own).s_local
    assert float(local) == pytest.approx(float(solved.s), rel=3e-3)
    # Far below and far away only the bulk stress is left.
    far = swtstudy.swt_field([3e3], 0.0, [0.0, 4e3], **PARAMETERS, **own)
    np.testing.assert_allclose(far.s_local, 0.15 * 0.1 / 0.91, rtol=1e-4)


def mirrored(found: Solution) -> tuple[Array, Array, Array]:
    return found.s, -found.critical_x, -found.critical_angle


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("p", "q"),
    [(1, 1), (2, 1), (1, 2), *(pytest.param(*each, marks=pytest.mark.slow) for each in ((3, 2), (1, 3)))],
)
def test_symmetries_of_an_oscillating_bulk_stress(p: int, q: int) -> None:
    phase, own = np.array([0.4, 2.0]), {"amplitude": 0.1, "mean": 0.03, "phase": np.array([1.0, 5.0])}
    batch = with_bulk(points(phase=phase, p=p, q=q), **own)
    found = solve_points(batch, 1e-6)

    def same(other: Solution, expected: tuple[Array, Array, Array]) -> None:
        for one, value in zip((other.s, other.critical_x, other.critical_angle), expected, strict=True):
            np.testing.assert_allclose(one, value, rtol=1e-5, atol=1e-3)

    turned = replace(batch, phase=phase + 2.0 * np.pi / p)
    same(solve_points(turned, 1e-6), (found.s, found.critical_x, found.critical_angle))
    shifted = phase + (np.pi / p if q % 2 else 0.0)
    flipped = replace(batch, phase=shifted, bulk_stress_phase=batch.bulk_stress_phase + np.pi)
    same(solve_points(flipped, 1e-6), mirrored(found))
    # Neither of the two alone is one.
    alone = solve_points(replace(batch, phase=phase + np.pi / p), 1e-6).s
    assert np.abs(alone / found.s - 1.0).max() > 1e-3


def test_points_without_bulk_stress_do_not_change_beside_others() -> None:
    batch = random_points(4, 6, largest_term=1)
    amplitude, mean = np.array([0.0, 0.1, 0.0, 0.0, 0.0, 0.2]), np.array([0.0, 0.0, 0.0, 0.1, 0.0, 0.1])
    mixed, plain = solve_points(with_bulk(batch, amplitude, mean)), solve_points(batch)
    without = (amplitude == 0.0) & (mean == 0.0)
    for name, values in vars(plain).items():
        np.testing.assert_array_equal(getattr(mixed, name)[without], values[without])
    assert np.all(mixed.s[~without] != plain.s[~without])


@pytest.mark.parametrize("profile", each_profile())
def test_s_is_continuous_where_the_bulk_stress_ends(profile: str) -> None:
    batch = random_points(6, 2, profile, largest_term=2)
    plain = solve_points(batch, 1e-6).s
    for small in (with_bulk(batch, 1e-9), with_bulk(batch, 0.0, 1e-9)):
        np.testing.assert_allclose(solve_points(small, 1e-6).s, plain, rtol=3e-6)


@pytest.mark.slow
@pytest.mark.parametrize("profile", each_profile("paraboloid"))
def test_s_converges_to_the_asked_accuracy(profile: str) -> None:
    batch = random_bulk(7, random_points(7, 8, profile, largest_term=3))
    coarse, fine = (solve_points(batch, rtol) for rtol in (1e-4, 1e-7))
    np.testing.assert_allclose(coarse.s, fine.s, rtol=1e-4)
    assert np.all(np.abs(coarse.s - fine.s) <= coarse.s_error + fine.s_error)


def test_one_body_of_a_real_contact_carries_it() -> None:
    given = RIG | {"normal_force": 200.0, "tangential_amplitude": 0.002, "bulk_stress_amplitude": 40.0}
    contact = swtstudy.physical(**given, bulk_stress_ratio=0.2, bulk_stress_body=2)
    # R = 0.2: from 20 to 100.
    assert contact.bulk_stress_mean == pytest.approx(60.0)
    own, other = contact.parameters(2), contact.parameters(1)
    assert own["bulk_stress_amplitude"] == pytest.approx(40.0 / contact.stress_scale)
    # In the other body it matters by the stick zone alone.
    assert "bulk_stress_mean" not in other
    assert other["bulk_strain_share"] == -1.0
    solved = contact.solve()
    for body, parameters in enumerate((other, own)):
        assert float(solved.s[body]) == pytest.approx(float(swtstudy.solve(**parameters).s), rel=1e-12)
    assert float(solved.s[1]) > 1.2 * float(solved.s[0])
    again = contact.with_parameters(friction=0.4)
    assert again.bulk_stress_amplitude == pytest.approx(40.0)
    for wrong, words in (
        ({"bulk_stress_ratio": 1.0}, "_ratio: found 1.0 .out of range.; allowed: a number below 1"),
        ({"bulk_stress_ratio": 0.1, "bulk_stress_mean": 3.0}, "bulk_stress_mean, bulk_stress_ratio: found b"),
        ({"bulk_stress_body": 0}, "bulk_stress_body: found 0; allowed: 1 or 2"),
        ({"bulk_stress_amplitude": -1.0}, "_amplitude: found -1.0 .out of range.; allowed: a stress, ≥ 0"),
        ({"bulk_stress_mean": "much"}, "bulk_stress_mean: found 'much' .not a number"),
    ):
        refused(words, swtstudy.physical, **{**given, **wrong})
    assert swtstudy.physical(**given, bulk_stress_mean=-3.0).bulk_stress_mean == -3.0


def test_a_study_names_the_body_that_carries_it() -> None:
    """What the file of an archive says is the same again."""
    text = """
        title = "two"
        [units]
        length = "mm"
        force = "N"
        stress = "MPa"
        [fixed]
        profile = "cylinder"
        young_modulus = [73e3, 75e3]
        poisson_ratio = 0.3
        radius = 80
        friction = 0.8
        normal_force = 500
        tangential_force_amplitude = 75
        bulk_stress_amplitude = 36
        bodies = ["pad", "specimen"]
        bulk_stress_body = 1
    """
    first = Study.from_text(text).grid
    for named in ("2", '"specimen"'):
        grid = Study.from_text(text.replace("bulk_stress_body = 1", f"bulk_stress_body = {named}")).grid
        assert grid.bulk_stress_body == 1
        again = Study.from_text(to_toml("two", 1e-3, grid, None, NOTHING)).grid
        assert again.bulk_stress_body == 1
        contact = swtstudy.physical(
            profile="cylinder", young_modulus=(73e3, 75e3), poisson_ratio=0.3, radius=80.0,
            friction=0.8, normal_force=500.0, tangential_force_amplitude=75.0, bulk_stress_amplitude=36.0,
            bulk_stress_body=2,
        )  # fmt: skip
        np.testing.assert_allclose(solve_grid(grid, 1e-3, NOTHING).SWT, contact.solve(1e-3).SWT, rtol=1e-12)
    assert float(solve_grid(first, 1e-3, NOTHING).SWT.sel(body=1)) > 1.3 * float(
        solve_grid(grid, 1e-3, NOTHING).SWT.sel(body=1)
    )


def test_the_shift_of_the_stick_zone() -> None:
    """At δA = 0: a = 1, p0 = 2/π, c = √(1 − U), and e/a = 4 σ_B/[π (1 + ν)(4 − 3ν) μ p0] up to a − c."""
    amplitude = np.array([0.0, 0.01, 0.1, 0.4])
    found = swtstudy.solve(normal_amplitude=0.0, bulk_stress_amplitude=amplitude, tangential_amplitude=0.75)
    shift = 4.0 * amplitude / (np.pi * 1.3 * 3.1 * 0.3 * (2.0 / np.pi))
    expected = np.where(shift <= 1.0 - np.sqrt(0.25), shift, np.nan)
    assert np.isnan(expected[-1])
    np.testing.assert_allclose(found.bulk_shift, expected, rtol=1e-12)
    own: dict[str, Any] = {"bulk_stress_amplitude": 0.01, "normal_amplitude": 0.2}
    for other in (
        {"friction": 0.0},
        {"tangential_amplitude": 3.0},  # gross slip
        {"normal_amplitude": 1.5},  # contact is lost
        {"profile": "rounded_punch", "flat_radius": 0.5},
        {"tangential_amplitude": 0.0, "normal_amplitude": 0.0},  # nothing slips
    ):
        assert np.isnan(swtstudy.solve(**{**own, **other}).bulk_shift)
    assert "bulk_shift" not in swtstudy.solve(bulk_stress_mean=0.1)
    forces = swtstudy.solve(
        bulk_stress_amplitude=0.01, normal_force_amplitude=0.0, tangential_force_amplitude=0.5
    )
    assert float(forces.bulk_shift) == pytest.approx(0.02 / (0.3 * 1.3 * 3.1))


@pytest.mark.parametrize("exponent", [0.5, 0.35])
def test_means_over_a_distance_know_it(exponent: float) -> None:
    """Without friction at rest: a static field and the bulk stress, by quadrature over the depth."""
    own: dict[str, Any] = {
        "friction": 0.0, "normal_amplitude": 0.0, "poisson_ratio": 0.3, "walker_exponent": exponent,
        "bulk_stress_amplitude": 0.1, "bulk_stress_mean": 0.2,
    }  # fmt: skip
    distance = 0.2
    found = swtstudy.solve(critical_distance=distance, **own)
    x = float(found.line_x.sel(direction="depth").squeeze())
    depth = np.linspace(0.0, 2.0 * distance, 401)
    field = swtstudy.swt_field(np.array([x]), 0.0, depth, **own).s_local.values.ravel()
    mean = float(trapezoid(field, depth) / (2.0 * distance))
    assert float(found.s_line.sel(direction="depth").squeeze()) == pytest.approx(mean, rel=3e-3)


@pytest.mark.slow
@pytest.mark.usefixtures("unwrapped")
def test_it_has_its_own_curve_in_the_cycle() -> None:
    own: dict[str, Any] = {"bulk_stress_amplitude": 0.1, "bulk_stress_mean": 0.05, "bulk_stress_phase": 2.0}
    point = swtstudy.inspect_point(**PARAMETERS, **own)
    time = point.time.values
    np.testing.assert_allclose(point.bulk_stress, 0.05 + 0.1 * np.sin(1.5 * time + 2.0), atol=1e-12)
    assert "bulk_stress" not in swtstudy.inspect_point(**PARAMETERS)
    figure = swtstudy.inspect(**PARAMETERS, **own)
    curves = [line for line in figure.axes[4].lines if line.get_label() == r"$\sigma_B$"]
    assert len(curves) == 1
    np.testing.assert_array_equal(curves[0].get_ydata(), point.bulk_stress)


def test_a_loop_has_no_frequency_for_it() -> None:
    loop = swtstudy.LoadPath("square", [[0, 0.5], [0.5, 0.5], [0.5, -0.5], [0, -0.5]])
    with pytest.raises(swtstudy.StudyError, match=r"bulk_stress_amplitude: found 0\.1 with a loop"):
        swtstudy.solve(load=loop, bulk_stress_amplitude=0.1)
    raised = swtstudy.solve(load=loop, bulk_stress_mean=[0.0, 0.05]).s
    assert float(raised[1]) > 1.1 * float(raised[0])


@pytest.mark.slow
def test_where_it_presses_tension_within_rounding_is_claimed() -> None:
    load = {"normal_amplitude": 0.0239, "tangential_amplitude": 0.3104, "phase": 5.497, "q": 2}
    pressed = with_bulk(points(**load, poisson_ratio=0.0622, friction=0.0752), 0.0567, -0.3527, 1.7071)
    found = solve_points(pressed, 1e-6)
    assert found.s[0] == 0.0 < found.s_error[0] < 1e-9


def test_without_tension_the_error_does_not_depend_on_the_point_before() -> None:
    load = {"normal_amplitude": [0.5, 0.0239], "tangential_amplitude": 0.3104, "phase": 5.497, "q": 2}
    both = points(**load, poisson_ratio=[0.3, 0.0622], friction=[0.5, 0.0752])
    pressed = with_bulk(both, 0.0567, [0.0, -0.3527], 1.7071)
    alone = solve_points(take(pressed, 1), 1e-6)
    after = solve_points(pressed, 1e-6)
    assert after.s[0] > 0.0
    assert (after.s[1], after.s_error[1]) == (alone.s[0], alone.s_error[0])
