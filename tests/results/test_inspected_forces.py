"""Forces and displacements of one point over its cycle, for all that may be prescribed, and their panels."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

import swtstudy
from swtstudy.paper.formalisms import march_springs

SQUARE = swtstudy.LoadPath("square", [[1, 1], [1, -1], [-1, -1], [-1, 1]])
MINOR = swtstudy.LoadPath.harmonic_sum("minor", [(1, 1, 0), (3, 0.4, 0.5)], [(1, 1, 1.0), (5, 0.25, 0)])
SCENES = {
    "displacements": {"phase": 0.5},
    "forces": {"normal_force_amplitude": 0.4, "tangential_force_amplitude": 0.35, "phase": 1.5},
    "normal force": {"normal_force_amplitude": 0.4, "tangential_amplitude": 0.7, "phase": 1},
    "tangential force": {"normal_amplitude": 0.4, "tangential_force_amplitude": 0.35, "phase": 2},
    "two periods": {
        "normal_force_amplitude": 0.4,
        "tangential_force_amplitude": 0.35,
        "frequency_ratio": "3/2",
        "profile": "rounded_punch",
        "flat_radius": 0.5,
    },
    "square": {"load": SQUARE, "normal_amplitude": 0.3, "tangential_amplitude": 0.3},
    "square of forces": {"load": SQUARE, "normal_force_amplitude": 0.3, "tangential_force_amplitude": 0.3},
    "sum": {"load": MINOR, "normal_amplitude": 0.3, "tangential_amplitude": 0.6},
    "sum of forces": {"load": MINOR, "normal_force_amplitude": 0.3, "tangential_force_amplitude": 0.4},
}


def spring_depth(r, parameters):
    """g(r) of a paraboloid or of a rounded punch over δ0."""
    b = parameters.get("flat_radius", 0.0)
    slope = np.sqrt(np.maximum(r**2 - b**2, 0.0))
    return r * slope - b * r * np.arctan2(slope, b)


def unit_of(parameters):
    """∫ w dr at the depth δ0 over δ0 a_H: F_0 of the springs."""
    r = np.linspace(0.0, 3.0, 300_001)
    return trapezoid(np.maximum(1.0 - spring_depth(r, parameters), 0.0), r)


@pytest.fixture(scope="module")
def points():
    return {name: swtstudy.inspect_point(**parameters) for name, parameters in SCENES.items()}


def test_what_is_prescribed_is_what_is_run(points):
    forces = points["forces"]
    t = forces.time.values
    np.testing.assert_allclose(forces.normal_force, 1 + 0.4 * np.sin(t + 1.5), atol=1e-12)
    np.testing.assert_allclose(forces.tangential_force, 0.35 * np.sin(t), atol=1e-12)
    t = points["normal force"].time.values
    np.testing.assert_allclose(points["normal force"].normal_force, 1 + 0.4 * np.sin(t + 1), atol=1e-9)
    np.testing.assert_allclose(points["normal force"].displacement, 0.7 * np.sin(t), atol=1e-12)
    t = points["tangential force"].time.values
    np.testing.assert_allclose(points["tangential force"].depth, 1 + 0.4 * np.sin(t + 2), atol=1e-9)
    np.testing.assert_allclose(points["tangential force"].tangential_force, 0.35 * np.sin(t), atol=1e-12)
    two = points["two periods"]
    assert float(two.time[-1]) == pytest.approx(4 * np.pi)
    np.testing.assert_allclose(two.tangential_force, 0.35 * np.sin(1.5 * two.time), atol=1e-12)
    total = points["sum of forces"]
    t = total.time.values
    assert t[-1] == pytest.approx(2 * np.pi)
    np.testing.assert_allclose(
        total.normal_force, 1 + 0.3 * (np.sin(t) + 0.4 * np.sin(3 * t + 0.5)), atol=1e-12
    )


def test_springs_are_compressed_by_the_depth_beyond_their_own(points):
    point = points["displacements"]
    r, depth = point.r.values, np.interp(point.instant_time, point.time, point.depth)
    expected = np.maximum(depth[:, None] - r**2, 0.0)
    np.testing.assert_allclose(point.compression, expected, atol=1e-4)


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", SCENES)
def test_springs_moved_like_that_give_these_forces(points, name):
    """Springs clipped step by step, from rest at u = 0: forces are their sums, F = ∫ w dr and ∫ τ dr."""
    point = points[name]
    cycle = np.linspace(0.0, float(point.time[-1]), 3001)
    depth, u = (np.interp(cycle, point.time, point[each]) for each in ("depth", "displacement"))
    node, weight = np.polynomial.legendre.leggauss(200)
    r = 0.5 * float(point.largest_radius) * (1.0 + node)
    springs = np.concatenate([spring_depth(r, SCENES[name]), spring_depth(point.r.values, SCENES[name])])
    course = np.concatenate([depth[:1], depth, depth[1:]]), np.concatenate([[0.0], u, u[1:]])
    compression, force = (part[-len(cycle) :] for part in march_springs(springs, *course, periods=1))
    unit = unit_of(SCENES[name]) / (0.5 * float(point.largest_radius))
    for found, march in ((point.normal_force, compression), (point.tangential_force, force)):
        expected = march[:, : len(r)] @ weight / unit
        np.testing.assert_allclose(np.interp(cycle, point.time, found), expected, atol=2e-3)
    for time, w, tau in zip(point.instant_time.values, point.compression, point.force, strict=True):
        at = int(np.abs(cycle - time).argmin())
        np.testing.assert_allclose(w, compression[at, len(r) :], atol=2e-3)
        np.testing.assert_allclose(tau, force[at, len(r) :], atol=5e-3)


@pytest.mark.parametrize("name", SCENES)
def test_the_loop_has_the_area_of_the_work(points, name):
    point = points[name]
    u, force = point.displacement.values, point.tangential_force.values
    area = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(u))
    assert area == pytest.approx(float(point.dissipation), rel=2e-3, abs=2e-6)
    assert (np.abs(force) <= point.normal_force + 1e-9).all()


@pytest.mark.parametrize("name", SCENES)
def test_the_state_next_to_the_edge_is_that_of_the_slip_map(points, name):
    point = points[name]
    slips = (point.slip_radius < point.contact_radius - 1e-6).values
    # Between two instants at which springs of one sense slip they do.
    both = slips[:-1] & slips[1:]
    ring = (0.5 * (point.slip_radius + point.contact_radius)).values
    cell = np.abs(point.r.values[None] - ring[:, None]).argmin(axis=1)
    seen = point.state.values[np.arange(len(ring)), cell]
    wide = (point.contact_radius - point.slip_radius).values > 0.01
    same = both & wide[:-1] & wide[1:] & (seen[:-1] == seen[1:])
    assert same.any()
    np.testing.assert_array_equal(point.edge_state.values[:-1][same], seen[:-1][same])
    sticks = ~slips[:-1] & ~slips[1:] & (np.diff(point.time) > 1e-3)
    assert (point.edge_state.values[:-1][sticks] == 1).mean() > 0.95


def test_no_contact_is_open():
    point = swtstudy.inspect_point(normal_amplitude=1.5)
    apart = (point.depth.values[:-1] < -1e-9) & (point.depth.values[1:] < -1e-9)
    assert (point.edge_state.values[:-1][apart] == 0).all()
    assert (point.normal_force.values[:-1][apart] == 0).all()
    np.testing.assert_allclose(point.tangential_force.values[:-1][apart], 0, atol=1e-12)


@pytest.mark.slow
def test_a_loop_has_no_frequencies_and_no_phase():
    figure = swtstudy.inspect(**SCENES["sum"])
    assert "omega" not in figure.get_suptitle()
    assert "psi" not in figure.get_suptitle()
    assert "minor" in figure.get_suptitle()
    assert [figure.axes[k].get_xlabel() for k in (1, 4, 7)] == [r"$\varphi$"] * 3
    figure = swtstudy.inspect(**SCENES["forces"])
    assert [figure.axes[k].get_xlabel() for k in (1, 4, 7)] == [r"$\omega_1 t$"] * 3
    assert figure.axes[0].get_title("left").endswith("load path, $F_x$ and $F_N$ prescribed")
