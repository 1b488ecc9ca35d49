"""s_error: an upper bound of the error of s that is not far above it."""

from __future__ import annotations

import csv
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scenes import PROFILE_NAMES, points

from swtstudy.mechanics import solve_points

#: Made by studies/checks/reference_values.py.
with (Path(__file__).parents[1] / "results" / "reference_values.csv").open(encoding="utf-8") as file:
    ROWS = list(csv.DictReader(file))


@lru_cache
def errors(rtol: float) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """What is missed of the reference values, s_error, and s; what the references miss is taken off."""
    missed, claimed, values = [], [], []
    for profile in PROFILE_NAMES:
        rows = [row for row in ROWS if row["profile"] == profile]
        names = [name for name in rows[0] if name not in ("profile", "s", "s_error") and rows[0][name]]
        columns = {name: np.array([float(row[name]) for row in rows]) for name in names}
        columns |= {name: columns[name].astype(int) for name in "pq"}
        found = solve_points(points(profile, **columns), rtol)
        s, s_error = (np.array([float(row[name]) for row in rows]) for name in ("s", "s_error"))
        missed.append(np.maximum(np.abs(found.s - s) - s_error, 0.0))
        claimed.append(found.s_error)
        values.append(s)
    return np.concatenate(missed), np.concatenate(claimed), np.concatenate(values)


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_s_error_bounds_the_error(rtol: float) -> None:
    missed, claimed, _ = errors(rtol)
    assert len(missed) >= 100
    assert np.mean(missed <= claimed) >= 0.99
    assert np.all(missed <= 3.0 * claimed)


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_s_error_is_not_far_above_the_tolerance(rtol: float) -> None:
    _, claimed, s = errors(rtol)
    # A quarter of the tolerance is the least that is claimed: nothing closer was looked at.
    assert 0.2 * rtol <= np.median(claimed / s) <= 0.5 * rtol
    assert np.mean(claimed <= rtol * s) >= 0.9
