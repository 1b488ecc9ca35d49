"""Profiles at rest by themselves: radii, depths and forces against each other; what is said of shapes."""

from typing import Any

import numpy as np
import pytest

from swtstudy import TabulatedProfile
from swtstudy.solver.at_rest import AtRest, check_shape, compact_shapes, largest_depths, too_small

SHAPES: dict[str, dict[str, float]] = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": 0.3},
    "truncated_paraboloid": {"flat_radius": 0.5},
    "wavy_paraboloid": {"waviness_amplitude": 0.03, "wavelength": 4.5},
    "power_law": {"exponent": 3.0},
    "cylinder": {},
    "rounded_flat": {"flat_half_width": 0.4},
    "wavy_cylinder": {"waviness_amplitude": 0.03, "wavelength": 4.5},
    "power_law_cylinder": {"exponent": 1.5},
}
PLANE = ("cylinder", "rounded_flat", "wavy_cylinder", "power_law_cylinder")
r = np.linspace(0.0, 3.0, 200)
TABLES = [TabulatedProfile("disc", r, r**2 / 2), TabulatedProfile("strip", r, r**2 / 2, geometry="plane")]


@pytest.mark.parametrize("profile", [*SHAPES, *TABLES], ids=str)
def test_radii_depths_and_forces_belong_together(profile: Any) -> None:
    shape = SHAPES.get(str(profile), {})
    found = AtRest(profile, {name: np.array([value]) for name, value in shape.items()})
    b = shape.get("flat_radius", shape.get("flat_half_width", 0.0))
    assert found.flat_radius.tolist() == [[b]]
    assert found.plane == (str(profile) in (*PLANE, "strip"))
    depth = np.array([[0.0, 1e-3, 0.3, 1.0, 1.5]])
    radius = found.radius(depth)
    assert radius[0, 0] == b
    np.testing.assert_allclose(found.depth(radius), depth, rtol=1e-9, atol=1e-12)
    # Half of a force is ∫ a dδ; of a strip the depth is the load.
    place = np.sqrt((radius - b) * (radius + b))
    force = found.rise(place)[1]
    np.testing.assert_allclose(found.radius_at(force), radius, rtol=1e-9)
    np.testing.assert_allclose(found.unit(), force[:, [3]], rtol=1e-12)
    if found.plane:
        np.testing.assert_allclose(force, depth * np.pi / 8.0, rtol=1e-9, atol=1e-12)
    else:
        steps = np.linspace(0.9999, 1.0001, 3) * depth[:, [3]]
        low, _, high = found.rise(np.sqrt((found.radius(steps) - b) * (found.radius(steps) + b)))[1][0]
        assert (high - low) / (steps[0, 2] - steps[0, 0]) == pytest.approx(radius[0, 3], rel=1e-6)
    # The pressure carries the load, over the width or over the area.
    edge = radius[:, [3]]
    share = np.polynomial.legendre.leggauss(400)
    angle = 0.25 * np.pi * (share[0] + 1.0)
    x = edge[0, 0] * np.sin(angle)
    weight = 0.25 * np.pi * share[1] * edge[0, 0] * np.cos(angle) * (1.0 if found.plane else 2.0 * np.pi * x)
    pressure = found.pressure(x[None], edge)[0]
    carried = (pressure * weight).sum() * (2.0 if found.plane else 1.0)
    assert carried == pytest.approx(2.0 * force[0, 3], rel=1e-3)
    largest = found.largest_pressure()
    if profile == "truncated_paraboloid":
        assert largest == np.inf
    elif shape.get("exponent") != 1.5:
        assert largest == pytest.approx(pressure.max(), rel=2e-3)


def test_a_sharp_tip_has_its_pressure_in_the_middle() -> None:
    """n/(n − 1)/π at the depth δ0, and π/4 of that under a strip, at a radius of 1."""
    for name, factor in (("power_law", 1.0), ("power_law_cylinder", 0.25 * np.pi)):
        for n in (1.5, 2.0):
            found = AtRest(name, {"exponent": np.array([n])})
            assert found.largest_pressure() == pytest.approx(factor * n / (n - 1.0) / np.pi)


def test_several_shapes_at_once() -> None:
    b = np.array([0.1, 0.5, 1.0])
    found = AtRest("truncated_paraboloid", {"flat_radius": b})
    alone = [AtRest("truncated_paraboloid", {"flat_radius": b[[k]]}).unit()[0, 0] for k in range(3)]
    np.testing.assert_allclose(found.unit()[:, 0], alone, rtol=1e-12)
    np.testing.assert_allclose(found.radius(np.zeros((3, 1)))[:, 0], b)


@pytest.mark.parametrize(
    ("profile", "shape", "force", "depth"),
    [
        ("paraboloid", {}, [1.0, 2.0, 0.0], [1.0, 2.0 ** (2.0 / 3.0), 0.0]),
        ("power_law", {"exponent": [3.0, 3.0]}, [1.0, 16.0], [1.0, 8.0]),
        ("cylinder", {}, [0.5, 1.7], [0.5, 1.7]),
        (TABLES[0], {}, [1.0, 2.0], [1.0, 2.0 ** (2.0 / 3.0)]),
        # Of a shape that no full disc can have nothing is known.
        (
            "wavy_paraboloid",
            {"waviness_amplitude": [0.0, 0.1], "wavelength": [1.0, 1.0]},
            [8.0, 8.0],
            [4.0, 1.0],
        ),
    ],
)
def test_the_largest_depth_under_a_force(profile: Any, shape: dict, force: list, depth: list) -> None:
    given = {name: np.array(values) for name, values in shape.items()}
    np.testing.assert_allclose(largest_depths(profile, given, np.array(force)), depth, rtol=1e-6)


def test_a_shape_that_is_not_compact_is_told_with_its_least_wavelength() -> None:
    wavy = {"waviness_amplitude": 0.03, "wavelength": 2.0}
    name, least = too_small("wavy_paraboloid", wavy, 1.0) or ("", 0.0)
    assert name == "wavelength"
    assert too_small("wavy_paraboloid", {**wavy, "wavelength": least}, 1.0) is None
    assert too_small("wavy_paraboloid", {**wavy, "wavelength": 0.999999 * least}, 1.0) == (name, least)
    assert too_small("wavy_paraboloid", {**wavy, "waviness_amplitude": 0.0}, 1.0) is None
    assert too_small("paraboloid", {}, 1.0) is None
    words = f"wavelength 2 is below {least:.4g}, the smallest for which the contact stays compact"
    assert (
        check_shape("wavy_paraboloid", wavy, 1.0)
        == f"{words} at waviness_amplitude 0.03 up to the depth 1 δ0"
    )
    assert check_shape("wavy_paraboloid", {**wavy, "wavelength": 5.0}, 1.0) is None
    plane = check_shape("wavy_cylinder", wavy, 1.5) or ""
    assert plane.endswith(" at waviness_amplitude 0.03 up to the load 1.5 P0")
    shapes = {"waviness_amplitude": np.array([0.03, 0.03, 0.0]), "wavelength": np.array([least, 2.0, 2.0])}
    assert compact_shapes("wavy_paraboloid", shapes, np.ones(3)).tolist() == [True, False, True]
    assert compact_shapes("rounded_punch", {"flat_radius": np.ones(2)}, 1.0).tolist() == [True, True]
    assert compact_shapes(TABLES[0], {}, np.array([1.0, 100.0])).tolist() == [True, False]
    assert check_shape(TABLES[0], {}, 1.0) is None
    assert check_shape(TABLES[0], {}, 100.0) == TABLES[0].refused_at(100.0)
