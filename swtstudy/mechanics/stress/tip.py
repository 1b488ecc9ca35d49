"""Contact edges and slip fronts that pass positions on the surface line, next to a tip above all.

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
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import TINY
from swtstudy.mechanics.points import FloatArray, Rows


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
        return cls(np.log(told / r), np.log(slowness.beside * told), np.log(np.maximum(far, TINY)))

    def put(self, radius: FloatArray, own: NDArray[np.bool_] | None = None) -> None:
        """Put what stands for radii, shape (n, X, T), in place, but for those at their ``own`` time."""
        at = np.nonzero(self.shift > 0.0)
        shift, near, far = (values[at][:, None] for values in vars(self).values())
        some = radius[at]
        share = (far - np.log(np.maximum(some, TINY))) / (far - near)
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


#: Rounding of a coordinate, over the largest one: 1.3e-15 there and back on a rounded punch, 4e-16 on a wavy
#: one; a hundredth: 6e-7, a hundred times: 2e-6. And of an instant, rad: doubles beside 2π are 9e-16 apart,
#: and from the coordinate to the instant and back there are five roundings. 1e-15: 5e-7 at rtol 1e-6.
COORDINATE, INSTANT = 2e-15, 2.5e-15


def arrival(
    load: Load, coordinate: Coordinate, position: FloatArray, at: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Distance from ``at``, the coordinate of r, shape (n, X), at which rounding leaves what arrives there.

    The stress shows the square root of this distance.

    Returns
    -------
    edge, front
        Shape (n, X): of a contact edge and of a slip front, which move at most at some rate.
    """
    normal, tangential = load.oscillations
    amplitude = load.normal_motion
    of_edge = COORDINATE * load.largest_normal + INSTANT * normal * amplitude
    of_front = of_edge + INSTANT * tangential * (load.motion - amplitude)
    next_to_r = coordinate.of(position + np.spacing(position)) - at
    return of_edge[:, None] + next_to_r, of_front[:, None] + next_to_r


@dataclass(frozen=True)
class Passing(Rows):
    """Edges and fronts that pass n × X positions.

    Attributes
    ----------
    position
        Shape (n, X): r.
    at, near
        Shape (n, X): the coordinate at which instants tell that r is passed, and how near to it is arrived.
    slower
        What next to a tip stands for its radii.
    """

    position: FloatArray
    at: FloatArray
    near: FloatArray
    slower: SlowerTime | None

    @classmethod
    def of(cls, cycle: Cycle, coordinate: Coordinate, position: FloatArray) -> tuple[Passing, Passing]:
        """Of edges and fronts."""
        if not coordinate.profile.tip.any():
            at = coordinate.of(position)
            of_edge, of_front = arrival(cycle.load, coordinate, position, at)
            return cls(position, at, of_edge, None), cls(position, at, of_front, None)

        def slowed(number: int, slowness: Slowness, over: FloatArray) -> Passing:
            told = told_radius(slowness, coordinate, over, position)
            at = coordinate.of(told)
            near = arrival(cycle.load, coordinate, told, at)[number]
            return cls(position, at, near, SlowerTime.of(slowness, coordinate, over, position, told))

        of_edge, of_front = reach_of_edges(cycle.load), reach_of_fronts(cycle)
        return slowed(0, OF_EDGE, of_edge), slowed(1, OF_FRONT, of_front)

    def spread(
        self,
        nodes: Nodes,
        radius: FloatArray,
        coordinate: FloatArray,
        own_time: NDArray[np.bool_] | None = None,
    ) -> FloatArray:
        """Radii at the distinct instants, (n, k), at the positions, (n, X, T): r where they arrive there.

        Next to a tip what stands for them, but for those at their ``own_time``, shape (n, k).
        """
        spread, distance = nodes.spread(radius), nodes.spread(coordinate)
        distance -= self.at[:, :, None]
        np.abs(distance, out=distance)
        if self.slower:
            self.slower.put(spread, None if own_time is None else nodes.spread(own_time))
        np.copyto(spread, self.position[:, :, None], where=distance <= self.near[:, :, None])
        return spread
