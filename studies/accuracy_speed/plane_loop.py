"""Compared method: the search of critical-plane packages, a Python loop over a hemisphere of normals."""

from __future__ import annotations

import numpy as np
from histories import stress_at

from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points


def plane_loop_s(point: Points, x: float, step: float) -> float:
    """Largest swt over planes every ``step`` degrees, at a given position."""
    nu = point.poisson_ratio.item()
    xx, yy, zz, xz = stress_at(LoadCycle(point), np.array([x]))[:, 0]
    zero = np.zeros_like(xx)
    stress = np.moveaxis(np.array([[xx, zero, xz], [zero, yy, zero], [xz, zero, zz]]), 2, 0)
    trace = np.trace(stress, axis1=1, axis2=2)
    strain = ((1.0 + nu) * stress - nu * trace[:, None, None] * np.eye(3)) / (1.0 - nu**2)
    best = 0.0
    for tilt in np.radians(np.arange(0.0, 90.0 + 0.5 * step, step)):
        for turn in np.radians(np.arange(0.0, 360.0, step)):
            normal = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
            on_plane = np.array([normal @ one @ normal for one in stress])
            strain_on_plane = np.array([normal @ one @ normal for one in strain])
            best = max(best, on_plane.max() * 0.5 * np.ptp(strain_on_plane))
    return float(best)
