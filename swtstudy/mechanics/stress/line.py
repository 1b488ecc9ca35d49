"""Stress on the surface line y = 0, z = 0 over the stationary cycle.

The stress at x is a short sum over the memory diagram: with the full-slip primitives A(r; ξ) of the profile
(`swtstudy.mechanics.indenter.base.Primitives`) a piece of slope do/dG = s from ξ1 to ξ2 contributes
−s [A(ξ2) − A(ξ1)], since τ′ = −o′. Nothing here depends on ν or μ; `stresses` brings them in.
"""

from __future__ import annotations

from copy import copy

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, DistinctPieces
from swtstudy.mechanics.contact.slip_front import SlipStates
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.events.nodes import Nodes
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import distinct, gather
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.growth import GrowthIntegrals
from swtstudy.mechanics.stress.history import History

#: Rounding of a coordinate, over the largest one: 1.3e-15 there and back on a rounded punch, 4e-16 on a wavy
#: one; a hundredth: 6e-7, a hundred times: 2e-6. And of an instant, rad: doubles beside 2π are 9e-16 apart,
#: and from the coordinate to the instant and back there are five roundings. 1e-15: 5e-7 at rtol 1e-6.
COORDINATE, INSTANT = 2e-15, 2.5e-15


def arrival(
    load: Load, coordinate: Coordinate, position: FloatArray, at: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How far from ``at``, the coordinate of r, shape (n, X), rounding leaves that of what arrives there.

    The stress shows the square root of this distance.

    Returns
    -------
    edge, front
        Shape (n, X): of a contact edge and of a slip front, which move at most at some rate.
    """
    normal, tangential = load.oscillations
    amplitude = 0.5 * (load.largest_normal - load.least_normal)
    of_edge = COORDINATE * load.largest_normal + INSTANT * normal * amplitude
    of_front = of_edge + INSTANT * tangential * (load.motion - amplitude)
    next_to_r = coordinate.of(position + np.spacing(position)) - at
    return of_edge[:, None] + next_to_r, of_front[:, None] + next_to_r


class SurfaceLine:
    """n × X positions on the surface line of n points, ready for any instants.

    Parameters
    ----------
    cycle, coordinate
        n cycles and the coordinate of their memory diagrams, which knows the n profiles.
    position
        Shape (n, X): r = |x| > 0 in a_H.
    digits
        Digits of the largest stress to which tables and series are made.
    """

    def __init__(self, cycle: Cycle, coordinate: Coordinate, position: FloatArray, digits: float) -> None:
        self.cycle, self.coordinate, self.position, self.digits = cycle, coordinate, position, digits
        self.primitives = coordinate.profile.primitives(position, digits)
        at = coordinate.of(position)
        #: The coordinate of r, and how near to it a contact edge, and a slip front, has arrived, (n, X, 1).
        self.at = at[:, :, None]
        self.edge_near, self.front_near = (
            distance[:, :, None] for distance in arrival(cycle.load, coordinate, position, at)
        )
        self.growth = GrowthIntegrals(cycle, coordinate, position, digits)
        self.pieces = DistinctPieces.of(cycle.memory)
        #: Shape (3, n, X, m): T1, T3, Π up to a front in each piece are base − slope · A(front), for lines.
        self.base = self._base()

    def take(self, index: NDArray[np.intp]) -> SurfaceLine:
        """The lines at ``index`` with their positions, repetitions allowed."""
        taken = copy(self)
        taken.cycle, taken.coordinate = self.cycle.take(index), self.coordinate.take(index)
        taken.position, taken.base = self.position[index], self.base[:, index]
        taken.primitives = taken.coordinate.profile.primitives(taken.position, self.digits)
        taken.at = self.at[index]
        taken.edge_near, taken.front_near = self.edge_near[index], self.front_near[index]
        taken.growth, taken.pieces = self.growth.take(index), self.pieces.take(index)
        return taken

    def _base(self) -> FloatArray:
        """Integrals over all pieces inside of each distinct piece, and slope · A at its start."""
        pieces, (n, columns) = self.pieces, self.position.shape
        breakpoints, number = distinct(pieces.start)
        radius = self.coordinate.radius(breakpoints)
        at_start = np.empty((3, n, columns, pieces.start.shape[1]))
        for component, values in zip(at_start, self._full_slip(radius[:, None]), strict=True):
            component[...] = gather(values, number[:, None])
        slope = _line_slope(pieces.slope)
        base = slope[:, None] * at_start
        if pieces.level.max(initial=0) == 0:
            return base
        below = gather(slope, pieces.below)[:, None]
        part = -below * (at_start - gather(at_start, pieces.below[:, None]))
        if self.growth.count:
            self._put_growths(part, gather(radius, number))
        inside = np.zeros_like(part)
        for level in range(1, int(pieces.level.max()) + 1):
            row, piece = np.nonzero(pieces.level == level)
            of_lower = inside[:, row, :, pieces.below[row, piece]]
            inside[:, row, :, piece] = of_lower + part[:, row, :, piece]
        return inside + base

    def _put_growths(self, part: FloatArray, start: FloatArray) -> None:
        """Put the integrals over growths right beneath pieces among those of the lines.

        Parameters
        ----------
        part
            Shape (3, n, X, m).
        start
            Shape (n, m): radius at which each piece begins.
        """
        pieces, columns = self.pieces, self.position.shape[1]
        grown = (gather(pieces.slope, pieces.below) == GROWTH) & (pieces.level > 0)
        row, piece = np.nonzero(grown)
        index = self.growth.index.reshape(len(start), -1)[row, pieces.first[row, pieces.below[row, piece]]]
        many = np.broadcast_arrays(
            row[:, None], np.arange(columns), index[:, None], start[row, piece][:, None]
        )
        found = self.growth.up_to(*(values.ravel() for values in many)).reshape(3, row.size, columns)
        part[:, row, :, piece] = np.moveaxis(found, 0, 1)

    def _full_slip(self, radius: FloatArray) -> FloatArray:
        """T1, T3 and Π up to ``radius`` (n, X or 1, …), shape (3, n, X, …)."""
        return np.concatenate([self.primitives.inner(radius), self.primitives.pressure(radius)[None]])

    def history(self, nodes: Nodes) -> History:
        """Stress building blocks at the given instants, index of shape (n, X, T)."""
        states = self.cycle.states(nodes.interval, nodes.instant)
        profile, edge_radius = self.coordinate.profile, self.coordinate.radius(states.edge)
        edge = self._spread_radius(nodes, edge_radius, states.edge, self.edge_near)
        r = self.position[:, :, None]
        inner, outer = self.primitives.inner(edge), self.primitives.outer(edge)
        tangential = self._tangential(nodes, states, (*inner, outer[0]))
        # What the springs inside r carry, and what those outside press on the inside.
        load = nodes.spread(profile.half_load(edge_radius))
        inside = np.minimum(load, profile.half_load(self.position)[:, :, None])
        return History(outer[0] / np.pi, (2.0 / np.pi) * (inside / (r * r) + outer[1]), *tangential)

    def _spread_radius(
        self, nodes: Nodes, radius: FloatArray, coordinate: FloatArray, near: FloatArray
    ) -> FloatArray:
        """Radii at the distinct instants, (n, k), at the positions, (n, X, T): r where they arrive there."""
        spread, distance = nodes.spread(radius), nodes.spread(coordinate)
        distance -= self.at
        np.abs(distance, out=distance)
        np.copyto(spread, self.position[:, :, None], where=distance <= near)
        return spread

    def _tangential(self, nodes: Nodes, states: SlipStates, at_edge: tuple[FloatArray, ...]) -> FloatArray:
        """T1, T3 and the traction, each over π, from the full-slip integrals up to the edge, (3, n, X, T)."""
        pieces, (n, columns) = self.pieces, self.position.shape
        place = nodes.interval * pieces.index.shape[-1] + states.piece
        piece = gather(pieces.index.reshape(n, -1), place)
        slope = gather(pieces.slope, piece)
        front_radius = self.coordinate.radius(states.front)
        front = self._spread_radius(nodes, front_radius, states.front, self.front_near)
        at_piece, sign = nodes.spread(piece), nodes.spread(states.sign)
        bend = sign - nodes.spread(_line_slope(slope))
        rows, count = np.arange(n)[:, None, None], self.base.shape[-1]
        of_base = (rows * columns + np.arange(columns)[:, None]) * count + at_piece
        total = self._full_slip(front)
        for result, base, edge_part in zip(total, self.base, at_edge, strict=True):
            result *= bend
            result += base.ravel().take(of_base)
            result -= sign * edge_part
        grown = slope == GROWTH
        if np.any(grown):
            # The part of a growth inside of the front, where the front cuts it.
            row, column, _ = where = np.nonzero(nodes.spread(grown))
            index = self.growth.index.reshape(n, -1)[row, pieces.first[row, at_piece[where]]]
            parts = self.growth.up_to(row, column, index, front[where])
            for component, part in zip(total, parts, strict=True):
                component[where] += part
        total /= np.pi
        return total


def _line_slope(slope: FloatArray) -> FloatArray:
    """do/dG of lines, 0 for growths."""
    return np.where(slope == GROWTH, 0.0, slope)
