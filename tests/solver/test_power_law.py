"""The power law against the closed forms of Galin and Sneddon; its tip."""

from __future__ import annotations

import numpy as np
import pytest
from oracles.point_loads import sum_of_point_loads
from scipy.special import gamma

import swtstudy

EXPONENTS = (1.1, 1.5, 2.0, 4.0, 10.0)
every_exponent = pytest.mark.parametrize("n", EXPONENTS)


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


def test_the_square_is_the_paraboloid() -> None:
    given = {"phase": [0.0, 1.0, 2.5], "friction": [0.3, 0.9]}
    square = swtstudy.solve(profile="power_law", exponent=2.0, **given)
    paraboloid = swtstudy.solve(**given)
    for name in ("s", "s_error", "critical_x", "critical_angle", "s_surface"):
        np.testing.assert_array_equal(square[name], paraboloid[name])


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
