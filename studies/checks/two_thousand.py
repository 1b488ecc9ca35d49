"""The study that the checks disturb, and what must not change by that."""

from __future__ import annotations

import xarray as xr

_STUDY = """
title = "%d points"
rtol = 1e-4
[fixed]
frequency_ratio = "1/4"
[axes]
phase = {start = 0, stop = 3, num = %d}
friction = {start = "0.05", stop = 1, num = %d}
"""


def study_text(quick: bool) -> str:
    """The study as it is written, with 2,000 points or, quickly, 100."""
    phases, rows = (50, 2) if quick else (100, 20)
    return _STUDY % (phases * rows, phases, rows)


def same_values(one: xr.Dataset, other: xr.Dataset) -> None:
    """Everything but the provenance is the same, to the last bit."""
    xr.testing.assert_equal(one.drop_attrs().drop_vars("run"), other.drop_attrs().drop_vars("run"))
