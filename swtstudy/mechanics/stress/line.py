"""Stress on the surface line y = 0, z = 0 over the stationary cycle.

The stress at x is a short sum over the memory diagram: with the full-slip primitives A(r; ξ) of the profile
(`swtstudy.mechanics.indenter.base.Primitives`) a piece of slope do/dG = s from ξ1 to ξ2 contributes
−s [A(ξ2) − A(ξ1)], since τ′ = −o′. Nothing here depends on ν or μ; `stresses` brings them in. Of a disc there
are c = 3 such integrals, T1, T3 and Π, of a strip c = 2, A and B.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, DistinctPieces
from swtstudy.mechanics.contact.slip_front import SlipStates
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import distinct, gather
from swtstudy.mechanics.points import FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.bulk import BulkStress
from swtstudy.mechanics.stress.growth import GrowthIntegrals
from swtstudy.mechanics.stress.history import History

#: Largest contact radii beyond which no profile is asked for: no rounding takes an edge there.
OUTSIDE = 1.1
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


class SurfaceLine(Rows):
    """n × X positions on the surface line of n points, ready for any instants.

    Parameters
    ----------
    cycle, coordinate
        n cycles and the coordinate of their memory diagrams, which knows the n profiles.
    position
        Shape (n, X): r = |x| > 0 in a_H.
    digits
        Digits of the largest stress to which tables and series are made.
    bulk
        n bulk stresses, or None.
    """

    def __init__(
        self,
        cycle: Cycle,
        coordinate: Coordinate,
        position: FloatArray,
        digits: float,
        bulk: BulkStress | None = None,
    ) -> None:
        self.cycle, self.coordinate, self.position, self.digits = cycle, coordinate, position, digits
        self.primitives, self.bulk = coordinate.profile.primitives(position, digits), bulk
        near = position if bulk is None else self._near_contact()
        #: Shape (n, X, 1): half of the load inside r, were the contact larger; in the plane it is not needed.
        self.inside = None if coordinate.profile.plane else coordinate.profile.half_load(near)[:, :, None]
        #: Shape (n, X): r, or a radius outside of the contact that no edge reaches either, and its G.
        self.near, self.at = near, coordinate.of(near)
        self.at_edge, self.at_front = arrival(cycle.load, coordinate, near, self.at)
        self.growth = GrowthIntegrals(cycle, coordinate, position, digits)
        self.pieces = DistinctPieces.of(cycle.memory)
        #: Shape (n, m): do/dG of the distinct pieces, 0 of growths.
        self.slope = np.where(self.pieces.slope == GROWTH, 0.0, self.pieces.slope)
        #: Shape (c, n, X, m): integrals up to a front in each piece are base − slope · A(front), of lines.
        self.base = self._base()

    def _near_contact(self) -> FloatArray:
        """The positions, those far outside of the largest contact nearer to it: a profile ends there."""
        largest = self.coordinate.radius(self.cycle.load.largest_normal[:, None])
        return np.minimum(self.position, OUTSIDE * largest)

    def take(self, index: IndexArray) -> SurfaceLine:
        """The lines at ``index`` with their positions, repetitions allowed."""
        names = ("cycle", "coordinate", "bulk", "position", "near", "at", "at_edge", "at_front", "inside")
        taken = self._with_rows_of((*names, "growth", "pieces", "slope"), index)
        taken.base = self.base[:, index]
        taken.primitives = taken.coordinate.profile.primitives(taken.position, self.digits)
        return taken

    def _growth_of(self, row: IndexArray, piece: IndexArray) -> IndexArray:
        """Numbers of the growths that left distinct pieces, shape (m,)."""
        index = self.growth.index.reshape(len(self.position), -1)
        return np.asarray(index[row, self.pieces.first[row, piece]])

    def _base(self) -> FloatArray:
        """Integrals over all pieces inside of each distinct piece, and slope · A at its start."""
        pieces, (n, columns) = self.pieces, self.position.shape
        breakpoints, number = distinct(pieces.start)
        radius = self.coordinate.radius(breakpoints)
        full_slip = self._full_slip(radius[:, None])
        at_start = np.empty((len(full_slip), n, columns, pieces.start.shape[1]))
        for component, values in zip(at_start, full_slip, strict=True):
            component[...] = gather(values, number[:, None])
        slope = self.slope
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
        """Add the integrals over growths right beneath pieces to those of the lines.

        Parameters
        ----------
        part
            Shape (c, n, X, m).
        start
            Shape (n, m): radius at which each piece begins.
        """
        pieces, columns = self.pieces, self.position.shape[1]
        grown = (gather(pieces.slope, pieces.below) == GROWTH) & (pieces.level > 0)
        row, piece = np.nonzero(grown)
        index = self._growth_of(row, pieces.below[row, piece])
        many = np.broadcast_arrays(
            row[:, None], np.arange(columns), index[:, None], start[row, piece][:, None]
        )
        found = self.growth.up_to(*(values.ravel() for values in many)).reshape(len(part), row.size, columns)
        part[:, row, :, piece] += np.moveaxis(found, 0, 1)

    def _full_slip(self, radius: FloatArray) -> FloatArray:
        """The integrals up to ``radius`` (n, X or 1, …), shape (c, n, X, …)."""
        return np.concatenate([self.primitives.inner(radius), self.primitives.pressure(radius)[None]])

    def history(self, nodes: Nodes) -> History:
        """Stress building blocks at the given instants, index of shape (n, X, T)."""
        states = self.cycle.states(nodes.interval, nodes.instant)
        radius = self.coordinate.radius(states.edge)
        edge = self._passing(nodes, radius, states.edge, self.at_edge)
        front = self._passing(nodes, self.coordinate.radius(states.front), states.front, self.at_front)
        inner, outer = self.primitives.inner(edge), self.primitives.outer(edge)
        tangential = self._tangential(nodes, states, front, (*inner, outer[0]))
        bulk = nodes.spread(self.bulk.at(nodes.instant)) if self.bulk else None
        if self.inside is None:
            pull, traction = tangential
            return History(outer[0] / np.pi, None, pull, None, traction, bulk)
        # What the springs inside r carry, and what those outside press on the inside.
        half_load = nodes.spread(self.coordinate.profile.half_load(radius))
        inside, r = np.minimum(half_load, self.inside), self.position[:, :, None]
        mean = (2.0 / np.pi) * (inside / (r * r) + outer[1])
        first, third, traction = tangential
        return History(outer[0] / np.pi, mean, first, third, traction, bulk)

    def _passing(
        self, nodes: Nodes, radius: FloatArray, coordinate: FloatArray, near: FloatArray
    ) -> FloatArray:
        """Radii at the distinct instants, (n, k), at the positions, (n, X, T): r where they arrive there."""
        spread, distance = nodes.spread(radius), nodes.spread(coordinate)
        distance -= self.at[:, :, None]
        np.abs(distance, out=distance)
        np.copyto(spread, self.near[:, :, None], where=distance <= near[:, :, None])
        return spread

    def _tangential(
        self, nodes: Nodes, states: SlipStates, front: FloatArray, at_edge: tuple[FloatArray, ...]
    ) -> FloatArray:
        """The integrals with the springs' τ′, over π, from full-slip ones up to the edge, (c, n, X, T)."""
        pieces, (n, columns) = self.pieces, self.position.shape
        place = nodes.interval * pieces.index.shape[-1] + states.piece
        piece = gather(pieces.index.reshape(n, -1), place)
        at_piece, sign = nodes.spread(piece), nodes.spread(states.sign)
        bend = sign - nodes.spread(gather(self.slope, piece))
        rows, count = np.arange(n)[:, None, None], self.base.shape[-1]
        of_base = (rows * columns + np.arange(columns)[:, None]) * count + at_piece
        total = self._full_slip(front)
        for result, base, edge_part in zip(total, self.base, at_edge, strict=True):
            result *= bend
            result += base.ravel().take(of_base)
            result -= sign * edge_part
        grown = gather(pieces.slope, piece) == GROWTH
        if np.any(grown):
            # The part of a growth inside of the front, where the front cuts it.
            row, column, _ = where = np.nonzero(nodes.spread(grown))
            index = self._growth_of(row, at_piece[where])
            parts = self.growth.up_to(row, column, index, front[where])
            for component, part in zip(total, parts, strict=True):
                component[where] += part
        total /= np.pi
        return total
