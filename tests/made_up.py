"""Made-up results and a study for the tests."""

from collections.abc import Callable

import numpy as np
import xarray as xr
from solved import REGIMES

from swtstudy.archive.archive import save as save
from swtstudy.paper.audit import AUDITED, audit_dataset
from swtstudy.paper.markdown import report as report
from swtstudy.paper.statements import STATEMENTS as STATEMENTS
from swtstudy.points.grid import ROW

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

#: A sample that has Sobol indices.
SALTELLI = """
title = "A sample"
[sample]
design = "saltelli"
size = 8
seed = 2
[sample.ranges]
friction = [0, 1]
phase = [0, 3]
[axes]
normal_amplitude = [0.25, 0.5]
"""


def having(name: str, value: float, **where: object) -> Callable[[xr.Dataset], xr.Dataset]:
    """A change of results: another value of a variable, everywhere or at some places."""

    def change(dataset: xr.Dataset) -> xr.Dataset:
        dataset = dataset.copy(deep=True)
        dataset[name][where] = value
        return dataset

    return change


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


def made_up_point(regime: str = "partial_slip", **changes: float) -> np.void:
    """An audited point with its maximum on the surface line, but for the changes."""
    found = {name: 0.0 for name in AUDITED.names}
    found |= dict.fromkeys(
        ("s", "s_surface", "critical_x", "s_all_planes", "s_body", "body_x", "normal_x"), 1.0
    )
    found |= {"s_error": 1e-5, "s_dense": np.nan, "regime": REGIMES.index(regime)}
    return np.array([tuple((found | changes).values())], AUDITED)[0]


def audit_of(points: list[np.void], **columns: object) -> xr.Dataset:
    """An audit of points that differ in their phases, and in these columns of their rows."""
    rows = np.zeros(len(points), ROW)
    for name, values in {"phase": np.arange(len(points)), **columns}.items():
        rows[name] = values
    return audit_dataset(rows, np.array(points, AUDITED), {}).assign_attrs(title="made up")


#: Where the maximum of the body is off the line.
OFF_LINE = {"body_x": 0.8, "body_y": 0.6}


def made_up_audit(on_line: int = 3, off_line: int = 0) -> xr.Dataset:
    """An audit with so many points whose maximum is on the line, at ν = 0.3, and off it, at ν = 0.45."""
    off = made_up_point(s_body=1.04, s_surface=1.04, **OFF_LINE)
    points = [made_up_point()] * on_line + [off] * off_line
    return audit_of(points, poisson_ratio=[0.3] * on_line + [0.45] * off_line)
