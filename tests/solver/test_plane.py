"""Plane contacts: kernels, stress on the surface and s, against closed forms, elements and a dense look."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.strip_march import StripMarch
from oracles.strips import STRIPS, Strip
from scenes import plane_points
from solved import solve_points
from told import refused

import swtstudy
from swtstudy import LoadPath, StudyError, TabulatedProfile

Array = NDArray[np.float64]
MEAN = 0.25 * np.pi


def solved(**given: Any) -> Any:
    own = {"profile": "cylinder", "normal_force_amplitude": 0.0} | given
    return swtstudy.solve(**own)


@pytest.mark.parametrize("b", [0.0, 0.5])
@pytest.mark.parametrize("count", [60, 500])
def test_a_table_is_what_it_is_a_table_of(b: float, count: int) -> None:
    x = np.linspace(0.0, 2.0, count)
    table = TabulatedProfile("mine", x, 0.5 * np.maximum(x - b, 0.0) ** 2, geometry="plane")
    given = {"normal_force_amplitude": 0.4, "tangential_force_amplitude": 0.3, "phase": 1.0, "rtol": 1e-5}
    s, closed = (
        float(swtstudy.solve(**given, **shape).s)
        for shape in ({"profile": table}, {"profile": "rounded_flat", "flat_half_width": b})
    )
    assert s == pytest.approx(closed, rel=2e-5 if b else 1e-8)


def test_a_table_says_how_far_it_goes() -> None:
    x = np.linspace(0.0, 1.1, 80)
    table = TabulatedProfile("short", x, 0.5 * x**2, geometry="plane")
    assert table.deepest == pytest.approx(1.21)
    with pytest.raises(StudyError, match=r"load 4P/\(πE\*\) = 1.3 is beyond the table of short"):
        solved(profile=table, normal_force_amplitude=0.3, tangential_force_amplitude=0.1)
    again = TabulatedProfile.of_content("again", table.content())
    assert again.geometry == "plane"
    assert again.code == table.code != TabulatedProfile("disc", x, 0.5 * x**2).code
    words = r"wrong\.geometry: found 'round'; allowed: one of axisymmetric, plane"
    refused(words, TabulatedProfile, "wrong", x, 0.5 * x**2, geometry="round")


def test_slope_of_a_cubic() -> None:
    """f = x³: N′ = ξ ∫ 6x dx/√(ξ² − x²) = 6 ξ², and N = 2 ξ³; also beyond the table, where N′/ξ stays."""
    x = np.linspace(0.0, 2.0, 9)
    cubic = TabulatedProfile("cubic", x, x**3, geometry="plane")
    radius = np.array([0.3, 0.5, 0.9, 1.7])
    np.testing.assert_allclose(cubic.slope(radius), 6.0 * radius**2, rtol=1e-12)
    np.testing.assert_allclose(cubic.rise(radius)[0], 2.0 * radius**3, rtol=1e-12)
    beyond = 16.0 + 6.0 * 2.0 * 0.5 * (3.0**2 - 2.0**2)
    np.testing.assert_allclose(cubic.rise(np.array([3.0]))[0], beyond, rtol=1e-9)


@pytest.mark.parametrize("gamma", [0.3, 0.5, 0.8])
def test_at_constant_load_s_is_known(gamma: float) -> None:
    """μ² Q_A/(μP), at the edge, on the plane normal to x; Q_A = μP is full sliding, where σ_xx = 2 μ p0."""
    rng = np.random.default_rng(1)
    n = 40
    mu, nu, pull = 10.0 ** rng.uniform(-1.0, 1.0, n), rng.uniform(0.0, 0.5, n), rng.uniform(0.02, 1.0, n)
    pull[:3] = 1.0
    batch = plane_points("cylinder", nu, mu, 0.0, pull, walker_exponent=gamma)
    found = solve_points(batch)
    expected = mu**2 * pull * (1.0 - nu**2) ** (2.0 * gamma - 1.0)
    np.testing.assert_allclose(found.s, expected, rtol=1e-7)
    np.testing.assert_allclose(np.abs(found.critical_x), 1.0, rtol=1e-12)
    np.testing.assert_allclose(found.critical_angle, 0.0, atol=1e-6)
    np.testing.assert_array_equal(found.s_surface, found.s)


def test_cattaneo_mindlin() -> None:
    """Two of Hertz's shear tractions, on strips: closed forms on both sides, and in plane strain."""
    mu, nu, pull = 0.7, 0.3, 0.6
    own = {"profile": "cylinder", "poisson_ratio": nu, "friction": mu, "normal_force_amplitude": 0.0}
    x = np.array([-1.5, -1.0, -0.9, -0.4, 0.1, 0.8, 0.99, 1.2])
    field = swtstudy.stress_field(x, 0.0, 0.0, time=0.5 * np.pi, tangential_force_amplitude=pull, **own)
    xx, yy, zz, xz = (np.ravel(field[f"sigma_{name}"]) for name in ("xx", "yy", "zz", "xz"))
    c = np.sqrt(1.0 - pull)

    def root(a: float) -> Array:
        return np.sqrt(np.maximum(a * a - x * x, 0.0))

    def along(a: float) -> Array:  # σ_xx by the shear √(a² − x²) in +x
        return -2.0 * np.where(np.abs(x) < a, x, x - np.sign(x) * np.sqrt(np.maximum(x * x - a * a, 0.0)))

    pressure, shear = 0.5 * root(1.0), 0.5 * mu * (root(1.0) - root(c))
    np.testing.assert_allclose(zz, -pressure, atol=1e-14)
    np.testing.assert_allclose(xz, -shear, atol=1e-14)
    np.testing.assert_allclose(xx, -pressure + 0.5 * mu * (along(1.0) - along(c)), atol=1e-14)
    np.testing.assert_allclose(yy, nu * (xx + zz), atol=1e-15)


#: From the least normal load on, as the field's instants are counted.
LOOPS = {
    "oblique": [[0.6, 0.1], [0.8, -0.6], [1.3, 0.0], [1.4, 0.5]],
    "growth": [[0.4, 0.1], [1.5, 0.6], [0.9, -0.5]],
}


def march(loop: Array, strip: StripMarch, per_side: int, x: Array) -> Array:
    """σ_xx at places after each part of the sides of the second round, (X, T), by elements."""
    ends = np.roll(loop, -1, axis=0)
    strip.step(MEAN * loop[0, 0], 0.0)
    strip.step(*(MEAN * loop[0] * [1.0, strip.friction]))
    found = []
    for _ in range(2):
        found = []
        for first, last in zip(loop, ends, strict=True):
            for share in np.arange(1, per_side + 1) / per_side:
                normal, tangential = MEAN * (first + share * (last - first))
                strip.step(normal, strip.friction * tangential)
                found.append(strip.stress_along(x))
    return np.stack(found, axis=1)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "b"), [("oblique", 0.6), ("oblique", 0.0), ("growth", 0.0)])
def test_boundary_elements_marched_in_time(name: str, b: float) -> None:
    """The normal load varies; the march knows neither a superposition nor a memory."""
    loop, mu, elements, per_side = np.array(LOOPS[name]), 0.5, 150, 24
    shape = {"profile": "rounded_flat", "flat_half_width": b} if b else {"profile": "cylinder"}
    given = shape | {"poisson_ratio": 0.3, "friction": mu, "load": LoadPath(name, loop - [1.0, 0.0])}
    given |= {"normal_force_amplitude": 1.0, "tangential_force_amplitude": 1.0}
    reach = 1.05 * float(swtstudy.solve(**given, rtol=1e-3, quantities=["contact_radius"]).contact_radius)
    strip = StripMarch(lambda x: 0.5 * np.maximum(x - b, 0.0) ** 2, reach, elements, mu)
    x = strip.x[::7]
    x = x[np.abs(x) < reach]
    expected = march(loop, strip, per_side, x)
    # A side takes as long as any other.
    sides = np.linspace(0.0, 2.0 * np.pi, len(loop) + 1)
    share = np.arange(1, per_side + 1) / per_side
    instants = (sides[:-1, None] + np.diff(sides)[:, None] * share).ravel()
    field = swtstudy.stress_field(x, 0.0, 0.0, time=instants, **given)
    found = field.sigma_xx.transpose("x", "time").values
    # Where a slip front is within one element that is off by all that the traction turns in it.
    off = np.abs(found - expected) / np.abs(expected).max()
    assert off.max() < 0.12
    assert off.mean() < 5e-3


def loop_points(profile: str, **given: Any) -> Any:
    return swtstudy.solve(
        profile=profile, normal_force_amplitude=1.0, tangential_force_amplitude=1.0, rtol=1e-6, **given
    )


def test_where_a_loop_starts_and_which_side_is_which_does_not_matter() -> None:
    corners = np.array([[0.3, 0.5, 0.1], [-0.4, 0.1, -0.2], [-0.2, -0.6, 0.3], [0.3, 0.0, 0.0]])
    other = {"bulk_stress_amplitude": 0.3, "profile": "rounded_flat", "flat_half_width": 0.4}
    found = [loop_points(load=LoadPath("mine", np.roll(corners, k, axis=0)), **other) for k in range(4)]
    first = found[0]
    for one in found[1:]:
        assert float(one.s) == pytest.approx(float(first.s), rel=1e-9)
    mirrored = loop_points(load=LoadPath("mirror", corners * [1.0, -1.0, 1.0]), **other)
    assert float(mirrored.s) == pytest.approx(float(first.s), rel=1e-9)
    assert float(mirrored.critical_x) == pytest.approx(-float(first.critical_x), rel=1e-6)


@pytest.mark.slow
def test_a_sampled_loop_comes_near_to_the_exact_one() -> None:
    t = 2.0 * np.pi * np.arange(600) / 600
    sampled = LoadPath("sampled", np.stack([0.5 * np.sin(t + 2.3), 0.4 * np.sin(t)], axis=1))
    exact = solved(normal_force_amplitude=0.5, tangential_force_amplitude=0.4, phase=2.3, rtol=1e-6)
    assert float(loop_points("cylinder", load=sampled).s) == pytest.approx(float(exact.s), rel=1e-4)


def test_far_from_the_contact_the_bulk_stress_is_plane_strain() -> None:
    mean, amplitude, nu = 0.1, 0.3, 0.4
    for gamma in (0.5, 0.3):
        batch = plane_points(
            "cylinder", nu, 0.0, 0.2, 0.0,
            bulk_stress_amplitude=amplitude, bulk_stress_mean=mean, walker_exponent=gamma,
        )  # fmt: skip
        found = solve_points(batch)
        expected = (mean + amplitude) ** (2 - 2 * gamma) * amplitude ** (2 * gamma)
        expected *= (1 - nu**2) ** (2 * gamma - 1)
        assert found.s[0] >= expected * (1.0 - 1e-9)
        assert found.s[0] == pytest.approx(expected, rel=1e-7)
    own = {"profile": "cylinder", "poisson_ratio": nu, "friction": 0.5}
    own |= {"normal_force_amplitude": 0.2, "tangential_force_amplitude": 0.4}
    own |= {"time": [0.3, 2.0]}
    pulled, bare = (
        swtstudy.stress_field([0.5, 3.0], 0.0, 0.0, **own, bulk_stress_mean=each) for each in (mean, 0.0)
    )
    np.testing.assert_allclose(pulled.sigma_yy, nu * (pulled.sigma_xx + pulled.sigma_zz), atol=1e-12)
    np.testing.assert_allclose(pulled.sigma_xx - bare.sigma_xx, mean, rtol=1e-9)


@pytest.mark.parametrize("strip", STRIPS, ids=str)
def test_without_friction_nothing_pulls(strip: Strip) -> None:
    given = {"friction": 0.0, "normal_force_amplitude": 0.5, "tangential_force_amplitude": 0.0}
    assert float(solved(profile=strip.profile, **strip.shape, **given).s) == 0.0


def test_a_loop_with_a_constant_normal_load_needs_no_normal_force_amplitude() -> None:
    loop = swtstudy.LoadPath("to and fro", [[0.0, 1.0], [0.0, -1.0]])
    given: dict[str, Any] = {"load": loop, "tangential_force_amplitude": 0.5, "rtol": 1e-6}
    for profile in ("cylinder", ["paraboloid", "cylinder"]):
        found = swtstudy.solve(profile=profile, **given)
        assert found.normal_force_amplitude.item() == 0.0
        np.testing.assert_array_equal(
            found.s, swtstudy.solve(profile=profile, normal_force_amplitude=0, **given).s
        )
    moving = swtstudy.LoadPath("round", [[0.1, 1.0], [0.1, -1.0]])
    with pytest.raises(StudyError, match=r"^normal_force_amplitude: found nothing"):
        swtstudy.solve(profile="cylinder", **given | {"load": moving})
    with pytest.raises(StudyError, match=r"^normal_amplitude: found a displacement"):
        swtstudy.solve(profile="cylinder", normal_amplitude=0.1, **given)


def test_it_shares_an_axis_with_discs() -> None:
    load = {"normal_force_amplitude": 0.3, "tangential_force_amplitude": 0.4, "phase": 1.0}
    both = swtstudy.solve(profile=["cylinder", "paraboloid"], **load)
    for name in both.profile.values:
        alone = swtstudy.solve(profile=str(name), **load)
        assert float(both.s.sel(profile=name)) == float(alone.s)
    plain = swtstudy.solve(profile="power_law_cylinder", exponent=2, **load)
    assert float(plain.s) == float(both.s.sel(profile="cylinder"))
