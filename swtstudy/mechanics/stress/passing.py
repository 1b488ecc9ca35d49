"""Contact edges and slip fronts that pass positions on the surface line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.events.nodes import Nodes
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows
from swtstudy.mechanics.stress.tip import (
    OF_EDGE,
    OF_FRONT,
    SlowerTime,
    Slowness,
    reach_of_edges,
    reach_of_fronts,
    told_radius,
)

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
