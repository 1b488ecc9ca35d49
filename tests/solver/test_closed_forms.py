"""Stress, springs and quantities of a contact against closed forms and oracles, as the package tells them."""

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray
from oracles import hertz
from oracles import profiles as oracle
from oracles.hamilton import hamilton
from oracles.springs import Path, bimodal, polygon, spring_forces

import swtstudy

Array = NDArray[np.float64]
P0 = 2.0 / np.pi  # of the paraboloid, a = a_H, in E* √(δ0/R)
X = np.array([-1.4, -1.05, -0.97, -0.6, -0.2, 0.15, 0.5, 0.9, 1.02, 1.3])
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
INDENTERS: dict[str, oracle.Indenter] = {
    "paraboloid": oracle.paraboloid(),
    "rounded_punch": oracle.rounded_punch(0.6),
    "truncated_paraboloid": oracle.truncated_paraboloid(0.6),
    "wavy_paraboloid": oracle.wavy_paraboloid(0.02, 4.5),
}
LOADS = {
    "in phase": (0.7, 0.4, 0.0, 1, 1),
    "all slides": (0.5, 1.2, 1.4, 1, 1),
    "grows in stick": (0.7, 0.25, 0.5, 1, 1),
    "two periods": (0.6, 0.7, 0.4, 3, 2),
    "quick": (0.5, 0.3, 2.0, 5, 2),
    "slow": (0.8, 0.9, 4.0, 1, 4),
    "lifts off": (1.2, 0.6, 0.4, 1, 1),
}


def at(x: Array, y: Array, z: Array, time: Array, **parameters: object) -> Array:
    """σ of `swtstudy.stress_field` at places one by one, shape (time, place, 6)."""
    places = (xr.DataArray(np.broadcast_to(v, np.shape(x)), dims="place") for v in (x, y, z))
    found = swtstudy.stress_field(*places, time=time, **parameters)
    parts = [found[f"sigma_{name}"].transpose("time", "place").values for name in COMPONENTS]
    return np.stack(parts, axis=-1)


def of_load(normal: float, tangential: float, phase: float, p: int, q: int) -> dict[str, object]:
    return {
        "normal_amplitude": normal,
        "tangential_amplitude": tangential,
        "phase": phase,
        "frequency_ratio": f"{p}/{q}",
    }


@pytest.fixture
def places() -> tuple[Array, Array, Array]:
    rng = np.random.default_rng(7)
    return *rng.uniform(-2.0, 2.0, (2, 60)), 10.0 ** rng.uniform(-1.5, 0.5, 60)


@pytest.mark.parametrize("ν", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("μ", [0.3, 1.0])
def test_on_the_surface_full_sliding_is_hamiltons_solution(ν: float, μ: float) -> None:
    # So large an amplitude that all slides forward at t = 0 and backward at π, at any depth.
    found = at(X, 0.0, 0.0, [0.0, np.pi], poisson_ratio=ν, friction=μ, **of_load(0.6, 20.0, 0.3, 1, 1))
    for stress, instant, sense in zip(found, (0.0, np.pi), (1.0, -1.0), strict=True):
        expected = hamilton(X, 1.0 + 0.6 * np.sin(instant + 0.3), ν, 1.0, sense * μ)
        for k, values in zip((0, 1, 2, 4), expected, strict=True):
            np.testing.assert_allclose(stress[:, k], values, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("ν", [0.0, 0.3, 0.5])
def test_beneath_it_full_sliding_is_hamiltons_solution(ν: float, places: tuple[Array, ...]) -> None:
    μ = 0.4
    found = at(*places, [0.0], poisson_ratio=ν, friction=μ, **of_load(0.0, 20.0, 0.0, 1, 1))[0] / P0
    pressed = np.array(hertz.pressed(*places, ν))
    dragged = np.array(hertz.dragged(*places, ν))
    np.testing.assert_allclose(found.T, pressed + μ * dragged, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("u", [0.8, 0.1, -0.55])
def test_cattaneo_mindlin_is_a_superposition_of_hamiltons_solutions(
    u: float, places: tuple[Array, ...]
) -> None:
    # Unloading from u = U: τ = −w(1) + 2 w(f) − w(1 − U), where w(D) = D − G within the depth D.
    amplitude, μ, ν = 5 / 6, 0.4, 0.3
    instant = [np.pi - np.arcsin(u / amplitude)]
    load = of_load(0.0, amplitude, 0.0, 1, 1)
    depths = np.array([1.0, 1.0 - 0.5 * (amplitude - u), 1.0 - amplitude])
    shares = μ * np.array([-1.0, 2.0, -1.0])
    expected = np.array(hertz.pressed(*places, ν))
    for depth, share in zip(depths, shares, strict=True):
        a = np.sqrt(depth)
        expected += share * a * np.array(hertz.dragged(*(v / a for v in places), ν))
    found = at(*places, instant, poisson_ratio=ν, friction=μ, **load)[0] / P0
    np.testing.assert_allclose(found.T, expected, rtol=0.0, atol=1e-9)
    line = at(X, 0.0, 0.0, instant, poisson_ratio=ν, friction=μ, **load)[0]
    parts = [hamilton(X, 1.0, ν, 1.0, 0.0)]
    parts += [hamilton(X, d, ν, 0.0, share) for d, share in zip(depths, shares, strict=True)]
    for k, values in zip((0, 1, 2, 4), zip(*parts, strict=True), strict=True):
        np.testing.assert_allclose(line[:, k], sum(values), rtol=0.0, atol=1e-10)


@pytest.mark.parametrize("ν", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("μ", [0.1, 0.6])
def test_trailing_edge_under_full_sliding(ν: float, μ: float) -> None:
    load = of_load(0.0, 5.0, 0.0, 1, 1)
    found = at(np.array([-1.0]), 0.0, 0.0, [0.0], poisson_ratio=ν, friction=μ, **load)[0, 0, 0]
    assert found / P0 == pytest.approx((1.0 - 2.0 * ν) / 3.0 + np.pi * μ * (4.0 + ν) / 8.0, rel=1e-10)


def mcewen(x: Array, z: Array, a: float) -> tuple[Array, ...]:
    """σ_xx, σ_zz, σ_xz over p0 by Hertz's pressure on a strip, and by the same shear in +x (Johnson 1985)."""
    # m and n with m² = ½ (root + s), n² = ½ (root − s), s = a² − x² + z².
    s = a * a - x * x + z * z
    root = np.sqrt(s * s + 4.0 * x * x * z * z)
    m = np.sqrt(0.5 * (root + s))
    n = np.sign(x) * np.sqrt(np.maximum(0.5 * (root - s), 0.0))
    share = (z * z + n * n) / (m * m + n * n)
    normal = (
        -(m * (1.0 + share) - 2.0 * z) / a,
        -m * (1.0 - share) / a,
        -n * (m * m - z * z) / (m * m + n * n) / a,
    )
    # The shear's σ_zz is the pressure's σ_xz, its σ_xz the pressure's σ_xx.
    along = (n * (2.0 - (z * z - m * m) / (m * m + n * n)) - 2.0 * x) / a
    return *normal, along, normal[2], normal[0]


@pytest.mark.parametrize("pull", [0.3, 0.9])
def test_a_cylinder_is_a_superposition_of_mcewens_fields(pull: float, places: tuple[Array, ...]) -> None:
    """At the largest pull the shear is that of all that slides, less that of the stick zone c = √(1 − Q)."""
    x, y, z = places
    μ, ν, c = 0.4, 0.3, np.sqrt(1.0 - pull)
    load = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": pull, "friction": μ}
    found = at(x, y, z, [0.5 * np.pi], profile="cylinder", poisson_ratio=ν, **load)[0] / 0.5
    whole, stick = mcewen(x, z, 1.0), mcewen(x, z, c)
    for k, number in ((0, 0), (2, 1), (4, 2)):
        expected = whole[number] + μ * (whole[number + 3] - c * stick[number + 3])
        np.testing.assert_allclose(found[:, k], expected, atol=1e-9)
    np.testing.assert_allclose(found[:, 1], ν * (found[:, 0] + found[:, 2]), atol=1e-14)
    np.testing.assert_array_equal(found[:, [3, 5]], 0.0)


def depths_of(indenter: oracle.Indenter, radius: Array) -> Array:
    """g at radii, by the oracle's quadrature."""
    return np.array([indenter.depth(ξ) if ξ > indenter.flat_radius else 0.0 for ξ in radius])


def surface_stress(ξ: Array, w: Array, τ: Array, r: float, ν: float, μ: float) -> Array:
    """σ_xx, σ_yy, σ_zz, σ_xz at (r, 0, 0) by springs at ascending radii ξ: w and τ, linear in between.

    Abel's transform of what each annulus adds, integrated exactly.
    """
    fall, change = -np.diff(w), np.diff(τ)
    width = np.diff(ξ)
    share = np.clip(ξ / r, None, 1.0)
    cosine = np.sqrt(1.0 - share**2)
    beyond = np.diff(np.arccosh(np.maximum(ξ / r, 1.0))) / width
    pressure, traction = (beyond @ fall) / np.pi, -(beyond @ change) / np.pi
    v = np.maximum(ξ, r)
    outside = np.diff(0.5 * (v * np.sqrt(v * v - r * r) - r * r * np.arccosh(v / r))) / width
    load = 2.0 * (0.5 * np.diff(ξ**2) / width - outside) @ fall
    xx, yy = (
        (np.diff(part) / width) @ change / np.pi
        for part in (-2.0 * cosine - 2.0 * ν / 3.0 * cosine**3, -2.0 * ν * (cosine - cosine**3 / 3.0))
    )
    ring = (1.0 - 2.0 * ν) * load / (2.0 * np.pi * r * r)
    return np.array([ring - pressure + μ * xx, -ring - 2.0 * ν * pressure + μ * yy, -pressure, -μ * traction])


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", INDENTERS)
@pytest.mark.parametrize("load", ["grows in stick", "two periods", "quick", "in phase"])
def test_stress_on_the_surface_is_that_of_its_springs(load: str, name: str) -> None:
    indenter, (d, u, ψ, p, q) = INDENTERS[name], LOADS[load]
    ν, μ, b = 0.3, 0.5, INDENTERS[name].flat_radius
    # Radii dense towards the axis and a face's edge, where g has a root.
    largest = 2.0
    ξ = b + (largest - b) * np.linspace(0.0, 1.0, 3001) ** 2
    g = depths_of(indenter, ξ)
    time = np.sort(np.random.default_rng(3).uniform(0.0, 2.0 * np.pi, 3))
    path = bimodal(d, u, ψ, p, q, periods=2)
    τ = spring_forces(path, g, time + 2.0 * np.pi)
    r = np.array([0.31, 0.83, 1.17, 1.6])
    given = of_load(d, u, ψ, p, q) | {"profile": name, **indenter.shape, "friction": μ, "poisson_ratio": ν}
    found = at(r, 0.0, 0.0, q * time, **given)
    other = at(-r, 0.0, 0.0, q * time, **given)
    for k, instant in enumerate(time):
        w = np.maximum(1.0 + d * np.sin(q * instant + ψ) - g, 0.0)
        for j, radius in enumerate(r):
            pressed = surface_stress(ξ, w, 0.0 * w, radius, ν, μ)
            whole = surface_stress(ξ, w, τ[k], radius, ν, μ)
            np.testing.assert_allclose(found[k, j, [0, 1, 2, 4]], whole, atol=2e-3)
            # Of the shear the normal components change sign with x.
            mirrored = [2.0, 2.0, 2.0, 0.0] * pressed + [-1.0, -1.0, -1.0, 1.0] * whole
            np.testing.assert_allclose(other[k, j, [0, 1, 2, 4]], mirrored, atol=2e-3)


def compare_springs(path: Path, point: xr.Dataset, angle: Array, indenter: oracle.Indenter) -> None:
    """Forces of springs at a point's decisive instants against the clip rule in a later period of a path."""
    g = depths_of(indenter, np.maximum(point.r.values, 1e-9))
    expected = spring_forces(path, g, angle)
    found = point.force.transpose("instant", "r").values
    np.testing.assert_allclose(found, expected, atol=2e-6)
    depth = path.depth(angle)[:, None]
    compression = point.compression.transpose("instant", "r").values
    np.testing.assert_allclose(compression, np.maximum(depth - g, 0.0), atol=1e-6)


@pytest.mark.quick(3)
@pytest.mark.parametrize("load", LOADS)
def test_springs_follow_the_clip_rule(load: str) -> None:
    d, u, ψ, p, q = LOADS[load]
    point = swtstudy.inspect_point(**of_load(d, u, ψ, p, q)).isel(r=slice(None, None, 13))
    # The instants are φ = ω1 t/q of the common period 2π.
    angle = point.instant_time.values / q + 2.0 * np.pi
    compare_springs(bimodal(d, u, ψ, p, q, periods=3), point, angle, oracle.paraboloid())


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", ["rounded_punch", "wavy_paraboloid", "truncated_paraboloid"])
def test_springs_of_other_profiles_follow_it(name: str) -> None:
    indenter, (d, u, ψ, p, q) = INDENTERS[name], LOADS["two periods"]
    point = swtstudy.inspect_point(profile=name, **indenter.shape, **of_load(d, u, ψ, p, q)).isel(
        r=slice(None, None, 29)
    )
    compare_springs(bimodal(d, u, ψ, p, q, 3), point, point.instant_time.values / q + 2.0 * np.pi, indenter)


@pytest.mark.quick(4)
@pytest.mark.parametrize("seed", range(10))
def test_springs_under_a_loop_follow_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners = (3, 9, 6, 2, 5)[seed % 5]
    low = -1.3 if seed % 3 == 2 else -0.8
    loop = np.stack([rng.uniform(low, 0.8, corners), rng.uniform(-0.9, 0.9, corners)], axis=1)
    # Deviations of the normal load: of both signs.
    loop[:2, 0] = 0.3, -0.2
    given = {"load": swtstudy.LoadPath("mine", loop), "normal_amplitude": 1.0, "tangential_amplitude": 1.0}
    whole = swtstudy.inspect_point(**given)
    point = whole.isel(r=slice(None, None, 13))
    # The corners as the package goes round them, from whichever first.
    corner = 2.0 * np.pi / corners * np.arange(corners)
    depth, u = (np.interp(corner, whole.time, whole[name]) for name in ("depth", "displacement"))
    # The tangential load comes after the first indentation; then round and round.
    path = polygon(
        np.concatenate([[depth[0]], depth, depth, depth, depth[:1]]), np.concatenate([[0.0], u, u, u, u[:1]])
    )
    place = 1.0 + corners * (point.instant_time.values / (2.0 * np.pi) + 2.0)
    compare_springs(path, point, place, oracle.paraboloid())


def test_gross_slip_is_where_the_slip_lines_cross_and_lift_off_where_the_depth_is_negative() -> None:
    rng = np.random.default_rng(1)
    fine = np.linspace(0.0, 2.0 * np.pi, 20001)
    seen = []
    for p, q in ((1, 1), (1, 2), (3, 2), (5, 4)):
        u, ψ = np.sort(rng.uniform(0.1, 1.6, 8)), float(rng.uniform(0.0, 2.0 * np.pi))
        d = float(rng.uniform(0.1, 0.9))
        found = swtstudy.solve(rtol=0.1, **of_load(d, u, ψ, p, q))
        depth, moved = 1.0 + d * np.sin(q * fine + ψ), u[:, None] * np.sin(p * fine)
        overlap = (moved - depth).max(axis=1) - (moved + depth).min(axis=1)
        clear = np.abs(overlap) > 1e-5  # the sampling's error
        slides = found.regime.values == found.regime.attrs["flag_meanings"].split().index("gross_slip")
        np.testing.assert_array_equal(slides[clear], overlap[clear] > 0.0)
        seen.extend(slides)
    assert 0.2 < np.mean(seen) < 0.8
    amplitudes = [0.5, 1.0, 1.0 + 1e-9, 1.2]
    found = swtstudy.solve(normal_amplitude=amplitudes, rtol=0.1)
    lifted = found.regime.values == found.regime.attrs["flag_meanings"].split().index("lift_off")
    np.testing.assert_array_equal(lifted, [False, False, True, True])


def test_equilibrium_and_compatibility() -> None:
    """div σ = 0 and (1 + ν) ∇²σ + grad grad tr σ = 0 (Beltrami–Michell) by differences of sixth order."""
    h, ν = 0.02, 0.3
    rng = np.random.default_rng(3)
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * h)
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / (180 * h**2)
    unit = np.zeros(7)
    unit[3] = 1
    line = h * np.arange(-3, 4)
    for _ in range(3):
        x, y, z = *rng.uniform(-1.3, 1.3, 2), rng.uniform(0.3, 1.0)
        given = {"profile": "rounded_punch", "flat_radius": 0.5, "phase": 1.0, "poisson_ratio": ν}
        found = swtstudy.stress_field(x + line, y + line, z + line, time=[0.7], **given).isel(time=0)
        parts = [found[f"sigma_{name}"].transpose("x", "y", "z").values for name in COMPONENTS]
        tensor = np.stack(parts, axis=-1)[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]

        def derivative(i: int, j: int | None = None, tensor: Array = tensor) -> Array:
            stencils = [unit, unit, unit]
            if i == j:
                stencils[i] = second
            else:
                stencils[i] = first
                if j is not None:
                    stencils[j] = first
            return np.einsum("xyzab,x,y,z->ab", tensor, *stencils)

        assert np.abs(sum(derivative(i)[i] for i in range(3))).max() < 1e-6
        laplacian = sum(derivative(i, i) for i in range(3))
        hessian = np.array([[derivative(i, j).trace() for j in range(3)] for i in range(3)])
        assert np.abs((1 + ν) * laplacian + hessian).max() < 2e-4


@pytest.mark.parametrize(("p", "q"), [(1, 1), (2, 1), (4, 1), (1, 3), (2, 3)])
def test_half_a_tangential_period_later_the_other_side_has_the_same_s(p: int, q: int) -> None:
    """Turned round, the tangential load is itself half a period later: the normal one has gone on by πq/p."""
    phase = 0.7 + np.pi * q / p * np.arange(3)
    found = [swtstudy.solve(rtol=1e-6, **of_load(0.6, 0.5, float(ψ), p, q)) for ψ in phase]
    for one in found[1:]:
        assert float(one.s) == pytest.approx(float(found[0].s), rel=3e-6)
    sides = np.sign([float(one.critical_x) for one in found])
    assert sides.tolist() == (sides[0] * np.array([1.0, -1.0, 1.0])).tolist()


def slip_work(pull: float, count: int = 4000) -> float:
    """Work per cycle by the local slip of Cattaneo and Mindlin's strip, over μP_0 · μδ0.

    From +Q to −Q the shear in the slip zone turns from μp to −μp, and q − q_before is twice that of a
    contact that moves for the first time by Q: ∮ = 2 ∫ 2 μp · slip dx over one side, twice, one way and back.
    """
    c = np.sqrt(1.0 - pull)
    # Slip is what the displacements by the change of the shear lack to those of the stick zone:
    # u′ = −(2/π) ∫ q ds/(x − s), of √(a² − s²): −2 x within, −2 (x − √(x² − a²)) beyond; the pressure is ½ √.
    x = c + (1.0 - c) * (np.arange(count) + 0.5) / count
    gradient = -2.0 * (0.5 * np.sqrt(x * x - c * c))
    slip = 2.0 * np.cumsum(gradient) * (1.0 - c) / count
    pressure = 0.5 * np.sqrt(1.0 - x * x)
    one_way = 2.0 * float((np.abs(slip) * pressure).sum()) * (1.0 - c) / count
    return 2.0 * one_way / (0.25 * np.pi)


def test_quantities_of_a_cylinder() -> None:
    """Work by the local slip; c = √(1 − Q/(μP)); at most 1.4 P_0 with half-width √1.4."""
    pull = np.array([0.3, 0.6, 0.9])
    names = ["dissipation", "stick_radius", "force_ratio", "contact_radius"]
    strip = {"profile": "cylinder", "quantities": names, "rtol": 0.1, "friction": 0.4}
    still = swtstudy.solve(normal_force_amplitude=0.0, tangential_force_amplitude=pull, **strip)
    np.testing.assert_allclose(still.dissipation, [slip_work(each) for each in pull], rtol=1e-3)
    assert float(still.dissipation[1]) == pytest.approx(0.0420060 / (0.25 * np.pi), rel=1e-5)
    assert (still.dissipation_error < 1e-5 * still.dissipation).all()
    np.testing.assert_allclose(still.stick_radius, np.sqrt(1.0 - pull), rtol=1e-12)
    np.testing.assert_allclose(still.force_ratio, pull, rtol=1e-9)
    moving = swtstudy.solve(normal_force_amplitude=0.4, tangential_force_amplitude=0.2, phase=1.0, **strip)
    assert float(moving.contact_radius) == pytest.approx(np.sqrt(1.4), rel=1e-12)


@pytest.mark.parametrize("name", INDENTERS)
def test_s_is_swt_of_the_stress_there_and_no_place_of_the_line_has_more(name: str) -> None:
    given = {"profile": name, **INDENTERS[name].shape, "phase": 0.9, "friction": 0.6, "normal_amplitude": 0.5}
    found = swtstudy.solve(rtol=1e-5, **given)
    x = float(found.critical_x)
    history = swtstudy.stress_field(x, 0.0, 0.0, **given)
    stress = np.stack([history[f"sigma_{each}"].values for each in COMPONENTS], axis=-1)
    swt, normal = swtstudy.swt_of_history(stress, 0.3, 1.0 - 0.3**2)
    assert float(swt) == pytest.approx(float(found.s), rel=1e-3)
    assert abs(normal[1]) < 1e-3
    angle = np.degrees(np.arctan2(normal[2], normal[0]))
    assert abs((angle - float(found.critical_angle) + 90.0) % 180.0 - 90.0) < 1.0
    line = swtstudy.swt_field(np.linspace(-1.6, 1.6, 161), 0.0, 0.0, **given)
    assert float(line.s_local.max()) <= float(found.s) * (1.0 + 1e-3)
