"""Next to a sharp tip where contact is lost: stresses that change with the logarithm of the radius."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scenes import points
from scipy.integrate import cumulative_trapezoid, quad

from swtstudy.mechanics import Points, solve_points
from swtstudy.mechanics.contact.memory import Growths
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.line.climb import refine
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.load.load_path import LoadPath
from swtstudy.mechanics.stress.growth import GrowthIntegrals
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import scene_of


def lifted(
    exponent: float, *values: float, phase: float, p: int = 1, q: int = 1
) -> tuple[Points, tuple[float, ...]]:
    """A power law that loses contact: n, then ν, μ, δA/δ0, u."""
    return points("power_law", *values, phase, p, q, exponent=exponent), values


#: The second one has a normal load of 6e-16 at its touch-down.
IN_STICK = [
    lifted(1.0464, 0.14, 1.9, 2.5, 0.52, phase=1.74),
    lifted(
        1.0035191158602617,
        0.19021213494326616,
        0.9261296718477738,
        2.349378790869555,
        0.5110039342849587,
        phase=5.066439779006894,
    ),
]


@pytest.mark.parametrize("r", [1e-3, 1e-60])
@pytest.mark.parametrize(("point", "values"), IN_STICK)
def test_the_traction_of_ground_gained_in_stick(point: Points, values: tuple[float, ...], r: float) -> None:
    """Shortly after touch-down, where all sticks, against a quadrature over the logarithm of the radius."""
    _, _, amplitude, tangential = values
    n, phase = float(point.shape["exponent"][0]), float(point.phase[0])

    def touch_down(depth: float) -> float:
        return float(np.mod(np.arcsin((depth - 1.0) / amplitude) - phase, 2.0 * np.pi))

    def slope(depth: float) -> float:
        φ = touch_down(depth)
        return -tangential * np.cos(φ) / (amplitude * np.cos(φ + phase))

    scene, deepest = scene_of(point), 0.5
    instant = touch_down(deepest)
    interval = int(np.searchsorted(scene.cycle.end[0], instant))
    line = SurfaceLine(scene.cycle, scene.coordinate, np.array([[r]]), 9.0)
    one = Nodes(np.array([[interval]]), np.array([[instant]]), np.zeros((1, 1, 1), dtype=np.intp))

    def density(t: float) -> float:
        """n ξⁿ⁻¹ τ′/g′ with ξ = r cosh t."""
        ξ = r * np.cosh(t)
        return n * ξ ** (n - 1.0) * slope(ξ**n)

    ends = np.linspace(0.0, np.arccosh(deepest ** (1.0 / n) / r), 60)
    expected = sum(quad(density, *pair, epsabs=0.0, epsrel=1e-10)[0] for pair in pairwise(ends))
    assert float(line.history(one).traction[0, 0, 0]) * np.pi == pytest.approx(expected, rel=1e-6)


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


def test_what_arrives_at_a_tip_within_no_time_counts() -> None:
    """A loop on which all springs slide one way while there is contact: one radius says it all."""
    n, ν, μ = 1.01, 0.3, 0.6
    loop = LoadPath("sliding", [(-1.0, -10.0), (1.0, 0.0), (-1.0, 10.0)])
    point = replace(points("power_law", ν, μ, 1.0, 1.0, exponent=n), path=loop)
    found = solve_points(point, 1e-5)
    deepest = float(scene_of(point).cycle.load.largest_normal[0])
    x = float(found.critical_x[0])
    assert abs(x) < 1e-20
    near = abs(x) * np.concatenate(
        [np.sin(np.linspace(0.0, 0.5 * np.pi, 4000)), np.geomspace(1.0, 1e6, 40000)]
    )
    a = np.concatenate([near, np.geomspace(near[-1], deepest ** (1.0 / n), 40000)])
    assert found.s[0] == pytest.approx(sliding_swt(n, ν, μ, abs(x), a, np.sign(x)), rel=2e-4)
    assert found.s_error[0] <= 1e-3 * found.s[0]


#: n, then ν, μ, δA/δ0, u, and ψ: a maximum between the landmarks at an x, on the plane at 2θ; or, with two
#: planes nearly as high, where the position is right.
HIDDEN = [
    (
        lifted(1.0962, 0.18811925, 0.34515162, 2.34317527, 1.43006822, phase=2.36434567),
        -0.014084,
        0.7478,
    ),
    (
        lifted(1.02387, 0.30666384, 0.7136246568, 2.9779652547, 1.24358993, phase=0.3302973472),
        -1.3e-12,
        1.0004,
    ),
    (
        lifted(1.0025574948, 0.447357931, 2.9235629342, 1.7253937141, 1.7463833713, phase=3.897589, q=2),
        2.71843206e-140,
        1.5631,
    ),
]


@pytest.mark.parametrize(("point", "x", "double_angle"), HIDDEN)
def test_no_maximum_on_the_way_to_a_tip_is_passed_over(point, x: float, double_angle: float) -> None:
    found, scene = solve_points(point[0], 1e-5), scene_of(point[0]).split_at_breakpoints()
    place = np.array([[abs(x)]]), np.array([np.sign(x)]), np.array([[double_angle]])
    swt, _ = refine(scene, *place, Resolution(8, 4, 8.0))
    assert found.s[0] >= swt[0, 0] - found.s_error[0]
    assert found.s_error[0] <= 1e-3 * found.s[0]


def test_a_contact_that_is_nearly_lost_keeps_its_least_radius() -> None:
    """At the tip the pressure of the least depth, which is none that the load is slowed down for."""
    n, r, least = 1.02, 1e-100, 1e-8
    scene = scene_of(points("power_law", 0.3, 2.0, 1.0 - least, 0.5, 0.3, exponent=n))
    instant = float(np.mod(-0.5 * np.pi - 0.3, 2.0 * np.pi))
    interval = int(np.searchsorted(scene.cycle.end[0], instant))
    one = Nodes(np.array([[interval]]), np.array([[instant]]), np.zeros((1, 1, 1), dtype=np.intp))
    found = SurfaceLine(scene.cycle, scene.coordinate, np.array([[r]]), 9.0).history(one).pressure[0, 0, 0]
    t = np.linspace(0.0, np.arccosh(least ** (1.0 / n) / r), 200001)
    expected = n / np.pi * np.trapezoid((r * np.cosh(t)) ** (n - 1.0), t)
    assert float(found) == pytest.approx(expected, rel=1e-6)


def test_growth_from_next_to_a_tip_on_has_nodes_enough() -> None:
    """Contact nearly lost and little tangential motion: the slope turns within much less than the ground."""
    scene = scene_of(points("power_law", 0.3, 0.5, 1.0 - 1e-6, 1e-3, 0.7, exponent=1.02))
    r = np.array([[1e-5, 1e-9, 1e-40]])
    few, many = (GrowthIntegrals(scene.cycle, scene.coordinate, r, digits) for digits in (6.5, 30.0))
    growths = Growths.of(scene.cycle.memory)
    number = int(growths.begin[0].argmin())
    stop = float(scene.profile.radius(growths.end[:, number])[0])
    where = np.zeros(3, dtype=np.intp), np.arange(3), np.full(3, number), np.full(3, stop)
    full = SurfaceLine(scene.cycle, scene.coordinate, r, 6.5).primitives.pressure(np.full((1, 3, 1), stop))
    np.testing.assert_allclose(few.up_to(*where)[2], many.up_to(*where)[2], rtol=0.0, atol=1e-4 * full.max())
