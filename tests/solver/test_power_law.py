"""The power law against the closed forms of Galin and Sneddon; its tip."""

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
    own = {"young_modulus": young, "poisson_ratio": ν, "radius": R, "friction": 0.5}
    own |= {"tangential_amplitude": 1e-3, "profile": "power_law", "exponent": n}
    contact = swtstudy.physical(**own, depth=depth)
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
    again = swtstudy.physical(**own, normal_force=force)
    assert again.depth == pytest.approx(depth, rel=1e-12)


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


@pytest.mark.parametrize("n", [1.001, 1.01, 1.3, 1.5])
@pytest.mark.parametrize("profile", ["power_law", "power_law_cylinder"])
def test_s_of_a_sharp_tip_holds_the_pressure_there(profile: str, n: float) -> None:
    """n/(n - 1)/π, in the plane n/(n - 1)/4, with tractions of ± μ times that; a strip has more beside it."""
    ν, μ, plane = 0.2, 10.0, profile == "power_law_cylinder"
    kind, amplitude = ("force_amplitude", 1.0 - 1e-12) if plane else ("amplitude", 3.0)
    given = {f"normal_{kind}": 0.0, f"tangential_{kind}": amplitude, "poisson_ratio": ν, "friction": μ}
    found = swtstudy.solve(profile=profile, exponent=n, **given)
    stick = 1e-12 ** ((n - 1.0) / n) if plane else 0.0
    p = n / (n - 1.0) * (0.25 if plane else 1.0 / np.pi)
    q, xx = μ * p * (1.0 - stick), -p if plane else -(0.5 + ν) * p
    angle = np.linspace(0.0, np.pi, 20_001)
    shear = q * np.abs(np.sin(2.0 * angle))
    tension = xx * np.sin(angle) ** 2 - p * np.cos(angle) ** 2 + shear
    at_tip = (tension * shear / (1.0 - ν)).max()
    assert found.s + found.s_error >= at_tip
    assert found.s_error <= 1e-4 * found.s
    if not plane:
        assert found.critical_x == 0.0
        assert float(found.s) == pytest.approx(at_tip, rel=1e-6)
