"""The study that the checks disturb, and what must not change by that."""

from __future__ import annotations

import xarray as xr

STUDY = """
title = "2,000 points"
rtol = 1e-4
[fixed]
frequency_ratio = "1/4"
[axes]
phase = {start = 0, stop = 3, num = 100}
friction = {start = "0.05", stop = 1, num = 20}
"""


def same_values(one: xr.Dataset, other: xr.Dataset) -> None:
    """Everything but the provenance is the same, to the last bit."""
    xr.testing.assert_equal(one.drop_attrs().drop_vars("run"), other.drop_attrs().drop_vars("run"))
