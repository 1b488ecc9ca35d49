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
VERSION = "22"
VALUES: dict[str, list[float]] = {
    "paraboloid": [0.1551365493, 0.147611081388, 0.148788222112],
    "long cycle": [0.170205407959, 0.16352357832, 0.137603701497],
    "rounded punch": [0.183752802563, 0.158340947049, 0.183764464155],
    "truncated paraboloid": [0.159996990958, 0.151316780484, 0.154487117182],
    "singular edge": [1.9422703682, 2.08856432033, 2.0965412792],
    "wavy paraboloid": [0.140864027637, 0.14779737877, 0.16523764295],
    "random": [0.0367138016342, 0.957737200705, 0.645634015374],
}


@pytest.mark.parametrize("case", CASES)
def test_values_are_those_of_their_version(case: str) -> None:
    found = solve_points(CASES[case], 1e-4)
    assert SOLVER_VERSION == VERSION
    assert np.all(np.abs(found.s - VALUES[case]) <= 0.1 * found.s_error)
