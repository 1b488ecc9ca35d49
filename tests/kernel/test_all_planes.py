"""The search over planes of every orientation, and dense grids of planes that share no code with it."""

import itertools

import numpy as np
import pytest

import swtstudy


def spiral(count):
    """Unit vectors nearly evenly over a half sphere, (count, 3)."""
    z = (np.arange(count) + 0.5) / count
    turn = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    flat = np.sqrt(1.0 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=-1)


def around(normal, size, count, rng):
    """Unit vectors next to one, (count, 3)."""
    near = normal + size * rng.normal(size=(count, 3))
    return near / np.linalg.norm(near, axis=1, keepdims=True)


def on_planes(history, normals, criterion, number, poisson_ratio):
    """The criterion of a history, (T, 6), on planes: the chord of all pairs of instants."""
    tensor = history[:, [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]
    traction = np.einsum("tij,pj->pti", tensor, normals)
    stress = np.einsum("pti,pi->pt", traction, normals)
    top = stress.max(axis=1)
    if criterion == "swt":
        trace = history[:, :3].sum(axis=1)
        swing = np.ptp((1.0 + poisson_ratio) * stress - poisson_ratio * trace, axis=1)
        return np.maximum(top, 0.0) ** (2.0 - 2.0 * number) * (0.5 * swing) ** (2.0 * number)
    shear = traction - stress[..., None] * normals[:, None]
    chord = np.zeros(len(normals))
    for one, other in itertools.combinations(range(len(history)), 2):
        chord = np.maximum(chord, np.linalg.norm(shear[:, one] - shear[:, other], axis=-1))
    if criterion == "findley":
        return np.maximum(0.5 * chord + number * top, 0.0)
    return 0.5 * chord * (1.0 + number * np.maximum(top, 0.0))


def dense(history, *criterion):
    """Largest value on a spiral of planes and on planes ever nearer to the highest ones."""
    rng = np.random.default_rng(0)
    normals = spiral(4000)
    values = on_planes(history, normals, *criterion)
    best = 0.0
    for k in np.argsort(-values)[:4]:
        normal, value = normals[k], values[k]
        for size in 0.02 * 0.5 ** np.arange(12):
            near = around(normal, size, 60, rng)
            others = on_planes(history, near, *criterion)
            if others.max() > value:
                normal, value = near[others.argmax()], others.max()
        best = max(best, value)
    return best


def histories():
    """Kinds of histories by name."""
    rng = np.random.default_rng(7)
    time = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)[:, None]
    smooth = rng.normal(size=6) + sum(
        rng.normal(size=6) * np.cos(k * time + rng.uniform(0.0, 6.0, size=6)) / k for k in (1, 2, 3)
    )
    pull = np.array([[0.2, 0.0, 0.0, 0.0, 0.0, 0.0]])
    pressed = smooth - np.array([2.5, 2.5, 2.5, 0.0, 0.0, 0.0])
    return {
        "two instants": rng.normal(size=(2, 6)),
        "three instants": rng.normal(size=(3, 6)),
        "rough": rng.normal(size=(12, 6)),
        "smooth": smooth,
        "in little tension": pressed,
        "uniaxial": np.concatenate([3.0 * pull, -pull]),
        "nearly uniaxial": np.concatenate([3.0 * pull, -pull]) + 1e-5 * rng.normal(size=(2, 6)),
        "pressed uniaxially": np.concatenate([-3.0 * pull, 0.0 * pull]) + 1e-3 * rng.normal(size=(2, 6)),
        "hydrostatic": np.outer([1.0, -0.5], [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        "pure shear": np.outer([1.0, -0.5], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        "turning shear": np.stack([np.cos(time[:, 0]), np.sin(time[:, 0])], axis=1) @ np.eye(6)[3:5],
        "constant": np.tile(rng.normal(size=6), (3, 1)),
        "one instant": rng.normal(size=(1, 6)),
        "nothing": np.zeros((2, 6)),
    }


HISTORIES = histories()
CRITERIA = [
    ("swt", 0.5, 0.3),
    ("swt", 0.5, -0.4),
    ("swt", 0.2, 0.3),
    ("swt", 0.85, 0.5),
    ("fatemi_socie", 0.6, 0.3),
    ("findley", 0.3, 0.3),
    ("findley", 0.0, 0.3),
]


@pytest.mark.parametrize("criterion", CRITERIA, ids=str)
@pytest.mark.parametrize("kind", HISTORIES)
def test_no_plane_of_a_dense_grid_is_higher(kind, criterion):
    """Nor is the value one that no plane has."""
    history, (name, number, nu) = HISTORIES[kind], criterion
    if name == "swt":
        value, normal = swtstudy.swt_of_history(history, nu, walker_exponent=number)
    else:
        value, normal = swtstudy.criterion_of_history(history, name, number)
    assert dense(history, *criterion) <= value * (1.0 + 1e-5) + 1e-9
    if value > 0.0:
        there = on_planes(history, normal[None], *criterion)[0]
        assert there == pytest.approx(float(value), rel=1e-9, abs=1e-12)
    else:
        assert np.isnan(normal).all()


@pytest.mark.filterwarnings("ignore:the search over planes ended early")
@pytest.mark.parametrize("k", [0.01, 0.1, 0.3, 1.0, 3.0])
@pytest.mark.parametrize("swing", [1e-4, 1e-2, 0.1, 0.3])
def test_findley_under_compression_has_a_ring_of_equal_planes(k, swing):
    """Of a stress -1 ± swing along x: all planes at one angle to x are alike, and nearly along it."""
    history = np.zeros((2, 6))
    history[:, 0] = -1.0 - swing, -1.0 + swing
    value, normal = swtstudy.criterion_of_history(history, "findley", k)
    pull = k * (1.0 - swing)
    assert value == pytest.approx(0.5 * swing**2 / (np.hypot(swing, pull) + pull), rel=1e-5)
    assert abs(normal[0]) == pytest.approx(np.sqrt(0.5 - 0.5 * pull / np.hypot(swing, pull)), rel=1e-3)


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_the_unit_of_stress_does_not_matter(unit):
    """Also where a stress to a high power would leave the range of floats."""
    history = HISTORIES["smooth"]
    value, _ = swtstudy.swt_of_history(unit * history, 0.3, 3.0, walker_exponent=0.02)
    expected, _ = swtstudy.swt_of_history(history, 0.3, walker_exponent=0.02)
    assert value / unit**2 == pytest.approx(float(expected) / 3.0, rel=1e-9)
    value, _ = swtstudy.criterion_of_history(unit * history, "fatemi_socie", 0.3 / unit)
    expected, _ = swtstudy.criterion_of_history(history, "fatemi_socie", 0.3)
    assert value / unit == pytest.approx(float(expected), rel=1e-9)
