"""Next to a tip: radii that are too small for instants to tell.

There stresses change with the logarithm of the radius, so that positions are looked at down to radii which
contact edges and slip fronts pass within less time than an instant can hold. Nothing depends on the speed at
which the load runs: it may be slowed down meanwhile. While an edge or a front is next to the tip, another
radius stands for its own, and that of the position for the least one that instants tell.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows


@dataclass(frozen=True)
class Slowness:
    """The rule by which the load is slowed down.

    Attributes
    ----------
    least
        Least coordinate that instants tell well enough, over the largest one or less.
    until
        Coordinate up to which the load is slower, over the same.
    beside
        Radii up to so many times the least one are to the position as they are to that: there the stress is
        not yet a line in the logarithm.
    """

    least: float
    until: float
    beside: float


#: Of contact edges where nothing or all of the contact sticks: the springs inside of each are what they would
#: be at another time. 1e-9 and 1e-7 left 3e-3 of s to rounding at μ < 1.
OF_EDGE = Slowness(1e-7, 1e-5, 10.0)
#: Of slip fronts, while the edge moves on at its own time. As that of edges: 1.4e-4 of s.
OF_FRONT = Slowness(1e-10, 1e-7, 30.0)


#: Where the edge is next to the tip, too, while a front is, less of the largest coordinate counts: so many
#: times the least edge or the tangential amplitude, whichever is more, but at least this share. All of it:
#: 2e-1 at 2 of 60 points with tangential amplitudes of 1e-4 to 0.1.
OF_LEAST_EDGE, OF_AMPLITUDE, LEAST_REACH = 1e5, 1e2, 1e-3


def reach_of_edges(load: Load) -> FloatArray:
    """Reference of the coordinates of `OF_EDGE`, shape (n,): 0 unless edges come to the tip."""
    return np.where(load.least_normal <= 0.0, load.largest_normal, 0.0)


def reach_of_fronts(cycle: Cycle) -> FloatArray:
    """Reference of the coordinates of `OF_FRONT`, shape (n,): 0 unless fronts come to the tip."""
    load = cycle.load
    amplitude = load.motion - load.normal_motion
    edge = np.maximum(OF_LEAST_EDGE * load.least_normal, OF_AMPLITUDE * amplitude)
    edge = np.clip(edge, LEAST_REACH * load.largest_normal, load.largest_normal)
    return np.where(cycle.gross_slip, edge, 0.0)


@dataclass(frozen=True)
class SlowerTime(Rows):
    """Slower time for n × X positions, some of which are next to a tip.

    Attributes
    ----------
    shift
        Shape (n, X): logarithm of the least radius that instants tell over the position, 0 where that is it.
    near, far
        Shape (n, X): logarithms of the radii between which the load gets back to its own speed.
    """

    shift: FloatArray
    near: FloatArray
    far: FloatArray

    @classmethod
    def of(
        cls, slowness: Slowness, coordinate: Coordinate, over: FloatArray, r: FloatArray, told: FloatArray
    ) -> SlowerTime | None:
        """Of positions r, shape (n, X), None where none needs it; for the rest see `told_radius`."""
        if not np.any(r < told):
            return None
        far = np.broadcast_to(coordinate.radius((slowness.until * over)[:, None]), r.shape)
        return cls(np.log(told / r), np.log(slowness.beside * told), np.log(np.maximum(far, 1e-300)))

    def put(self, radius: FloatArray, own: NDArray[np.bool_] | None = None) -> None:
        """Put what stands for radii, shape (n, X, T), in place, but for those at their ``own`` time."""
        at = np.nonzero(self.shift > 0.0)
        shift, near, far = (values[at][:, None] for values in vars(self).values())
        some = radius[at]
        share = (far - np.log(np.maximum(some, 1e-300))) / (far - near)
        slower = some * np.exp(-shift * np.clip(share, 0.0, 1.0))
        radius[at] = slower if own is None else np.where(own[at], some, slower)


def told_radius(slowness: Slowness, coordinate: Coordinate, over: FloatArray, r: FloatArray) -> FloatArray:
    """Positions r, shape (n, X), next to a tip the least radius that instants tell.

    Parameters
    ----------
    over
        Shape (n,): see `reach_of_edges` and `reach_of_fronts`.
    """
    least = coordinate.radius((slowness.least * over)[:, None])
    return np.asarray(np.where(coordinate.profile.tip[:, None], np.maximum(r, least), r))


def told_by_fronts(cycle: Cycle, coordinate: Coordinate, r: FloatArray) -> FloatArray:
    """The positions r, shape (n, X), at which instants tell that fronts pass, see `told_radius`."""
    if not coordinate.profile.tip.any():
        return r
    return told_radius(OF_FRONT, coordinate, reach_of_fronts(cycle), r)
