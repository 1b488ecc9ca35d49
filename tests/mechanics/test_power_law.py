"""The power law against the closed forms of Galin and Sneddon; its tip."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles.point_loads import sum_of_point_loads
from scenes import points, take
from scipy.integrate import cumulative_trapezoid, quad
from scipy.special import gamma

import swtstudy
from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body import Body, closer_nodes, time_nodes
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.line.positions import INNERMOST
from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.mechanics.stress.scene import scene_of

EXPONENTS = (1.1, 1.5, 2.0, 4.0, 10.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


def pressure(n: float, r: float, a: float) -> float:
    """p/E* over δ0/a_H: (n/π) ∫ ξⁿ⁻¹ dξ/√(ξ² − r²), in v = √(ξ² − r²)."""
    v = np.sqrt(a * a - r * r)
    if n % 2 == 0.0:
        m = int(n) // 2 - 1
        # Binomial: a polynomial.
        coefficients = [gamma(m + 1) / gamma(k + 1) / gamma(m - k + 1) / (2 * k + 1) for k in range(m + 1)]
        terms = (c * r ** (2 * (m - k)) * v ** (2 * k + 1) for k, c in enumerate(coefficients))
        return n / np.pi * sum(terms)
    ends = [0.0, *(e for e in (0.1 * r, r, 10.0 * r) if e < v), v]
    parts = (
        quad(lambda v: (r * r + v * v) ** (0.5 * n - 1.0), *pair, epsabs=0.0, epsrel=1e-12)[0]
        for pair in pairwise(ends)
    )
    return n / np.pi * sum(parts)


@every_exponent
def test_radius_force_and_pressure_of_a_real_contact(n: float) -> None:
    """f = c rⁿ has δ0 = κ c aⁿ, κ = √π Γ(n/2 + 1)/Γ((n + 1)/2), and F = 2 E* n/(n + 1) δ0 a."""
    R, depth, young, ν = 30.0, 0.02, 73.1e3, 0.33
    contact = swtstudy.physical(
        young_modulus=young,
        poisson_ratio=ν,
        radius=R,
        depth=depth,
        friction=0.5,
        tangential_amplitude=1e-3,
        profile="power_law",
        exponent=n,
    )
    effective, c = 0.5 * young / (1.0 - ν**2), 1.0 / (n * R ** (n - 1.0))
    κ = np.sqrt(np.pi) * gamma(0.5 * n + 1.0) / gamma(0.5 * (n + 1.0))
    a = (depth / (c * κ)) ** (1.0 / n)
    assert contact.contact_radius == pytest.approx(a, rel=1e-13)
    assert contact.length_scale == contact.contact_radius
    force = 2.0 * effective * n / (n + 1.0) * depth * a
    assert contact.normal_force == pytest.approx(force, rel=1e-13)
    assert contact.swt_scale == pytest.approx(effective * (depth / a) ** 2, rel=1e-13)
    # The mean pressure is that of the distribution.
    if n <= 2.0:
        assert contact.peak_pressure == pytest.approx(effective * depth / a * n / (n - 1.0) / np.pi, rel=1e-7)
    again = swtstudy.physical(
        young_modulus=young,
        poisson_ratio=ν,
        radius=R,
        normal_force=force,
        friction=0.5,
        tangential_amplitude=1e-3,
        profile="power_law",
        exponent=n,
    )
    assert again.depth == pytest.approx(depth, rel=1e-12)


@every_exponent
def test_pressure(n: float) -> None:
    profile = make_profile("power_law", {"exponent": np.array([n])}, np.array([1.75]))
    a = float(profile.radius(np.array([[1.75]]))[0, 0])
    assert a**n == pytest.approx(1.75, rel=1e-14)
    # On both sides of where the two series for it meet.
    r = a * np.array([1e-6, 0.01, 0.3, 0.5, 0.7, 0.71, 0.9, 0.999, 1.0, 1.1])[None]
    found, _ = profile.primitives(r, 10.0).outer(np.full((1, r.size), a))
    expected = [pressure(n, x, a) if x < a else 0.0 for x in r[0].tolist()]
    np.testing.assert_allclose(found[0] / np.pi, expected, rtol=1e-10, atol=1e-15)


@pytest.mark.parametrize("n", [3.0, 3.0 + 1e-13, 3.0 + 1e-9, 3.0 - 1e-6, 19.0, 1.0 + 1e-6])
def test_pressure_near_odd_exponents(n: float) -> None:
    """There two terms of the series for small r/a have poles, which cancel."""
    profile = make_profile("power_law", {"exponent": np.array([n])}, np.ones(1))
    r = np.array([[1e-4, 0.2, 0.6]])
    found, _ = profile.primitives(r, 10.0).outer(np.ones((1, 3)))
    expected = [pressure(n, x, 1.0) for x in r[0].tolist()]
    np.testing.assert_allclose(found[0] / np.pi, expected, rtol=1e-9)


def test_the_square_is_the_paraboloid() -> None:
    given = {"phase": [0.0, 1.0, 2.5], "friction": [0.3, 0.9]}
    square = swtstudy.solve(profile="power_law", exponent=2.0, **given)
    paraboloid = swtstudy.solve(**given)
    for name in ("s", "s_error", "critical_x", "critical_angle", "s_surface"):
        np.testing.assert_array_equal(square[name], paraboloid[name])


@pytest.mark.parametrize("n", [1.1, 1.5, 4.0, 10.0, 20.0])
def test_s_is_that_of_the_field(n: float) -> None:
    """The field is superposed in another way, and its planes are searched in another."""
    batch = points("power_law", phase=[0.3, 2.0], friction=[0.3, 0.6], exponent=n)
    found = solve_points(batch, 1e-6)
    for k, x in enumerate(found.critical_x.tolist()):
        scene = scene_of(take(batch, k))
        nodes = closer_nodes(scene, time_nodes(scene, 5, [abs(x)]), (x, 0.0, 0.0), cells=80)
        assert float(Body(scene, nodes, cells=80).swt(x, 0.0, 0.0).swt) == pytest.approx(found.s[k], rel=1e-5)


def sliding_swt(n: float, ν: float, μ: float, r: float, a: NDArray[np.float64], side: float) -> float:
    """Largest swt at r over planes, while the edge comes to and goes from radii a, all springs at τ = w."""
    t = np.arccosh(np.maximum(a / r, 1.0))
    ξ = r * np.cosh(t)
    # Over the springs outside of r, ξ = r cosh t, and inside, ξ = r sin φ.
    outer = cumulative_trapezoid(n * ξ ** (n - 1.0), t, initial=0.0)
    within = cumulative_trapezoid(n * ξ ** (n - 1.0) * np.exp(-t) * r * np.sinh(t), t, initial=0.0)
    φ = np.arcsin(np.minimum(a / r, 1.0))
    g = n * (r * np.sin(φ)) ** (n - 1.0)
    first, third, normal = (
        cumulative_trapezoid(values, φ, initial=0.0)
        for values in (2.0 * np.sin(φ) * g, 2.0 * np.sin(φ) ** 3 * g, np.sin(φ) * np.cos(φ) * g)
    )
    p, mean = outer / np.pi, 2.0 / np.pi * (normal + within / r)
    # τ′ = −g′.
    pull = -side * μ / np.pi
    spread = 0.5 * (1.0 - 2.0 * ν) * mean
    xx = spread - p + pull * ((1.0 + ν) * first - ν * third)
    yy = -spread - 2.0 * ν * p + pull * ν * third
    zz, xz = -p, -μ * p
    best = 0.0
    for θ in np.linspace(-0.5 * np.pi, 0.5 * np.pi, 721):
        c, s = np.cos(θ), np.sin(θ)
        tension = c * c * xx + s * s * zz + 2.0 * s * c * xz
        strain = (tension * (1.0 + ν) - ν * (xx + yy + zz)) / (1.0 - ν * ν)
        best = max(best, tension.max() * 0.5 * np.ptp(strain))
    return best


def test_next_to_a_sharp_tip() -> None:
    """A loop on which all springs slide one way while there is contact: one radius says it all."""
    n, ν, μ = 1.01, 0.3, 0.6
    loop = LoadPath("sliding", [(-1.0, -10.0), (1.0, 0.0), (-1.0, 10.0)])
    point = replace(points("power_law", ν, μ, 1.0, 1.0, exponent=n), path=loop)
    found = solve_points(point, 1e-5)
    deepest = float(scene_of(point).cycle.load.largest_normal[0])
    x, largest = float(found.critical_x[0]), deepest ** (1.0 / n)
    # swt rises up to the tip; what is nearer is left out.
    assert abs(x) == pytest.approx(INNERMOST * largest, rel=1e-6)
    near = abs(x) * np.concatenate(
        [np.sin(np.linspace(0.0, 0.5 * np.pi, 4000)), np.geomspace(1.0, largest / abs(x), 80000)]
    )
    assert found.s[0] == pytest.approx(sliding_swt(n, ν, μ, abs(x), near, np.sign(x)), rel=2e-4)


def test_results_say_that_swt_rises_up_to_a_sharp_tip() -> None:
    given = {"profile": "power_law", "normal_amplitude": 0.0, "tangential_amplitude": 5.0, "friction": 1.0}
    sharp = swtstudy.solve(exponent=[1.05, 1.6], **given)
    (line,) = [each for each in sharp.swt.validity() if "tip" in each]
    assert line.startswith("swt rises up to the tip at 1 of 2 points")
    assert abs(float(sharp.critical_x[0])) == pytest.approx(INNERMOST, rel=1e-6)
    assert not any("tip" in each for each in sharp.isel(exponent=1).swt.validity())
    # A blunt one is smooth there.
    blunt = swtstudy.solve(
        exponent=2.5, bulk_stress_mean=-0.4, bulk_stress_amplitude=0.41, **given | {"friction": 0.0}
    )
    assert not any("tip" in each for each in blunt.swt.validity())


@pytest.mark.parametrize("n", [1.5, 4.0])
def test_stress_beneath_is_a_sum_of_point_loads(n: float) -> None:
    """At a constant force, while the whole contact slides in +x."""
    place, ν, μ = (0.4, -0.7, 0.6), 0.3, 0.5
    load = {"normal_amplitude": 0.0, "tangential_amplitude": 5.0}
    field = swtstudy.stress_field(
        *place, time=[0.0], profile="power_law", exponent=n, poisson_ratio=ν, friction=μ, **load
    )
    names = ("xx", "yy", "zz", "yz", "xz", "xy")
    found = [float(field[f"sigma_{name}"][0]) for name in names]
    normal, tangential = sum_of_point_loads(lambda ξ: n * ξ**n, 1.0, 0.0, place, ν)
    np.testing.assert_allclose(found, normal + μ * tangential, rtol=0.0, atol=1e-6)
