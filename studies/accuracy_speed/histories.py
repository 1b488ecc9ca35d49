"""The stress of a point's cycle at uniform instants, from this package's contact solution."""

from __future__ import annotations

import numpy as np

from swtstudy.solver.load_cycle import LoadCycle

INSTANTS = 64


def stress_at(cycle: LoadCycle, x: np.ndarray) -> np.ndarray:
    """σ_xx, σ_yy, σ_zz and σ_xz at places x/a_H of the surface line, shape (4, X, INSTANTS)."""
    states = cycle.states(2.0 * np.pi * (np.arange(INSTANTS) + 0.5) / INSTANTS)
    stresses = [cycle.stress(float(place), states) for place in x]
    return np.array([[each[name] for each in stresses] for name in ("xx", "yy", "zz", "xz")])
