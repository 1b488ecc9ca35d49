"""Changed values of s need a new version of the solver: archives of different versions never mix."""

import json

import numpy as np
import pytest
import stand_in
from scenes import points, random_points
from solved import solve_points

from swtstudy import Study, run

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
VERSION = "41"
VALUES: dict[str, list[float]] = {
    "paraboloid": [0.1551365493323, 0.1476110272643, 0.1487882209774],
    "long cycle": [0.1702053363658, 0.1635234887289, 0.1376035913666],
    "rounded punch": [0.1837526122984, 0.1583409469004, 0.1837640241972],
    "truncated paraboloid": [0.1599969909589, 0.1513167710793, 0.1544869742698],
    "singular edge": [2.0695107816817, 2.0885553737555, 2.0965432572318],
    "wavy paraboloid": [0.1408640065854, 0.1477973788208, 0.1652376252627],
    "random": [0.0367135880615, 0.9577375641361, 0.6456339033787],
}


def test_an_archive_names_the_version_of_these_values(tmp_path) -> None:
    study = Study.from_text('title = "t"\n[axes]\nphase = [0, 1]\n')
    found = run(study, tmp_path / "t.nc", solver=stand_in.smooth, workers=1)
    assert json.loads(found.attrs["runs"])[0]["solver_version"] == VERSION


@pytest.mark.parametrize("case", CASES)
def test_values_are_those_of_their_version(case: str) -> None:
    found = solve_points(CASES[case], 1e-4)
    assert np.all(np.abs(found.s - VALUES[case]) <= 0.1 * found.s_error)
