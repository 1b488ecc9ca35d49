"""The permanent stick zone, from the extremes of the slip lines alone."""

from __future__ import annotations

from swtstudy.mechanics.load.bimodal import Protocol, turning_instants
from swtstudy.mechanics.points import FloatArray


def stick_depth(protocol: Protocol) -> FloatArray:
    """Depth G_s = (min(u + δ) − max(u − δ))/2 up to which springs stick all through the stationary cycle.

    A spring at G can keep one offset if that fits into all of its bounds [u − δ + G, u + δ − G]. Negative
    if the whole contact slides, or is lost, once a cycle.

    Returns
    -------
    Shape (n,), in δ0.
    """
    instants = turning_instants(protocol)
    depth, displacement = protocol.depth(instants), protocol.displacement(instants)
    return 0.5 * ((displacement + depth).min(axis=1) - (displacement - depth).max(axis=1))
