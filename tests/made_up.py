"""Made-up results and a study for the tests."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from swtstudy.paper.audit.point import AuditedPoint
from swtstudy.paper.audit.report import audit_dataset
from swtstudy.points.canonical import ROW

#: Phases over one turn, its end included.
PHASES = np.linspace(0, 2 * np.pi, 49)

#: A study with a figure of two panels and two rows.
PANELS = """
title = "Panels"
[axes]
phase = [0, "pi"]
frequency_ratio = ["1/2", 1, "3/2"]
flat_radius = {start = 0, stop = 2, num = 5}
[fixed]
profile = "rounded_punch"
[figure]
x = "flat_radius"
hue = "frequency_ratio"
panels = "phase"
y = ["s", "s/s(flat_radius=0)"]
title = "A title"
"""


def made_up(function: Callable[..., xr.DataArray], **axes: object) -> xr.Dataset:
    """Results with s = function(axes), and everything else as it usually is."""
    arrays = {name: xr.DataArray(np.atleast_1d(values), dims=name) for name, values in axes.items()}
    coords = {name: array.values for name, array in arrays.items()}
    s = sum((0 * array for array in arrays.values() if array.dtype.kind == "f"), function(**arrays))
    for name in axes:
        s = s if name in s.dims else s.expand_dims({name: coords[name]})
    s = s.assign_coords(coords).transpose(*axes)
    zero = xr.zeros_like(s)
    return xr.Dataset(
        {"s": s, "s_error": zero + 1e-6, "critical_x": zero + 1, "critical_angle": zero, "regime": zero + 1}
    )


def made_up_point(**changes: object) -> AuditedPoint:
    """An audited point with its maximum on the surface line, but for the changes."""
    line = {
        "s": 1.0,
        "s_error": 1e-5,
        "s_surface": 1.0,
        "critical_x": 1.0,
        "regime": "partial_slip",
        "s_dense": np.nan,
        "s_all_planes": 1.0,
        "s_body": 1.0,
        "position": np.array([1.0, 0.0, 0.0]),
        "normal": np.array([1.0, 0.0, 0.0]),
    }
    return AuditedPoint(**(line | changes))


def made_up_audit_point(row: tuple[float, ...], **_: object) -> AuditedPoint:
    """In the place of `audit_point`, at no cost."""
    return made_up_point()


def made_up_audit(on_line: int = 3, off_line: int = 0) -> xr.Dataset:
    """An audit with so many points whose maximum is on the line, at ν = 0.3, and off it, at ν = 0.45."""
    off = {"s_body": 1.04, "s_surface": 1.04, "position": np.array([0.8, 0.6, 0.0])}
    points = [made_up_point()] * on_line + [made_up_point(**off)] * off_line
    rows = np.zeros(len(points), ROW)
    rows["phase"] = np.arange(len(points))
    rows["poisson_ratio"] = [0.3] * on_line + [0.45] * off_line
    return audit_dataset(rows, points, {}).assign_attrs(title="made up")
