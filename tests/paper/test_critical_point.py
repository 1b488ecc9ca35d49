"""Statements on the critical point and plane, and the zone of permanent stick."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up import made_up, made_up_audit
from solved import REGIMES

from swtstudy.paper.statements.critical_point import stick_radius
from swtstudy.paper.statements.statement import STATEMENTS


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


def test_the_radius_of_permanent_stick():
    # Table 1: u + δ ≥ 1 − 19/12 and u − δ ≤ −1 + 1/12 for ψ = 0, so G_s = 1/6; for ψ = π/2 all slides.
    np.testing.assert_allclose(stick_radius(located()), [math.sqrt(1 / 6), 0], rtol=1e-9)
    np.testing.assert_allclose(stick_radius(located("rounded_punch", flat_radius=0.0)), [math.sqrt(1 / 6), 0])
    punch = stick_radius(located("truncated_paraboloid", flat_radius=0.5)).values
    assert punch[0] ** 2 * (punch[0] ** 2 - 0.25) == pytest.approx(1 / 36)
    assert punch[1] == 0


@pytest.mark.parametrize(("x", "holds"), [(-1.0, True), (0.42, False), (0.1, False)])
def test_the_critical_point_lies_outside_of_stick(x, holds):
    results = located()
    results["critical_x"] = results.critical_x * x
    finding = STATEMENTS["outside_of_stick"](results, results)
    assert finding.holds == holds
    assert finding.measured.startswith("2 of 4 points")


@pytest.mark.parametrize(("angle", "holds"), [(-9.0, True), (12.0, False)])
def test_the_critical_plane(angle, holds):
    results = located()
    results["critical_angle"] = results.critical_angle + angle
    assert STATEMENTS["normal_along_x"](results).holds == holds


@pytest.mark.parametrize(("off_line", "holds"), [(0, True), (1, True), (5, False)])
def test_the_critical_point_is_on_the_line(off_line, holds):
    finding = STATEMENTS["on_the_line"](made_up_audit(40, off_line))
    assert finding.holds == holds
    assert f"off the line {off_line}" in finding.measured
    assert ("4.0% higher, for ν ≥ 0.45" in finding.measured) == (off_line > 0)


@pytest.mark.parametrize(("regime", "holds"), [(0, False), (1, True), (2, False), (3, False), (4, False)])
def test_the_regime(regime, holds):
    results = located()
    results["regime"] = results.regime * regime
    finding = STATEMENTS["slips_partially"](results)
    assert finding.holds == holds
    assert REGIMES[regime].replace("_", " ") in finding.measured
    assert "the regime is partial slip" in STATEMENTS["slips_partially"].criterion
