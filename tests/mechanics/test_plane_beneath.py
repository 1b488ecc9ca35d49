"""The field beneath plane contacts: McEwen's, line loads, the surface, and swt in the section."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scenes import PLANE_NAMES, plane_points, random_plane_points, take
from solved import solve_points

from swtstudy.mechanics.body.body import Body, closer_nodes, time_nodes
from swtstudy.mechanics.body.body_maximum import body_maximum
from swtstudy.mechanics.body.nonlocal_swt import nonlocal_swt
from swtstudy.mechanics.stress.scene import scene_of
from swtstudy.mechanics.stress.strip import StripFunctions, normal_components, tangential_components
from swtstudy.mechanics.stress.superposition import STRIP, slope_cells, stress_history

Array = NDArray[np.float64]
NU = 0.3


def mcewen(x: Array, z: Array, a: float) -> tuple[Array, Array, Array, Array, Array, Array]:
    """σ_xx, σ_zz, σ_xz over p0 by Hertz's pressure on a strip, and by the same shear in +x (Johnson 1985)."""
    # m and n with m² = ½ (root + s), n² = ½ (root − s), s = a² − x² + z².
    s = a * a - x * x + z * z
    root = np.sqrt(s * s + 4.0 * x * x * z * z)
    m = np.sqrt(0.5 * (root + s))
    n = np.sign(x) * np.sqrt(np.maximum(0.5 * (root - s), 0.0))
    share = (z * z + n * n) / (m * m + n * n)
    normal = (
        -(m * (1.0 + share) - 2.0 * z) / a,
        -m * (1.0 - share) / a,
        -n * (m * m - z * z) / (m * m + n * n) / a,
    )
    # The shear's σ_zz is the pressure's σ_xz, its σ_xz the pressure's σ_xx.
    along = (n * (2.0 - (z * z - m * m) / (m * m + n * n)) - 2.0 * x) / a
    return *normal, along, normal[2], normal[0]


@pytest.mark.slow
def test_hertz_is_mcewens_field() -> None:
    rng = np.random.default_rng(3)
    x, z, a = rng.uniform(-2.0, 2.0, 300), 10.0 ** rng.uniform(-2.0, 0.5, 300), 1.0
    cells = slope_cells(lambda xi: 0.5 * np.pi * xi * xi, [0.0, a])
    found = stress_history(x, 0.0 * x, z, cells, [[1.0], [0.0]], [[[0.0]], [[-1.0]]], 1.0, NU, STRIP) / 0.5
    pressed, dragged = found[:, 0], found[:, 1]
    xx, zz, xz, shear_xx, shear_zz, shear_xz = mcewen(x, z, a)
    for component, expected in ((0, xx), (2, zz), (4, xz)):
        np.testing.assert_allclose(pressed[:, component], expected, atol=1e-12)
    for component, expected in ((0, shear_xx), (2, shear_zz), (4, shear_xz)):
        np.testing.assert_allclose(dragged[:, component], expected, atol=1e-12)
    for one in (pressed, dragged):
        np.testing.assert_allclose(one[:, 1], NU * (one[:, 0] + one[:, 2]), atol=1e-15)
        np.testing.assert_array_equal(one[:, [3, 5]], 0.0)


def test_one_strip_is_its_line_loads() -> None:
    """Flamant's line loads, of the traction 1/√(ξ² − s²)."""
    rng = np.random.default_rng(4)
    x, z, xi = rng.uniform(-2.0, 2.0, 50), rng.uniform(0.2, 2.0, 50), 0.8
    s = xi * np.sin(np.pi * (np.arange(400) + 0.5) / 400 - 0.5 * np.pi)
    off, square = x[:, None] - s, (x[:, None] - s) ** 2 + z[:, None] ** 2
    w = np.abs(x) + 1j * z
    inverse = 1.0 / (np.sqrt(w - xi) * np.sqrt(w + xi))
    bend = -z * w * inverse**3
    f = StripFunctions(inverse.real, inverse.imag, bend.real, bend.imag)
    weight = -2.0 / np.pi / square**2 * np.pi / 400
    depth = z[:, None]
    pressed = ((weight * part).sum(axis=1) for part in (off**2 * depth, depth**3, off * depth**2))
    dragged = ((weight * part).sum(axis=1) for part in (off**3, off * depth**2, off**2 * depth))
    for part, expected in ((normal_components, pressed), (tangential_components, dragged)):
        found = part(f, x, 0.0 * x, z, NU)
        for component, values in zip((0, 2, 4), expected, strict=True):
            np.testing.assert_allclose(found[:, component], values, atol=1e-12)


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", PLANE_NAMES)
def test_s_is_swt_of_the_body_over_all_planes(name: str) -> None:
    """At the critical point no plane is higher, also none whose normal leaves the section."""
    batch = random_plane_points(2, 3, name)
    found = solve_points(batch, 1e-5)
    for k in np.flatnonzero(np.isfinite(found.critical_x)):
        scene, x = scene_of(take(batch, k)), float(found.critical_x[k])
        nodes = closer_nodes(scene, time_nodes(scene, 5, [abs(x)]), (x, 0.0, 0.0), 60)
        body = Body(scene, nodes, 60).swt(x, 0.0, 0.0)
        assert float(body.swt) == pytest.approx(found.s[k], rel=2e-3 if name == "wavy_cylinder" else 3e-4)
        assert abs(body.normal[1]) < 1e-3


@pytest.mark.parametrize(("name", "shape"), [("cylinder", {}), ("rounded_flat", {"flat_half_width": 0.5})])
def test_means_in_the_section(name: str, shape: dict[str, float]) -> None:
    """Half discs, depths ℓ/2 and lines of 2ℓ by quadrature of their own over swt of the body."""
    batch = plane_points(name, NU, 0.6, 0.0, 0.5, bulk_stress_amplitude=0.05, **shape)
    found = solve_points(batch)
    x, scene = float(found.critical_x[0]), scene_of(batch)
    distance = np.array([0.02, 0.1])
    means = nonlocal_swt(scene, found.critical_x, found.critical_angle, distance)
    body = Body(scene, time_nodes(scene, 40, [abs(x)]), 60)
    node, weight = np.polynomial.legendre.leggauss(10)
    node, weight = 0.5 * (1.0 + node), 0.5 * weight
    for k, size in enumerate(distance):
        # d = ℓ t², φ = π sin²: roots beside the edge and the surface.
        d, turn = size * node**2, np.pi * np.sin(0.5 * np.pi * node) ** 2
        of_turn = weight * np.sin(np.pi * node)
        swt = body.swt(x + d[:, None] * np.cos(turn), 0.0, d[:, None] * np.sin(turn)).swt
        area = (weight * node**3)[:, None] * of_turn
        disc = float((area * swt).sum() / area.sum())
        assert means.volume[0, k] == pytest.approx(disc, rel=3e-3)
        assert abs(means.volume[0, k] - disc) < 3.0 * means.volume_error[0, k] + 1e-3 * disc
        assert means.point[0, k, 0] == pytest.approx(float(body.swt(x, 0.0, 0.5 * size).swt), rel=2e-3)
        line = float((2.0 * node * weight * body.swt(x, 0.0, 2.0 * size * node**2).swt).sum())
        assert means.line[0, k, 0] == pytest.approx(line, rel=3e-3)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("friction", "pull", "mean", "amplitude", "excess"),
    [(0.0, 0.0, 0.0, 0.05, 0.5215), (0.3, 0.05, 0.15, 0.15, 0.0745), (0.3, 0.2, 0.15, 0.15, 0.0)],
)
def test_beneath_a_load_that_pulsates_a_bulk_stress_is_worse(friction, pull, mean, amplitude, excess) -> None:
    """Where next to nothing rubs: what docs/theory/plane.md says."""
    bulk = {"bulk_stress_mean": mean, "bulk_stress_amplitude": amplitude}
    batch = plane_points("cylinder", NU, friction, 0.75, pull, **bulk)
    found = solve_points(batch)
    whole, _ = body_maximum(scene_of(batch), float(found.critical_x[0]))
    assert whole.swt / found.s[0] - 1.0 == pytest.approx(excess, abs=2e-4)
    assert (abs(whole.position[2]) > 2.5) == (excess > 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cylinder", pytest.param("rounded_flat", marks=pytest.mark.slow)])
def test_the_search_of_the_body_stays_in_the_section(name: str) -> None:
    """It finds s of the line, nothing higher beneath it, and y = 0; far away swt of a bulk stress alone."""
    batch = random_plane_points(8, 2, name)
    found = solve_points(batch)
    for k in range(2):
        whole, at_line = body_maximum(scene_of(take(batch, k)), float(found.critical_x[k]))
        assert whole.swt == pytest.approx(found.s[k], rel=1e-3)
        assert float(at_line.swt) == pytest.approx(found.s[k], rel=1e-3)
        assert whole.position[1] == 0.0
    shape = {"flat_half_width": 0.2} if name == "rounded_flat" else {}
    batch = plane_points(name, 0.4, 0.0, 0.0, 0.0, bulk_stress_amplitude=0.3, **shape)

    whole, _ = body_maximum(scene_of(batch), np.nan)
    assert whole.swt == pytest.approx(0.09, rel=1e-12)
