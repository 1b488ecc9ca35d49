"""Quantities, means, errors and places of some points, as in data/known.txt: a change is to be meant."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from asking import EVERY
from folders import sections

import swtstudy

STILL = {"normal_amplitude": 0.0, "critical_distance": (0.5,)}
FORCES = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.4}
#: The quickest ones first.
POINTS: dict[str, dict[str, Any]] = {
    "bulk": {**STILL, "bulk_stress_amplitude": 0.1, "bulk_stress_mean": 0.05},
    "plain": {"phase": 1.0, "friction": 0.6},
    "findley": {"criterion": "findley", "normal_sensitivity": 0.3, "frequency_ratio": 2},
    "wide face": {"profile": "rounded_punch", "flat_radius": 20.0, **STILL},
    "tip": {"profile": "power_law", "exponent": 1.4, **STILL},
    "waves": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 4.5, **STILL},
    "cylinder": {"profile": "cylinder", "critical_distance": (0.1, 1.0), **FORCES},
    "parting": {"phase": 1.0, "normal_amplitude": 1.2, "critical_distance": (0.1,)},
}
KNOWN = sections("known.txt")


def found(name: str) -> xr.Dataset:
    return swtstudy.solve(rtol=1e-3, quantities=EVERY, **POINTS[name])


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", POINTS)
def test_values_errors_and_places_are_known(name: str) -> None:
    dataset = found(name)
    for line in KNOWN[name].splitlines():
        variable, *numbers = line.split()
        values = dataset[variable].values.ravel()
        np.testing.assert_allclose(values, [*map(float, numbers)], 1e-4, 1e-12, err_msg=variable)
