"""The stress field of power laws, whose density is steep: its pressure is known in closed form."""

import numpy as np
import pytest

import swtstudy

ROOTS, WEIGHTS = np.polynomial.legendre.leggauss(60)


def pressure(exponent: float, edge: float, x: float) -> float:
    """Pressure over E* δ0/a_H at x of a contact of this radius: (1/π) ∫ n ξⁿ⁻¹ dξ/√(ξ²-x²)."""
    most = np.sqrt((edge - x) * (edge + x))
    root = 0.5 * most * (ROOTS + 1.0)
    return float(WEIGHTS @ (exponent * (x * x + root * root) ** (0.5 * exponent - 1.0))) * 0.5 * most / np.pi


@pytest.mark.parametrize("z", [0.0, 1e-13])
@pytest.mark.parametrize("exponent", [1.2, 4.0, 8.0, 15.0, 20.0])
def test_the_field_of_a_power_law_has_its_pressure(exponent: float, z: float) -> None:
    time = np.linspace(0.1, 6.2, 13)
    radius = (1.0 + 0.5 * np.sin(time)) ** (1.0 / exponent)
    x = np.array([0.3, 0.6, 0.9, 0.97])
    field = swtstudy.stress_field(
        x, [0.0], [z], time=time, profile="power_law", exponent=exponent, normal_amplitude=0.5, phase=0.0
    )
    exact = np.array([[pressure(exponent, a, r) if r < a else 0.0 for a in radius] for r in x])
    found = -field.sigma_zz.squeeze().transpose("x", "time").values
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-7 * exact.max())
