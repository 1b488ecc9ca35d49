"""The stress beneath the surface through `stress_field`: closed forms, the surface as a limit, and strips."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

import swtstudy

Array = NDArray[np.float64]
COMPONENTS = ("sigma_xx", "sigma_yy", "sigma_zz", "sigma_yz", "sigma_xz", "sigma_xy")
SCENES: dict[str, dict[str, Any]] = {
    "paraboloid": {"frequency_ratio": "1/2", "phase": 2.3},
    "rounded punch": {"profile": "rounded_punch", "flat_radius": 0.5, "phase": 1.0},
    "small face": {"profile": "rounded_punch", "flat_radius": 0.003, "phase": 1.0},
    "truncated": {"profile": "truncated_paraboloid", "flat_radius": 0.5, "phase": 1.0},
    "waves": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5.0, "phase": 1.0},
    "power law": {"profile": "power_law", "exponent": 1.5, "phase": 1.0},
    "near a cone": {"profile": "power_law", "exponent": 1.0005, "phase": 1.0},
    "forces": {"normal_force_amplitude": 0.3, "tangential_force_amplitude": 0.4, "phase": 1.0},
    "bulk stress": {"bulk_stress_mean": 0.1, "bulk_stress_amplitude": 0.2, "phase": 1.0},
    "rounded flat": {
        "profile": "rounded_flat",
        "flat_half_width": 0.5,
        "normal_force_amplitude": 0.3,
        "tangential_force_amplitude": 0.4,
        "phase": 1.0,
    },
}
R = np.linspace(0.0, 2.0, 9)
TABLE = swtstudy.TabulatedProfile("worn", R, 0.5 * R**2)


def at_points(x: Any, y: Any, z: Any, time: Any, **parameters: Any) -> Array:
    """Shape (instants, points, 6)."""
    places = (xr.DataArray(np.asarray(v, dtype=float), dims="point") for v in np.broadcast_arrays(x, y, z))
    field = swtstudy.stress_field(*places, time=time, **parameters)
    return np.stack([field[name].values for name in COMPONENTS], axis=-1)


@pytest.mark.parametrize("depth", [1e-12, 1e-6])
@pytest.mark.parametrize("scene", SCENES)
def test_the_surface_is_the_limit(scene: str, depth: float) -> None:
    """On the line and off it, inside and outside: the stress moves by a root of the depth at most."""
    rng = np.random.default_rng(5)
    angle, radius = rng.uniform(0.0, np.pi, 60), rng.uniform(0.02, 1.6, 60)
    angle[:20] = np.pi * (np.arange(20) % 2)
    time = 2.0 * np.pi * np.arange(9) / 9
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    surface = at_points(x, y, 0.0, time, **SCENES[scene])
    beneath = at_points(x, y, depth, time, **SCENES[scene])
    np.testing.assert_allclose(beneath, surface, atol=0.5 * np.sqrt(depth))


@pytest.mark.parametrize("scene", SCENES)
def test_the_stress_is_in_equilibrium(scene: str) -> None:
    """Its divergence is 0, at depths from a hundredth of the contact to several of it."""
    rng = np.random.default_rng(6)
    z = 10.0 ** rng.uniform(-2.0, 0.7, 12)
    middle = np.stack([rng.uniform(-1.5, 1.5, 12), rng.uniform(-1.0, 1.0, 12), z])
    if "rounded_flat" in SCENES[scene].values():
        middle[1] = 0.0
    # Fourth-order differences: their error goes with the fourth power of the step over the depth.
    offsets, weights, step = (-2, -1, 1, 2), (1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0), 0.02 * z
    rows = ((0, 5, 4), (5, 1, 3), (4, 3, 2))
    divergence, size = np.zeros((3, 5, 12)), 0.0
    for axis in range(3):
        for offset, weight in zip(offsets, weights, strict=True):
            place = middle.copy()
            place[axis] += offset * step
            stress = at_points(*place, np.arange(5.0), **SCENES[scene])
            size = max(size, float(np.abs(stress).max()))
            for row in range(3):
                divergence[row] += weight * stress[..., rows[row][axis]]
    assert np.abs(divergence).max() < 3e-6 * size


def test_a_table_of_a_paraboloid_has_its_field() -> None:
    """Panels and closed forms of the same contact, close to the surface and far from it."""
    parameters = {"normal_amplitude": 0.3, "tangential_amplitude": 2.0, "phase": np.pi / 2}
    x, time = np.linspace(-1.5, 1.5, 41), np.array([0.0, 0.4, 2.0, 3.5])
    for depth in (1e-5, 0.01, 0.3, 3.0):
        table, closed = (
            at_points(x, 0.1, depth, time, profile=profile, **parameters) for profile in (TABLE, "paraboloid")
        )
        np.testing.assert_allclose(table, closed, atol=2e-8)


def test_far_beneath_a_contact_is_a_point_load() -> None:
    """At a depth of 10 a the field is that of the resultant within a per cent, and no digits are lost."""
    parameters = {"normal_amplitude": 0.0, "tangential_amplitude": 0.0}
    found = at_points(0.0, 0.0, [10.0, 100.0], [0.0], **parameters)[0, :, 2]
    force = 4.0 / 3.0
    np.testing.assert_allclose(found, -1.5 * force / (np.pi * np.array([10.0, 100.0]) ** 2), rtol=1e-2)
