"""The field beneath plane contacts: line loads, and swt in the section."""

import numpy as np
import pytest
from body import DOWN, body_maximum, opened, swt_at
from scenes import PLANE_NAMES, plane_points, random_plane_points, take
from solved import solve_points

from swtstudy.kernel.field import mean_about
from swtstudy.kernel.mean import LINE, POINT, SPHERE
from swtstudy.kernel.punch import FUNCTIONS, components, strip

NU = 0.3


def test_one_strip_is_its_line_loads() -> None:
    """Flamant's line loads, of the traction 1/√(ξ² − s²)."""
    rng = np.random.default_rng(4)
    x, z, xi = rng.uniform(-2.0, 2.0, 50), rng.uniform(0.2, 2.0, 50), 0.8
    s = xi * np.sin(np.pi * (np.arange(400) + 0.5) / 400 - 0.5 * np.pi)
    off, square = x[:, None] - s, (x[:, None] - s) ** 2 + z[:, None] ** 2
    weight = -2.0 / np.pi / square**2 * np.pi / 400
    depth = z[:, None]
    pressed = ((weight * part).sum(axis=1) for part in (off**2 * depth, depth**3, off * depth**2))
    dragged = ((weight * part).sum(axis=1) for part in (off**3, off * depth**2, off**2 * depth))
    none, functions = np.zeros(FUNCTIONS), np.zeros(FUNCTIONS)
    found = np.empty((2, x.size, 2, 6))
    for k in range(x.size):
        strip(abs(x[k]), z[k], xi, functions)
        for number, own in enumerate([(functions, none), (none, functions)]):
            components(np.int64(1), *own, x[k], 0.0, z[k], NU, found[number, k, 0], found[number, k, 1])
    for number, expected in enumerate((pressed, dragged)):
        for component, values in zip((0, 2, 4), expected, strict=True):
            np.testing.assert_allclose(found[number, :, 0, component], values, atol=1e-12)
    np.testing.assert_array_equal(found[1, :, 1], -found[1, :, 0])


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", PLANE_NAMES)
def test_s_is_swt_of_the_body_over_all_planes(name: str) -> None:
    """At the critical point no plane is higher, also none whose normal leaves the section."""
    batch = random_plane_points(2, 3, name)
    found = solve_points(batch, 1e-5)
    for k in np.flatnonzero(np.isfinite(found.critical_x)):
        value, normal = swt_at(take(batch, k), found.critical_x[k], 0.0, 0.0)
        assert float(value) == pytest.approx(found.s[k], rel=2e-4)
        assert abs(normal[1]) < 1e-3


@pytest.mark.parametrize(("name", "shape"), [("cylinder", {}), ("rounded_flat", {"flat_half_width": 0.5})])
def test_means_in_the_section(name: str, shape: dict[str, float]) -> None:
    """Half discs, depths ℓ/2 and lines of 2ℓ by quadrature of their own over swt of the body."""
    batch = plane_points(name, NU, 0.6, 0.0, 0.5, bulk_stress_amplitude=0.05, **shape)
    found = solve_points(batch)
    x = float(found.critical_x[0])
    cycle = opened(batch)

    def mean(kind: int, size: float) -> tuple[float, float]:
        return mean_about(cycle, kind, x, DOWN, size, 0.0, 1e-3)

    node, weight = np.polynomial.legendre.leggauss(10)
    node, weight = 0.5 * (1.0 + node), 0.5 * weight
    for size in (0.02, 0.1):
        # d = ℓ t², φ = π sin²: roots beside the edge and the surface.
        d, turn = size * node**2, np.pi * np.sin(0.5 * np.pi * node) ** 2
        of_turn = weight * np.sin(np.pi * node)
        swt, _ = swt_at(batch, x + d[:, None] * np.cos(turn), 0.0, d[:, None] * np.sin(turn))
        area = (weight * node**3)[:, None] * of_turn
        disc = float((area * swt).sum() / area.sum())
        value, error = mean(SPHERE, size)
        assert value == pytest.approx(disc, rel=3e-3)
        assert abs(value - disc) < 3.0 * error + 1e-3 * disc
        assert mean(POINT, size)[0] == pytest.approx(float(swt_at(batch, x, 0.0, 0.5 * size)[0]), rel=2e-3)
        line = float((2.0 * node * weight * swt_at(batch, x, 0.0, 2.0 * size * node**2)[0]).sum())
        assert mean(LINE, size)[0] == pytest.approx(line, rel=3e-3)


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
    whole, _ = body_maximum(batch, float(found.critical_x[0]))
    assert whole.swt / found.s[0] - 1.0 == pytest.approx(excess, abs=2e-4)
    assert (abs(whole.position[2]) > 2.5) == (excess > 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cylinder", "rounded_flat"])
def test_the_search_of_the_body_stays_in_the_section(name: str) -> None:
    """It finds s of the line, nothing higher beneath it, and y = 0; far away swt of a bulk stress alone."""
    batch = random_plane_points(8, 2, name)
    found = solve_points(batch)
    for k in range(2):
        whole, at_line = body_maximum(take(batch, k), float(found.critical_x[k]))
        assert whole.swt == pytest.approx(found.s[k], rel=1e-3)
        assert float(at_line.swt) == pytest.approx(found.s[k], rel=1e-3)
        assert whole.position[1] == 0.0
    shape = {"flat_half_width": 0.2} if name == "rounded_flat" else {}
    batch = plane_points(name, 0.4, 0.0, 0.0, 0.0, bulk_stress_amplitude=0.3, **shape)

    whole, _ = body_maximum(batch, np.nan)
    assert whole.swt == pytest.approx(0.09, rel=1e-12)
