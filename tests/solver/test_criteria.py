"""Criteria of shear: closed forms, brute force over places and planes, and what goes with which criterion."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from body import body_maximum, history_at, swt_at
from numpy.typing import NDArray
from oracles.circle import hemisphere
from oracles.hertz import at_the_edge
from scenes import plane_points, points, random_points, take
from scipy.optimize import minimize
from solved import Points, Solution, solve_points
from stand_in import distinct

import swtstudy

Array = NDArray[np.float64]

SHEAR = ("fatemi_socie", "findley")


def symmetric_tensor(stress: Array) -> Array:
    """Stresses of shape (…, 6) as tensors, (…, 3, 3)."""
    return np.asarray(stress[..., np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])])


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
    spread, pull, _ = at_the_edge(ν, μ, u)
    swing, mean = 2 / np.pi * pull, 2 / np.pi * spread
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


@pytest.mark.parametrize("instants", [3, pytest.param(9, marks=pytest.mark.slow)])
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
def test_uniaxial_history_and_bulk_stress_far_away(name: str) -> None:
    mean, swing, k = 0.2, 0.5, 0.6
    history = np.zeros((3, 6))
    history[:, 0] = mean, mean + swing, mean - swing
    expected = uniaxial(name, k, np.array([swing]), mean)[0]
    assert float(swtstudy.criterion_of_history(history, name, k)[0]) == pytest.approx(expected, rel=1e-6)
    # A bulk stress so large that the contact hardly matters, in the plane and not.
    for batch in (
        points(normal_amplitude=0.0, tangential_amplitude=1e-3, friction=0.1),
        plane_points("cylinder", 0.3, 0.1, 0.0, 1e-3),
    ):
        bulk = {"bulk_stress_mean": np.array([mean]), "bulk_stress_amplitude": np.array([swing])}
        own = of_criterion(replace(batch, **bulk), name, k)
        # Beneath, far from the contact, the bulk stress is alone.
        deep, _ = swt_at(own, 0.0, 0.0, 300.0)
        assert float(deep) == pytest.approx(expected, rel=1e-3)


@pytest.mark.slow
def test_the_body_says_the_same_as_the_line_where_friction_rules() -> None:
    batch = points(poisson_ratio=0.29, friction=0.5, normal_amplitude=0.3, tangential_amplitude=0.9)
    for name in SHEAR:
        own = of_criterion(batch, name, 0.3)
        line = solve_points(own, 1e-5)
        body, at_line = body_maximum(own, float(line.critical_x[0]))
        assert at_line.swt == pytest.approx(line.s[0], rel=2e-4)
        assert body.swt == pytest.approx(line.s[0], rel=2e-4)


def radius_of_smallest_sphere(cloud: Array) -> float:
    """The least r² with |p − c|² ≤ r² of all points p, over centres c."""
    start = cloud.mean(axis=0)
    largest = ((cloud - start) ** 2).sum(axis=1).max()
    around = {"type": "ineq", "fun": lambda v: v[-1] - ((cloud - v[:-1]) ** 2).sum(axis=1)}
    found = minimize(lambda v: v[-1], [*start, largest], method="SLSQP", constraints=around, tol=1e-12)
    return float(np.sqrt(found.x[-1]))


@pytest.mark.parametrize("count", [1, 2, 7, 40])
def test_crosslands_sphere(count: int) -> None:
    """√J2,a is the radius of the smallest sphere around the deviator, of the norm √(s:s/2)."""
    stress = np.random.default_rng(count).normal(size=(3, count, 6))
    deviator = stress.copy()
    deviator[..., :3] -= stress[..., :3].mean(axis=-1, keepdims=True)
    deviator[..., :3] /= np.sqrt(2.0)
    expected = [radius_of_smallest_sphere(cloud) for cloud in deviator]
    for scale in (1e-9, 1.0, 1e9):
        value, _ = swtstudy.criterion_of_history(scale * stress, "crossland", 0.0)
        np.testing.assert_allclose(value, scale * np.array(expected), rtol=1e-6, atol=1e-7 * scale)
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
    line = solve_points(own, 1e-4)
    angle = np.linspace(0.0, 0.5 * np.pi, 65)
    x = line.critical_x[0]
    values, normals = swt_at(own, x * np.cos(angle), np.sin(angle), 0.0)
    assert values.max() > 1.02 * line.s[0]
    assert np.abs(normals[values.argmax(), 1]) > 0.5
    assert line.s_surface[0] == pytest.approx(values.max(), rel=1e-3)


STEEL = {"young_modulus": 210e3, "poisson_ratio": 0.3, "radius": 50.0, "normal_force": 200.0, "friction": 0.5}


@pytest.mark.slow
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
    both = swtstudy.physical(
        **own, criterion=["swt", "fatemi_socie"], normal_sensitivity=0.3, yield_strength=[400.0, 500.0]
    )
    strong = both.solve(1e-5, constants=constants)
    for body, strength in ((1, 400.0), (2, 500.0)):
        fs = strong.sel(body=body, criterion="fatemi_socie")
        own = {"criterion": "fatemi_socie", "normal_sensitivity": 0.3 * stress / strength}
        alone = swtstudy.solve(**given, **own, poisson_ratio=0.3, rtol=1e-5)
        np.testing.assert_allclose(fs.s, alone.s, rtol=1e-6)
        np.testing.assert_allclose(fs.FS, alone.s * stress / (210e3 / 2.6), rtol=1e-6)
        life = swtstudy.ShearConstants.estimated(constants[0], 0.3)
        np.testing.assert_allclose(fs.FS_cycles, life.cycles(fs.FS), rtol=1e-6)
        assert np.isnan(fs.cycles).all()


def highest_of_all_planes(name: str, k: float, stress: Array) -> float:
    """The definition over planes of every orientation, from one history, (T, 6): tensors turned."""
    sphere = np.random.default_rng(0).normal(size=(700, 3))
    best, value = np.array([1.0, 0.0, 0.0]), 0.0
    for spread in (np.inf, 0.06, 0.012, 0.003):
        normals = sphere if np.isinf(spread) else np.vstack([best, best + spread * sphere[:120]])
        normals = normals / np.linalg.norm(normals, axis=1)[:, None]
        traction = np.einsum("tij,pj->tpi", symmetric_tensor(stress), normals)
        tension = np.einsum("tpi,pi->tp", traction, normals)
        shear = traction - tension[..., None] * normals
        across = np.cross(normals, [0.3, 0.5, 0.81])
        across /= np.linalg.norm(across, axis=1)[:, None]
        turned, swing = np.cross(normals, across), np.zeros(len(normals))
        for turn in np.pi / 48 * np.arange(48):
            line = np.cos(turn) * across + np.sin(turn) * turned
            swing = np.maximum(swing, 0.5 * np.ptp(np.einsum("tpi,pi->tp", shear, line), axis=0))
        largest = tension.max(axis=0)
        made = swing + k * largest if name == "findley" else swing * (1.0 + k * np.maximum(largest, 0.0))
        best, value = normals[made.argmax()], max(value, float(made.max()))
    return value


STRIP = {"profile": "cylinder", "friction": 0.5, "phase": 1.0}
STRIP |= {"normal_force_amplitude": 0.3, "tangential_force_amplitude": 0.5}


@pytest.mark.slow
@pytest.mark.parametrize("name", SHEAR)
def test_means_of_criteria_of_shear(name: str) -> None:
    """Values at the places of a Gauss rule, each the highest of random planes, averaged."""
    k, size = 0.5, 0.1
    found = swtstudy.solve(**STRIP, criterion=name, normal_sensitivity=k, critical_distance=size)
    own = of_criterion(plane_points(**STRIP), name, k)

    def at(x: float, z: float) -> float:
        return highest_of_all_planes(name, k, history_at(own, x, 0.0, z))

    down = {"direction": found.direction.values[0]}
    point = at(float(found.point_x.sel(down)), 0.5 * size)
    assert float(found.s_point.sel(down)) == pytest.approx(point, rel=2e-3)
    node, weight = np.polynomial.legendre.leggauss(5)
    share, weight = 0.5 * (node + 1.0), 0.5 * weight
    values = [at(float(found.line_x.sel(down)), 2.0 * size * u * u) for u in share]
    assert float(found.s_line.sel(down)) == pytest.approx(np.dot(2.0 * share * weight, values), rel=5e-3)
    total = 0.0
    for r, of_r in zip(size * share**2, 4.0 * share**3 * weight, strict=True):  # 2 r dr/size²
        for u, of_u in zip(share, 6.0 * share * (1.0 - share) * weight, strict=True):
            turn = np.pi * u * u * (3.0 - 2.0 * u)
            total += of_r * of_u * at(float(found.volume_x) + r * np.cos(turn), r * np.sin(turn))
    assert float(found.s_volume) == pytest.approx(total, rel=5e-3)
    assert float(found.s_volume) < 0.8 * float(found.s)


@pytest.mark.slow
def test_means_of_shear_with_units() -> None:
    """Each is the same multiple of its s as the value at the worst place, and has its own life."""
    own = STEEL | {"tangential_force_amplitude": 60.0, "normal_sensitivity": 0.3, "yield_strength": 400.0}
    constants = swtstudy.FatigueConstants(210e3, 900.0, -0.1, 0.5, -0.6)
    for criterion, name in (("findley", "findley_stress"), ("fatemi_socie", "FS")):
        given = {} if criterion == "findley" else {"constants": constants}
        found = swtstudy.physical(**own, criterion=criterion).solve(critical_distance=0.05, **given)
        scale = found[name] / found.s
        for end in ("_volume", "_volume_error", "_line", "_point"):
            np.testing.assert_allclose(found[f"{name}{end}"], scale * found[f"s{end}"], rtol=1e-12)
        if given:
            life = swtstudy.ShearConstants.estimated(constants, 0.3).cycles(found.FS_volume.values)
            np.testing.assert_allclose(found.FS_cycles_volume, life, rtol=1e-6)
            assert (found.FS_cycles_volume > found.FS_cycles).all()


def test_where_slip_reverses_at_a_sharp_edge_the_shear_has_no_bound() -> None:
    """The amplitude of σ_xz grows by as much in each decade towards the edge; in stick it does not."""
    amplitudes = {}
    for u in (0.02, 1.5):
        own = {"profile": "truncated_paraboloid", "flat_radius": 0.5, "normal_amplitude": 0.0}
        x = 0.5 * (1.0 + 10.0 ** -np.arange(2.0, 6.0))
        field = swtstudy.stress_field(x, 0.0, 0.0, **own, tangential_amplitude=u)
        amplitudes[u] = 0.5 * np.ptp(field.sigma_xz.transpose("x", ...).values, axis=1)
    sliding = np.diff(amplitudes[1.5])
    assert (sliding > 0.05).all()
    np.testing.assert_allclose(sliding, sliding[0], rtol=0.1)
    assert (np.diff(amplitudes[0.02]) < 0.01 * sliding[0]).all()


@pytest.mark.usefixtures("unwrapped")
def test_a_point_by_criteria_of_shear_in_units() -> None:
    """What swt_field and inspect_point say of the critical point is what the results have there."""
    own = STEEL | {"tangential_force_amplitude": 60.0, "normal_sensitivity": 0.3}
    material = {"yield_strength": 400.0}
    for criterion, name in (("findley", "findley_stress"), ("fatemi_socie", "FS")):
        contact = swtstudy.physical(**own, **material, criterion=criterion)
        found, point = contact.solve(1e-5).sel(body=1), contact.inspect_point()
        local = contact.swt_field(float(point.shown_x), 0.0, 0.0)[name]
        assert float(local) == pytest.approx(float(found[name]), rel=1e-3)
        assert float(point.s_local.max()) == pytest.approx(float(found[name]), rel=1e-3)
        amplitude, tension = 0.5 * np.ptp(point.shear_stress.values), float(point.normal_stress.max())
        made = amplitude + 0.3 * tension
        if criterion == "fatemi_socie":
            made = amplitude * (1.0 + 0.3 * tension / 400.0) / (210e3 / 2.6)
        assert float(found[name]) == pytest.approx(made, rel=1e-3)
        with pytest.raises(ValueError, match=f"criterion: found {criterion}; allowed: swt"):
            contact.swt(0.1)
    assert len(contact.inspect().axes) == 9  # no axis of a strain


def test_swt_has_no_sensitivity_to_tell_points_apart() -> None:
    axes = 'criterion = ["swt", "findley"]\nnormal_sensitivity = [0.1, 0.3]'
    assert distinct(swtstudy.Study.from_text(f'title = "t"\n[axes]\n{axes}\n')) == 3


@pytest.mark.slow
def test_on_the_line_a_plane_that_does_not_hold_the_y_axis_may_be_higher() -> None:
    own = random_points(3, 8, "paraboloid", largest_term=2)
    one = {"friction": 0.307, "poisson_ratio": 0.06, "normal_amplitude": 0.1, "tangential_amplitude": 1.46}
    own = replace(take(own, 1), **{name: np.full(1, value) for name, value in one.items()})
    own = of_criterion(own, "fatemi_socie", 0.74)
    line = solve_points(own, 1e-4)
    _, at_line = body_maximum(own, float(line.critical_x[0]))
    assert at_line.swt > 1.005 * line.s[0]
    assert line.s_surface[0] >= at_line.swt * (1.0 - 3e-3)


@pytest.mark.slow
def test_planes_off_the_line_have_instants_of_their_own() -> None:
    """Those that make s alone, or a coarse look, leave a circle 1 % low here; another one is the highest."""
    own = points(poisson_ratio=0.1024930, friction=0.1642169, normal_amplitude=0.8367486)
    own = replace(own, q=np.array([2]), tangential_amplitude=np.array([0.6682807]))
    own = of_criterion(replace(own, phase=np.array([5.9745489])), "fatemi_socie", 0.9)
    line = solve_points(own, 1e-4)
    angle = np.linspace(0.0, np.pi, 49)
    highest = []
    for radius in (abs(float(line.critical_x[0])), *np.linspace(1.31, 1.34, 16)):
        values, _ = swt_at(own, radius * np.cos(angle), radius * np.sin(angle), 0.0)
        highest.append(values.max())
    assert 1.005 * line.s[0] < highest[0] < 0.9 * max(highest)
    assert line.s_surface[0] == pytest.approx(max(highest), rel=1e-3)
