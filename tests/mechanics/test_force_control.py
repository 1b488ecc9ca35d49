"""Prescribed forces: the memory diagram in the other coordinate, against springs marched one by one."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest
from memory import prescribed_scene, slopes
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.force_march import ForceMarch, second_round
from scipy.special import struve

from swtstudy.mechanics.contact.cycle import out_of_equilibrium
from swtstudy.mechanics.control.coordinate import ForceCoordinate, profile_up_to_force, unit_half_load
from swtstudy.mechanics.line.look import Accuracy
from swtstudy.mechanics.line.maximum import Maximum, maximum
from swtstudy.mechanics.line.singular_edge import _seen_from_edge, at_edge, may_be_largest, not_finite
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.load.polygon import PolygonLoad
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.mechanics.stress.work import (
    dissipated_work,
    largest_contact_radius,
    largest_force_ratio,
    permanent_stick_radius,
)
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]
INDENTERS = {
    "paraboloid": oracle.paraboloid(),
    "rounded_punch": oracle.rounded_punch(0.6),
    "truncated_paraboloid": oracle.truncated_paraboloid(0.5),
    "wavy_paraboloid": oracle.wavy_paraboloid(0.03, 4.5),
    "power_law": oracle.power_law(3.0),
}
EVERY = [(normal, tangential) for normal in (False, True) for tangential in (False, True)]


def scene_of(load: Load, control: Control, name: str = "paraboloid", mu: float = 0.5) -> Scene:
    many = np.ones(len(load))
    shape = {key: value * many for key, value in INDENTERS[name].shape.items()}
    return prescribed_scene(load, control, 0.3 * many, mu * many, name, shape)


def largest(scene: Scene, rtol: float = 1e-6) -> Maximum:
    return maximum(scene, Accuracy.for_tolerance(rtol))


def harmonic(f: float, q: float, psi: float, p: int = 1, periods: int = 1) -> BimodalLoad:
    return BimodalLoad(np.array([f]), np.array([q]), np.array([psi]), p, periods)


def depth_of(name: str, xi: Array) -> Array:
    """g(ξ)/δ0 of the profiles of `INDENTERS` (eq. 11)."""
    b = INDENTERS[name].flat_radius
    w = np.sqrt(np.maximum(xi**2 - b**2, 0.0))
    if name == "rounded_punch":
        return np.asarray(xi * (w - b * np.arctan2(w, b)))
    if name == "truncated_paraboloid":
        return xi * w
    if name in ("paraboloid", "power_law"):
        return np.asarray(xi ** INDENTERS[name].shape.get("exponent", 2.0))
    return np.interp(xi, *wavy_depth())


@lru_cache
def wavy_depth() -> tuple[Array, Array]:
    """g of the wavy one in a fine table: the Struve function is slow."""
    xi = np.linspace(0.0, 2.5, 20001)
    h, wavelength = INDENTERS["wavy_paraboloid"].shape.values()
    z = 2.0 * np.pi / (wavelength * np.sqrt(h)) * xi
    return xi, np.asarray(xi**2 + 0.5 * np.pi * h * z * struve(0, z))


def package_forces(scene: Scene, name: str, radius: Array, instant: float) -> Array:
    """τ of springs at radii: −∫ τ′ dG from the edge inwards, over the pieces of the package's diagram."""
    node, weight = np.polynomial.legendre.leggauss(10)
    share = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, 7))
    # Over w = √(ξ² − b²), in which g is smooth.
    b, tau = INDENTERS[name].flat_radius, np.zeros_like(radius)
    own = np.sqrt(np.maximum(radius**2 - b**2, 0.0))
    for begin, end, slope in slopes(scene.cycle, instant):
        xi = scene.coordinate.radius(np.array([[begin, end]]))[0]
        first, last = np.sqrt(np.maximum(xi**2 - b**2, 0.0))
        for ends in pairwise(first + (last - first) * share):
            inside = np.clip(own, *ends)
            half = 0.5 * (ends[1] - inside)
            w = inside[:, None] + half[:, None] * (1.0 + node)
            at = scene.coordinate.of(np.hypot(w, b).reshape(1, -1))[0]
            values = np.broadcast_to(slope(at), at.shape).reshape(w.shape)
            rate = (depth_of(name, np.hypot(w + 1e-6, b)) - depth_of(name, np.hypot(w - 1e-6, b))) / 2e-6
            tau -= (half[:, None] * weight * values * rate).sum(axis=1)
    return tau


def random_harmonic(rng: np.random.Generator, control: Control) -> BimodalLoad:
    """A load that leaves the contact in equilibrium, with slip."""
    p, q = [(1, 1), (1, 2), (2, 1), (3, 2)][rng.integers(4)]
    f, psi = rng.uniform(0.2, 0.7), rng.uniform(0.0, 2.0 * np.pi)
    t = np.linspace(0.0, 2.0 * np.pi, 2001)
    normal = 1.0 + f * np.sin(q * t + psi)
    if control.tangential_force and not control.normal_force:
        normal = np.maximum(normal, 0.0) ** 1.5 * 0.7  # no profile's force is smaller
    limit = np.min(normal / np.maximum(np.abs(np.sin(p * t)), 1e-9))
    return harmonic(f, rng.uniform(0.5, 0.9) * limit, psi, p, q)


@pytest.mark.parametrize(("normal_force", "tangential_force"), EVERY)
@pytest.mark.parametrize("name", INDENTERS)
def test_every_spring_carries_what_a_march_with_solved_displacements_gives_it(
    name: str, normal_force: bool, tangential_force: bool
) -> None:
    control = Control(normal_force, tangential_force)
    rng = np.random.default_rng([normal_force, tangential_force, *map(ord, name)])
    load = random_harmonic(rng, control)
    scene = scene_of(load, control, name)
    edges = np.linspace(0.0, 1.02 * scene.profile.radius(scene.profile.largest_depth)[0], 241)
    radius = 0.5 * (edges[1:] + edges[:-1])
    steps = 320
    t = 2.0 * np.pi * np.arange(steps) / steps
    springs = ForceMarch(depth_of(name, radius), np.diff(edges))
    expected = second_round(
        springs, load.normal(t[None])[0], load.tangential(t[None])[0], normal_force, tangential_force
    )
    some = rng.choice(steps, 3, replace=False)
    found = np.stack([package_forces(scene, name, radius, t[k]) for k in some])
    assert np.abs(expected[some]).max() > 0.05
    # The march's steps and springs.
    np.testing.assert_allclose(found, expected[some], rtol=0.0, atol=5e-4)


@pytest.mark.parametrize("name", INDENTERS)
@pytest.mark.parametrize("forces", [True, False])
def test_springs_under_a_polygon_of_two_forces_or_two_displacements(name: str, forces: bool) -> None:
    rng = np.random.default_rng([17, forces, *map(ord, name)])
    corners = np.stack([rng.uniform(0.2, 1.7, 7), rng.uniform(-0.9, 0.9, 7)], axis=1)
    corners[:, 1] *= corners[:, 0] if forces else 1.3
    load = PolygonLoad.of([corners])
    scene = scene_of(load, Control(forces, forces), name)
    edges = np.linspace(0.0, 1.02 * scene.profile.radius(scene.profile.largest_depth)[0], 241)
    radius = 0.5 * (edges[1:] + edges[:-1])
    # A whole number of steps on each side.
    t = 2.0 * np.pi * np.arange(420) / 420
    springs = ForceMarch(depth_of(name, radius), np.diff(edges))
    normal, tangential = load.normal(t[None])[0], load.tangential(t[None])[0]
    expected = second_round(springs, normal, tangential, forces, forces)
    some = rng.choice(np.flatnonzero(np.arange(420) % 60), 4, replace=False)
    found = np.stack([package_forces(scene, name, radius, t[k]) for k in some])
    assert np.abs(expected[some]).max() > 0.05
    np.testing.assert_allclose(found, expected[some], rtol=0.0, atol=5e-4)


def units(load: Load, name: str) -> Array:
    many = np.ones(len(load))
    return unit_half_load(
        name, {key: value * many for key, value in INDENTERS[name].shape.items()}, len(load)
    )


@pytest.mark.parametrize("name", INDENTERS)
def test_the_radius_at_a_force_is_the_inverse_of_the_force(name: str) -> None:
    shape = {key: value * np.ones(2) for key, value in INDENTERS[name].shape.items()}
    profile, unit = profile_up_to_force(name, shape, np.array([1.9, 0.7]))
    coordinate = ForceCoordinate(profile, unit)
    force = np.concatenate([np.geomspace(1e-6, 0.1, 30), np.linspace(0.1, 1.0, 30)])
    force = np.stack([1.9 * force, 0.7 * force])
    radius = coordinate.radius(force)
    # Next to a flat face ξ − b has few digits, and the rounded punch's force is a difference of terms b³.
    atol = 1e-11 if INDENTERS[name].flat_radius else 0.0
    np.testing.assert_allclose(coordinate.of(radius), force, rtol=1e-12, atol=atol)
    largest_radius = profile.radius(profile.largest_depth)
    np.testing.assert_allclose(largest_radius, radius[:, -1], rtol=1e-12)
    # ∫ ξ dg by the profile's own definition, over that up to the depth δ0.
    w, b = np.linspace(0.0, 2.2, 200_001), INDENTERS[name].flat_radius
    xi = np.hypot(w, b)
    g = depth_of(name, xi)
    half_load = np.append(0.0, np.cumsum(0.5 * (xi[1:] + xi[:-1]) * np.diff(g)))
    at = np.interp(np.sqrt((radius - b) * (radius + b)), w, half_load) / np.interp(1.0, g, half_load)
    np.testing.assert_allclose(at, force, rtol=0.0, atol=1e-7)
    taken = coordinate.take(np.array([1, 0, 1]))
    np.testing.assert_array_equal(taken.radius(force[[1, 0, 1]]), radius[[1, 0, 1]])
    np.testing.assert_array_equal(taken.take(np.array([2, 1])).radius(force[[1, 0]]), radius[[1, 0]])
    at_radius, slope = coordinate.with_weighted_slope(radius)
    np.testing.assert_array_equal(at_radius, coordinate.of(radius))
    np.testing.assert_array_equal(slope, profile.weighted_slope(radius))


def test_the_paraboloids_force_is_the_cube_of_the_radius() -> None:
    profile, unit = profile_up_to_force("paraboloid", {}, np.array([2.0]))
    coordinate = ForceCoordinate(profile, unit)
    xi = np.linspace(0.0, 1.25, 50)[None]
    np.testing.assert_allclose(coordinate.of(xi), xi**3, rtol=1e-14)
    np.testing.assert_allclose(coordinate.radius(xi**3), xi, rtol=1e-14)


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", INDENTERS)
def test_at_constant_normal_load_both_controls_give_the_same(name: str) -> None:
    u = np.array([0.2, 0.6, 0.9])
    shape = {key: value * np.ones(3) for key, value in INDENTERS[name].shape.items()}
    profile, unit = profile_up_to_force(name, shape, np.ones(3))
    # Cattaneo and Mindlin: g(c) = 1 − U, Q = 1 − N(c).
    force = 1.0 - ForceCoordinate(profile, unit).of(profile.radius(1.0 - u[:, None]))[:, 0]
    found = []
    for control in (Control(*kind) for kind in EVERY):
        amplitude = force if control.tangential_force else u
        load = BimodalLoad(np.zeros(3), amplitude, np.zeros(3), 1, 1)
        scene = scene_of(load, control, name)
        found.append([largest(scene).swt, dissipated_work(scene, unit)[0], largest_force_ratio(scene, unit)])
        found[-1] += [permanent_stick_radius(scene, unit), largest_contact_radius(scene, unit)]
    for one in found[1:]:
        for values, expected in zip(one, found[0], strict=True):
            np.testing.assert_allclose(values, expected, rtol=2e-6)
    np.testing.assert_allclose(found[0][2], force, rtol=1e-9)


def test_a_prescribed_force_makes_the_known_value() -> None:
    found = largest(scene_of(harmonic(0.5, 0.35, 1.1), Control(True, True)))
    # By another code, to some 2e-5.
    assert found.swt[0] == pytest.approx(0.1238493, rel=4e-5)
    # By springs whose offsets are clipped at the turning points of T ± N one by one, integrated over 4,000
    # cells of the angle, and searched with ever closer instants, to 3e-8.
    assert found.swt[0] == pytest.approx(0.12384632, rel=1e-7)
    assert found.position[0] == pytest.approx(-0.959599, abs=5e-5)


def test_incipient_sliding_is_the_same_in_both_controls() -> None:
    by_force = largest(scene_of(harmonic(0.0, 1.0, 0.0), Control(True, True)))
    by_displacement = largest(scene_of(harmonic(0.0, 1.0, 0.0), Control()))
    assert by_force.swt[0] == pytest.approx(by_displacement.swt[0], rel=1e-5)


def test_sliding_next_to_a_flat_faces_edge_is_the_same_in_both_controls() -> None:
    # The whole contact slides, within rounding of what can be carried: s is made next to r = b.
    load = harmonic(0.0, 1.0 + 1e-13, 0.0)
    sliding, flat = (np.array([0.3]), np.array([0.95])), np.array([1.5])
    found = []
    for control in (Control(), Control(True, True)):
        scene = prescribed_scene(load, control, *sliding, "truncated_paraboloid", {"flat_radius": flat})
        assert may_be_largest(scene)[0]
        assert not not_finite(scene)[0]
        assert not out_of_equilibrium(scene.cycle.load, Control(True, True))[0]
        accuracy = Accuracy.for_tolerance(1e-5)
        found.append(at_edge(scene, maximum(scene, accuracy), accuracy))
    edge, force = _seen_from_edge(scene.coordinate, np.ones((1, 1))), np.array([[0.3, 1.0]])
    np.testing.assert_allclose(edge.radius(force), scene.coordinate.radius(force))
    np.testing.assert_allclose(edge.of(flat), scene.coordinate.of(np.hypot(flat, 1e-7 * flat)), rtol=0.05)
    assert [abs(one.position[0]) for one in found] == [flat[0], flat[0]]
    assert found[1].swt[0] == pytest.approx(found[0].swt[0], rel=2e-5)


def test_dissipated_work_is_mindlins() -> None:
    u = np.array([1e-3, 0.1, 0.5, 5 / 6, 1.0, 1.3])
    stick = np.maximum(1.0 - u, 0.0)
    load = BimodalLoad(np.zeros(6), u, np.zeros(6), 1, 1)
    scene, unit = scene_of(load, Control()), units(load, "paraboloid")
    expected = 4.0 * u * (1.0 + stick**1.5) - 3.2 * (1.0 - stick**2.5)
    expected = np.where(u <= 1.0, expected, 0.8 + 4.0 * (u - 1.0))
    work, error = dissipated_work(scene, unit)
    np.testing.assert_allclose(work, expected, rtol=1e-7, atol=1e-13)
    assert (np.abs(work - expected) <= error + 1e-15).all()
    assert (error <= 1e-6 * expected + 1e-13).all()
    radius = permanent_stick_radius(scene, unit)
    np.testing.assert_allclose(radius[:-1], np.sqrt(stick[:-1]), rtol=1e-12)
    assert np.isnan(radius[-1])
    np.testing.assert_allclose(largest_contact_radius(scene, unit), 1.0)
    np.testing.assert_allclose(largest_force_ratio(scene, unit), 1.0 - stick**1.5, rtol=1e-9)
    straight = PolygonLoad.of([np.array([[1.0, value], [1.0, -value]]) for value in u])
    work, _ = dissipated_work(scene_of(straight, Control()), units(straight, "paraboloid"))
    np.testing.assert_allclose(work, expected, rtol=1e-7, atol=1e-13)


@pytest.mark.parametrize(("normal_force", "tangential_force"), EVERY)
def test_work_and_largest_force_are_those_of_the_marched_springs(
    normal_force: bool, tangential_force: bool
) -> None:
    control = Control(normal_force, tangential_force)
    load = harmonic(0.4, 0.42, 0.8, 3, 2)
    scene = scene_of(load, control)
    unit = units(load, "paraboloid")
    edges = np.linspace(0.0, 1.02 * scene.profile.radius(scene.profile.largest_depth)[0], 301)
    radius = 0.5 * (edges[1:] + edges[:-1])
    t = 2.0 * np.pi * np.arange(600) / 600
    springs = ForceMarch(radius**2, np.diff(edges))
    normal, tangential = load.normal(t[None])[0], load.tangential(t[None])[0]
    moved = np.empty(len(t))
    tau = second_round(springs, normal, tangential, normal_force, tangential_force, moved)
    force = tau @ springs.width / springs.unit
    depth = np.array([springs.depth_at(value, normal_force) for value in normal])
    carried = np.maximum(depth[:, None] - radius**2, 0.0) @ springs.width / springs.unit
    work = 0.5 * (force + np.roll(force, 1)) @ (moved - np.roll(moved, 1))
    assert dissipated_work(scene, unit)[0][0] == pytest.approx(work, rel=3e-3)
    assert largest_force_ratio(scene, unit)[0] == pytest.approx(np.abs(force / carried).max(), rel=1e-3)
    assert work > 0.01


def test_what_cannot_be_carried_is_told() -> None:
    f, q = np.array([0.5, 0.5, 0.5, 1.0, 1.2, 0.0]), np.array([0.5, 0.5 + 1e-9, 0.49, 0.0, 0.0, 1.0])
    load = BimodalLoad(f, q, np.zeros(6), 1, 1)
    # In phase and out of phase: Q² + F² + 2 Q F |cos ψ| ≤ 1 for two forces.
    amplitude = np.array([0.5, 0.5, 0.5, 1.0, 1.2, 0.0]) + q
    np.testing.assert_array_equal(out_of_equilibrium(load, Control(True, True)), amplitude > 1.0 + 1e-12)
    np.testing.assert_array_equal(out_of_equilibrium(load, Control(True, False)), f > 1.0)
    assert not out_of_equilibrium(load, Control(False, False)).any()
    psi = np.linspace(0.0, 3.0, 7)
    limit = -0.6 * np.abs(np.cos(psi)) + np.sqrt(1.0 - 0.36 * np.sin(psi) ** 2)
    for share, lost in ((1.0 - 1e-9, False), (1.0, False), (1.0 + 1e-9, True)):
        load = BimodalLoad(np.full(7, 0.6), share * limit, psi, 1, 1)
        np.testing.assert_array_equal(out_of_equilibrium(load, Control(True, True)), lost)


def test_a_depth_that_lifts_off_cannot_carry_a_tangential_force() -> None:
    scene = scene_of(harmonic(1.1, 0.1, 0.3), Control(False, True))
    assert out_of_equilibrium(scene.cycle.load, Control(False, True))[0]


@pytest.mark.parametrize(("normal_force", "tangential_force"), [(True, False), (False, True)])
def test_a_loop_in_mixed_control_needs_a_constant_normal_load(
    normal_force: bool, tangential_force: bool
) -> None:
    control = Control(normal_force, tangential_force)
    with pytest.raises(ValueError, match="two displacements or two forces"):
        scene_of(PolygonLoad.of([np.array([[1.0, 0.0], [1.2, 0.3]])]), control)
    steady = PolygonLoad.of([np.array([[1.0, 0.4], [1.0, -0.4]])])
    straight = largest(scene_of(steady, control))
    harmonic_one = largest(scene_of(harmonic(0.0, 0.4, 0.0), control))
    assert straight.swt[0] == pytest.approx(harmonic_one.swt[0], rel=2e-6)


@pytest.mark.quick(8)
@pytest.mark.parametrize("name", INDENTERS)
@pytest.mark.parametrize(
    ("normal_force", "p", "q"), [(True, 1, 1), (False, 3, 2), (True, 1, 4), (False, 4, 1)]
)
def test_mapped_loads_turn_where_their_turning_instants_are(
    name: str, normal_force: bool, p: int, q: int
) -> None:
    rng = np.random.default_rng([p, q])
    n = 8
    f, t = np.append(rng.uniform(0.0, 0.99, n - 2), [1.0, 1.2]), rng.uniform(0.01, 1.0, n)
    given = BimodalLoad(f, t, rng.uniform(0.0, 6.0, n), p, q)
    load = scene_of(given, Control(normal_force, not normal_force), name).cycle.load
    turns = load.turning_instants()
    fine = np.linspace(0.0, 2.0 * np.pi, 10_001)
    grid = np.broadcast_to(fine, (n, fine.size))
    normal, tangential = load.normal(grid), load.tangential(grid)
    for values in (normal, tangential - normal, tangential + normal):
        step = np.diff(values, axis=1)
        step[np.abs(step) < 1e-13] = 0.0
        row, cell = np.nonzero(step[:, 1:] * step[:, :-1] < 0.0)
        near = (turns[row] >= fine[cell, None] - 1e-9) & (turns[row] <= fine[cell + 2, None] + 1e-9)
        assert np.all(near.any(axis=1))
    inside = grid[:, 40:-40:50]
    rate = (load.normal(inside + 1e-6) - load.normal(inside - 1e-6)) / 2e-6
    smooth = load.normal(inside) > 0.05
    np.testing.assert_allclose(load.normal_rate(inside)[smooth], rate[smooth], rtol=1e-5, atol=1e-7)
