"""Statements on the critical point and plane, and the zone of permanent stick."""

import math
import re

import pytest
import xarray as xr
from made_up import STATEMENTS, made_up


def located(profile: str = "paraboloid", **shape: float) -> xr.Dataset:
    results = made_up(lambda phase: 1 + phase, phase=[0.0, math.pi / 2])
    table = {
        "poisson_ratio": 0.3,
        "friction": 0.3,
        "normal_amplitude": 0.75,
        "frequency_ratio": 1.0,
        "tangential_amplitude": 5 / 6,
        "profile": profile,
    }
    return results.assign_coords({**table, **shape})


def stick_radius(results: xr.Dataset) -> float:
    """The smallest radius of permanent stick that is not 0, from a critical point far outside."""
    far = results.assign(critical_x=0.0 * results.critical_x + 1e6)
    finding = STATEMENTS["outside_of_stick"](far)
    assert finding.measured.startswith("1 of 2 points have a zone of permanent stick;")
    return 1e6 / float(re.search(r"smallest ([0-9.]+)", finding.measured)[1])


def test_the_radius_of_permanent_stick():
    # Table 1: u + δ ≥ 1 − 19/12 and u − δ ≤ −1 + 1/12 for ψ = 0, so G_s = 1/6; for ψ = π/2 all slides.
    for results in (located(), located("rounded_punch", flat_radius=0.0)):
        assert stick_radius(results) == pytest.approx(math.sqrt(1 / 6), rel=1e-8)
    punch = stick_radius(located("truncated_paraboloid", flat_radius=0.5))
    assert punch**2 * (punch**2 - 0.25) == pytest.approx(1 / 36)


@pytest.mark.parametrize(("x", "holds"), [(-1.0, True), (0.42, False), (0.1, False)])
def test_the_critical_point_lies_outside_of_stick(x, holds):
    results = located()
    results["critical_x"] = results.critical_x * x
    finding = STATEMENTS["outside_of_stick"](results, results)
    assert finding.holds == holds
    assert finding.measured.startswith("2 of 4 points")
