"""The study that the checks disturb, and the comparison of its undisturbed and disturbed results."""

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
    """The text of the study, with 2,000 points or, if quick, 200."""
    phases, rows = (50, 4) if quick else (100, 20)
    return _STUDY % (phases * rows, phases, rows)


def same_values(one: xr.Dataset, other: xr.Dataset) -> None:
    """Check that everything but the provenance is identical."""
    xr.testing.assert_equal(one.drop_attrs().drop_vars("run"), other.drop_attrs().drop_vars("run"))
