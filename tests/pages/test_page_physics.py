"""The numbers that the pages say of yield, lives, lengths and the Poisson ratio, computed anew."""

import numpy as np
import pytest
from body import von_mises
from scipy.integrate import quad
from test_page_numbers import says

import swtstudy

#: Of studies/physical.py.
STRENGTH_EXPONENT = -0.113
RIG = {"young_modulus": 73.1e3, "radius": 50.0, "normal_force": 200.0}


def first_yield(friction, force):
    """Peak pressure over yield strength at first yield, under a constant normal force, ν = 0.3."""
    loads = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": force}
    still = {"friction": friction, "poisson_ratio": 0.3, "time": [np.pi / 2]}
    x = np.linspace(-1.02, 1.02, 205)
    at = [swtstudy.stress_field(x, 0.0, z, **still, **loads) for z in (0.0, np.linspace(0.02, 1.0, 50))]
    return 2.0 / np.pi / max(von_mises(field).max() for field in at)


def test_first_yield():
    says("begins to yield where `peak_pressure` is {} times the yield strength", first_yield(1e-6, 0.5))
    full = first_yield(0.5, 1 - 1e-12), first_yield(0.8, 1 - 1e-12)
    says("slides as a whole, {} times at μ = {} and {} times at μ = {}", full[0], 0.5, full[1], 0.8)
    says("±{} μF, {} and {} times", 0.6, first_yield(0.5, 0.6), first_yield(0.8, 0.6))


def test_lengths():
    """Ahead of a crack the largest principal stress is f(θ)/√r, of which SWT is the square."""

    def f(angle):
        return np.cos(0.5 * angle) * (1.0 + np.sin(0.5 * abs(angle)))

    def radius(power):
        """Of the half sphere over which the mean of the power is that at L/2 ahead, over L."""
        ring = quad(lambda r: 2.0 * r * np.sqrt(1.0 - r * r) * r ** (-0.5 * power), 0.0, 1.0)[0]
        mean = ring * 2.0 * quad(lambda angle: f(angle) ** power, 0.0, 0.5 * np.pi)[0] / (2.0 / 3.0 * np.pi)
        return 0.5 * mean ** (2.0 / power)

    lengths = radius(1), 2005, 1.54, radius(2)
    assert lengths[0] == pytest.approx(lengths[2], rel=5e-3)
    says("if its radius is {} L for stress (Bellett and Taylor {}: {}), and {} L for SWT", *lengths)


@pytest.mark.parametrize("exponent", [0.5, 0.3])
def test_mean_stress_sensitivity(exponent):
    stress = np.zeros((2, 2, 6))
    stress[:, :, 0] = [[-1.0, 1.0], [0.0, 2.0]]  # R = −1 and R = 0, of one amplitude
    swt = swtstudy.swt_of_history(stress, 0.3, walker_exponent=exponent).swt
    sensitivity = np.sqrt(swt[1] / swt[0]) - 1.0
    assert sensitivity == pytest.approx(2.0 ** (1.0 - exponent) - 1.0)
    if exponent == 0.5:
        says("sensitivity of SWT, σ_a(R = −1)/σ_a(R = 0) − 1 (Schütz), is {};", sensitivity)
        assert f"− 1 = {sensitivity:.2f}" in swtstudy.FatigueConstants.cycles.__doc__


def test_lives_far_out():
    steep = swtstudy.FatigueConstants(73.1e3, 927.0, STRENGTH_EXPONENT, 0.409, -0.713)
    lives = steep.cycles(steep.swt(1e9) * np.array([1.0, 1.0 / 1.1]))
    power = np.log(lives[1] / lives[0]) / np.log(1.1)
    says("with SWT^−{}: 10 % of SWT are a factor of {}.", power, lives[1] / lives[0])


def falls(of):
    """By how many per cent something falls from ν = 0.25 to 0.35, at three μ."""
    return [100.0 * (1.0 - of(0.35, friction) / of(0.25, friction)) for friction in (0.5, 0.3, 0.1)]


def swt(poisson_ratio, friction, **loads):
    contact = swtstudy.physical(poisson_ratio=poisson_ratio, friction=friction, **RIG, **loads)
    return contact.solve(rtol=1e-5).SWT.values[0]


def as_in_table_1(poisson_ratio, friction):
    """With the displacements that are those of Table 1 at its Poisson ratio, 0.3."""
    table = swtstudy.physical(
        poisson_ratio=0.3, friction=friction, **RIG, tangential_amplitude=1e-3, normal_amplitude=0.0
    )
    moduli, depth = table.moduli, table.depth
    slip = 5 / 6 * friction * moduli.normal / moduli.tangential * depth
    return swt(poisson_ratio, friction, normal_amplitude=0.75 * depth, tangential_amplitude=slip)


@pytest.mark.slow
def test_poisson_ratio():
    plain = falls(lambda ν, μ: float(swtstudy.solve(poisson_ratio=ν, friction=μ, rtol=1e-5).s))
    says("falls by {}, {} and {} % at μ = {}, {} and {}.", *plain, 0.5, 0.3, 0.1)
    given = falls(as_in_table_1)
    says("displacements SWT falls by {}, {} and {} %", *given)
    says("Some {} points of that are the scale's", np.mean(np.subtract(plain, given)))
    force = falls(lambda ν, μ: swt(ν, μ, tangential_force_amplitude=0.6 * μ * RIG["normal_force"]))
    says("constant normal force F SWT falls by {}, {} and {} %.", *force)
