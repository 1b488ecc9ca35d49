"""s_error: an upper bound of the error of s that is not far above it."""

import csv
from functools import lru_cache

import numpy as np
import pytest
from folders import RESULTS
from numpy.typing import NDArray
from scenes import PROFILE_NAMES, points
from solved import solve_points

import swtstudy

#: Made by studies/checks/reference_values.py.
with (RESULTS / "reference_values.csv").open(encoding="utf-8") as file:
    ROWS = list(csv.DictReader(file))


#: Every fourth one of them, and, at a looser and a closer tolerance, both halves: those take seconds each.
EACH_PART = [
    (slice(0, None, 4), 1e-4),
    *(
        pytest.param(slice(half, None, 2), rtol, marks=pytest.mark.slow)
        for half in (0, 1)
        for rtol in (1e-4, 1e-6)
    ),
]


@lru_cache
def errors(
    start: int, step: int, rtol: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """What is missed of the reference values, s_error, and s; what the references miss is taken off."""
    missed, claimed, values = [], [], []
    for profile in PROFILE_NAMES:
        rows = [row for row in ROWS if row["profile"] == profile][start::step]
        names = [name for name in rows[0] if name not in ("profile", "s", "s_error") and rows[0][name]]
        columns = {name: np.array([float(row[name]) for row in rows]) for name in names}
        columns |= {name: columns[name].astype(int) for name in "pq"}
        found = solve_points(points(profile, **columns), rtol)
        s, s_error = (np.array([float(row[name]) for row in rows]) for name in ("s", "s_error"))
        # What rises up to a sharp tip is told with the result.
        told = np.abs(found.critical_x) < 1e-4
        missed.append(np.maximum(np.abs(found.s - s) - s_error, 0.0)[~told])
        claimed.append(found.s_error[~told])
        values.append(s[~told])
    return np.concatenate(missed), np.concatenate(claimed), np.concatenate(values)


@pytest.mark.parametrize(("part", "rtol"), EACH_PART)
def test_s_error_bounds_the_error(part: slice, rtol: float) -> None:
    missed, claimed, _ = errors(part.start, part.step, rtol)
    assert len(missed) >= 100 // part.step
    assert np.mean(missed <= claimed) >= 0.99
    assert np.all(missed <= 3.0 * claimed)


@pytest.mark.parametrize(("part", "rtol"), EACH_PART)
def test_s_error_is_not_far_above_the_tolerance(part: slice, rtol: float) -> None:
    _, claimed, s = errors(part.start, part.step, rtol)
    assert np.median(claimed / s) <= rtol
    # Rounding comes on top: mostly less than 5e-7, where both factors vanish more.
    assert np.mean(claimed <= (rtol + 5e-7) * s) >= 0.8


# Profile, ν, μ, δA/δ0, amplitude, ψ, p, q, lengths: what arrives at the critical point does so within a few
# roundings of its place there, or its tension is far below the largest pressure.
ROUNDED = [
    ("paraboloid", (0.493942436601859, 0.10258408356447156, 0.002155720006299617, 1.5049506881416092e-05)),
    ("paraboloid", (0.4990045562237181, 0.18235865140373503, 0.0, 2.6467850489703402e-05)),
    ("paraboloid", (0.49966131938480884, 0.005776507271744697, 0.8261278989805596, 0.01659111293389111)),
    ("truncated_paraboloid", (0.5, 0.008153294916441173, 0.5674980506579675, 0.008763884720723513)),
    ("truncated_paraboloid", (0.0, 0.0015699502976126802, 1.689804700483817e-05, 0.0)),
]
PHASES = [
    (5.497787143782138, 2, 7),
    (0.7679145853425319, 4, 3),
    (2.5481532291081543, 1, 1),
    (6.110340634191094, 1, 4),
    (1.1545366519989295, 3, 2),
]
LENGTHS = [{}, {}, {}, {"flat_radius": 20.0}, {"flat_radius": 6.581116694018547}]


@pytest.mark.parametrize(
    "case", [pytest.param(k, marks=[pytest.mark.slow] if k in (0, 3) else []) for k in range(len(ROUNDED))]
)
def test_s_error_bounds_what_rounding_and_tables_make_of_s(case: int) -> None:
    profile, values = ROUNDED[case]
    point = points(profile, *values, *PHASES[case], **LENGTHS[case])
    closest = solve_points(point, 1e-8).s[0]
    for rtol in (1e-5, 1e-6):
        found = solve_points(point, rtol)
        assert abs(found.s[0] - closest) <= found.s_error[0]
        # Not any bound will do.
        assert found.s_error[0] <= 0.01 * closest


def test_a_climb_does_not_walk_off_on_rounding() -> None:
    """Where cusps are as near to one another as rounding shows, swt between them is flat but for that."""
    found = swtstudy.solve(
        normal_force_amplitude=0.4,
        tangential_force_amplitude=0.25,
        frequency_ratio="1/2",
        phase=6.0 * np.pi / 72.0,
    )
    assert float(found.s_error) < 1e-3 * float(found.s)


def test_a_shear_criterion_that_tension_makes_alone_has_an_error() -> None:
    """Where nothing is sheared the tension is what rounding counts against."""
    given = {"criterion": "findley", "normal_sensitivity": 0.0237, "friction": 0.06, "phase": 1.0}
    given |= {"normal_force_amplitude": 1e-3, "tangential_force_amplitude": 0.0}
    rough, close = (swtstudy.solve(**given, rtol=rtol) for rtol in (1e-2, 1e-5))
    assert rough.s_error <= 0.01 * rough.s
    assert abs(rough.s - close.s) <= rough.s_error + close.s_error


def test_many_cusps_are_searched_to_the_tolerance() -> None:
    """Groups of pieces of the line, of which a side is ruled out before the other one."""
    found = solve_points(points(p=16, q=15, phase=0.7), 1e-2)
    assert found.s_error[0] <= 1e-2 * found.s[0]


@pytest.mark.slow
@pytest.mark.parametrize("rtol", [1e-1, 1e-2, 1e-3, 1e-4])
def test_long_ratios_are_searched_to_the_tolerance(rtol: float) -> None:
    rng = np.random.default_rng(2)
    p, q = rng.integers(10, 65, (2, 12))
    shared = np.gcd(p, q)
    columns = {"normal_amplitude": (0.05, 0.9), "tangential_amplitude": (0.05, 1.0), "friction": (0.1, 0.9)}
    loads = {name: rng.uniform(*ends, 12) for name, ends in {"phase": (0.0, 6.28), **columns}.items()}
    batch = points("rounded_punch", p=p // shared, q=q // shared, flat_radius=0.5, **loads)
    found = solve_points(batch, rtol)
    assert np.all(found.s_error <= rtol * found.s)
