"""Changed values of s need a new version of the solver: archives of different versions never mix."""

import numpy as np
import pytest
from scenes import points, random_points
from solved import solve_points

from swtstudy.vocabulary.version import SOLVER_VERSION

PSI = np.array([0.0, 0.7, 2.1])
CASES = {
    "paraboloid": points(phase=PSI),
    "long cycle": points(phase=PSI, p=1, q=4),
    "rounded punch": points("rounded_punch", flat_radius=0.5, phase=PSI, p=3, q=2),
    "truncated paraboloid": points("truncated_paraboloid", flat_radius=0.5, phase=PSI),
    "singular edge": points(
        "truncated_paraboloid", friction=0.95, tangential_amplitude=1.0, flat_radius=1.0, phase=PSI
    ),
    "wavy paraboloid": points("wavy_paraboloid", waviness_amplitude=0.01, wavelength=5.0, phase=PSI),
    "random": random_points(5, 3, "paraboloid"),
}
VERSION = "23"
VALUES: dict[str, list[float]] = {
    "paraboloid": [0.1551365493, 0.1476110886069, 0.1487882321472],
    "long cycle": [0.1702054140418, 0.1635235780327, 0.1376037048480],
    "rounded punch": [0.1837528022403, 0.1583409468143, 0.1837644641200],
    "truncated paraboloid": [0.1599969909586, 0.1513167821473, 0.1544871168794],
    "singular edge": [2.0695168325765, 2.0885632224905, 2.0965433562144],
    "wavy paraboloid": [0.1408640284497, 0.1477973796465, 0.1652376531652],
    "random": [0.0367138022422, 0.9577378657923, 0.6456340164177],
}


@pytest.mark.parametrize("case", CASES)
def test_values_are_those_of_their_version(case: str) -> None:
    found = solve_points(CASES[case], 1e-4)
    assert SOLVER_VERSION == VERSION
    assert np.all(np.abs(found.s - VALUES[case]) <= 0.1 * found.s_error)
