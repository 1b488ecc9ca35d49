"""Climbs over planes of every orientation: principal stresses, and derivatives along great circles."""

import numpy as np
import pytest

from swtstudy.kernel.climb import largest_principal, set_jet, set_shear_jet, set_square

pytestmark = pytest.mark.xdist_group("kernel")
#: Places of xx, yy, zz, yz, xz and xy in a matrix.
PLACES = (0, 1, 2, 1, 0, 0), (0, 1, 2, 2, 2, 1)


def matrix(tensor):
    """Six components as a symmetric matrix, (3, 3)."""
    full = np.zeros((3, 3))
    full[PLACES] = tensor
    full.T[PLACES] = tensor
    return full


def random_plane(rng):
    """A tensor, (6,), a plane's normal and two tangents, (3, 3)."""
    return rng.normal(size=6), np.linalg.qr(rng.normal(size=(3, 3)))[0]


def shear_stress(F, n):
    """|F n - n nᵀ F n| of the plane of any vector n."""
    n = n / np.linalg.norm(n)
    traction = matrix(F) @ n
    return np.linalg.norm(traction - n * (n @ traction))


def differences(value, n, p, q, h=1e-3):
    """A function of the normal and its first and second derivatives along the great circles of p and q."""

    def at(a, b):
        size = np.hypot(a, b)
        return value(n * np.cos(size) + (a * p + b * q) * np.sinc(size / np.pi))

    slopes = [(at(h, 0) - at(-h, 0)) / (2 * h), (at(0, h) - at(0, -h)) / (2 * h)]
    bends = [(at(h, 0) + at(-h, 0) - 2 * at(0, 0)) / h**2, (at(0, h) + at(0, -h) - 2 * at(0, 0)) / h**2]
    mixed = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h**2)
    return [at(0, 0), *slopes, *bends, mixed]


@pytest.mark.parametrize("seed", range(4))
def test_largest_principal_stress(seed):
    stresses = np.random.default_rng(seed).normal(size=(6, 3))
    stresses[:, 2] = [0.7, 0.7, 0.7, 0.0, 0.0, 0.0]
    for i in range(3):
        found = np.linalg.eigvalsh(matrix(stresses[:, i])).max()
        assert largest_principal(stresses, i) == pytest.approx(found, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_square_of_a_tensor(seed):
    tensor, square = np.random.default_rng(seed).normal(size=6), np.empty(6)
    set_square(tensor, square)
    assert matrix(square) == pytest.approx(matrix(tensor) @ matrix(tensor))


@pytest.mark.parametrize("seed", range(4))
def test_derivatives_of_the_normal_and_of_the_shear_stress(seed):
    tensor, (n, p, q) = random_plane(np.random.default_rng(seed))
    normal, square, of_square = np.empty(6), np.empty(6), np.empty(6)
    set_jet(tensor, n, p, q, normal)
    assert normal == pytest.approx(differences(lambda x: x @ matrix(tensor) @ x, n, p, q), abs=3e-5)
    set_square(tensor, square)
    set_jet(square, n, p, q, of_square)
    shear = normal.copy()
    set_shear_jet(shear, of_square)
    assert shear == pytest.approx(differences(lambda x: shear_stress(tensor, x), n, p, q), abs=3e-4)
