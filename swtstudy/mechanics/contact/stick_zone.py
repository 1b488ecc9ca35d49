"""The permanent stick zone, from the extremes of the slip lines alone."""

from __future__ import annotations

from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.points import FloatArray


def stick_coordinate(load: Load) -> FloatArray:
    """Coordinate G = (min(T + N) − max(T − N))/2 up to which springs stick all through the stationary cycle.

    A spring at G can keep one offset if that fits into all of its bounds [T − N + G, T + N − G]. Negative
    if the whole contact slides, or is lost, once a cycle.

    Returns
    -------
    Shape (n,).
    """
    instants = load.turning_instants()
    normal, tangential = load.normal(instants), load.tangential(instants)
    return 0.5 * ((tangential + normal).min(axis=1) - (tangential - normal).max(axis=1))
