"""Compared method: surface stress by the periodic half-space of tamaas, from this package's tractions."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from histories import INSTANTS, stress_at
from textbook import brute_force

from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points

#: Width of the periodic cell over the largest contact diameter, layers, and planes over 180°.
WIDTH, LAYERS, PLANES = 2.0, 2, 180
#: Radii from which the tractions are interpolated.
RADII = 2000


@lru_cache(maxsize=2)
def _model(side: int, width: float, nu: float):
    import tamaas

    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.Model(tamaas.model_type.volume_2d, [0.01 * width, width, width], [LAYERS, side, side])
    model.E, model.nu = 1.0 - nu**2, nu
    tamaas.ModelFactory.registerVolumeOperators(model)
    shape = [LAYERS, side, side, 6]
    return model, np.zeros(shape), np.zeros(shape)


def half_space_s(point: Points, side: int) -> float:
    """s on the line y = 0 of the grid; the time includes the contact solution, which is this package's."""
    nu, cycle = point.poisson_ratio.item(), LoadCycle(point)
    largest = cycle.radii[2]
    width = 2.0 * WIDTH * largest
    radius = np.linspace(1e-3, 1.01, RADII) * largest
    _, _, zz, xz = stress_at(cycle, radius)
    pressure, traction = -zz, -xz
    axis = (np.arange(side) - side // 2) * width / side
    grid = np.hypot(axis[:, None], axis)
    model, strain, stress = _model(side, width, nu)
    line = np.empty((INSTANTS, side, 6))
    for instant in range(INSTANTS):
        model.traction[..., 2] = np.interp(grid, radius, pressure[:, instant], right=0.0)
        model.traction[..., 0] = np.interp(grid, radius, traction[:, instant], right=0.0)
        model.operators["boussinesq_gradient"](model.traction, strain)
        model.operators["hooke"](strain, stress)
        line[instant] = stress[0, :, side // 2]
    xx, yy, zz, _, xz = (line[..., k].T for k in range(5))
    zero = np.zeros_like(xx)
    # brute_force covers both signs of x by the sign of the tangential part; here x itself has both signs.
    return brute_force((xx, yy, zz, zero, zero, xz / np.sqrt(2.0)), nu, PLANES)[0]
