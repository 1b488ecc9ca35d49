"""The stick zone that a bulk stress shifts: closed forms of the edge in tension (Nowell and Hills 1987)."""

from __future__ import annotations

import numpy as np
import pytest

from swtstudy.kernel.batch import solve_batch


def solve_one(
    profile: str, friction: float, force: float, bulk: float, mean: float = 0.0, **given: object
) -> np.void:
    """A contact under a constant normal force and a bulk stress in phase with the tangential one."""
    own = {"control": (True, True), "bulk_amplitude": [bulk], "bulk_mean": [mean]}
    return solve_batch(profile, [given.pop("nu", 0.3)], [friction], [0.0], [force], **(own | given))[0]


def at_the_edge(friction: float, force: float, bulk: float, mean: float = 0.0) -> float:
    """s of the cylinder at its edge in tension."""
    shift = abs(bulk) / (2.0 * friction)
    tension = friction * (np.sqrt((1.0 + shift) ** 2 - 1.0 + force) - shift)
    return float((tension + mean + abs(bulk)) * (tension + abs(bulk)))


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize(
    ("friction", "force", "share"), [(0.3, 0.2, 0.05), (0.8, 0.5, 0.5), (1.2, 0.8, 0.99)]
)
@pytest.mark.parametrize("ratio", [-1.0, 0.2])
def test_the_cylinder(nu: float, friction: float, force: float, share: float, ratio: float) -> None:
    width = 1.0 - np.sqrt(1.0 - force)
    bulk = 2.0 * friction * share * width
    mean = bulk * (1.0 + ratio) / (1.0 - ratio)
    found = solve_one("cylinder", friction, force, bulk, mean, nu=nu, rtol=1e-6)
    assert found["shift"] == pytest.approx(share * width, rel=1e-12)
    assert found["s"] == pytest.approx(at_the_edge(friction, force, bulk, mean), rel=2e-6)
    assert found["critical_x"] == pytest.approx(-1.0 if share < 0.0 else found["critical_x"])
    assert abs(found["critical_x"]) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    ("profile", "force", "share", "rise"),
    [
        ("cylinder", 0.2, 0.1, 5.4),
        ("cylinder", 0.5, 0.2, 5.4),
        ("cylinder", 0.8, 0.5, 3.4),
        ("paraboloid", 0.2, 0.1, 5.8),
        ("paraboloid", 0.4, 0.25, 10.0),
        ("paraboloid", 0.8, 0.5, 5.7),
        ("paraboloid", 0.6, 1.0, 15.0),
    ],
)
def test_the_rise_by_the_shift(profile: str, force: float, share: float, rise: float) -> None:
    power = 2.0 if profile == "cylinder" else 3.0
    width = 1.0 - (1.0 - force) ** (1.0 / power)
    stiffness = 4.0 if profile == "cylinder" else 1.3 * 2.8 + 1.3 * 0.0
    if profile == "paraboloid":
        stiffness = (1.0 + 0.3) * (4.0 - 3.0 * 0.3)
    bulk = 0.5 * share * width * stiffness * 0.5
    moved = solve_one(profile, 0.5, force, bulk)
    still = solve_one(profile, 0.5, force, bulk, pulled=[0.0])
    assert moved["shift"] == pytest.approx(share * width, rel=1e-9)
    assert 100.0 * (moved["s"] / still["s"] - 1.0) == pytest.approx(rise, rel=0.06)


def test_in_antiphase_the_other_edge_is_in_tension() -> None:
    one = solve_one("cylinder", 0.5, 0.5, 0.1)
    other = solve_one("cylinder", 0.5, 0.5, 0.1, bulk_phase=[np.pi])
    assert one["critical_x"] == -other["critical_x"]
    assert one["shift"] == -other["shift"]
