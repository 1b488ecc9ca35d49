"""Stress on the surface line y = 0, z = 0 over the stationary cycle.

The stress at x is a short sum over the memory diagram: with the full-slip primitives A(r; ξ) of the profile
(`swtstudy.mechanics.indenter.base.Primitives`) a piece of slope do/dG = s from ξ1 to ξ2 contributes
−s [A(ξ2) − A(ξ1)], since τ′ = −o′. Nothing here depends on ν or μ; `stresses` brings them in.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH
from swtstudy.mechanics.contact.slip_front import SlipStates
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.events.nodes import Nodes
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics.arrays import distinct, gather
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.growth import GrowthIntegrals
from swtstudy.mechanics.stress.history import History

#: Rounding of a coordinate, over the largest one, and of an instant, rad.
COORDINATE, INSTANT = 2e-15, 1e-15


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
        self.cycle, self.coordinate, self.position = cycle, coordinate, position
        self.primitives = coordinate.profile.primitives(position, digits)
        self.at = coordinate.of(position)[:, :, None]
        #: How near a contact edge, and a slip front, is at r.
        self.edge_arrived, self.front_arrived = (
            distance[:, :, None] for distance in arrival(cycle.load, coordinate, position, self.at[..., 0])
        )
        self.growth = GrowthIntegrals(cycle, coordinate, position, digits)
        #: Shape (3, n, X, i·d): T1, T3, Π up to a front in each piece are base − slope · A(front), for lines.
        self.base = self._base()

    def _base(self) -> FloatArray:
        """Integrals over all pieces inside of each piece, and slope · A at its start."""
        memory, (n, columns) = self.cycle.memory, self.position.shape
        starts = np.where(np.isfinite(memory.start), memory.start, 0.0)
        breakpoints, number = distinct(starts.reshape(n, -1))
        radius = self.coordinate.radius(breakpoints)
        at_start = np.empty((3, n, columns, *starts.shape[1:]))
        for component, values in zip(at_start, self._full_slip(radius[:, None]), strict=True):
            component[...] = gather(values, number[:, None]).reshape(component.shape)
        slope = _line_slope(memory.slope)[:, None]
        piece = -slope[..., :-1] * np.diff(at_start, axis=-1)
        if self.growth.count:
            self._put_growths(piece, gather(radius, number).reshape(starts.shape))
        inside = np.zeros_like(at_start)
        np.cumsum(piece, axis=-1, out=inside[..., 1:])
        return (inside + slope * at_start).reshape(3, n, columns, -1)

    def _put_growths(self, piece: FloatArray, start: FloatArray) -> None:
        """Put the integrals over growths that end at the start of the next piece among those of the lines.

        Parameters
        ----------
        piece
            Shape (3, n, X, i, d − 1).
        start
            Shape (n, i, d): radius at which each piece begins.
        """
        memory, columns = self.cycle.memory, self.position.shape[1]
        finite = np.isfinite(memory.start)
        row, i, d = np.nonzero((finite & (memory.slope == GROWTH))[..., :-1] & finite[..., 1:])
        up_to, index = start[row, i, d + 1], self.growth.index[row, i, d]
        many = np.broadcast_arrays(row[:, None], np.arange(columns), index[:, None], up_to[:, None])
        part = self.growth.up_to(*(values.ravel() for values in many)).reshape(3, row.size, columns)
        piece[:, row, :, i, d] = np.moveaxis(part, 0, 1)

    def _full_slip(self, radius: FloatArray) -> FloatArray:
        """T1, T3 and Π up to ``radius`` (n, X or 1, …), shape (3, n, X, …)."""
        inner, outer = self.primitives.inner(radius), self.primitives.outer(radius)
        return np.concatenate([inner, outer[:1]])

    def history(self, nodes: Nodes) -> History:
        """Stress building blocks at the given instants, index of shape (n, X, T)."""
        states = self.cycle.states(nodes.interval, nodes.instant)
        profile, edge_radius = self.coordinate.profile, self.coordinate.radius(states.edge)
        edge = self._spread_radius(nodes, states.edge, edge_radius, self.edge_arrived)
        r = self.position[:, :, None]
        inner, outer = self.primitives.inner(edge), self.primitives.outer(edge)
        tangential = self._tangential(nodes, states, (*inner, outer[0]))
        # What the springs inside r carry, and what those outside press on the inside.
        load = nodes.spread(profile.half_load(edge_radius))
        inside = np.minimum(load, profile.half_load(self.position)[:, :, None])
        return History(outer[0] / np.pi, (2.0 / np.pi) * (inside / (r * r) + outer[1]), *tangential)

    def _spread_radius(
        self, nodes: Nodes, coordinate: FloatArray, radius: FloatArray, arrived: FloatArray
    ) -> FloatArray:
        """Radii at the distinct instants, (n, k), at the positions, (n, X, T): r where they arrive there."""
        spread = nodes.spread(radius)
        arrives = np.abs(nodes.spread(coordinate) - self.at) <= arrived
        np.copyto(spread, self.position[:, :, None], where=arrives)
        return spread

    def _tangential(self, nodes: Nodes, states: SlipStates, at_edge: tuple[FloatArray, ...]) -> FloatArray:
        """T1, T3 and the traction, each over π, from the full-slip integrals up to the edge, (3, n, X, T)."""
        memory, (n, columns) = self.cycle.memory, self.position.shape
        place = nodes.interval * memory.start.shape[-1] + states.piece
        slope = gather(memory.slope.reshape(n, -1), place)
        front = self._spread_radius(
            nodes, states.front, self.coordinate.radius(states.front), self.front_arrived
        )
        at_place, sign = nodes.spread(place), nodes.spread(states.sign)
        bend = sign - nodes.spread(_line_slope(slope))
        rows, places = np.arange(n)[:, None, None], self.base.shape[-1]
        of_base = (rows * columns + np.arange(columns)[:, None]) * places + at_place
        total = self._full_slip(front)
        for result, base, edge_part in zip(total, self.base, at_edge, strict=True):
            result *= bend
            result += base.ravel().take(of_base)
            result -= sign * edge_part
        grown = slope == GROWTH
        if np.any(grown):
            # The part of a growth inside of the front, where the front cuts it.
            row, column, _ = where = np.nonzero(nodes.spread(grown))
            index = self.growth.index.reshape(n, -1)[row, at_place[where]]
            parts = self.growth.up_to(row, column, index, front[where])
            for component, part in zip(total, parts, strict=True):
                component[where] += part
        total /= np.pi
        return total


def _line_slope(slope: FloatArray) -> FloatArray:
    """do/dG of lines, 0 for growths."""
    return np.where(slope == GROWTH, 0.0, slope)
