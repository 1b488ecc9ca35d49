"""The field beneath the contact: closed forms, point loads, the field equations, boundary values."""

import numpy as np
import pytest
from ContactMechanics.ReferenceSolutions import Hertz
from oracles.point_loads import sum_of_point_loads
from oracles.punch import punch_functions

from swtstudy.mechanics.stress.punch import PunchFunctions, normal_components, tangential_components
from swtstudy.mechanics.stress.superposition import SlopeCells, graded_radii, slope_cells, stress_history

POISSON = 0.3
P0 = 2 / np.pi  # of the paraboloid with a = 1, in E* √(δ0/R)


# Slopes g′ times √(ξ² − b²).
def paraboloid(ξ):
    return 2 * ξ**2


def rounded(ξ, b=0.5):
    w = np.sqrt(ξ**2 - b**2)
    return w * (2 * w - b * np.arccos(b / ξ))


def truncated(ξ, b=0.5):
    return 2 * ξ**2 - b**2


HERTZ = slope_cells(paraboloid, [0.0, 1.0])
ROUNDED = slope_cells(rounded, graded_radii(0.5, 1.2, 200), start=0.5)


def field(x, y, z, cells=HERTZ, poisson_ratio=POISSON):
    """Normal load and full sliding in +x with μ = 1, as (…, 2, 6)."""
    one = np.ones(cells.gradient.shape)
    return stress_history(x, y, z, cells, [one[0], 0 * one[0]], [0 * one, -one], 1.0, poisson_ratio)


@pytest.fixture
def points():
    rng = np.random.default_rng(7)
    return *rng.uniform(-2, 2, (2, 500)), 10 ** rng.uniform(-1.5, 0.5, 500)


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.5])
def test_full_sliding_hertz_is_hamilton(points, poisson_ratio):
    stress = field(*points, poisson_ratio=poisson_ratio) / P0
    for load, solution in enumerate((Hertz.stress_Cartesian, Hertz.stress_for_tangential_loading)):
        np.testing.assert_allclose(stress[:, load].T, solution(*points, poisson_ratio), rtol=0, atol=1e-10)


def test_cattaneo_mindlin_is_two_hamilton_fields(points):
    c, friction = 0.6, 0.4
    cells = slope_cells(paraboloid, [0.0, c, 1.0])
    # In the stick zone the springs share one displacement: dτ/dG = 0.
    stress = stress_history(*points, cells, [1, 1], [[0, -1]], friction, POISSON) / P0
    sliding = np.array(Hertz.stress_for_tangential_loading(*points, POISSON))
    stick = c * np.array(Hertz.stress_for_tangential_loading(*(v / c for v in points), POISSON))
    expected = np.array(Hertz.stress_Cartesian(*points, POISSON)) + friction * (sliding - stick)
    np.testing.assert_allclose(stress.T, expected, rtol=0, atol=1e-10)


def test_rounded_punch_is_a_sum_of_point_loads():
    expected = sum_of_point_loads(rounded, 1.2, 0.5, (0.4, -0.7, 0.6), POISSON)
    np.testing.assert_allclose(field(0.4, -0.7, 0.6, ROUNDED), expected, rtol=0, atol=2e-8 * P0)


def test_equilibrium_and_compatibility():
    """div σ = 0 and (1 + ν) ∇²σ + grad grad tr σ = 0 (Beltrami–Michell) by differences of sixth order."""
    h = 0.02
    rng = np.random.default_rng(3)
    here = np.concatenate([rng.uniform(-1.3, 1.3, (2, 20)), rng.uniform(0.3, 1.0, (1, 20))])
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * h)
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / (180 * h**2)
    unit = np.zeros(7)
    unit[3] = 1
    line = h * np.arange(-3, 4)
    grid = np.array(np.meshgrid(line, line, line, indexing="ij"))
    stress = field(*(here[:, :, None, None, None] + grid[:, None]), ROUNDED)
    tensor = stress[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]

    def derivative(i, j=None):
        stencils = [unit, unit, unit]
        if i == j:
            stencils[i] = second
        else:
            stencils[i] = first
            if j is not None:
                stencils[j] = first
        return np.einsum("nxyzlab,x,y,z->nlab", tensor, *stencils)

    divergence = sum(derivative(i)[..., i] for i in range(3))
    assert np.abs(divergence).max() < 1e-6
    laplacian = sum(derivative(i, i) for i in range(3))
    hessian = np.array([[derivative(i, j).trace(axis1=-2, axis2=-1) for j in range(3)] for i in range(3)])
    residual = (1 + POISSON) * laplacian + np.moveaxis(hessian, (0, 1), (-2, -1))
    assert np.abs(residual).max() < 1e-4


def test_boundary_values_are_the_tractions():
    rng = np.random.default_rng(5)
    r, angle = rng.uniform(0, 1.5, 200), rng.uniform(0, 2 * np.pi, 200)
    stress = field(r * np.cos(angle), r * np.sin(angle), 0.0)
    traction = P0 * np.sqrt(np.maximum(1 - r**2, 0))
    zero = np.zeros(200)
    np.testing.assert_allclose(stress[:, 0, 2:5], np.array([-traction, zero, zero]).T, atol=1e-13)
    np.testing.assert_allclose(stress[:, 1, 2:5], np.array([zero, zero, -traction]).T, atol=1e-13)


def test_surface_formulas():
    """The normal load inside r, and the springs inside r alone, act on the in-plane stress."""
    ν = POISSON
    u, w = np.polynomial.legendre.leggauss(200)
    for r in (0.3, 0.8, 1.0, 1.4):
        normal, tangential = field(r, 0.0, 0.0)
        p = P0 * np.sqrt(max(1 - r**2, 0))
        load = 4 / 3 * (1 - max(1 - r**2, 0) ** 1.5)
        np.testing.assert_allclose(normal[0], (1 - 2 * ν) * load / (2 * np.pi * r**2) - p, atol=1e-13)
        np.testing.assert_allclose(
            normal[1], -(1 - 2 * ν) * load / (2 * np.pi * r**2) - 2 * ν * p, atol=1e-13
        )
        end = np.arcsin(min(1 / r, 1.0))
        φ = end * (u + 1) / 2
        slope = -2 * r * np.sin(φ) * w * end / 2
        xx = (2 * np.sin(φ) * (1 + ν * np.cos(φ) ** 2) * slope).sum() / np.pi
        yy = (2 * ν * np.sin(φ) ** 3 * slope).sum() / np.pi
        np.testing.assert_allclose(tangential[:2], [xx, yy], atol=1e-13)


def test_trailing_edge_under_full_sliding():
    normal, tangential = field(-1.0, 0.0, 0.0) / P0
    μ = 0.3
    σxx = normal[0] + μ * tangential[0]
    assert σxx == pytest.approx((1 - 2 * POISSON) / 3 + np.pi * μ * (4 + POISSON) / 8, abs=1e-14)


@pytest.mark.parametrize("cells", [HERTZ, ROUNDED, slope_cells(paraboloid, [0.0, 0.6, 1.0])])
@pytest.mark.parametrize("r", [0.0, 1e-9, 0.3, 0.5, 0.6, 0.9, 1.0, 1.2, 1.5])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_continuity_towards_the_surface(cells, r, angle):
    """On the axis, at a slip front (0.6), at the contact's edge (1, 1.2) and elsewhere."""
    depth = 10.0 ** -np.arange(2, 17)
    x, y = r * np.cos(angle), r * np.sin(angle)
    change = np.abs(field(x, y, depth, cells) - field(x, y, 0.0, cells)).max(axis=(1, 2))
    # The stress is a square root at an edge, and z ln z where the slope or the pressure have a kink.
    assert (change < 4 * np.sqrt(depth) + 1e-12).all()


def test_continuity_towards_the_axis():
    distance = 10.0 ** -np.arange(2, 13)
    for z in (0.0, 1e-9, 0.1):
        change = np.abs(field(distance, 0.5 * distance, z, HERTZ) - field(0.0, 0.0, z, HERTZ)).max(
            axis=(1, 2)
        )
        assert (change < 5 * distance + 1e-11).all()


def test_cells_keep_mass_and_first_moment():
    """∫ g′ and ∫ ξ g′ over each cell, here beside the singularity of the truncated paraboloid."""
    ends = graded_radii(0.5, 1.2, 20)
    cells = slope_cells(truncated, ends, start=0.5)
    g = ends * np.sqrt(ends**2 - 0.25)
    mass = cells.intercept[0] * np.diff(ends) + cells.gradient[0] * np.diff(ends**2) / 2
    np.testing.assert_allclose(mass, np.diff(g), atol=1e-12)
    moment = cells.intercept[0] * np.diff(ends**2) / 2 + cells.gradient[0] * np.diff(ends**3) / 3
    np.testing.assert_allclose(moment, np.diff(ends * g - (ends**2 - 0.25) ** 1.5 / 3), atol=1e-12)


@pytest.mark.parametrize("slope", [rounded, truncated])
def test_interior_accuracy_of_the_singular_profiles(slope):
    """Against Gauss quadrature in v, ξ² = b² + v², of the field of single punches."""
    rng = np.random.default_rng(11)
    x, y, z = *rng.uniform(-1.4, 1.4, (2, 40)), rng.uniform(0.1, 1.0, 40)
    u, w = np.polynomial.legendre.leggauss(400)
    v = np.sqrt(1.2**2 - 0.25) * (u + 1) / 2
    ξ = np.sqrt(0.25 + v**2)
    weight = w * np.sqrt(1.2**2 - 0.25) / 2 * slope(ξ) / ξ
    functions = punch_functions(np.hypot(x, y)[:, None], z[:, None], ξ)
    summed = PunchFunctions(*((np.imag(f) * weight).sum(axis=1) / np.pi for f in functions))
    expected = [part(summed, x, y, z, POISSON) for part in (normal_components, tangential_components)]
    cells = slope_cells(slope, graded_radii(0.5, 1.2, 200), start=0.5)
    np.testing.assert_allclose(field(x, y, z, cells), np.stack(expected, axis=1), rtol=0, atol=1e-8 * P0)


def test_instants_and_points_keep_their_shapes():
    cells = SlopeCells(np.array([0.0, 0.5, 1.0]), np.zeros((1, 2)), np.full((1, 2), 2.0))
    stress = stress_history(
        np.zeros((4, 1)), np.zeros(3), 0.1, cells, np.ones((7, 2)), np.zeros((7, 1, 2)), 0.3, 0.3
    )
    assert stress.shape == (4, 3, 7, 6)
