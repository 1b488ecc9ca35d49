"""Stress on the surface line y = 0, z = 0 over the stationary cycle.

The stress at x is a short sum over the memory diagram: with the full-slip primitives A(r; ξ) of the profile
(`swtstudy.mechanics.profiles.base.Primitives`) a piece of slope do/dG = s from ξ1 to ξ2 contributes
−s [A(ξ2) − A(ξ1)], since τ′ = −o′. Nothing here depends on ν or μ; `combine` brings them in.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import GROWTH, Cycle
from swtstudy.mechanics.gather import gather, packed
from swtstudy.mechanics.growth import GrowthIntegrals
from swtstudy.mechanics.instants import Nodes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile

T = TypeVar("T", bound=np.generic)

#: A front or an edge whose depth is nearer than this to that of r, over the largest depth, has arrived at r.
ARRIVED = 2e-15


@dataclass(frozen=True)
class History:
    """The building blocks of the stress at n × X positions and T instants, each (n, X, T).

    Attributes
    ----------
    pressure
        p in E* √(δ0/R).
    mean_pressure
        Load inside r over π r², same unit.
    tangential_1, tangential_3
        T1 and T3 with the springs' τ′: (1/π) ∫ 2 sin φ τ′ dφ and (1/π) ∫ 2 sin³φ τ′ dφ.
    traction
        (1/π) ∫ τ′ dξ/√(ξ²−r²) over the springs outside r: −q/μ.
    """

    pressure: FloatArray
    mean_pressure: FloatArray
    tangential_1: FloatArray
    tangential_3: FloatArray
    traction: FloatArray

    def take(self, *index: NDArray[np.intp] | int) -> History:
        """The blocks at ``index`` of the leading axes."""
        return History(*(values[index] for values in vars(self).values()))

    def with_tangential_sign(self, sign: float | FloatArray) -> History:
        """The same with the tangential load times ±1."""
        tangential = (sign * v for v in (self.tangential_1, self.tangential_3, self.traction))
        return History(self.pressure, self.mean_pressure, *tangential)

    def joined(self, other: History) -> History:
        """These instants, then the other ones."""
        both = zip(vars(self).values(), vars(other).values(), strict=True)
        return History(*(np.concatenate(pair, axis=-1) for pair in both))


class SurfaceLine:
    """n × X positions on the surface line of n points, ready for any instants.

    Parameters
    ----------
    cycle, profile
        n cycles and n profiles, one pair a point.
    position
        Shape (n, X): r = |x| > 0 in a_H.
    digits
        Digits of the largest stress to which tables and series are made.
    """

    def __init__(self, cycle: Cycle, profile: Profile, position: FloatArray, digits: float) -> None:
        self.cycle, self.profile, self.position = cycle, profile, position
        self.primitives = profile.primitives(position, digits)
        # The stress shows the square root of the distance at which rounding leaves what arrives at r.
        self.depth = profile.depth(position)[:, :, None]
        beyond = profile.depth(position + np.spacing(position))[:, :, None]
        self.arrived = ARRIVED * (1.0 + cycle.protocol.normal_amplitude[:, None, None]) + beyond - self.depth
        memory = cycle.memory
        n, intervals, pieces = memory.start.shape
        finite = np.isfinite(memory.start)
        breakpoints, number = _distinct(np.where(finite, memory.start, 0.0).reshape(n, -1))
        radius = profile.radius(breakpoints)[:, None, :]
        columns = position.shape[1]
        at_start = np.empty((3, n, columns, intervals, pieces))
        number = number[:, None]
        for component, values in zip(at_start, self._full_slip(radius), strict=True):
            component[...] = gather(values, number).reshape(component.shape)

        slope = np.where(memory.slope == GROWTH, 0.0, memory.slope)[:, None]
        # Integral over each complete piece, up to the start of the next one.
        piece = -slope[..., :-1] * np.diff(at_start, axis=-1)
        self.growth = GrowthIntegrals(cycle, profile, position, digits)
        if self.growth.count:
            self.growth_index = self.growth.index(cycle)
            grown = finite & (memory.slope == GROWTH)
            row, i, d = np.nonzero(grown[..., :-1] & finite[..., 1:])
            up_to = gather(radius[:, 0], number[:, 0]).reshape(finite.shape)[row, i, d + 1]
            index = self.growth_index[row, i, d]
            many = np.broadcast_arrays(row[:, None], np.arange(columns), index[:, None], up_to[:, None])
            part = self.growth.up_to(*(values.ravel() for values in many)).reshape(3, row.size, columns)
            piece[:, row, :, i, d] = np.moveaxis(part, 0, 1)
        inside = np.zeros_like(at_start)
        np.cumsum(piece, axis=-1, out=inside[..., 1:])
        #: Shape (3, n, X, i·d): integral up to the front = base − slope · A(front), for lines.
        self.base = (inside + slope * at_start).reshape(3, n, columns, -1)

    def _full_slip(self, radius: FloatArray) -> FloatArray:
        """T1, T3 and Π up to ``radius`` (n, X or 1, …), shape (3, n, X, …)."""
        inner, outer = self.primitives.inner(radius), self.primitives.outer(radius)
        return np.concatenate([inner, outer[:1]])

    def history(self, nodes: Nodes) -> History:
        """Stress building blocks at the given instants, index of shape (n, X, T)."""
        cycle, profile = self.cycle, self.profile
        n, _, pieces = cycle.memory.start.shape
        states = cycle.states(nodes.interval, nodes.instant)
        place = nodes.interval * pieces + states.piece
        slope = gather(cycle.memory.slope.reshape(n, -1), place)
        grown = slope == GROWTH
        slope = np.where(grown, 0.0, slope)
        front_radius, edge_radius = profile.radius(states.front), profile.radius(states.depth)
        half_load = profile.half_load(edge_radius)

        rows = np.arange(n)[:, None, None]
        at = rows * nodes.instant.shape[1] + nodes.index

        def at_positions(values: NDArray[T]) -> NDArray[T]:
            return values.ravel().take(at)

        place, sign, slope = at_positions(place), at_positions(states.sign), at_positions(slope)
        r = self.position[:, :, None]

        def radius_at_positions(depth: FloatArray, radius: FloatArray) -> FloatArray:
            values = at_positions(radius)
            np.copyto(values, r, where=np.abs(at_positions(depth) - self.depth) <= self.arrived)
            return values

        edge = radius_at_positions(states.depth, edge_radius)
        front = radius_at_positions(states.front, front_radius)
        at_front = self._full_slip(front)
        inner, outer = self.primitives.inner(edge), self.primitives.outer(edge)
        columns, places = self.base.shape[2:]
        of_base = (rows * columns + np.arange(columns)[:, None]) * places + place
        bend = sign - slope
        total = at_front
        for result, base, edge_part in zip(total, self.base, (*inner, outer[0]), strict=True):
            result *= bend
            result += base.ravel().take(of_base)
            result -= sign * edge_part
        if np.any(grown):
            self._add_growth(total, at_positions(grown), place, front)
        total /= np.pi
        # What the springs inside r carry, and what those outside press on the inside.
        inside = np.minimum(at_positions(half_load), profile.half_load(self.position)[:, :, None])
        return History(outer[0] / np.pi, (2.0 / np.pi) * (inside / (r * r) + outer[1]), *total)

    def _add_growth(
        self,
        total: FloatArray,
        grown: NDArray[np.bool_],
        place: NDArray[np.intp],
        front_radius: FloatArray,
    ) -> None:
        """Add the part of a growth inside of the front, where the front cuts it."""
        row, column, _ = where = np.nonzero(grown)
        index = self.growth_index.reshape(len(total[0]), -1)[row, place[where]]
        parts = self.growth.up_to(row, column, index, front_radius[where])
        for component, part in zip(total, parts, strict=True):
            component[where] += part


def _distinct(values: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """The distinct values of each row, shape (n, k), and the number of each value, shape of ``values``."""
    order = np.argsort(values, axis=1, kind="stable")
    ascending = gather(values, order)
    new = np.ones(values.shape, dtype=bool)
    new[:, 1:] = ascending[:, 1:] != ascending[:, :-1]
    number = np.empty(values.shape, dtype=np.intp)
    np.put_along_axis(number, order, np.cumsum(new, axis=1) - 1, axis=1)
    return packed(new, ascending)[0], number


def stresses(
    history: History, poisson_ratio: FloatArray, friction: FloatArray, side: float | FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """σ_xx, σ_yy, σ_zz, σ_xz in E* √(δ0/R), tension positive.

    Parameters
    ----------
    history
        Building blocks at r = |x|.
    poisson_ratio, friction
        Shape (n,).
    side
        Sign of x.
    """
    nu, mu = (v.reshape(v.shape + (1,) * (history.pressure.ndim - 1)) for v in (poisson_ratio, friction))
    spread = 0.5 * (1.0 - 2.0 * nu) * history.mean_pressure
    pull = side * mu
    sigma_xx = (
        spread - history.pressure + pull * ((1.0 + nu) * history.tangential_1 - nu * history.tangential_3)
    )
    sigma_yy = -spread - 2.0 * nu * history.pressure + pull * nu * history.tangential_3
    return sigma_xx, sigma_yy, -history.pressure, mu * history.traction
