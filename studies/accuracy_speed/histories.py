"""The stress of a point's cycle at uniform instants, from this package's contact solution."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics import Points
from swtstudy.mechanics.load_cycle import LoadCycle

INSTANTS = 64


def stress_at(point: Points, x: float) -> np.ndarray:
    """σ_xx, σ_yy, σ_zz and σ_xz at x/a_H on the surface line, shape (4, INSTANTS)."""
    cycle = LoadCycle.of(point)
    stress = cycle.stress(x, cycle.states(2.0 * np.pi * (np.arange(INSTANTS) + 0.5) / INSTANTS))
    return np.array([stress[name] for name in ("xx", "yy", "zz", "xz")])
