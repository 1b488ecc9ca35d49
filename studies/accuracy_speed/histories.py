"""The stress of a point's cycle at uniform instants, from this package's contact solution."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics import Points
from swtstudy.mechanics.contact import solve_cycle
from swtstudy.mechanics.instants import Nodes
from swtstudy.mechanics.profiles import make_profile
from swtstudy.mechanics.protocol import Protocol
from swtstudy.mechanics.surface_stress import History, SurfaceLine

INSTANTS, DIGITS = 64, 6.0


def history_at(point: Points, radius: np.ndarray) -> History:
    """Building blocks of the stress at r = ``radius``, shape (1, X, INSTANTS)."""
    p, q = int(point.p[0]), int(point.q[0])
    protocol = Protocol(point.normal_amplitude, point.tangential_amplitude, point.phase, p, q)
    cycle = solve_cycle(protocol)
    profile = make_profile(point.profile, point.shape, 1.0 + point.normal_amplitude)
    instant = 2.0 * np.pi * (np.arange(INSTANTS) + 0.5) / INSTANTS
    interval = (instant[:, None] >= cycle.end[0]).sum(axis=1)
    index = np.broadcast_to(np.arange(INSTANTS), (1, len(radius), INSTANTS))
    line = SurfaceLine(cycle, profile, radius[None], DIGITS)
    return line.history(Nodes(interval[None], instant[None], index))
