"""The search over all planes."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import swtstudy
from swtstudy import swt_of_history

POISSON = 0.3


def smooth_histories(rng, n):
    t = np.linspace(0, 2 * np.pi, 48, endpoint=False)[:, None]
    mean, first, second = rng.normal(size=(3, n, 1, 6))
    return mean + first * np.sin(t) + second * np.sin(2 * t + 1)


def rough_histories(rng, n):
    return rng.normal(size=(n, 48, 6))


def compressed_histories(rng, n):
    stress = smooth_histories(rng, n)
    stress[..., :3] -= 1.5
    return stress


def tensors(stress):
    return stress[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]


def directions(count):
    """Unit vectors nearly evenly over a half sphere: a spiral."""
    z = (np.arange(count) + 0.5) / count
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], axis=-1)


def swt_on_planes(stress, normals, poisson_ratio, young_modulus=1.0):
    """Largest normal stress times half the swing of the normal strain, for each history and normal."""
    normal = np.einsum("pi,ntij,pj->npt", normals, tensors(stress), normals)
    trace = stress[:, None, :, :3].sum(axis=-1)
    strain = ((1 + poisson_ratio) * normal - poisson_ratio * trace) / young_modulus
    return np.maximum(normal.max(axis=-1), 0) * np.ptp(strain, axis=-1) / 2


def rotated(stress, rotations):
    tensor = np.einsum("nij,ntjk,nlk->ntil", rotations, tensors(stress), rotations)
    return tensor[..., [0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]]


@pytest.mark.parametrize("histories", [smooth_histories, rough_histories, compressed_histories])
def test_rotating_a_history_rotates_the_plane_only(histories):
    stress = histories(np.random.default_rng(2), 300)
    rotations = Rotation.random(300, random_state=3).as_matrix()
    swt, normal = swt_of_history(stress, POISSON)
    swt_rotated, normal_rotated = swt_of_history(rotated(stress, rotations), POISSON)
    np.testing.assert_allclose(swt_rotated, swt, rtol=1e-11, atol=1e-14)
    alignment = np.abs(np.einsum("ni,nij,nj->n", normal_rotated, rotations, normal))
    np.testing.assert_allclose(alignment[swt > 0], 1.0, atol=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("histories", [smooth_histories, rough_histories, compressed_histories])
def test_no_plane_is_higher(histories):
    stress = histories(np.random.default_rng(4), 60)
    swt, normal = swt_of_history(stress, POISSON)
    assert (swt_on_planes(stress, directions(2000), POISSON).max(axis=1) <= swt * (1 + 1e-12)).all()
    on_its_plane = [
        swt_on_planes(s[None], n[None], POISSON)[0, 0] for s, n in zip(stress, normal, strict=True)
    ]
    np.testing.assert_allclose(on_its_plane, swt, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0)


def test_never_less_than_the_search_in_the_plane_of_sliding():
    angle = np.linspace(-np.pi / 2, np.pi / 2, 2000)
    in_plane = np.stack([np.cos(angle), 0 * angle, np.sin(angle)], axis=-1)
    stress = smooth_histories(np.random.default_rng(5), 60)
    swt, _ = swt_of_history(stress, POISSON)
    assert (swt_on_planes(stress, in_plane, POISSON).max(axis=1) <= swt * (1 + 1e-12)).all()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"stress": np.ma.array(np.eye(2, 6) * 9.0, mask=np.eye(2, 6))},
            "stress: found 2 components that are not finite or masked; allowed: finite numbers",
        ),
        ({"stress": np.zeros(6)}, r"the shape \(6,\)"),
        ({"stress": "x"}, "stress: found 'x'; allowed: an array of numbers"),
        ({"poisson_ratio": -1}, r"poisson_ratio: found -1; allowed: a number in \(-1, 0.5\]"),
        ({"poisson_ratio": None}, "poisson_ratio: found None"),
        ({"young_modulus": np.timedelta64(1, "s")}, "young_modulus: found"),
    ],
)
def test_mistakes_are_named(changes, words):
    pull = np.zeros((2, 6))
    pull[1, 0] = 1.0
    good = {"stress": pull, "poisson_ratio": POISSON, "young_modulus": 2.0}
    assert swtstudy.swt_of_history(**good).swt == pytest.approx(0.25)
    with pytest.raises(ValueError, match=words):
        swtstudy.swt_of_history(**{**good, **changes})


def test_any_plain_numbers_are_constants():
    pull = np.outer([0.0, 1.0, 0.5], [1, 0, 0, 0, 0, 0])
    swt, _ = swtstudy.swt_of_history(pull, Fraction(3, 10), young_modulus=Decimal(10))
    assert swt == pytest.approx(0.05)


def test_closed_forms():
    # Uniaxial, pulsating: the plane normal to the load. Pure compression: no plane opens.
    pull = np.zeros((3, 6))
    pull[1:, 1] = 2.0, 1.0
    swt, normal = swt_of_history(pull, POISSON, young_modulus=10.0)
    assert swt == pytest.approx(0.2)
    np.testing.assert_allclose(normal, [0, 1, 0], atol=1e-9)
    assert swt_of_history(-pull, POISSON).swt == 0.0
    # Alternating shear τ: principal planes at 45°, σ_n = τ, ε_n = ±(1 + ν) τ/E.
    shear = np.zeros((2, 6))
    shear[:, 4] = 1.0, -1.0
    swt, normal = swt_of_history(shear, POISSON)
    assert swt == pytest.approx(1 + POISSON)
    np.testing.assert_allclose(np.abs(normal), [np.sqrt(0.5), 0, np.sqrt(0.5)], atol=1e-9)


def test_tension_in_a_narrow_cone():
    """Hydrostatic pressure leaves tension within 2° of an axis that lies between the coarse planes."""
    axis = Rotation.from_euler("xyz", [0.3, 0.2, 0.1]).as_matrix()[None]
    stress = np.zeros((1, 2, 6))
    stress[0, 0, :3] = 1.0 - np.cos(np.radians(2.0)) ** 2, -1.0, -1.0
    stress[0, 0, 0] = np.sin(np.radians(2.0)) ** 2
    stress[0, 0, 1:3] = -(np.cos(np.radians(2.0)) ** 2)
    swt, normal = swt_of_history(rotated(stress, axis), POISSON)
    assert swt[0] > 0
    assert abs(normal[0] @ axis[0][:, 0]) > np.cos(np.radians(2.0))


def test_batch_axes_are_kept():
    stress = smooth_histories(np.random.default_rng(6), 6).reshape(2, 3, 48, 6)
    swt, normal = swt_of_history(stress, POISSON)
    assert swt.shape == (2, 3)
    assert normal.shape == (2, 3, 3)
