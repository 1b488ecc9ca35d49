"""Criteria of shear: closed forms, brute force over places and planes, and what goes with which criterion."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from brute_shear import brute
from numpy.typing import NDArray
from scenes import plane_points, points, random_plane_points, random_points, take

import swtstudy
from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.body.body_maximum import body_maximum
from swtstudy.mechanics.numerics.hemisphere import hemisphere
from swtstudy.mechanics.planes.all_planes import swt_of_history
from swtstudy.mechanics.planes.crossland import smallest_sphere
from swtstudy.mechanics.planes.shear import FatemiSocie, Findley
from swtstudy.mechanics.planes.weights import symmetric_tensor
from swtstudy.mechanics.points import Points, Solution
from swtstudy.mechanics.stress.scene import scene_of
from swtstudy.points.grid import complete
from swtstudy.solving import solve_grid

Array = NDArray[np.float64]

SHEAR = {"fatemi_socie": FatemiSocie, "findley": Findley}


def of_criterion(batch: Points, name: str, sensitivity: float | Array) -> Points:
    return replace(batch, criterion=name, normal_sensitivity=np.full(len(batch), sensitivity))


def uniaxial(name: str, k: float, swing: Array, mean: float | Array = 0.0) -> Array:
    """A uniaxial stress of swing ±S about M: Findley's in closed form, that of planes 1e-5 rad apart."""
    if name == "findley":
        pull = k * (swing + mean)
        return np.asarray(0.5 * (pull + np.hypot(swing, pull)))
    θ = np.linspace(0.0, np.pi / 2.0, 157_081)
    shear, tension = 0.5 * np.sin(2.0 * θ), np.cos(θ) ** 2
    pairs = np.broadcast(swing, mean)
    return np.array([(s * shear * (1.0 + k * max(s + m, 0.0) * tension)).max() for s, m in pairs])


@pytest.mark.parametrize("name", SHEAR)
def test_cylinder_under_constant_load(name: str) -> None:
    """At its edge the stress in the section is uniaxial, of swing ±2 p0 √(Q/μP) μ, p0 = 1/2."""
    ratio, μ = np.array([0.1, 0.4, 0.7]), 0.5
    found = solve_points(of_criterion(plane_points("cylinder", 0.3, μ, 0.0, ratio), name, 0.4), 1e-6)
    np.testing.assert_allclose(found.s, uniaxial(name, 0.4, μ * np.sqrt(ratio)), rtol=1e-6)
    np.testing.assert_allclose(np.abs(found.critical_x), 1.0, rtol=1e-9)
    assert (np.abs(found.s - uniaxial(name, 0.4, μ * np.sqrt(ratio))) <= found.s_error).all()


@pytest.mark.parametrize("name", SHEAR)
def test_sphere_under_constant_load(name: str) -> None:
    """At its edge the stress is biaxial in the surface, σ_xx of swing ±τx about (1 − 2ν) p0/3.

    FS does not know pressure: where the stick zone ends, ±μp on the x-normal may be more.
    """
    ν, μ, u = 0.3, 0.3, np.array([0.2, 0.5, 0.7])
    θ = np.arcsin(np.sqrt(1.0 - u))
    i = (np.pi / 2 - θ) / 2 + np.sin(2 * θ) / 4
    j = (np.pi / 2 - θ) / 8 + np.sin(4 * θ) / 32
    swing, mean = 2 / np.pi * 2 * μ * (i + ν * j), 2 / np.pi * (1 - 2 * ν) / 3
    batch = points(poisson_ratio=ν, friction=μ, normal_amplitude=0.0, tangential_amplitude=u)
    found = solve_points(of_criterion(batch, name, 0.3), 1e-6)
    inside = μ * 2 / np.pi * np.sqrt(u) if name == "fatemi_socie" else 0.0
    np.testing.assert_allclose(found.s, np.maximum(uniaxial(name, 0.3, swing, mean), inside), rtol=1e-6)
    np.testing.assert_allclose(found.s_surface, found.s, rtol=1e-6)


def test_a_sliding_sphere_shears_most_inside() -> None:
    """FS does not know pressure: μp on the x-normal, at the centre, is more than at the edge."""
    batch = points(poisson_ratio=0.48, friction=0.24, normal_amplitude=0.0, tangential_amplitude=1.3)
    found = solve_points(of_criterion(batch, "fatemi_socie", 0.1), 1e-5)
    assert found.s[0] == pytest.approx(0.24 * 2.0 / np.pi, rel=1e-5)
    assert abs(found.critical_x[0]) < 2e-3


@pytest.mark.parametrize("name", SHEAR)
def test_nothing_that_moves(name: str) -> None:
    batch = points(normal_amplitude=0.0, tangential_amplitude=0.0)
    assert solve_points(of_criterion(batch, name, 0.3)).s[0] == 0.0


@pytest.mark.parametrize(("name", "profile"), [("fatemi_socie", "paraboloid"), ("findley", "rounded_flat")])
def test_no_place_plane_or_instant_of_the_line_has_more(name: str, profile: str) -> None:
    """Plain loops; 48 points of six profiles were no more than 7e-8 above s, and 2e-3 below."""
    plane = profile == "rounded_flat"
    batch = random_plane_points(405, 2, profile) if plane else random_points(400, 2, profile, largest_term=2)
    batch = of_criterion(replace(batch, walker_exponent=np.full(2, 0.5)), name, 0.4)
    found = solve_points(batch, 1e-4)
    for k in range(2):
        value, _ = brute(scene_of(take(batch, k)), name, 0.4, steps=24)
        assert value <= found.s[k] + found.s_error[k] + 1e-7 * value
        assert value >= (1.0 - 4e-3) * found.s[k]


def random_histories(seed: int, count: int, instants: int) -> Array:
    return np.asarray(np.random.default_rng(seed).normal(size=(count, instants, 6)))


def by_pairs(stress: Array, normals: Array, name: str, k: float) -> Array:
    """A criterion on planes, (n, planes), by the chords between all pairs of instants."""
    tensor = symmetric_tensor(stress)
    traction = np.einsum("ntij,pj->npti", tensor, normals)
    tension = np.einsum("npti,pi->npt", traction, normals)
    shear = traction - tension[..., None] * normals[None, :, None]
    amplitude = np.zeros(tension.shape[:2])
    for one, other in itertools.combinations(range(stress.shape[1]), 2):
        chord = np.linalg.norm(shear[:, :, one] - shear[:, :, other], axis=-1)
        amplitude = np.maximum(amplitude, 0.5 * chord)
    if name == "findley":
        return np.asarray(amplitude + k * tension.max(axis=-1))
    return np.asarray(amplitude * (1.0 + k * np.maximum(tension.max(axis=-1), 0.0)))


@pytest.mark.parametrize("instants", [3, 9])
@pytest.mark.parametrize("name", SHEAR)
def test_all_planes_against_all_pairs_of_instants(name: str, instants: int) -> None:
    stress = random_histories(instants, 30, instants)
    value, normal = swtstudy.criterion_of_history(stress, name, 0.3)
    table = by_pairs(stress, hemisphere(4000), name, 0.3)
    assert (table.max(axis=1) <= value * (1.0 + 5e-3)).all()
    assert np.median(table.max(axis=1) / value) <= 1.0
    np.testing.assert_allclose(table.max(axis=1), value, rtol=2e-2)
    own = [by_pairs(stress[[k]], normal[[k]], name, 0.3)[0, 0] for k in range(30)]
    # The largest chord itself, and no projection of it.
    np.testing.assert_allclose(own, value, rtol=6e-3)
    assert np.median(np.abs(own / value - 1.0)) < 1e-12


@pytest.mark.parametrize("name", SHEAR)
def test_derivatives_on_any_plane(name: str) -> None:
    """The amplitude's by the largest chord, against differences on great circles."""
    from swtstudy.mechanics.planes.swing import SHEAR_STRESS
    from swtstudy.mechanics.planes.weights import jet_weights, tangent_basis

    rng = np.random.default_rng(1)
    change, normal = rng.normal(size=(20, 6)), rng.normal(size=(20, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    tangent = tangent_basis(normal)
    jets = SHEAR_STRESS.amplitude_jets(jet_weights(normal, tangent), change)

    def amplitude(first: float, second: float) -> Array:
        way = first * tangent[:, 0] + second * tangent[:, 1]
        length = np.hypot(first, second)
        turned = np.cos(length) * normal + np.sinc(length / np.pi) * way
        traction = np.einsum("nij,nj->ni", symmetric_tensor(change), turned)
        inside = (traction * turned).sum(axis=1)
        return np.asarray(np.sqrt((traction**2).sum(axis=1) - inside**2))

    h = 1e-4
    here, right, left = amplitude(0, 0), amplitude(h, 0), amplitude(-h, 0)
    mixed = amplitude(h, h) - amplitude(h, -h) - amplitude(-h, h) + amplitude(-h, -h)
    np.testing.assert_allclose(jets[:, 0], here, rtol=1e-12)
    np.testing.assert_allclose(jets[:, 1], (right - left) / (2 * h), rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(jets[:, 3], (right - 2 * here + left) / h**2, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(jets[:, 5], mixed / (4 * h**2), rtol=1e-4, atol=1e-4)
    # And the criterion's of these.
    criterion = SHEAR[name](np.full(20, 0.4))
    tension = np.abs(rng.normal(size=(20, 6))) + 0.1
    slope, stiffness = criterion.log_derivatives(tension, jets)

    def logarithm(s: float) -> Array:
        T, a = (v[:, 0] + s * v[:, 1] + 0.5 * s * s * v[:, 3] for v in (tension, jets))
        return np.log(criterion.value(T, a))

    low, zero, high = logarithm(-h), logarithm(0.0), logarithm(h)
    np.testing.assert_allclose(slope[:, 0], (high - low) / (2 * h), rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(-stiffness[:, 0], (high - 2 * zero + low) / h**2, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("name", SHEAR)
def test_uniaxial_history_and_bulk_stress_far_away(name: str) -> None:
    mean, swing, k = 0.2, 0.5, 0.6
    history = np.zeros((3, 6))
    history[:, 0] = mean, mean + swing, mean - swing
    expected = uniaxial(name, k, np.array([swing]), mean)[0]
    assert swt_of_history(history, 0.3, 1.0, SHEAR[name](np.full(1, k))).swt == pytest.approx(
        expected, rel=1e-8
    )
    # A bulk stress so large that the contact hardly matters, in the plane and not.
    for batch in (
        points(normal_amplitude=0.0, tangential_amplitude=1e-3, friction=0.1),
        plane_points("cylinder", 0.3, 0.1, 0.0, 1e-3),
    ):
        bulk = {"bulk_stress_mean": np.array([mean]), "bulk_stress_amplitude": np.array([swing])}
        scene = scene_of(of_criterion(replace(batch, **bulk), name, k))
        far, double_angle = scene.bulk.far_field(scene.poisson_ratio, scene.criterion, scene.profile.plane)
        assert far[0] == pytest.approx(expected, rel=1e-8)
        θ = 0.5 * double_angle[0]
        there = scene.criterion.value((mean + swing) * np.cos(θ) ** 2, 0.5 * swing * np.sin(2 * θ))
        assert there[0] == pytest.approx(expected, rel=1e-8)


def test_the_body_says_the_same_as_the_line_where_friction_rules() -> None:
    batch = points(poisson_ratio=0.29, friction=0.5, normal_amplitude=0.3, tangential_amplitude=0.9)
    for name in SHEAR:
        own = of_criterion(batch, name, 0.3)
        line = solve_points(own, 1e-5)
        body, at_line = body_maximum(scene_of(own), float(line.critical_x[0]))
        assert at_line.swt == pytest.approx(line.s[0], rel=2e-5)
        assert body.swt == pytest.approx(line.s[0], rel=1e-4)


def test_crosslands_sphere() -> None:
    rng = np.random.default_rng(3)
    for dimension, count in itertools.product((2, 5, 6), (1, 2, 7, 40)):
        cloud = rng.normal(size=(count, dimension))
        centre, radius = smallest_sphere(cloud)
        away = np.linalg.norm(cloud - centre, axis=1)
        assert away.max() == pytest.approx(radius)
        on = cloud[away >= radius * (1.0 - 1e-9)]
        # The smallest has its centre between the points on it.
        assert len(on) >= min(count, 2)
        for _ in range(200):
            way = rng.normal(size=dimension)
            assert ((on - centre) @ way).max() >= -1e-9
    torsion = np.zeros((64, 6))
    t = 2.0 * np.pi * np.arange(64) / 64
    torsion[:, 5] = 0.7 * np.sin(t)
    assert swtstudy.criterion_of_history(torsion, "crossland", 0.4)[0] == pytest.approx(0.7)
    pull = np.zeros((2, 6))
    pull[1, 0] = 3.0
    value, normal = swtstudy.criterion_of_history(pull, "crossland", 0.4)
    assert value == pytest.approx(1.5 / np.sqrt(3.0) + 0.4)
    assert np.isnan(normal).all()


def test_a_criterion_is_a_dimension() -> None:
    names = ["swt", *SHEAR]
    found = swtstudy.solve(criterion=names, normal_sensitivity=0.3, phase=[0.0, 2.0])
    assert found.s.dims == ("criterion", "phase")
    assert found.s.attrs["criterion"] == "swt fatemi_socie findley"
    for name in names:
        own = {} if name == "swt" else {"criterion": name, "normal_sensitivity": 0.3}
        alone = swtstudy.solve(phase=[0.0, 2.0], **own)
        np.testing.assert_array_equal(found.s.sel(criterion=name), alone.s)
    assert "criterion" not in swtstudy.solve().coords
    assert "beneath the surface" in alone.s.attrs["comment"]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"criterion": "findley"}, "normal_sensitivity: found nothing"),
        ({"normal_sensitivity": 0.3}, "normal_sensitivity: found a value with the criterion swt"),
        (
            {"criterion": "findley", "normal_sensitivity": 0.3, "walker_exponent": 0.4},
            "walker_exponent: found",
        ),
        (
            {"criterion": "findley", "normal_sensitivity": 0.3, "critical_distance": 0.1},
            "critical_distance: found a value with the criterion findley",
        ),
        (
            {
                "criterion": ["swt", "findley"],
                "normal_sensitivity": 0.3,
                "profile": "truncated_paraboloid",
                "flat_radius": 0.3,
            },
            "profile: found truncated_paraboloid with the criterion findley",
        ),
        ({"criterion": "tresca"}, "criterion: found 'tresca'"),
    ],
)
def test_what_goes_with_no_criterion(given: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        swtstudy.solve(**given)


def test_wrong_histories() -> None:
    with pytest.raises(ValueError, match=r"criterion: found 'findly'; allowed: .*findley") as error:
        swtstudy.criterion_of_history(np.full((2, 6), np.nan), "findly", -1.0)
    assert len(str(error.value).splitlines()) == 3


def solution(batch: Points, name: str) -> Solution:
    return solve_points(of_criterion(batch, name, 0.4), 1e-4)


@pytest.mark.parametrize("name", SHEAR)
def test_half_a_period_later_it_is_mirrored(name: str) -> None:
    """s(ψ) has the period of swt's: what is canonical for it is so for each criterion."""
    found = solution(points(phase=[0.7, 0.7 + np.pi], q=2, p=1, tangential_amplitude=0.7), name)
    turned = solution(points(phase=[0.7, 0.7 + 2 * np.pi], q=2, p=1, tangential_amplitude=0.7), name)
    assert turned.s[0] == pytest.approx(turned.s[1], rel=1e-6)
    assert found.s[0] != pytest.approx(found.s[1], rel=1e-3)


def test_lives_of_shear() -> None:
    """Both ways, and each term alone where it rules."""
    tensile = swtstudy.FatigueConstants(200e3, 1000.0, -0.1, 0.5, -0.6)
    own = swtstudy.ShearConstants.estimated(tensile, 0.25)
    cycles = np.array([1.0, 1e3, 1e5, 1e7])
    expected = 1000.0 / np.sqrt(3.0) / 80e3 * (2 * cycles) ** -0.1 + np.sqrt(3.0) * 0.5 * (2 * cycles) ** -0.6
    np.testing.assert_allclose(own.parameter(cycles), expected, rtol=1e-12)
    np.testing.assert_allclose(own.cycles(expected), cycles, rtol=1e-9)
    assert own.cycles(0.0) == np.inf
    with pytest.raises(ValueError, match="strength: found 0"):
        swtstudy.ShearConstants(80e3, 0.0, -0.1, 0.5, -0.6)
    with pytest.raises(ValueError, match="poisson_ratio: found 2"):
        swtstudy.ShearConstants.estimated(tensile, 2.0)


def test_the_circle_knows_planes_that_do_not_hold_the_y_axis() -> None:
    """At ν = 0 a sphere shears more beside the line, between x and y, than on it."""
    own = points(poisson_ratio=0.02, friction=0.2, normal_amplitude=0.0, tangential_amplitude=0.5)
    own = of_criterion(own, "fatemi_socie", 1.5)
    line, scene = solve_points(own, 1e-4), scene_of(own)
    angle = np.linspace(0.0, 0.5 * np.pi, 65)
    nodes = time_nodes(scene, 12, [1.0])
    x = line.critical_x[0]
    found = Body(scene, nodes, 60).swt(x * np.cos(angle), np.sin(angle), 0.0)
    assert found.swt.max() > 1.02 * line.s[0]
    assert np.abs(found.normal[found.swt.argmax(), 1]) > 0.5
    assert line.s_surface[0] == pytest.approx(found.swt.max(), rel=1e-3)


STEEL = {"young_modulus": 210e3, "poisson_ratio": 0.3, "radius": 50.0, "normal_force": 200.0, "friction": 0.5}


def test_criteria_with_units() -> None:
    """Findley's is a stress; Fatemi's and Socie's a strain, whose k is over the yield strength."""
    own = STEEL | {"tangential_force_amplitude": [30.0, 60.0]}
    contact = swtstudy.physical(**own, criterion=["swt", "findley"], normal_sensitivity=0.3)
    found = contact.solve().sel(body=1)
    stress = contact.moduli.normal * contact.depth / contact.length_scale
    pure = contact.grid.numbers["tangential_amplitude"].values
    given = {"tangential_force_amplitude": pure, "normal_force_amplitude": 0.0, "friction": 0.5}
    alone = swtstudy.solve(**given, criterion="findley", normal_sensitivity=0.3, poisson_ratio=0.3)
    expected = stress * alone.s.values
    np.testing.assert_allclose(found.findley_stress.sel(criterion="findley"), expected, rtol=1e-6)
    assert np.isnan(found.findley_stress.sel(criterion="swt")).all()
    assert np.isnan(found.SWT.sel(criterion="findley")).all()
    assert np.isfinite(found.SWT.sel(criterion="swt")).all()
    one = swtstudy.physical(
        **(own | {"tangential_force_amplitude": 30.0}), criterion="findley", normal_sensitivity=0.0
    )
    assert swtstudy.solve(**one.parameters()).s == pytest.approx(one.solve().s.values[0], rel=1e-9)
    with pytest.raises(ValueError, match="yield_strength: found nothing"):
        swtstudy.physical(**own, criterion="fatemi_socie", normal_sensitivity=0.3)

    constants = (swtstudy.FatigueConstants(210e3, 900.0, -0.1, 0.5, -0.6),) * 2
    grid = replace(contact.grid, axes={**contact.grid.axes, "criterion": ("swt", "fatemi_socie")})
    strong = solve_grid(replace(grid, yield_strengths=(400.0, 500.0), materials=constants), 1e-5)
    for body, strength in ((1, 400.0), (2, 500.0)):
        fs = strong.sel(body=body, criterion="fatemi_socie")
        alone = swtstudy.solve(
            **given,
            criterion="fatemi_socie",
            normal_sensitivity=0.3 * stress / strength,
            poisson_ratio=0.3,
            rtol=1e-5,
        )
        np.testing.assert_allclose(fs.s, alone.s, rtol=1e-6)
        np.testing.assert_allclose(fs.FS, alone.s * stress / (210e3 / 2.6), rtol=1e-6)
        life = swtstudy.ShearConstants.estimated(constants[0], 0.3)
        np.testing.assert_allclose(fs.FS_cycles, life.cycles(fs.FS), rtol=1e-6)
        assert np.isnan(fs.cycles).all()


def test_swt_has_no_sensitivity_to_tell_points_apart() -> None:
    names = {"criterion": ("swt", "findley"), "normal_sensitivity": (0.1, 0.3)}
    rows, _ = complete({}, names).canonical()
    assert (rows[0] == rows[1]).all()
    assert len({*map(tuple, rows)}) == 3


def test_on_the_line_a_plane_that_does_not_hold_the_y_axis_may_be_higher() -> None:
    own = random_points(3, 8, "paraboloid", largest_term=2)
    one = {"friction": 0.307, "poisson_ratio": 0.06, "normal_amplitude": 0.1, "tangential_amplitude": 1.46}
    own = replace(take(own, 1), **{name: np.full(1, value) for name, value in one.items()})
    own = of_criterion(own, "fatemi_socie", 0.74)
    line = solve_points(own, 1e-4)
    _, at_line = body_maximum(scene_of(own), float(line.critical_x[0]))
    assert at_line.swt > 1.005 * line.s[0]
    # At the instants that make s: others may make the other plane.
    assert line.s_surface[0] >= at_line.swt * (1.0 - 3e-3)
